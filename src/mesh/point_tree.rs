//! Points sorted into nested boxes, to find those in a region.

use crate::math::bounds::Bounds;
use glam::Vec3;

/// Points in a box that is not divided further.
const LEAF: usize = 8;

/// A balanced tree of boxes, each divided at the median of its longest extent (Bentley 1975).
pub(super) struct PointTree<'a> {
    positions: &'a [Vec3],
    /// Indices of points; every node is a range of these.
    order: Vec<u32>,
    /// Node `i` has the children `2 i + 1` and `2 i + 2`.
    boxes: Vec<Bounds>,
}

impl<'a> PointTree<'a> {
    /// A tree of those `positions` whose indices are given.
    pub fn new(positions: &'a [Vec3], indices: Vec<u32>) -> Self {
        let leaves = indices.len().div_ceil(LEAF).next_power_of_two();
        let mut tree = Self { positions, order: indices, boxes: vec![Bounds::EMPTY; 2 * leaves - 1] };
        let mut order = std::mem::take(&mut tree.order);
        tree.divide(0, &mut order);
        tree.order = order;
        tree
    }

    fn divide(&mut self, node: usize, points: &mut [u32]) {
        let positions = self.positions;
        let bounds = Bounds::of(points.iter().map(|&point| positions[point as usize]));
        self.boxes[node] = bounds;
        if self.is_leaf(node) {
            return;
        }
        let axis = bounds.extent().max_position();
        let along = |point: u32| positions[point as usize][axis];
        let middle = points.len() / 2;
        points.select_nth_unstable_by(middle, |&a, &b| along(a).total_cmp(&along(b)));
        let (low, high) = points.split_at_mut(middle);
        self.divide(2 * node + 1, low);
        self.divide(2 * node + 2, high);
    }

    fn is_leaf(&self, node: usize) -> bool {
        2 * node + 1 >= self.boxes.len()
    }

    /// Calls `visit` with the index of every point in `region`, and perhaps of some near it.
    pub fn visit(&self, region: &Bounds, visit: &mut impl FnMut(u32)) {
        self.visit_node(0, &self.order, region, visit);
    }

    fn visit_node(&self, node: usize, points: &[u32], region: &Bounds, visit: &mut impl FnMut(u32)) {
        let bounds = &self.boxes[node];
        if bounds.min.cmpgt(region.max).any() || bounds.max.cmplt(region.min).any() {
            return;
        }
        if self.is_leaf(node) {
            points.iter().for_each(|&point| visit(point));
            return;
        }
        let (low, high) = points.split_at(points.len() / 2);
        self.visit_node(2 * node + 1, low, region, visit);
        self.visit_node(2 * node + 2, high, region, visit);
    }
}
