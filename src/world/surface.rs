//! Polygons as surfaces to start rays from: normals, areas, points.

use crate::math::polygon::vector_area;
use crate::math::random::Stream;
use crate::math::warp::{cosine_hemisphere, frame};
use crate::mesh::side_index;
use crate::scene::Scene;
use crate::tracer::{Ray, Tracer};
use glam::{DVec3, Vec3, Vec3A};

/// What the exploration of a scene needs to know of each polygon.
pub struct Surfaces {
    corners: Vec<([Vec3A; 4], usize)>,
    /// Unit normals of fronts, and areas in m².
    facing: Vec<(Vec3A, f64)>,
}

/// A place on one side of a polygon.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Index as in [`crate::mesh::Mesh::sides`].
    pub side: usize,
    /// Lifted off the surface.
    pub point: Vec3A,
    /// On the side's own side.
    pub normal: Vec3A,
}

impl Surfaces {
    pub fn new(scene: &Scene) -> Self {
        let corners = scene.polygons.iter().map(|polygon| {
            let indices = polygon.corners();
            let corner = |i: usize| Vec3A::from(scene.positions[indices[i.min(indices.len() - 1)] as usize]);
            ([corner(0), corner(1), corner(2), corner(3)], indices.len())
        });
        let corners: Vec<_> = corners.collect();
        let facing = corners.iter().map(|(corners, count)| {
            let corners: Vec<DVec3> = corners[..*count].iter().map(|corner| corner.as_dvec3()).collect();
            let area = vector_area(&corners);
            (area.normalize().as_vec3a(), area.length())
        });
        Self { facing: facing.collect(), corners }
    }

    pub fn len(&self) -> usize {
        self.corners.len()
    }

    /// All corners of all polygons.
    pub fn corners(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.corners.iter().flat_map(|(corners, _)| corners.map(Vec3::from))
    }

    /// Corners of one polygon.
    pub fn corners_of(&self, polygon: usize) -> &[Vec3A] {
        let (corners, count) = &self.corners[polygon];
        &corners[..*count]
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

    /// A random place on a side, off the surface by the tracer's offset. Every part of the side can come up; of a
    /// quad that is no parallelogram some parts do so more often.
    pub fn place(&self, side: usize, tracer: &Tracer, stream: &mut Stream) -> Place {
        let ([a, b, c, d], count) = self.corners[side / 2];
        let at = stream.uniform2();
        let point = if count == 3 {
            let weights = crate::math::warp::triangle(at);
            a + weights.x * (b - a) + weights.y * (c - a)
        } else {
            a.lerp(b, at.x).lerp(d.lerp(c, at.x), at.y)
        };
        let normal = self.normal(side);
        Place { side, point: tracer.lift(point, normal), normal }
    }

    /// Where a cosine-distributed ray from a place arrives; `None` if it leaves the scene.
    pub fn bounce(&self, from: &Place, tracer: &Tracer, stream: &mut Stream) -> Option<Place> {
        let direction = frame(from.normal) * cosine_hemisphere(stream.uniform2());
        let hit = tracer.closest(&Ray { origin: from.point, direction })?;
        let side = side_index(hit.polygon, hit.is_front);
        let normal = self.normal(side);
        Some(Place { side, point: tracer.lift(from.point + hit.distance * direction, normal), normal })
    }
}

impl Place {
    /// Whether the two places face each other with nothing between them.
    pub fn sees(&self, other: &Place, tracer: &Tracer) -> bool {
        let way = other.point - self.point;
        way.dot(self.normal) > 0.0 && way.dot(other.normal) < 0.0 && tracer.is_visible(self.point, other.point)
    }
}
