//! Which patch a point of a picture shows. No graphics adapter is needed.

use crate::{SIZE, build, element_at, pixels, square};
use glam::Vec3;
use lightwell::camera::Camera;
use lightwell::scene::{Scene, Viewpoint};
use lightwell::viewport::pick_patch;

#[test]
fn the_patch_under_every_pixel_is_picked() {
    let world = square();
    let camera = Camera::new(&world.viewpoint, &world.bounds);
    let mut checked = 0;
    for (x, y) in pixels() {
        if let Some(element) = element_at(&world, x, y) {
            let picked = pick_patch(&world, &camera, [x as f32 + 0.5, y as f32 + 0.5], SIZE);
            assert_eq!(picked, Some(world.mesh.elements[element].patch), "{x} {y}");
            checked += 1;
        }
    }
    assert!(checked > 1500);
    assert_eq!(pick_patch(&world, &camera, [0.5, 0.5], SIZE), None, "there is nothing in the corner");
}

#[test]
fn a_closed_room_is_picked_from_outside_as_it_is_seen() {
    let world = build(Scene::open("furnace").expect("a built-in scene"), 1.0);
    // Before the front wall of the cube between 0 and 1, whose outside has no elements; from near by and from far away.
    for distance in [1.5, 40.0, 500.0] {
        let viewpoint =
            Viewpoint { eye: Vec3::new(0.5, 0.5, distance), target: Vec3::splat(0.5), up: Vec3::Y, vertical_fov: 5.0 };
        let camera = Camera::new(&viewpoint, &world.bounds);
        let middle = SIZE.map(|pixels| 0.5 * pixels as f32);
        let picked = pick_patch(&world, &camera, middle, SIZE).expect("a patch");
        let patch = &world.mesh.patches[picked as usize];
        assert!(patch.normal.z > 0.9 && patch.center.z < 0.1, "{patch:?} from {distance}");
    }
}
