//! Boxes sorted into nested boxes, to find those that touch a region.

use crate::math::bounds::Bounds;
use glam::Vec3;

/// Boxes in a node that is not divided further.
const LEAF: usize = 4;

/// A balanced tree, each of whose nodes is divided at the median along its longest extent (Bentley 1975).
#[derive(Clone, Debug, Default)]
pub struct BoxTree {
    /// Box `i` of those that were put in is `boxes[i]`.
    boxes: Vec<Bounds>,
    /// Indices of boxes; every node is a range of these, and its two parts are the halves of it.
    order: Vec<u32>,
    /// Node `i` has the parts `2 i + 1` and `2 i + 2`.
    nodes: Vec<Bounds>,
}

impl BoxTree {
    pub fn new(boxes: Vec<Bounds>) -> Self {
        let leaves = boxes.len().div_ceil(LEAF).next_power_of_two();
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = vec![Bounds::EMPTY; 2 * leaves - 1];
        divide(0, &boxes, &mut order, &mut nodes);
        Self { boxes, order, nodes }
    }

    /// Calls `visit` with the index of every box that touches `region`.
    pub fn visit(&self, region: &Bounds, visit: &mut impl FnMut(u32)) {
        if !self.nodes.is_empty() {
            self.visit_node(0, &self.order, region, visit);
        }
    }

    /// Whether `is_wanted` holds for the index of any box that `point` is in; it is asked of each at most once.
    pub fn any_at(&self, point: Vec3, is_wanted: &impl Fn(u32) -> bool) -> bool {
        !self.nodes.is_empty() && self.any_in_node(0, &self.order, &Bounds { min: point, max: point }, is_wanted)
    }

    fn any_in_node(&self, node: usize, boxes: &[u32], region: &Bounds, is_wanted: &impl Fn(u32) -> bool) -> bool {
        if !touch(&self.nodes[node], region) {
            return false;
        }
        if 2 * node + 1 >= self.nodes.len() {
            return boxes.iter().any(|&index| touch(&self.boxes[index as usize], region) && is_wanted(index));
        }
        let (low, high) = boxes.split_at(boxes.len() / 2);
        self.any_in_node(2 * node + 1, low, region, is_wanted)
            || self.any_in_node(2 * node + 2, high, region, is_wanted)
    }

    fn visit_node(&self, node: usize, boxes: &[u32], region: &Bounds, visit: &mut impl FnMut(u32)) {
        if !touch(&self.nodes[node], region) {
            return;
        }
        if 2 * node + 1 >= self.nodes.len() {
            boxes.iter().filter(|&&index| touch(&self.boxes[index as usize], region)).for_each(|&index| visit(index));
            return;
        }
        let (low, high) = boxes.split_at(boxes.len() / 2);
        self.visit_node(2 * node + 1, low, region, visit);
        self.visit_node(2 * node + 2, high, region, visit);
    }
}

fn divide(node: usize, boxes: &[Bounds], order: &mut [u32], nodes: &mut [Bounds]) {
    let bounds = Bounds::of(order.iter().flat_map(|&index| {
        let Bounds { min, max } = boxes[index as usize];
        [min, max]
    }));
    nodes[node] = bounds;
    if 2 * node + 1 >= nodes.len() {
        return;
    }
    let axis = bounds.extent().max_position();
    let along = |index: u32| boxes[index as usize].min[axis] + boxes[index as usize].max[axis];
    let middle = order.len() / 2;
    if middle > 0 {
        order.select_nth_unstable_by(middle, |&a, &b| along(a).total_cmp(&along(b)).then(a.cmp(&b)));
    }
    let (low, high) = order.split_at_mut(middle);
    divide(2 * node + 1, boxes, low, nodes);
    divide(2 * node + 2, boxes, high, nodes);
}

fn touch(a: &Bounds, b: &Bounds) -> bool {
    a.min.cmple(b.max).all() && b.min.cmple(a.max).all()
}

/// The box with this much added on every side.
pub fn grown(bounds: &Bounds, by: f32) -> Bounds {
    Bounds { min: bounds.min - Vec3::splat(by), max: bounds.max + Vec3::splat(by) }
}
