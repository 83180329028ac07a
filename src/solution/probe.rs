//! Irradiance at points of surfaces, read off a solution.

use super::Solution;
use crate::math::rgb::Rgb;
use crate::world::{World, is_covered};
use glam::Vec3A;

/// A solution made ready to be asked at many points.
pub struct SurfaceProbe<'a> {
    world: &'a World,
    /// E at the vertices of the mesh, W/m².
    vertex_irradiance: Vec<Rgb>,
}

impl<'a> SurfaceProbe<'a> {
    pub fn new(world: &'a World, solution: &Solution) -> Self {
        let mut vertex_irradiance = Vec::new();
        world.mesh.smooth(&solution.light.irradiance, &mut vertex_irradiance);
        Self { world, vertex_irradiance }
    }

    /// Irradiance E, W/m², at a point on a surface whose lit side faces along the unit `normal`, interpolated between the
    /// vertices of its element, and 0 where something stands on the surface; `None` where no such surface is.
    pub fn irradiance(&self, point: Vec3A, normal: Vec3A) -> Option<Rgb> {
        let (ray, hit) = self.world.meet_at(point, normal)?;
        // The given point may be under the surface, by its rounding alone.
        let met = ray.origin + hit.distance * ray.direction;
        if is_covered(&self.world.mesh, &self.world.tracer, self.world.tracer.lift(met, normal), normal) {
            return Some(Rgb::ZERO);
        }
        let location = self.world.mesh.locate(hit.polygon, hit.is_front, met)?;
        Some(self.world.mesh.interpolate(&location, &self.vertex_irradiance))
    }
}
