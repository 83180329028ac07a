//! Which patch a point of a picture shows.

use crate::camera::Camera;
use crate::tracer::Ray;
use crate::world::World;

/// The patch seen at a point of a picture, in pixels from its top left corner; `None` where there is none. As in the
/// picture, sides without a mesh hide nothing.
pub fn pick_patch(world: &World, camera: &Camera, at: [f32; 2], size: [u32; 2]) -> Option<u32> {
    let mut ray = camera.ray(at, size);
    loop {
        let hit = world.tracer.closest(&ray)?;
        let point = ray.origin + hit.distance * ray.direction;
        if let Some(location) = world.mesh.locate(hit.polygon, hit.is_front, point) {
            return Some(world.mesh.elements[location.element as usize].patch);
        }
        // The next origin lies behind that side by twice what a hit is known to.
        let behind = hit.distance + 2.0 * world.tracer.offset();
        ray = Ray { origin: ray.origin + behind * ray.direction, ..ray };
    }
}
