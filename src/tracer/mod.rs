//! The one door to the bounding volume hierarchy: closest hits, and visibility between two points.
//!
//! A ray that slips between two triangles, or past a surface that is very near, is a light leak, so six guards stand
//! here, each with a test that goes red without it (`tests/tracer.rs`, and of slivers `tests/world/slivers.rs`):
//! - Rays are traced in a frame of fixed size, so that nothing depends on the scene's units. The scale is a power of
//!   two and loses no digit.
//! - Boxes are padded by more than the rounding of a box test. This also keeps every hit away from the hierarchy's
//!   absolute cut-off of 1e-4 below which it drops a box.
//! - The triangle test is watertight (Woop, Benthin, Wald 2013): triangles that share an edge leave no gap.
//! - Distances are those to planes, which are found in double precision: between the edges of a sliver, single precision says next
//!   to nothing of where along it a ray passes.
//! - A ray that leaves a polygon starts on it, and never meets it. What is nearer to its ends than single precision can tell
//!   is decided in double precision (`contact`), so that a ray passes nothing that touches the surface that it leaves.
//! - Points of hits keep off the edges of their triangle, and elsewhere a little back on the ray, so that rounding does not move
//!   them beyond a surface that meets theirs.

mod contact;
mod triangle;

use crate::math::bounds::Bounds;
use contact::{Contact, Facet};
use glam::{Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::{Ray as FrameRay, RayHit};
use std::time::Duration;
use triangle::{Crossing, PaddedTriangle, Shear, Triangle};

/// Half the longest extent of the scene in the tracer's frame lies in (256, 512].
const FRAME_HALF_EXTENT: f32 = 512.0;
/// Every point of the scene is nearer to the frame's origin than this: 512 √3, rounded up.
const FRAME_RADIUS: f32 = 1024.0;
/// Added to boxes on every side at least, in frame units. A slab test at distances up to 2 · 1024 is wrong by at most
/// 3 · 2^-24 · 2048 = 4e-4; the hierarchy drops boxes that end within 1e-4 of the origin.
const BOX_PADDING: f32 = 1.0 / 512.0;
/// Hits are known to about this many units in the last place of the scene's largest coordinate.
const OFFSET_ULPS: f32 = 32.0;
/// Points of hits keep off edges by so many: more than the rounding of the point.
const INSET_ULPS: f32 = 8.0;
/// What is nearer than so many to the end of a ray, or to another hit, is decided in double precision: more than the rounding
/// of a point that was inset.
const SLACK_ULPS: f32 = 16.0;

/// Cosines of two unit vectors are known to this: three products, three components of either.
const SLOPE_ROUNDING: f32 = 6.0 * f32::EPSILON;

/// The polygon of points that lie on none.
pub const SPACE: u32 = u32::MAX;

/// A half-line in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    pub origin: Vec3A,
    /// Unit length.
    pub direction: Vec3A,
    /// The polygon that it leaves at its origin, which it does not meet; [`SPACE`] for a ray that starts on none.
    pub leaves: u32,
}

/// A point of a polygon, where a ray starts or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// In the plane of the polygon, but for rounding.
    pub point: Vec3A,
    /// [`SPACE`] for a point that is on none.
    pub polygon: u32,
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
    /// Where, m: inside of the polygon by more than rounding, and in its plane but for rounding.
    pub point: Vec3A,
}

/// Triangles in a bounding volume hierarchy.
pub struct Tracer {
    bvh: CwBvh,
    /// In the order of the hierarchy's leaves, in frame coordinates.
    triangles: Vec<Triangle>,
    /// The polygon of each triangle.
    owners: Vec<u32>,
    /// The same in world space, as they were given.
    corners: Vec<[Vec3; 3]>,
    /// The triangles of each polygon, the same one twice where there is one.
    parts: Vec<[u32; 2]>,
    center: Vec3A,
    frame_from_world: f32,
    world_from_frame: f32,
    /// m
    offset: f32,
    /// [`SLACK_ULPS`] in frame units.
    slack: f32,
}

impl Ray {
    /// From a point in space, in a unit direction.
    pub fn new(origin: Vec3A, direction: Vec3A) -> Self {
        Self { origin, direction, leaves: SPACE }
    }

    /// From a point of a polygon, in a unit direction on either side.
    pub fn leaving(from: SurfacePoint, direction: Vec3A) -> Self {
        Self { origin: from.point, direction, leaves: from.polygon }
    }

    fn start(&self) -> SurfacePoint {
        SurfacePoint { point: self.origin, polygon: self.leaves }
    }
}

impl SurfacePoint {
    /// On no polygon.
    pub fn in_space(point: Vec3A) -> Self {
        Self { point, polygon: SPACE }
    }
}

impl Hit {
    /// Where a ray leaves.
    pub fn surface_point(&self) -> SurfacePoint {
        SurfacePoint { point: self.point, polygon: self.polygon }
    }
}

impl Tracer {
    /// Builds the hierarchy over triangles, each with the index of the polygon that it is a part of. A polygon has one or two.
    pub fn new(triangles: &[(u32, [Vec3; 3])]) -> Self {
        let bounds = Bounds::of(triangles.iter().flat_map(|(_, corners)| *corners));
        let center = if bounds.is_empty() { Vec3::ZERO } else { bounds.center() };
        let frame_from_world = frame_scale(bounds.extent().max_element() * 0.5);
        let offset = OFFSET_ULPS * f32::EPSILON * bounds.magnitude();
        let to_frame = |corner: Vec3A| (corner - Vec3A::from(center)) * frame_from_world;
        let padded: Vec<PaddedTriangle> = triangles
            .iter()
            .map(|(_, corners)| PaddedTriangle {
                triangle: Triangle::new(corners, to_frame, frame_from_world),
                padding: offset * frame_from_world,
            })
            .collect();
        let bvh = build_cwbvh(&padded, BvhBuildParams::medium_build(), &mut Duration::default());
        let owners: Vec<u32> = bvh.primitive_indices.iter().map(|&i| triangles[i as usize].0).collect();
        Self {
            triangles: bvh.primitive_indices.iter().map(|&i| padded[i as usize].triangle).collect(),
            corners: bvh.primitive_indices.iter().map(|&i| triangles[i as usize].1).collect(),
            parts: parts(&owners),
            owners,
            bvh,
            center: center.into(),
            frame_from_world,
            world_from_frame: 1.0 / frame_from_world,
            offset,
            slack: offset * frame_from_world * (SLACK_ULPS / OFFSET_ULPS),
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
        let limit = (reach * self.frame_from_world - skipped).max(0.0);
        let mut search = ClosestHit {
            tracer: self,
            shear: Shear::new(origin, ray.direction),
            ray,
            leaving_slope: self.slope_of(ray.leaves, ray.direction),
            limit,
            farthest: limit,
            best: Candidate { triangle: NO_TRIANGLE, crossing: Crossing::default() },
        };
        self.bvh.ray_traverse(frame_ray(origin, ray.direction, limit), &mut RayHit::none(), |_, i| search.visit(i));
        let Candidate { triangle, crossing } = search.best;
        if triangle == NO_TRIANGLE {
            return None;
        }
        Some(Hit {
            polygon: self.owners[triangle],
            distance: (skipped + crossing.distance) * self.world_from_frame,
            is_front: self.is_front(triangle, crossing.slope, ray.direction),
            point: self.inset_point(&self.triangles[triangle], &crossing, ray.direction),
        })
    }

    /// Whether a ray meets nothing that is not farther away than `reach`, m. It must start in the scene or near it.
    pub fn is_free(&self, ray: &Ray, reach: f32) -> bool {
        let limit = reach * self.frame_from_world;
        let end = SurfacePoint::in_space(ray.origin);
        self.is_unobstructed(self.to_frame(ray.origin), ray.direction, limit, [ray.start(), end])
    }

    /// Whether nothing stands between two points, of different polygons or in space, however near to each other they are.
    pub fn is_unoccluded(&self, from: SurfacePoint, to: SurfacePoint) -> bool {
        let (origin, end) = (self.to_frame(from.point), self.to_frame(to.point));
        let distance = origin.distance(end);
        distance == 0.0 || self.is_unobstructed(origin, (end - origin) / distance, distance, [from, to])
    }

    /// Whether nothing but the polygons at its ends meets a ray, in frame coordinates.
    fn is_unobstructed(&self, origin: Vec3A, direction: Vec3A, distance: f32, ends: [SurfacePoint; 2]) -> bool {
        let shear = Shear::new(origin, direction);
        let [start, end] = ends;
        let is_hit = |i: usize| {
            let Some(edges) = shear.intersect(&self.triangles[i]) else { return false };
            if self.owners[i] == start.polygon || self.owners[i] == end.polygon {
                return false;
            }
            let crossing = shear.crossing(&self.triangles[i], edges);
            let slope = crossing.slope.abs();
            let is_past = |end: SurfacePoint, distance: f32, direction| {
                let least_slope = || slope.min(self.slope_of(end.polygon, direction));
                if end.polygon != SPACE && distance.abs() * least_slope() <= self.slack {
                    self.distance_between(end, i, direction).is_some()
                } else {
                    distance >= 0.0
                }
            };
            is_past(start, crossing.distance, direction) && is_past(end, distance - crossing.distance, -direction)
        };
        let ray = frame_ray(origin, direction, distance);
        self.bvh.ray_traverse_miss(ray, |_, i| if is_hit(i) { 0.0 } else { f32::INFINITY })
    }

    /// How far a ray goes from a point of a polygon until it meets a triangle, in frame units: decided in double precision.
    #[cold]
    #[inline(never)]
    fn distance_between(&self, from: SurfacePoint, triangle: usize, direction: Vec3A) -> Option<f32> {
        let point = from.point.as_dvec3();
        let mut start = self.parts[from.polygon as usize].map(|part| self.facet(part));
        if start[0].is_line() || !start[0].contains(start[0].project(point), 0.0) && !start[1].is_line() {
            start.reverse();
        }
        let mut end = self.parts[self.owners[triangle] as usize];
        if end[0] as usize != triangle {
            end.reverse();
        }
        let end = end.map(|part| self.facet(part));
        let distance = self.contact().distance(&start, start[0].project(point), &end, direction.as_dvec3())?;
        Some((distance * f64::from(self.frame_from_world)) as f32)
    }

    /// Whether a ray meets a triangle's front, whatever single precision knows of the cosine with its normal.
    fn is_front(&self, triangle: usize, slope: f32, direction: Vec3A) -> bool {
        if slope.abs() > SLOPE_ROUNDING { slope < 0.0 } else { self.facet(triangle as u32).faces(direction.as_dvec3()) }
    }

    /// Whether a ray meets the first of two triangles before the second one: decided in double precision.
    #[cold]
    #[inline(never)]
    fn touches_before(&self, first: usize, second: usize, ray: &Ray) -> bool {
        let [first, second] = [first, second].map(|triangle| self.facet(triangle as u32));
        self.contact().is_before(&first, &second, ray.origin.as_dvec3(), ray.direction.as_dvec3())
    }

    /// Sine of the elevation of a direction over a polygon; 1 over none.
    fn slope_of(&self, polygon: u32, direction: Vec3A) -> f32 {
        let parts = self.parts.get(polygon as usize);
        parts.map_or(1.0, |parts| self.triangles[parts[0] as usize].slope(direction).abs())
    }

    fn contact(&self) -> Contact {
        Contact { slack: f64::from(self.offset * (SLACK_ULPS / OFFSET_ULPS)) }
    }

    fn facet(&self, triangle: u32) -> Facet {
        Facet::new(&self.corners[triangle as usize], self.owners[triangle as usize])
    }

    /// The point of a crossing in world space, moved so little that only rounding is made good: back on the ray, or near an edge
    /// towards the middle of the triangle, which it must not leave.
    fn inset_point(&self, triangle: &Triangle, crossing: &Crossing, direction: Vec3A) -> Vec3A {
        let inset = self.slack * (INSET_ULPS / SLACK_ULPS);
        let point = triangle.point(crossing);
        let point = if triangle.distance_to_edges(crossing) > 2.0 * inset {
            point - inset * direction
        } else {
            let inwards = triangle.center() - point;
            point + inwards * (inset * inwards.length_recip()).min(0.5)
        };
        point * self.world_from_frame + self.center
    }

    /// A point of a surface, moved off it along the unit normal by more than the rounding error of its coordinates: where rays
    /// start that leave no one polygon and must meet nothing in its plane. (Wächter, Binder 2019 for the idea.)
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

/// A search for the first surface along a ray, in frame coordinates.
struct ClosestHit<'a> {
    tracer: &'a Tracer,
    shear: Shear,
    ray: &'a Ray,
    /// Sine of the ray's elevation over the polygon that it leaves.
    leaving_slope: f32,
    /// Nothing beyond counts.
    limit: f32,
    /// Nothing that is surely beyond can come first.
    farthest: f32,
    best: Candidate,
}

const NO_TRIANGLE: usize = usize::MAX;

/// A triangle that the ray meets.
#[derive(Clone, Copy)]
struct Candidate {
    triangle: usize,
    crossing: Crossing,
}

impl ClosestHit<'_> {
    /// Takes the triangle if it comes first so far; tells how far boxes are still of interest.
    #[inline(always)]
    fn visit(&mut self, triangle: usize) -> f32 {
        let Some(edges) = self.shear.intersect(&self.tracer.triangles[triangle]) else { return f32::INFINITY };
        if self.tracer.owners[triangle] == self.ray.leaves {
            return f32::INFINITY;
        }
        let mut crossing = self.shear.crossing(&self.tracer.triangles[triangle], edges);
        let slope = crossing.slope.abs();
        if (crossing.distance - self.farthest) * slope > self.tracer.slack {
            return f32::INFINITY;
        }
        // Near the planes of both, single precision does not know on which side of an edge the ray passes.
        let least_slope = slope.min(self.leaving_slope);
        if self.ray.leaves != SPACE && crossing.distance.abs() * least_slope <= self.tracer.slack {
            match self.tracer.distance_between(self.ray.start(), triangle, self.ray.direction) {
                Some(distance) => crossing.distance = distance,
                None => return f32::INFINITY,
            }
        }
        if !(0.0..=self.limit).contains(&crossing.distance) {
            return f32::INFINITY;
        }
        let candidate = Candidate { triangle, crossing };
        if self.best.triangle != NO_TRIANGLE && !self.is_before(&candidate, &self.best) {
            return f32::INFINITY;
        }
        self.best = candidate;
        // What touches the triangle may come first though its box begins behind.
        self.farthest = self.farthest.min(crossing.distance + self.tracer.slack / slope);
        self.farthest
    }

    fn is_before(&self, this: &Candidate, best: &Candidate) -> bool {
        let (near, far) = (this.crossing.distance, best.crossing.distance);
        let least_slope = this.crossing.slope.abs().min(best.crossing.slope.abs());
        if (near - far).abs() * least_slope > 2.0 * self.tracer.slack {
            return near < far;
        }
        self.tracer.touches_before(this.triangle, best.triangle, self.ray)
    }
}

/// For each polygon its triangles, of which each has an owner.
fn parts(owners: &[u32]) -> Vec<[u32; 2]> {
    const NONE: u32 = u32::MAX;
    let count = owners.iter().max().map_or(0, |&last| last as usize + 1);
    let mut parts = vec![[NONE; 2]; count];
    for (triangle, &owner) in owners.iter().enumerate() {
        let [first, second] = &mut parts[owner as usize];
        if *first == NONE {
            *first = triangle as u32;
        }
        *second = triangle as u32;
    }
    parts
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
