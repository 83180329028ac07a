//! The one door to the bounding volume hierarchy: closest hits, and visibility between two points.
//!
//! A ray that slips between two triangles, or past a surface that is very near, is a light leak, so three guards stand
//! here, each with a test that goes red without it (`tests/tracer.rs`):
//! - Rays are traced in a frame of fixed size, so that nothing depends on the scene's units. The scale is a power of
//!   two and loses no digit.
//! - Boxes are padded by more than the rounding of a box test. This also keeps every hit away from the hierarchy's
//!   absolute cut-off of 1e-4 below which it drops a box.
//! - The triangle test is watertight (Woop, Benthin, Wald 2013): triangles that share an edge leave no gap.

use crate::math::bounds::Bounds;
use glam::{Vec3, Vec3A, Vec3Swizzles};
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::{Ray as FrameRay, RayHit};
use obvhs::{Boundable, BvhBuildParams};
use std::time::Duration;

/// Half the longest extent of the scene in the tracer's frame lies in (256, 512].
const FRAME_HALF_EXTENT: f32 = 512.0;
/// Every point of the scene is nearer to the frame's origin than this: 512 √3, rounded up.
const FRAME_RADIUS: f32 = 1024.0;
/// Added to boxes on every side, in frame units. A slab test at distances up to 2 · 1024 is wrong by at most
/// 3 · 2^-24 · 2048 = 4e-4; the hierarchy drops boxes that end within 1e-4 of the origin.
const BOX_PADDING: f32 = 1.0 / 512.0;
/// Hits are known to about this many units in the last place of the scene's largest coordinate.
const OFFSET_ULPS: f32 = 32.0;

/// A half-line in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    pub origin: Vec3A,
    /// Unit length.
    pub direction: Vec3A,
}

/// Where a ray meets the scene first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Index of the polygon.
    pub polygon: u32,
    /// Distance from the ray's origin, m.
    pub distance: f32,
    /// Whether the ray meets the polygon's front.
    pub is_front: bool,
}

/// Triangles in a bounding volume hierarchy.
pub struct Tracer {
    bvh: CwBvh,
    /// In the order of the hierarchy's leaves, in frame coordinates.
    triangles: Vec<Triangle>,
    /// The polygon of each triangle.
    owners: Vec<u32>,
    center: Vec3A,
    frame_from_world: f32,
    offset: f32,
}

impl Tracer {
    /// Builds the hierarchy over triangles, each with the index of the polygon that it is a part of.
    pub fn new(triangles: &[(u32, [Vec3; 3])]) -> Self {
        let bounds = Bounds::of(triangles.iter().flat_map(|(_, corners)| *corners));
        let center = if bounds.is_empty() { Vec3::ZERO } else { bounds.center() };
        let frame_from_world = frame_scale(bounds.extent().max_element() * 0.5);
        let to_frame = |corner: Vec3| ((corner - center) * frame_from_world).to_array();
        let framed: Vec<Triangle> = triangles.iter().map(|(_, corners)| Triangle::new(corners.map(to_frame))).collect();
        let bvh = build_cwbvh(&framed, BvhBuildParams::medium_build(), &mut Duration::default());
        Self {
            triangles: bvh.primitive_indices.iter().map(|&i| framed[i as usize]).collect(),
            owners: bvh.primitive_indices.iter().map(|&i| triangles[i as usize].0).collect(),
            bvh,
            center: center.into(),
            frame_from_world,
            offset: OFFSET_ULPS * f32::EPSILON * bounds.magnitude(),
        }
    }

    /// The first surface along the ray, if any.
    pub fn closest(&self, ray: &Ray) -> Option<Hit> {
        self.closest_within(ray, f32::INFINITY)
    }

    /// The first surface along the ray that is not farther away than `reach`, m.
    pub fn closest_within(&self, ray: &Ray, reach: f32) -> Option<Hit> {
        let mut origin = self.to_frame(ray.origin);
        // From far away the slabs of a box would round to more than its padding: start near the scene instead.
        let skipped = (origin.length() - 2.0 * FRAME_RADIUS).max(0.0);
        origin += skipped * ray.direction;
        let frame_ray = frame_ray(origin, ray.direction, (reach * self.frame_from_world - skipped).max(0.0));
        let shear = Shear::new(&frame_ray);
        let mut found = RayHit::none();
        let hit = self.bvh.ray_traverse(frame_ray, &mut found, |ray, i| shear.intersect(&self.triangles[i], ray));
        hit.then(|| {
            let i = found.primitive_id as usize;
            Hit {
                polygon: self.owners[i],
                distance: (skipped + found.t) / self.frame_from_world,
                is_front: self.triangles[i].normal().dot(ray.direction) < 0.0,
            }
        })
    }

    /// Whether a ray meets nothing that is not farther away than `reach`, m. It must start in the scene or near it.
    pub fn is_free(&self, ray: &Ray, reach: f32) -> bool {
        let ray = frame_ray(self.to_frame(ray.origin), ray.direction, reach * self.frame_from_world);
        let shear = Shear::new(&ray);
        self.bvh.ray_traverse_miss(ray, |ray, i| shear.intersect(&self.triangles[i], ray))
    }

    /// Whether nothing stands between two points. Both should be off their surfaces: see [`Tracer::lift`].
    pub fn is_visible(&self, from: Vec3A, to: Vec3A) -> bool {
        let origin = self.to_frame(from);
        let way = self.to_frame(to) - origin;
        let distance = way.length();
        if distance == 0.0 {
            return true;
        }
        let ray = frame_ray(origin, way / distance, distance);
        let shear = Shear::new(&ray);
        self.bvh.ray_traverse_miss(ray, |ray, i| shear.intersect(&self.triangles[i], ray))
    }

    /// A point of a surface, moved off it along the unit normal by more than the rounding error of its coordinates:
    /// the origin of rays that must not meet that surface again. (Wächter, Binder 2019 for the idea.)
    pub fn lift(&self, point: Vec3A, normal: Vec3A) -> Vec3A {
        point + self.offset * normal
    }

    /// How far [`Tracer::lift`] moves a point, m.
    pub fn offset(&self) -> f32 {
        self.offset
    }

    fn to_frame(&self, point: Vec3A) -> Vec3A {
        (point - self.center) * self.frame_from_world
    }
}

/// The power of two that brings `half_extent` into (256, 512]; 1 for a scene without extent. Below 1e-36 it is the largest
/// that there is.
fn frame_scale(half_extent: f32) -> f32 {
    let largest = (f32::MAX_EXP - 1) as f32;
    if half_extent > 0.0 { (FRAME_HALF_EXTENT / half_extent).log2().floor().min(largest).exp2() } else { 1.0 }
}

/// Adding zero turns −0 into +0: the hierarchy takes the sign of a component in two ways that differ for −0.
fn frame_ray(origin: Vec3A, direction: Vec3A, limit: f32) -> FrameRay {
    FrameRay::new(origin, direction + Vec3A::ZERO, 0.0, limit)
}

/// Three corners in frame coordinates: all their x, all their y and all their z, so that one instruction works on all three.
#[derive(Clone, Copy, Debug)]
struct Triangle([Vec3A; 3]);

impl Triangle {
    fn new(corners: [[f32; 3]; 3]) -> Self {
        let [a, b, c] = corners;
        Self([0, 1, 2].map(|axis| Vec3A::new(a[axis], b[axis], c[axis])))
    }

    /// Normal by winding, not of unit length.
    fn normal(&self) -> Vec3A {
        let [x, y, z] = self.0;
        let corner = |i: usize| Vec3A::new(x[i], y[i], z[i]);
        (corner(1) - corner(0)).cross(corner(2) - corner(0))
    }
}

impl Boundable for Triangle {
    fn aabb(&self) -> Aabb {
        let padding = Vec3A::splat(BOX_PADDING);
        let [low, high] = [Vec3A::min_element, Vec3A::max_element].map(|of| Vec3A::from_array(self.0.map(of)));
        Aabb { min: low - padding, max: high + padding }
    }
}

/// The shear that turns a ray into the z axis, computed once for all its triangles.
struct Shear {
    /// Axes x, y, z of the sheared space; z is the one along which the ray moves most.
    axes: [usize; 3],
    /// Shear along x and y, and the scale of z.
    factors: [f32; 3],
}

impl Shear {
    fn new(ray: &FrameRay) -> Self {
        let direction = ray.direction.to_array();
        let z = ray.direction.abs().max_position();
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let scale = 1.0 / direction[z];
        Self { axes, factors: [direction[axes[0]] * scale, direction[axes[1]] * scale, scale] }
    }

    /// Distance along the ray within its limits, or infinity. In the sheared plane a triangle is hit where its three
    /// edge functions agree in sign. Both triangles at an edge compute the same value for it, and a rounded difference
    /// of two products has the right sign or is 0; since 0 agrees with either sign, there is no gap, and the original's
    /// second try in double precision, which decides which of the two triangles is hit, is not needed.
    #[inline(always)]
    fn intersect(&self, triangle: &Triangle, ray: &FrameRay) -> f32 {
        // The corners in the space where the ray starts at the origin and runs along z.
        let [x, y, z] = self.axes;
        let depth = triangle.0[z] - Vec3A::splat(ray.origin[z]);
        let across = triangle.0[x] - Vec3A::splat(ray.origin[x]) - self.factors[0] * depth;
        let along = triangle.0[y] - Vec3A::splat(ray.origin[y]) - self.factors[1] * depth;
        // Of the edges from the second corner to the third, from the third to the first, from the first to the second.
        let edges = across.zxy() * along.yzx() - along.zxy() * across.yzx();
        let any_negative = edges.cmplt(Vec3A::ZERO).any();
        let any_positive = edges.cmpgt(Vec3A::ZERO).any();
        let determinant = edges.element_sum();
        if (any_negative && any_positive) || determinant == 0.0 {
            return f32::INFINITY;
        }
        let distance = self.factors[2] * edges.dot(depth) / determinant;
        if distance >= ray.tmin && distance <= ray.tmax { distance } else { f32::INFINITY }
    }
}
