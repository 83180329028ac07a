//! Which emitter a place looks at: emitters in a tree, each of whose parts is chosen by an estimate of the irradiance that it
//! gives there (Conty Estevez, Kulla 2018). So a weak lamp is found beside it, and a strong one is not looked for behind it.

use super::Surface;
use super::emitter::Emitter;
use crate::math::bounds::Bounds;
use crate::math::rgb::total;
use glam::Vec3A;

/// Parts of a node: single precision numbers in a register.
const WIDTH: usize = 8;
/// Squared radii are taken for so much larger than they are, so that rounding hides no emitter.
const MARGIN: f32 = 1.002;
/// Cosines of two unit vectors are known to this.
const COSINE_ROUNDING: f32 = 6.0 * f32::EPSILON;
/// Marks parts of more than one emitter, and parts of none: neither a polygon nor [`SPACE`](crate::tracer::SPACE).
const GROUP: u32 = u32::MAX - 1;
/// The parent of the first node.
const NOWHERE: Slot = Slot { node: u32::MAX, part: 0 };

/// Emitters in groups of groups: each is divided at the median along its longest extent until there are eight parts.
#[derive(Default)]
pub struct EmitterTree {
    nodes: Vec<Node>,
    /// Where each emitter is a part.
    places: Vec<Slot>,
}

/// Eight parts, or fewer, of which the rest have no flux: for each the sphere round it, and the cone round its normals.
struct Node {
    /// m
    center: [[f32; WIDTH]; 3],
    /// m²
    squared_radius: [f32; WIDTH],
    axis: [[f32; WIDTH]; 3],
    /// Of half the angle of the cone.
    spread_cosine: [f32; WIDTH],
    spread_sine: [f32; WIDTH],
    /// W, summed over the channels.
    flux: [f32; WIDTH],
    /// Index of the node, or of the emitter where there is but one.
    index: [u32; WIDTH],
    /// Of the emitter, or [`GROUP`].
    polygon: [u32; WIDTH],
    /// Of which this node is a part.
    parent: Slot,
}

/// One part of a node.
#[derive(Clone, Copy)]
struct Slot {
    node: u32,
    part: u32,
}

/// The emitter that a number chose.
pub struct Choice {
    pub emitter: usize,
    pub probability: f32,
    /// What is left of the number, in [0, 1).
    pub rest: f32,
}

impl EmitterTree {
    pub(super) fn new(emitters: &[Emitter]) -> Self {
        let mut tree = Self { nodes: Vec::new(), places: vec![NOWHERE; emitters.len()] };
        if !emitters.is_empty() {
            let mut order: Vec<u32> = (0..emitters.len() as u32).collect();
            tree.add(emitters, &mut order, NOWHERE);
        }
        tree
    }

    /// Adds a node of these emitters, and all nodes below it.
    fn add(&mut self, emitters: &[Emitter], order: &mut [u32], parent: Slot) {
        let node = self.nodes.len();
        self.nodes.push(Node::new(parent));
        for (part, members) in divided(emitters, order, WIDTH).into_iter().enumerate() {
            let slot = Slot { node: node as u32, part: part as u32 };
            self.nodes[node].set(part, members.iter().map(|&index| &emitters[index as usize]));
            if let [emitter] = *members {
                self.nodes[node].index[part] = emitter;
                self.nodes[node].polygon[part] = emitters[emitter as usize].polygon;
                self.places[emitter as usize] = slot;
            } else {
                self.nodes[node].index[part] = self.nodes.len() as u32;
                self.add(emitters, members, slot);
            }
        }
    }

    /// The emitter that a number in [0, 1) chooses for a place; `None` where no emitter shines on the place.
    pub fn choose(&self, surface: &Surface, mut number: f32) -> Option<Choice> {
        if let [_] = *self.places {
            return Some(Choice { emitter: 0, probability: 1.0, rest: number });
        }
        let (mut node, mut probability) = (self.nodes.first()?, 1.0);
        loop {
            let irradiance = node.irradiance(surface);
            let mut sum = 0.0;
            let ends = irradiance.map(|of_part| {
                sum += of_part;
                sum
            });
            if sum <= 0.0 {
                return None;
            }
            // A little less, so that rounding does not lead past the last part.
            let at = number * sum * (1.0 - f32::EPSILON);
            let part = ends.iter().filter(|&&end| end <= at).count();
            let start = ends[part] - irradiance[part];
            number = ((at - start) / irradiance[part]).clamp(0.0, 1.0 - f32::EPSILON);
            probability *= irradiance[part] / sum;
            if node.polygon[part] != GROUP {
                return Some(Choice { emitter: node.index[part] as usize, probability, rest: number });
            }
            node = &self.nodes[node.index[part] as usize];
        }
    }

    /// The probability with which [`EmitterTree::choose`] chooses an emitter for a place.
    pub fn probability(&self, surface: &Surface, emitter: usize) -> f32 {
        if let [_] = *self.places {
            return 1.0;
        }
        let mut slot = self.places[emitter];
        let mut probability = 1.0;
        while let Some(node) = self.nodes.get(slot.node as usize) {
            let irradiance = node.irradiance(surface);
            let of_part = irradiance[slot.part as usize];
            // Before it is divided: 0 of nothing is 0.
            if of_part <= 0.0 {
                return 0.0;
            }
            probability *= of_part / irradiance.iter().sum::<f32>();
            slot = node.parent;
        }
        probability
    }
}

/// Emitters in so many groups, or in groups of one.
fn divided<'a>(emitters: &[Emitter], order: &'a mut [u32], groups: usize) -> Vec<&'a mut [u32]> {
    if groups == 1 || order.len() == 1 {
        return vec![order];
    }
    let middle = |emitter: u32| emitters[emitter as usize].bounds().center();
    let axis = Bounds::of(order.iter().map(|&emitter| middle(emitter))).extent().max_position();
    let half = order.len() / 2;
    order.select_nth_unstable_by(half, |&a, &b| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.cmp(&b)));
    let (low, high) = order.split_at_mut(half);
    let mut parts = divided(emitters, low, groups / 2);
    parts.extend(divided(emitters, high, groups / 2));
    parts
}

impl Node {
    fn new(parent: Slot) -> Self {
        Self {
            center: [[0.0; WIDTH]; 3],
            squared_radius: [1.0; WIDTH],
            axis: [[0.0; WIDTH]; 3],
            spread_cosine: [1.0; WIDTH],
            spread_sine: [0.0; WIDTH],
            flux: [0.0; WIDTH],
            index: [u32::MAX; WIDTH],
            polygon: [GROUP; WIDTH],
            parent,
        }
    }

    fn set<'a>(&mut self, part: usize, members: impl Iterator<Item = &'a Emitter> + Clone) {
        let corners = members.clone().flat_map(|emitter| emitter.corners());
        let bounds = Bounds::of(corners.map(|&corner| corner.into()));
        let sum: Vec3A = members.clone().map(|emitter| emitter.normal).sum();
        let axis = sum.try_normalize().unwrap_or(Vec3A::Z);
        let least = members.clone().map(|emitter| axis.dot(emitter.normal)).fold(1.0, f32::min);
        let spread_cosine = (least - COSINE_ROUNDING).max(-1.0);
        for i in 0..3 {
            self.center[i][part] = bounds.center()[i];
            self.axis[i][part] = axis[i];
        }
        self.squared_radius[part] = MARGIN * bounds.radius().powi(2);
        self.spread_cosine[part] = spread_cosine;
        self.spread_sine[part] = (1.0 - spread_cosine * spread_cosine).sqrt();
        self.flux[part] = members.map(|emitter| total(emitter.flux())).sum::<f64>() as f32;
    }

    /// Of each part, flux over the squared distance, times the largest cosines that there may be at both ends: in proportion to
    /// a rough irradiance, and 0 only where there is none. Without branches, so that all parts are computed at once.
    #[inline]
    fn irradiance(&self, surface: &Surface) -> [f32; WIDTH] {
        let [x, y, z] = &self.center;
        let [axis_x, axis_y, axis_z] = &self.axis;
        let (point, facing) = (surface.point, surface.facing);
        let mut irradiance = [0.0; WIDTH];
        for i in 0..WIDTH {
            let (x, y, z) = (point.x - x[i], point.y - y[i], point.z - z[i]);
            let squared_distance = x * x + y * y + z * z;
            let per_distance = squared_distance.sqrt().recip();
            let squared_radius = self.squared_radius[i];
            let squared_sine = squared_radius / squared_distance;
            let blur = Angle { cosine: (1.0 - squared_sine).max(0.0).sqrt(), sine: squared_sine.min(1.0).sqrt() };
            let spread = Angle { cosine: self.spread_cosine[i], sine: self.spread_sine[i] };
            let leaving = Angle::of_cosine((axis_x[i] * x + axis_y[i] * y + axis_z[i] * z) * per_distance);
            let arriving = Angle::of_cosine(-(facing.x * x + facing.y * y + facing.z * z) * per_distance);
            let cosines = leaving.less(spread).less(blur).cosine.max(0.0) * arriving.less(blur).cosine.max(0.0);
            let flux = if self.polygon[i] == surface.polygon { 0.0 } else { self.flux[i] };
            let is_outside = squared_distance > squared_radius;
            irradiance[i] = flux * if is_outside { cosines / squared_distance } else { squared_radius.recip() };
        }
        irradiance
    }
}

/// An angle in [0, π].
#[derive(Clone, Copy)]
struct Angle {
    cosine: f32,
    sine: f32,
}

impl Angle {
    #[inline(always)]
    fn of_cosine(cosine: f32) -> Self {
        Self { cosine, sine: (1.0 - cosine * cosine).max(0.0).sqrt() }
    }

    /// The difference, or 0 where it is negative.
    #[inline(always)]
    fn less(self, other: Self) -> Self {
        let is_negative = self.cosine > other.cosine;
        let cosine = self.cosine * other.cosine + self.sine * other.sine;
        let sine = self.sine * other.cosine - self.cosine * other.sine;
        Self { cosine: if is_negative { 1.0 } else { cosine }, sine: if is_negative { 0.0 } else { sine } }
    }
}
