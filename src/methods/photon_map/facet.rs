//! Polygons as flat pieces that lie next to each other.

use crate::math::bounds::Bounds;
use crate::math::polygon::vector_area;
use crate::scene::{Polygon, Scene};
use glam::{DVec3, Vec3, Vec3A};

/// Surfaces that are nearer to each other than this share of the scene's radius touch: no light gets between them.
const TOUCHING: f32 = 4e-4;
/// Cosine of the largest angle at which polygons that share an edge are taken for one smooth surface: 30°.
const SMOOTH: f32 = 0.866;

/// Lengths that count as nothing.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// What is no farther from a plane lies on it, m.
    pub flat: f32,
    /// No light gets between surfaces that are no farther apart, m.
    pub touching: f32,
}

impl Limits {
    /// For a scene with these bounds whose coordinates are known to `rounding`, m.
    pub fn new(bounds: &Bounds, rounding: f32) -> Self {
        Self { flat: 2.0 * rounding, touching: (TOUCHING * bounds.radius()).max(4.0 * rounding) }
    }
}

/// A planar convex polygon.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    corners: [Vec3A; 4],
    count: usize,
    /// Unit normal of the front.
    pub normal: Vec3A,
}

impl Facet {
    pub fn new(scene: &Scene, polygon: &Polygon) -> Self {
        let indices = polygon.corners();
        let corner = |i: usize| scene.positions[indices[i.min(indices.len() - 1)] as usize];
        let corners = [0, 1, 2, 3].map(corner);
        let precise: Vec<DVec3> = corners[..indices.len()].iter().map(|corner| corner.as_dvec3()).collect();
        Self {
            corners: corners.map(Vec3A::from),
            count: indices.len(),
            normal: vector_area(&precise).normalize_or_zero().as_vec3a(),
        }
    }

    pub fn corners(&self) -> &[Vec3A] {
        &self.corners[..self.count]
    }

    pub fn center(&self) -> Vec3A {
        self.corners().iter().sum::<Vec3A>() / self.count as f32
    }

    pub fn bounds(&self) -> Bounds {
        Bounds::of(self.corners().iter().map(|&corner| Vec3::from(corner)))
    }

    /// Unit normal on a side as in [`crate::mesh::Mesh::sides`].
    pub fn facing(&self, side: usize) -> Vec3A {
        if side.is_multiple_of(2) { self.normal } else { -self.normal }
    }

    /// From corner to corner, counter-clockwise seen from the front.
    pub fn edges(&self) -> impl Iterator<Item = [Vec3A; 2]> + Clone + '_ {
        let corners = self.corners();
        (0..corners.len()).map(move |i| [corners[i], corners[(i + 1) % corners.len()]])
    }

    /// Of its corners, the lowest and highest above the plane of `other`, m, on the side to which `facing` points.
    pub fn heights_over(&self, other: &Self, facing: Vec3A) -> [f32; 2] {
        let heights = self.corners().iter().map(|&corner| (corner - other.corners[0]).dot(facing));
        heights.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], height| [low.min(height), high.max(height)])
    }

    /// Whether each lies in the plane of the other.
    pub fn is_coplanar(&self, other: &Self, limits: &Limits) -> bool {
        let lies_in = |a: &Self, b: &Self| {
            let [low, high] = a.heights_over(b, b.normal);
            low >= -limits.flat && high <= limits.flat
        };
        lies_in(self, other) && lies_in(other, self)
    }

    /// Whether they share an edge and go on in each other there without a crease.
    pub fn is_smooth(&self, other: &Self, limits: &Limits) -> bool {
        self.edges().any(|edge| self.goes_on_at(edge, other, limits))
    }

    /// Whether an edge is one of the other polygon's as well, and this polygon goes on in that one there without a crease.
    pub fn goes_on_at(&self, [from, to]: [Vec3A; 2], other: &Self, limits: &Limits) -> bool {
        let same = |a: Vec3A, b: Vec3A| a.distance_squared(b) <= limits.flat * limits.flat;
        let cosine = self.normal.dot(other.normal);
        other.edges().any(|[start, end]| {
            // The fronts are on one side where the edge runs to and fro, front and back where it runs the same way in both.
            (same(start, to) && same(end, from) && cosine >= SMOOTH)
                || (same(start, from) && same(end, to) && cosine <= -SMOOTH)
        })
    }

    /// The part of a line that runs over this polygon or less than `slack`, m, past it, as seen along its normal: where it
    /// begins and ends, as shares of the way between the two points.
    pub fn clip(&self, [from, to]: [Vec3A; 2], slack: f32) -> Option<[f32; 2]> {
        let (mut begin, mut end) = (0.0_f32, 1.0_f32);
        for [start, next] in self.edges() {
            let inward = self.normal.cross(next - start).normalize_or_zero();
            let depths = [from, to].map(|point| (point - start).dot(inward) + slack);
            let along = depths[0] / (depths[0] - depths[1]);
            match depths.map(|depth| depth >= 0.0) {
                [true, true] => {}
                [false, true] => begin = begin.max(along),
                [true, false] => end = end.min(along),
                [false, false] => return None,
            }
        }
        (begin < end).then_some([begin, end])
    }
}
