//! Polygons as surfaces to start rays from: normals, areas, points.

use crate::math::polygon::vector_area;
use crate::math::random::Stream;
use crate::math::warp::{cosine_hemisphere, frame};
use crate::mesh::{Region, side_index};
use crate::scene::{Polygon, Scene};
use crate::tracer::{Ray, SurfacePoint, Tracer};
use glam::{DVec3, Vec3, Vec3A};

/// What the exploration of a scene needs to know of each polygon.
pub struct Surfaces {
    regions: Vec<Region>,
    /// Unit normals of fronts, and areas in m².
    facing: Vec<(Vec3A, f64)>,
    /// Whether light goes through.
    is_clear: Vec<bool>,
}

/// A walk goes through at most so many clear surfaces at a time.
const MOST_CLEAR: usize = 16;

/// A place on one side of a polygon.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Index as in [`crate::mesh::Mesh::sides`].
    pub side: usize,
    pub point: Vec3A,
    /// On the side's own side.
    pub normal: Vec3A,
}

impl Surfaces {
    pub fn new(scene: &Scene) -> Self {
        let region = |polygon: &Polygon| {
            let indices = polygon.corners();
            let corner = |i: usize| Vec3A::from(scene.positions[indices[i.min(indices.len() - 1)] as usize]);
            Region::new([corner(0), corner(1), corner(2), corner(3)], indices.len())
        };
        let facing = |region: &Region| {
            let corners: Vec<DVec3> = region.corners().iter().map(|corner| corner.as_dvec3()).collect();
            let area = vector_area(&corners);
            (area.normalize().as_vec3a(), area.length())
        };
        let regions: Vec<Region> = scene.polygons.iter().map(region).collect();
        let is_clear = |polygon: &Polygon| scene.materials[polygon.material as usize].lobes().is_clear();
        let is_clear = scene.polygons.iter().map(is_clear).collect();
        Self { facing: regions.iter().map(facing).collect(), is_clear, regions }
    }

    pub fn len(&self) -> usize {
        self.regions.len()
    }

    /// All corners of all polygons.
    pub fn corners(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.regions.iter().flat_map(|region| region.corners().iter().map(|&corner| Vec3::from(corner)))
    }

    /// Corners of one polygon.
    pub fn corners_of(&self, polygon: usize) -> &[Vec3A] {
        self.regions[polygon].corners()
    }

    /// Unit normal on the given side.
    pub fn normal(&self, side: usize) -> Vec3A {
        let front = self.facing[side / 2].0;
        if side.is_multiple_of(2) { front } else { -front }
    }

    /// m²
    pub fn area(&self, side: usize) -> f64 {
        self.facing[side / 2].1
    }

    /// A random place on a side, a little off its edges. Every other part of the side can come up.
    pub fn place(&self, side: usize, stream: &mut Stream) -> Place {
        let points = self.regions[side / 2].sampler();
        Place { side, point: points.point(stream.uniform2()), normal: self.normal(side) }
    }

    /// Where a cosine-distributed ray from a place arrives; `None` if it leaves the scene. It goes through every other clear
    /// surface in its way, unbent: what glass lights is lit by way of it, wherever exactly.
    pub fn bounce(&self, from: &Place, tracer: &Tracer, stream: &mut Stream) -> Option<Place> {
        self.bounce_from(from.surface_point(), from.normal, tracer, stream)
    }

    /// The same for a ray that starts beyond what lies in the plane of the place.
    pub fn bounce_beyond(&self, from: &Place, tracer: &Tracer, stream: &mut Stream) -> Option<Place> {
        let start = SurfacePoint::in_space(tracer.lift(from.point, from.normal));
        self.bounce_from(start, from.normal, tracer, stream)
    }

    fn bounce_from(
        &self,
        mut start: SurfacePoint,
        normal: Vec3A,
        tracer: &Tracer,
        stream: &mut Stream,
    ) -> Option<Place> {
        let direction = frame(normal) * cosine_hemisphere(stream.uniform2());
        for _ in 0..MOST_CLEAR {
            let hit = tracer.closest(&Ray::leaving(start, direction))?;
            if !self.is_clear[hit.polygon as usize] || stream.uniform() < 0.5 {
                let side = side_index(hit.polygon, hit.is_front);
                return Some(Place { side, point: hit.point, normal: self.normal(side) });
            }
            start = hit.surface_point();
        }
        None
    }
}

impl Place {
    pub fn surface_point(&self) -> SurfacePoint {
        SurfacePoint { point: self.point, polygon: (self.side / 2) as u32 }
    }

    /// Whether the two places face each other, by more than rounding, with nothing between them.
    pub fn sees(&self, other: &Place, tracer: &Tracer) -> bool {
        let way = other.point - self.point;
        way.dot(self.normal) > tracer.offset()
            && way.dot(other.normal) < -tracer.offset()
            && tracer.is_unoccluded(self.surface_point(), other.surface_point())
    }
}
