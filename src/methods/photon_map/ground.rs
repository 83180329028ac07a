//! Which surfaces go on in each other, so that photons on one say something about light on the other.

use super::border::{Border, Segment};
use super::facet::{Facet, Limits};
use crate::math::bounds::Bounds;
use crate::math::box_tree::{BoxTree, grown};
use crate::methods::transport::{Surface, Transport};
use glam::Vec3A;
use rayon::prelude::*;

/// The surfaces of a scene, joined where they go on without a crease, and where each ends.
pub struct Ground {
    /// Of each side, as in [`crate::mesh::Mesh::sides`]: the lowest side that it is joined with.
    groups: Vec<u32>,
    /// Of each group, by its lowest side: whether it bends.
    is_curved: Vec<bool>,
    facets: Vec<Facet>,
    limits: Limits,
    segments: Vec<Segment>,
    tree: BoxTree,
}

impl Ground {
    pub fn new(transport: &Transport) -> Self {
        let world = &transport.world;
        let limits = Limits::new(&world.bounds, world.tracer.offset());
        let facets: Vec<Facet> = world.scene.polygons.iter().map(|polygon| Facet::new(&world.scene, polygon)).collect();
        let neighbours = neighbours(&facets, limits.touching);
        let mut groups = Groups::new(facets.len());
        for (polygon, others) in neighbours.iter().enumerate() {
            for &other in others.iter().filter(|&&other| other as usize > polygon) {
                groups.join(&facets, polygon, other as usize, &limits);
            }
        }
        let Groups { lowest, is_curved } = groups.flat();
        let border = Border { facets: &facets, groups: &lowest, limits };
        let segments: Vec<Segment> = (0..lowest.len())
            .into_par_iter()
            .filter(|&side| world.mesh.sides[side].is_some())
            .flat_map_iter(|side| border.of(side, &neighbours[side / 2]))
            .collect();
        let tree = BoxTree::new(segments.iter().map(|segment| Bounds::of(segment.ends.map(Into::into))).collect());
        Self { groups: lowest, is_curved, facets, limits, segments, tree }
    }

    /// The group of a side.
    pub fn group(&self, side: u32) -> u32 {
        self.groups[side as usize]
    }

    /// Whether a group bends, so that not all that is on it goes on evenly from a place of it.
    pub fn is_curved(&self, group: u32) -> bool {
        self.is_curved[group as usize]
    }

    /// Unit normal of a side.
    pub fn facing(&self, side: u32) -> Vec3A {
        self.facets[side as usize / 2].facing(side as usize)
    }

    /// A place of a surface, moved off the outline of its polygon to the inside, where rounding may have taken it to the
    /// outside.
    pub fn inside(&self, at: &Surface) -> Vec3A {
        let to_middle = self.facets[at.polygon as usize].center() - at.point;
        at.point + (2.0 * self.limits.flat) * to_middle.normalize_or_zero()
    }

    /// Calls `visit` with every segment at which a group ends that may be within `radius`, m, of a point.
    pub fn segments(&self, group: u32, point: Vec3A, radius: f32, mut visit: impl FnMut(&Segment)) {
        let region = grown(&Bounds { min: point.into(), max: point.into() }, radius);
        self.tree.visit(&region, &mut |index| {
            let segment = &self.segments[index as usize];
            if segment.group == group {
                visit(segment);
            }
        });
    }
}

/// Of each polygon those that it may touch.
fn neighbours(facets: &[Facet], touching: f32) -> Vec<Vec<u32>> {
    let bounds: Vec<Bounds> = facets.iter().map(|facet| grown(&facet.bounds(), touching)).collect();
    let tree = BoxTree::new(bounds.clone());
    let of = |(polygon, region): (usize, &Bounds)| {
        let mut others = Vec::new();
        tree.visit(region, &mut |other| others.push(other));
        others.retain(|&other| other as usize != polygon);
        others.sort_unstable();
        others
    };
    bounds.par_iter().enumerate().map(of).collect()
}

/// Sides joined with each other: disjoint sets with path halving (Tarjan, van Leeuwen 1984).
struct Groups {
    /// Of each side one that it is joined with, and is not higher.
    lowest: Vec<u32>,
    is_curved: Vec<bool>,
}

impl Groups {
    fn new(polygons: usize) -> Self {
        Self { lowest: (0..2 * polygons as u32).collect(), is_curved: vec![false; 2 * polygons] }
    }

    /// Joins the sides of two polygons that go on in each other, if they do.
    fn join(&mut self, facets: &[Facet], a: usize, b: usize, limits: &Limits) {
        let (facet, other) = (&facets[a], &facets[b]);
        let is_flat = facet.is_coplanar(other, limits);
        if !is_flat && !facet.is_smooth(other, limits) {
            return;
        }
        // Fronts belong together, or the front of one and the back of the other.
        let turned = usize::from(facet.normal.dot(other.normal) < 0.0);
        for side in 0..2 {
            let (low, high) = (self.root(2 * a + side), self.root(2 * b + (side ^ turned)));
            let (low, high) = (low.min(high), low.max(high));
            self.lowest[high as usize] = low;
            self.is_curved[low as usize] |= self.is_curved[high as usize] || !is_flat;
        }
    }

    fn root(&mut self, side: usize) -> u32 {
        let mut side = side as u32;
        while self.lowest[side as usize] != side {
            self.lowest[side as usize] = self.lowest[self.lowest[side as usize] as usize];
            side = self.lowest[side as usize];
        }
        side
    }

    /// The same with every side led to its lowest at once.
    fn flat(mut self) -> Self {
        for side in 0..self.lowest.len() {
            self.lowest[side] = self.root(side);
        }
        self
    }
}
