//! One emitter: a polygon that shines from its front, and points of it by area, or by solid angle where it is near.

use super::Media;
use crate::math::bounds::Bounds;
use crate::math::rgb::{Rgb, Rgb64};
use crate::math::spherical_triangle::SphericalTriangle;
use crate::mesh::{Region, Sampler};
use crate::tracer::SurfacePoint;
use glam::{DVec3, Vec2, Vec3A};
use std::f64::consts::PI;

/// A place is near that is less than so many radii away from the middle: over what is farther away the squared distance varies
/// by less than a factor of 4, and points by area are as good and cheaper.
const NEAR_RADII: f32 = 3.0;
/// Shadow rays keep this share of an emitter away from its edges, where a rounded point may lie beyond the next surface.
const INSET: f64 = 1.0 / 8192.0;

/// A triangle, or a quad cut in two: a quad need not be a parallelogram, on which alone a bilinear map is uniform.
pub(super) struct Emitter {
    corners: [Vec3A; 4],
    triangle_count: usize,
    points: [Sampler; 2],
    /// Of the area, that of the first triangle.
    first_share: f32,
    /// Of the bounding box.
    pub center: Vec3A,
    /// m²
    squared_near_distance: f32,
    /// The unit normal in double precision, for places next to the plane.
    precise_normal: DVec3,
    /// Unit normal of the front.
    pub normal: Vec3A,
    pub polygon: u32,
    pub media: Media,
    /// W/(m²·sr)
    pub radiance: Rgb,
    /// m²
    pub area: f64,
    /// Of points by area, 1/m².
    density: f32,
}

/// How an emitter fills the directions of a place that is near it.
struct NearView<'a> {
    emitter: &'a Emitter,
    triangles: [SphericalTriangle; 2],
    /// sr
    solid_angle: f64,
}

impl Emitter {
    /// `corners` are the three or four of a polygon.
    pub fn new(polygon: u32, corners: &[Vec3A], normal: Vec3A, radiance: Rgb) -> Self {
        let triangle_count = corners.len() - 2;
        let corners = [0, 1, 2, 3].map(|i: usize| corners[i.min(corners.len() - 1)]);
        let triangle = |i: usize| [corners[0], corners[i + 1], corners[i + 2]];
        let areas = [0, 1].map(|i| {
            let [a, b, c] = triangle(i).map(|corner| corner.as_dvec3());
            0.5 * (b - a).cross(c - a).length()
        });
        let sampler = |i: usize| {
            let [a, b, c] = triangle(i);
            Region::new([a, b, c, c], 3).sampler()
        };
        let low = corners.into_iter().fold(corners[0], Vec3A::min);
        let high = corners.into_iter().fold(corners[0], Vec3A::max);
        let area = areas[0] + areas[1];
        let [a, b, c, d] = corners.map(|corner| corner.as_dvec3());
        let precise_normal = (c - a).cross(d - b).normalize_or_zero();
        Self {
            corners,
            triangle_count,
            points: [sampler(0), sampler(triangle_count - 1)],
            first_share: if area > 0.0 { (areas[0] / area) as f32 } else { 1.0 },
            center: 0.5 * (low + high),
            squared_near_distance: 0.25 * NEAR_RADII * NEAR_RADII * (high - low).length_squared(),
            precise_normal,
            normal,
            polygon,
            media: Media::default(),
            radiance,
            area,
            density: area.recip() as f32,
        }
    }

    pub fn corners(&self) -> &[Vec3A] {
        &self.corners[..self.triangle_count + 2]
    }

    pub fn bounds(&self) -> Bounds {
        Bounds::of(self.corners().iter().map(|&corner| corner.into()))
    }

    /// π L A, W.
    pub fn flux(&self) -> Rgb64 {
        self.radiance.as_dvec3() * (PI * self.area)
    }

    fn surface_point(&self, point: Vec3A) -> SurfacePoint {
        SurfacePoint { point, polygon: self.polygon }
    }

    /// A point in proportion to area. `which` in [0, 1) chooses the triangle.
    pub fn point(&self, which: f32, at: Vec2) -> SurfacePoint {
        self.surface_point(self.points[usize::from(which >= self.first_share)].point(at))
    }

    /// The density of the direction towards a point that is chosen in proportion to area, 1/sr; `None` where
    /// the direction meets the back.
    pub fn pdf_by_area(&self, direction: Vec3A, distance: f32) -> Option<f32> {
        let cosine = -direction.dot(self.normal);
        (cosine > 0.0).then(|| self.density * distance * distance / cosine)
    }

    pub fn is_near(&self, place: Vec3A) -> bool {
        place.distance_squared(self.center) < self.squared_near_distance
    }

    /// For a place that is near: a unit direction that is uniform over the solid angle, the point there, and the
    /// density, 1/sr. `which` in [0, 1) chooses the triangle. `None` from behind, and from its own plane, which is as thick as
    /// `rounding`, m. Few places are near, and all others should not carry the code of these along.
    #[inline(never)]
    pub fn sample_near(&self, place: Vec3A, rounding: f64, which: f32, at: Vec2) -> Option<(Vec3A, SurfacePoint, f32)> {
        let view = self.near_view(place, rounding)?;
        let (direction, point) = view.sample(place, which, at);
        Some((direction, point, view.pdf()))
    }

    /// The density of that choice, 1/sr.
    #[inline(never)]
    pub fn pdf_near(&self, place: Vec3A, rounding: f64) -> Option<f32> {
        Some(self.near_view(place, rounding)?.pdf())
    }

    fn near_view(&self, place: Vec3A, rounding: f64) -> Option<NearView<'_>> {
        // Differences of numbers of single precision are exact in double precision.
        let place = place.as_dvec3();
        if (place - self.corners[0].as_dvec3()).dot(self.precise_normal) <= rounding {
            return None;
        }
        let [a, b, c, d] = self.corners.map(|corner| corner.as_dvec3() - place);
        let triangles = [[a, b, c], [a, c, d]].map(SphericalTriangle::new);
        let solid_angle = triangles[0].solid_angle() + triangles[1].solid_angle();
        (solid_angle > 0.0).then_some(NearView { emitter: self, triangles, solid_angle })
    }
}

impl NearView<'_> {
    /// The density of every direction, 1/sr.
    fn pdf(&self) -> f32 {
        self.solid_angle.recip() as f32
    }

    /// A direction, and the point of the emitter there.
    fn sample(&self, place: Vec3A, which: f32, at: Vec2) -> (Vec3A, SurfacePoint) {
        let is_second = f64::from(which) * self.solid_angle >= self.triangles[0].solid_angle();
        let index = usize::from(is_second && self.triangles[1].solid_angle() > 0.0);
        let direction = self.triangles[index].direction(at.as_dvec2());
        let corners = [0, index + 1, index + 2].map(|i| self.emitter.corners[i].as_dvec3() - place.as_dvec3());
        let point =
            corners.iter().zip(weights(corners, direction)).map(|(corner, weight)| *corner * weight).sum::<DVec3>();
        (direction.as_vec3a(), self.emitter.surface_point((place.as_dvec3() + point).as_vec3a()))
    }
}

/// The barycentric weights of the point of a triangle in a direction, kept off its edges.
fn weights([a, b, c]: [DVec3; 3], direction: DVec3) -> [f64; 3] {
    let volumes = [direction.dot(c.cross(b)), direction.dot(a.cross(c)), direction.dot(b.cross(a))];
    let sum: f64 = volumes.iter().sum();
    let kept = volumes.map(|volume| (volume / sum).max(INSET));
    let sum: f64 = kept.iter().sum();
    kept.map(|weight| weight / sum)
}
