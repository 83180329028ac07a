//! Which patch, point or photon a point of a picture shows. No graphics adapter is needed.

use crate::{SIZE, build, element_at, frame, on_plane, pixels, square};
use glam::{Vec2, Vec3};
use lightwell::camera::Camera;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::side_index;
use lightwell::scene::{Scene, Viewpoint};
use lightwell::solution::{Path, Photon, Scattering};
use lightwell::viewport::{Frame, View, pick_patch, pick_photon, pick_point};

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

#[test]
fn a_point_of_a_surface_is_picked_with_the_side_that_is_seen() {
    let world = square();
    let camera = Camera::new(&world.viewpoint, &world.bounds);
    for (x, y) in [(60, 40), (45, 50)] {
        let at = [x as f32 + 0.5, y as f32 + 0.5];
        let (point, normal) = pick_point(&world, &camera, at, SIZE).expect("the square is there");
        assert!((point - on_plane(x, y).0.extend(0.0)).length() < 1e-4 && normal == Vec3::Z, "{point} {normal}");
    }
    assert_eq!(pick_point(&world, &camera, [0.5, 0.5], SIZE), None);
}

#[test]
fn the_nearest_photon_that_is_seen_is_picked() {
    let world = square();
    let (middle, size) = on_plane(60, 40);
    let photon = |along_x: f32, is_front: bool| Photon {
        position: (middle + Vec2::new(along_x * size, 0.0)).extend(0.0),
        flux: Rgb::ONE,
        direction: Vec3::NEG_Z,
        side: side_index(0, is_front) as u32,
        path: Path::LIGHT.then(Scattering::Diffuse),
        emission: 0,
    };
    // In pixels from the middle: on the back, near by, nearer, and too far away.
    let photons = [photon(0.5, false), photon(3.0, true), photon(-2.0, true), photon(20.0, true)];
    let pick = |at: [f32; 2], filter: &str| {
        let filter = filter.parse().expect("a pattern");
        pick_photon(&world, &photons, &Frame { filter, ..frame(&world, View::Photons) }, at)
    };
    assert_eq!(pick([60.5, 40.5], ""), Some(2));
    assert_eq!(pick([62.5, 40.5], ""), Some(1));
    assert_eq!(pick([60.5, 44.5], ""), Some(2), "some pixels above");
    assert_eq!(pick([70.5, 40.5], ""), None, "more than six pixels from all");
    assert_eq!(pick([80.5, 40.5], ""), Some(3));
    assert_eq!(pick([60.5, 40.5], "LDE"), None, "what is not drawn is not picked");
}
