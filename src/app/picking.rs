//! Which patch is seen at a point of the picture.

use crate::camera::Camera;
use crate::tracer::Ray;
use crate::world::World;
use egui::Vec2;
use glam::DVec4;

/// More surfaces than this, seen from behind one after the other, and the picture shows nothing that could be meant.
const MOST_LAYERS: usize = 256;

/// The patch that is drawn at a point of the picture, which is given in shares of the picture's width and height from
/// its top left. `aspect` is width / height.
///
/// Sides that no light reaches are not drawn, so the way goes on behind them.
pub fn patch_at(world: &World, camera: &Camera, aspect: f32, at: Vec2) -> Option<u32> {
    let mut ray = ray_through(camera, aspect, at);
    for _ in 0..MOST_LAYERS {
        let hit = world.tracer.closest(&ray)?;
        let point = ray.origin + hit.distance * ray.direction;
        if let Some(location) = world.mesh.locate(hit.polygon, hit.is_front, point) {
            return Some(world.mesh.elements[location.element as usize].patch);
        }
        ray.origin = world.tracer.lift(point, ray.direction);
    }
    None
}

fn ray_through(camera: &Camera, aspect: f32, at: Vec2) -> Ray {
    let clip = DVec4::new(2.0 * f64::from(at.x) - 1.0, 1.0 - 2.0 * f64::from(at.y), 1.0, 1.0);
    let on_near_plane = camera.clip_from_world(aspect).inverse() * clip;
    let eye = camera.eye();
    let direction = (on_near_plane.truncate() / on_near_plane.w - eye).normalize();
    Ray { origin: eye.as_vec3a(), direction: direction.as_vec3a() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cancel::Cancel;
    use crate::mesh::MeshSettings;
    use crate::scene::Scene;
    use egui::vec2;
    use glam::Vec3A;

    fn furnace() -> World {
        World::build(Scene::open("furnace").unwrap(), &MeshSettings::default(), &Cancel::default()).unwrap()
    }

    #[test]
    fn the_patch_in_the_middle_lies_where_the_camera_looks() {
        let world = furnace();
        let camera = Camera::new(&world.viewpoint, &world.bounds);
        let patch = &world.mesh.patches[patch_at(&world, &camera, 1.5, vec2(0.5, 0.5)).unwrap() as usize];
        let ray = ray_through(&camera, 1.5, vec2(0.5, 0.5));
        let to_plane = (patch.center - ray.origin).dot(patch.normal) / ray.direction.dot(patch.normal);
        let point = ray.origin + to_plane * ray.direction;
        let size = patch.corners().iter().map(|&corner| Vec3A::from(corner).distance(patch.center)).fold(0.0, f32::max);
        assert!(to_plane > 0.0 && point.distance(patch.center) <= size);
    }

    #[test]
    fn the_middle_of_a_patch_in_sight_picks_that_patch() {
        let world = furnace();
        let camera = Camera::new(&world.viewpoint, &world.bounds);
        let aspect = 1.25;
        for (index, patch) in world.mesh.patches.iter().enumerate() {
            let clip = camera.clip_from_world(aspect) * patch.center.as_dvec3().extend(1.0);
            let at = vec2(0.5 + 0.5 * (clip.x / clip.w) as f32, 0.5 - 0.5 * (clip.y / clip.w) as f32);
            let is_seen = clip.w > 0.0 && patch.normal.dot(camera.eye().as_vec3a() - patch.center) > 0.0;
            if is_seen && vec2(0.0, 0.0).min(at) == vec2(0.0, 0.0) && vec2(1.0, 1.0).max(at) == vec2(1.0, 1.0) {
                assert_eq!(patch_at(&world, &camera, aspect, at), Some(index as u32), "patch {index} at {at}");
            }
        }
    }

    #[test]
    fn walls_are_looked_through_from_outside_and_beyond_them_there_is_nothing() {
        let world = furnace();
        let mut camera = Camera::new(&world.viewpoint, &world.bounds);
        camera.fit(&world.bounds, 1.0);
        let patch = patch_at(&world, &camera, 1.0, vec2(0.5, 0.5)).expect("a wall of the room is in the middle");
        let patch = &world.mesh.patches[patch as usize];
        assert!(patch.normal.dot(camera.eye().as_vec3a() - patch.center) > 0.0, "it is seen from where it shines");
        assert_eq!(patch_at(&world, &camera, 1.0, vec2(0.01, 0.01)), None);
    }
}
