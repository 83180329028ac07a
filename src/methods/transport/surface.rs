//! A place where a ray met a surface.

use crate::mesh::side_index;
use crate::tracer::SurfacePoint;
use glam::Vec3A;

/// The first surface along a ray, seen from the side on which the ray came.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Index of the polygon; [`crate::tracer::SPACE`] where there is none.
    pub polygon: u32,
    /// Whether the ray met its front.
    pub is_front: bool,
    /// From the ray's origin, m.
    pub distance: f32,
    /// On the plane of the polygon.
    pub point: Vec3A,
    /// Unit normal of the polygon on the side that was met.
    pub facing: Vec3A,
    /// Unit normal for shading on the same side: that of the smooth surface which the polygon stands for.
    pub normal: Vec3A,
    /// Index into the scene's materials.
    pub material: u32,
}

impl Surface {
    /// Where rays start.
    pub fn surface_point(&self) -> SurfacePoint {
        SurfacePoint { point: self.point, polygon: self.polygon }
    }

    /// Index of the side as in [`crate::mesh::Mesh::sides`].
    pub fn side(&self) -> u32 {
        side_index(self.polygon, self.is_front) as u32
    }
}
