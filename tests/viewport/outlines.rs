//! Lines over the picture: outlines of elements and of the shooter.

use crate::{
    HALF_ROUNDING, SIZE, SNAP, build, corners, depth_inside, frame, gpu, light, on_plane, pixels, plane, plane_scene,
    solution, square,
};
use glam::{Vec2, Vec3};
use lightwell::math::rgb::Rgb;
use lightwell::mesh::Element;
use lightwell::scene::{Material, Polygon};
use lightwell::solution::Solution;
use lightwell::viewport::{Frame, View, render_picture};
use std::f32::consts::PI;

#[test]
fn outlines_are_on_the_edges_of_elements_and_not_in_the_radiance() {
    let Some(gpu) = gpu() else { return };
    for polygon in [&[0, 1, 2, 3][..], &[0, 1, 2]] {
        let world = plane(polygon, 1.0, Vec3::ZERO);
        let solution = solution(&world, |_| Rgb::splat(2.0));
        let plain = frame(&world, View::Patches);
        let lined = Frame { wireframe: true, ..plain };
        let [plain, lined] =
            [plain, lined].map(|frame| render_picture(&gpu, &world, &light(&solution), &frame, 4).expect("one"));
        assert!(plain.linear == lined.linear, "outlines are not light");
        for (x, y) in pixels() {
            let (point, size) = on_plane(x, y);
            let is_front = |element: &&Element| world.mesh.patches[element.patch as usize].normal.z > 0.0;
            let elements = world.mesh.elements.iter().filter(is_front);
            let depth =
                elements.map(|element| depth_inside(&corners(&world, element), point)).fold(-9.0, f32::max) / size;
            let index = (y * SIZE[0] + x) as usize;
            let differs = plain.srgb[index] != lined.srgb[index];
            // A line is one pixel wide, half on each side of an edge, and half a pixel of its rim is blurred.
            assert!(!differs || depth < 1.0 + SNAP, "{x} {y} is {depth} pixels inside");
            assert!(differs || !(0.0..0.4).contains(&depth), "{x} {y} is {depth} pixels inside");
        }
    }
}

#[test]
fn the_shooter_is_outlined() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let mut solution = solution(&world, |_| Rgb::splat(2.0));
    let plain = frame(&world, View::Patches);
    let outlined = Frame { show_shooter: true, ..plain };
    let render =
        |solution: &Solution, frame| render_picture(&gpu, &world, &light(solution), frame, 4).expect("a picture");
    let without = render(&solution, &plain);
    solution.shooter = None;
    assert!(render(&solution, &outlined) == without);

    let is_front = |&index: &usize| world.mesh.patches[index].normal.z > 0.0;
    let shooter = (0..world.mesh.patches.len()).find(is_front).expect("a patch in front");
    solution.shooter = Some(shooter as u32);
    let with = render(&solution, &outlined);
    assert!(with.linear == without.linear, "outlines are not light");
    let corners: Vec<Vec2> = world.mesh.patches[shooter].corners().iter().map(|corner| corner.truncate()).collect();
    for (x, y) in pixels() {
        let (point, size) = on_plane(x, y);
        let distance = distance_to_outline(&corners, point) / size;
        let at = (y * SIZE[0] + x) as usize;
        // The line is three pixels wide with square ends, and a pixel's samples are within half a pixel of its middle.
        let differs = with.srgb[at] != without.srgb[at];
        assert!(differs || distance > 1.0 - SNAP, "{x} {y} is {distance} pixels off the line");
        assert!(!differs || distance < 1.5 * 2f32.sqrt() + 0.5 + SNAP, "{x} {y} is {distance} pixels off the line");
    }
}

fn distance_to_outline(corners: &[Vec2], point: Vec2) -> f32 {
    let to_edge = |i: usize| {
        let (from, to) = (corners[i], corners[(i + 1) % corners.len()]);
        let along = ((point - from).dot(to - from) / from.distance_squared(to)).clamp(0.0, 1.0);
        from.lerp(to, along).distance(point)
    };
    (0..corners.len()).map(to_edge).fold(f32::INFINITY, f32::min)
}

#[test]
fn what_is_hidden_shows_neither_light_nor_outlines() {
    let Some(gpu) = gpu() else { return };
    let mut scene = plane_scene(&[0, 1, 2, 3], 1.0, Vec3::ZERO);
    let square = scene.positions.clone();
    let moved = |along: Vec3| square.iter().map(move |&position| position + along).collect::<Vec<Vec3>>();
    scene.positions.extend([moved(Vec3::Z), moved(Vec3::NEG_Z)].concat());
    scene.polygons.push(Polygon::new(&[4, 5, 6, 7], 0, 0, 0));
    // Behind both something is dark: where all surfaces glow, they would be turned to face each other.
    scene.materials.push(Material::grey("dark"));
    scene.polygons.push(Polygon::new(&[8, 9, 10, 11], 1, 0, 0));
    let world = build(scene, 0.5);
    let patch_of = |element: usize| &world.mesh.patches[world.mesh.elements[element].patch as usize];
    let mut solution = solution(&world, |element| Rgb::splat(if patch_of(element).polygon == 1 { PI } else { 1e3 }));
    let behind = world.mesh.patches.iter().position(|patch| patch.polygon == 0 && patch.is_front).expect("a patch");
    solution.shooter = Some(behind as u32);
    let frame = Frame { show_shooter: true, wireframe: true, ..frame(&world, View::Patches) };
    let picture = render_picture(&gpu, &world, &light(&solution), &frame, 4).expect("a picture");
    assert!(picture.linear.iter().all(|value| value[0] <= value[3] * (1.0 + HALF_ROUNDING)));
    solution.shooter = None;
    assert!(picture == render_picture(&gpu, &world, &light(&solution), &frame, 4).expect("a picture"));
}
