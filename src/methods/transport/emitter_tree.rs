//! Importance sampling of many emitters by a light tree (Conty Estevez, Kulla 2018): each child of a node is chosen by an estimate
//! of the irradiance that it gives at a place.

use super::Surface;
use super::emitter::Emitter;
use crate::math::bounds::Bounds;
use crate::math::rgb::total;
use glam::Vec3A;

/// Children of a node: single precision numbers in a register.
const WIDTH: usize = 8;
/// Squared radii are taken for so much larger than they are, so that rounding hides no emitter.
const MARGIN: f32 = 1.002;
/// Cosines of two unit vectors are known to this.
const COSINE_ROUNDING: f32 = 6.0 * f32::EPSILON;
/// Marks children of more than one emitter, and those that are none: neither a polygon nor [`SPACE`](crate::tracer::SPACE).
const GROUP: u32 = u32::MAX - 1;
/// The parent of the first node.
const NO_PARENT: ChildIndex = ChildIndex { node: u32::MAX, child: 0 };

/// Emitters in groups of groups, divided where the groups become small and the bright ones smallest.
#[derive(Default)]
pub struct EmitterTree {
    nodes: Vec<Node>,
    /// Where each emitter is a child.
    leaves: Vec<ChildIndex>,
    /// 1 over the radius of the scene's emitters, 1/m: squared distances are in units of it, so that they do not underflow.
    per_unit: f32,
}

/// Bounding spheres of up to eight children, and bounding cones of their normals. Unused children have no flux.
struct Node {
    /// m
    center: [[f32; WIDTH]; 3],
    /// In squared units of the tree.
    squared_radius: [f32; WIDTH],
    axis: [[f32; WIDTH]; 3],
    /// Of half the angle of the cone.
    spread_cosine: [f32; WIDTH],
    spread_sine: [f32; WIDTH],
    /// As a share of all.
    flux: [f32; WIDTH],
    /// Index of the node, or of the emitter where there is but one.
    index: [u32; WIDTH],
    /// Of the emitter, or [`GROUP`].
    polygon: [u32; WIDTH],
    parent: ChildIndex,
}

/// One child of a node.
#[derive(Clone, Copy)]
struct ChildIndex {
    node: u32,
    child: u32,
}

/// The emitter that a number chose.
pub struct ChosenEmitter {
    pub index: usize,
    pub probability: f32,
    /// What is left of the number, in [0, 1).
    pub rest: f32,
}

impl EmitterTree {
    pub(super) fn new(emitters: &[Emitter]) -> Self {
        let bounds = bounds_of(emitters.iter());
        let per_unit = bounds.radius().max(f32::MIN_POSITIVE).recip();
        let mut tree = Self { nodes: Vec::new(), leaves: vec![NO_PARENT; emitters.len()], per_unit };
        if !emitters.is_empty() {
            let flux: f64 = emitters.iter().map(|emitter| total(emitter.flux())).sum();
            let mut order: Vec<u32> = (0..emitters.len() as u32).collect();
            tree.add(emitters, flux, &mut order, NO_PARENT);
        }
        tree
    }

    /// Adds a node of these emitters, and all nodes below it.
    fn add(&mut self, emitters: &[Emitter], flux: f64, order: &mut [u32], parent: ChildIndex) {
        let node = self.nodes.len();
        self.nodes.push(Node::new(parent));
        for (child, members) in divided(emitters, order).into_iter().enumerate() {
            let at = ChildIndex { node: node as u32, child: child as u32 };
            let per_unit = self.per_unit;
            self.nodes[node].set(child, members.iter().map(|&index| &emitters[index as usize]), flux, per_unit);
            if let [emitter] = *members {
                self.nodes[node].index[child] = emitter;
                self.nodes[node].polygon[child] = emitters[emitter as usize].polygon;
                self.leaves[emitter as usize] = at;
            } else {
                self.nodes[node].index[child] = self.nodes.len() as u32;
                self.add(emitters, flux, members, at);
            }
        }
    }

    /// The emitter that a number in [0, 1) chooses for a place; `None` where no emitter shines on the place.
    pub fn choose(&self, surface: &Surface, mut number: f32) -> Option<ChosenEmitter> {
        let (mut node, mut probability) = (self.nodes.first()?, 1.0);
        loop {
            let importance = node.importance(surface, self.per_unit);
            let mut sum = 0.0;
            let ends = importance.map(|of_child| {
                sum += of_child;
                sum
            });
            // Rounding must not lead past the last one.
            let last = importance.iter().rposition(|&of_child| of_child > 0.0)?;
            let at = number * sum;
            let child = ends.iter().filter(|&&end| end <= at).count().min(last);
            let start = ends[child] - importance[child];
            number = ((at - start) / importance[child]).clamp(0.0, 1.0 - f32::EPSILON);
            probability *= importance[child] / sum;
            if node.polygon[child] != GROUP {
                return Some(ChosenEmitter { index: node.index[child] as usize, probability, rest: number });
            }
            node = &self.nodes[node.index[child] as usize];
        }
    }

    /// The probability with which [`EmitterTree::choose`] chooses an emitter for a place.
    pub fn probability(&self, surface: &Surface, emitter: usize) -> f32 {
        let mut at = self.leaves[emitter];
        let mut probability = 1.0;
        while let Some(node) = self.nodes.get(at.node as usize) {
            let importance = node.importance(surface, self.per_unit);
            let of_child = importance[at.child as usize];
            // Before it is divided: 0 of nothing is 0.
            if of_child <= 0.0 {
                return 0.0;
            }
            probability *= of_child / importance.iter().sum::<f32>();
            at = node.parent;
        }
        probability
    }
}

fn bounds_of<'a>(emitters: impl Iterator<Item = &'a Emitter>) -> Bounds {
    Bounds::of(emitters.flat_map(|emitter| emitter.corners()).map(|&corner| corner.into()))
}

/// Emitters in eight groups, or in groups of one: again and again the group that costs most is divided.
fn divided<'a>(emitters: &[Emitter], order: &'a mut [u32]) -> Vec<&'a mut [u32]> {
    let mut groups = vec![(f32::INFINITY, order)];
    while groups.len() < WIDTH {
        let costs = groups.iter().map(|(cost, group)| if group.len() > 1 { *cost } else { -1.0 });
        let Some((largest, _)) =
            costs.enumerate().filter(|(_, cost)| *cost >= 0.0).max_by(|(_, a), (_, b)| a.total_cmp(b))
        else {
            break;
        };
        let (_, group) = groups.swap_remove(largest);
        groups.extend(halves(emitters, group));
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// A group cut across its longest extent where its two parts cost least, with the cost of each.
fn halves<'a>(emitters: &[Emitter], group: &'a mut [u32]) -> [(f32, &'a mut [u32]); 2] {
    let center = |index: u32| emitters[index as usize].center;
    let axis = Bounds::of(group.iter().map(|&index| center(index).into())).extent().max_position();
    group.sort_unstable_by(|&a, &b| center(a)[axis].total_cmp(&center(b)[axis]).then(a.cmp(&b)));
    let low = costs(emitters, group.iter());
    let mut high = costs(emitters, group.iter().rev());
    high.reverse();
    let middle = group.len() / 2;
    let order = |&a: &usize, &b: &usize| {
        let [[cost_a, off_a], [cost_b, off_b]] =
            [a, b].map(|cut| [low[cut - 1] + high[cut], cut.abs_diff(middle) as f32]);
        cost_a.total_cmp(&cost_b).then(off_a.total_cmp(&off_b))
    };
    let cut = (1..group.len()).min_by(order).unwrap_or(middle);
    let (first, second) = group.split_at_mut(cut);
    [(low[cut - 1], first), (high[cut], second)]
}

/// Of the first emitter, the first two and so on: flux times the squared radius.
fn costs<'a>(emitters: &[Emitter], order: impl Iterator<Item = &'a u32>) -> Vec<f32> {
    let (mut bounds, mut flux) = (Bounds::EMPTY, 0.0);
    order
        .map(|&index| {
            let emitter = &emitters[index as usize];
            let own = emitter.bounds();
            bounds = Bounds { min: bounds.min.min(own.min), max: bounds.max.max(own.max) };
            flux += total(emitter.flux());
            (flux * f64::from(bounds.radius()).powi(2)) as f32
        })
        .collect()
}

impl Node {
    fn new(parent: ChildIndex) -> Self {
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

    fn set<'a>(
        &mut self,
        child: usize,
        members: impl Iterator<Item = &'a Emitter> + Clone,
        flux_of_all: f64,
        per_unit: f32,
    ) {
        let bounds = bounds_of(members.clone());
        let sum: Vec3A = members.clone().map(|emitter| emitter.normal).sum();
        let axis = sum.try_normalize().unwrap_or(Vec3A::Z);
        let least = members.clone().map(|emitter| axis.dot(emitter.normal)).fold(1.0, f32::min);
        let spread_cosine = (least - COSINE_ROUNDING).max(-1.0);
        for i in 0..3 {
            self.center[i][child] = bounds.center()[i];
            self.axis[i][child] = axis[i];
        }
        let radius = bounds.radius() + f32::EPSILON * bounds.magnitude();
        self.squared_radius[child] = MARGIN * (radius * per_unit).powi(2);
        self.spread_cosine[child] = spread_cosine;
        self.spread_sine[child] = (1.0 - spread_cosine * spread_cosine).sqrt();
        self.flux[child] = (members.map(|emitter| total(emitter.flux())).sum::<f64>() / flux_of_all) as f32;
    }

    /// Of each child, flux over the squared distance, times the largest cosines that there may be at both ends: 0 only where it
    /// gives no irradiance. Without branches, so that all children are computed at once.
    #[inline]
    fn importance(&self, surface: &Surface, per_unit: f32) -> [f32; WIDTH] {
        let [x, y, z] = &self.center;
        let [axis_x, axis_y, axis_z] = &self.axis;
        let (point, facing) = (surface.point, surface.facing);
        let mut importance = [0.0; WIDTH];
        for i in 0..WIDTH {
            let [x, y, z] = [point.x - x[i], point.y - y[i], point.z - z[i]].map(|way| way * per_unit);
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
            importance[i] = flux * if is_outside { cosines / squared_distance } else { squared_radius.recip() };
        }
        importance
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
