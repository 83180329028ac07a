//! Sides of polygons that bound the same space.

use super::surface::Surfaces;
use crate::math::warp::frame;
use crate::mesh::side_index;
use crate::scene::Scene;
use glam::Vec3A;
use std::collections::HashMap;

/// Sides joined across edges.
pub struct Shells {
    /// The shell of each side.
    pub of_side: Vec<usize>,
    pub count: usize,
}

/// Joins sides that meet at an edge with nothing between them. Where more than two polygons share an edge, they are
/// taken in their order round it. An edge of one polygon alone joins nothing: light would have to turn round it.
pub fn shells(scene: &Scene, surfaces: &Surfaces) -> Shells {
    let mut joined = UnionFind((0..2 * surfaces.len()).collect());
    let mut edges: HashMap<(u32, u32), Vec<EdgeUse>> = HashMap::new();
    for (index, polygon) in scene.polygons.iter().enumerate() {
        let corners = polygon.corners();
        for (i, &from) in corners.iter().enumerate() {
            let to = corners[(i + 1) % corners.len()];
            let use_ = EdgeUse { polygon: index as u32, runs_up: from < to };
            edges.entry((from.min(to), from.max(to))).or_default().push(use_);
        }
    }
    for ((from, to), uses) in &mut edges {
        let axis = Vec3A::from(scene.positions[*to as usize] - scene.positions[*from as usize]).normalize_or_zero();
        sort_round(axis, uses, surfaces);
        for (i, this) in uses.iter().enumerate().filter(|_| uses.len() > 1) {
            let next = &uses[(i + 1) % uses.len()];
            joined.join(side_index(this.polygon, this.runs_up), side_index(next.polygon, !next.runs_up));
        }
    }
    joined.into_shells()
}

/// A polygon at an edge, and whether its corners run along the edge from the lower to the higher index.
struct EdgeUse {
    polygon: u32,
    runs_up: bool,
}

/// Sorts the polygons at an edge by their angle round it. The front of a polygon that runs up looks towards growing
/// angles, its back towards falling ones; of one that runs down it is the other way round.
fn sort_round(axis: Vec3A, uses: &mut [EdgeUse], surfaces: &Surfaces) {
    if uses.len() < 3 {
        return;
    }
    let round = frame(axis);
    let angle = |edge_use: &EdgeUse| {
        let normal = surfaces.normal(side_index(edge_use.polygon, edge_use.runs_up));
        let outward = normal.cross(axis);
        outward.dot(round.y_axis).atan2(outward.dot(round.x_axis))
    };
    uses.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
}

/// Disjoint sets with path halving (Tarjan, van Leeuwen 1984).
struct UnionFind(Vec<usize>);

impl UnionFind {
    fn root(&mut self, mut item: usize) -> usize {
        while self.0[item] != item {
            self.0[item] = self.0[self.0[item]];
            item = self.0[item];
        }
        item
    }

    /// The smaller root stays, so the result does not depend on the order of joins.
    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b)] = a.min(b);
    }

    fn into_shells(mut self) -> Shells {
        let mut numbers = HashMap::new();
        let of_side = (0..self.0.len()).map(|side| {
            let root = self.root(side);
            let next = numbers.len();
            *numbers.entry(root).or_insert(next)
        });
        let of_side: Vec<usize> = of_side.collect();
        Shells { of_side, count: numbers.len() }
    }
}
