//! Radiance: which element a pixel shows, and how its value varies.

use crate::{
    HALF_ROUNDING, SIZE, SNAP, build, corners, element_at, frame, gpu, light, motley, on_plane, pixel, pixels, plane,
    solution, square,
};
use glam::{Vec2, Vec3};
use lightwell::camera::Camera;
use lightwell::math::rgb::Rgb;
use lightwell::scene::{Scene, Viewpoint};
use lightwell::viewport::{Picture, View, render_picture};
use lightwell::world::World;
use std::f32::consts::PI;
use std::sync::Arc;

fn assert_near(found: [f32; 4], radiance: Rgb, tolerance: impl Fn(f32) -> f32, place: &str) {
    for channel in 0..3 {
        let error = (found[channel] - radiance[channel]).abs();
        assert!(error <= tolerance(radiance[channel]), "{place}: {found:?}, not {radiance}");
    }
    assert_eq!(found[3], 1.0, "{place} is covered");
}

#[test]
fn every_pixel_of_the_constant_views_has_the_radiance_of_its_element() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let solution = solution(&world, motley);
    let radiance = |radiosity: Rgb| radiosity / PI;
    for (view, values) in [(View::Patches, &solution.light.radiosity), (View::Unshot, &solution.light.unshot)] {
        let picture = render_picture(&gpu, &world, &light(&solution), &frame(&world, view), 4).expect("a picture");
        let mut checked = 0;
        for (x, y) in pixels() {
            if let Some(element) = element_at(&world, x, y) {
                let expected = radiance(values[element]);
                assert_near(pixel(&picture, x, y), expected, |value| HALF_ROUNDING * value, &format!("{x} {y}"));
                checked += 1;
            } else if on_plane(x, y).0.abs().max_element() > 1.0 + 0.8 * on_plane(x, y).1 {
                assert_eq!(pixel(&picture, x, y), [0.0; 4], "{x} {y} is background");
            }
        }
        assert!(checked > 1500, "{checked} pixels in {} elements", world.mesh.elements.len());
    }
}

#[test]
fn the_smooth_view_is_linear_over_triangles_and_bilinear_over_quads() {
    let Some(gpu) = gpu() else { return };
    for polygon in [&[0, 1, 2, 3][..], &[0, 1, 2], &[1, 2, 3]] {
        let world = plane(polygon, 1.0, Vec3::ZERO);
        let solution = solution(&world, motley);
        let mut at_vertices = Vec::new();
        world.mesh.smooth(&solution.light.radiosity, &mut at_vertices);
        let picture =
            render_picture(&gpu, &world, &light(&solution), &frame(&world, View::Smooth), 4).expect("a picture");
        let mut checked = 0;
        for (x, y) in pixels() {
            let Some(element) = element_at(&world, x, y).map(|index| &world.mesh.elements[index]) else { continue };
            let (point, size) = on_plane(x, y);
            let corners = corners(&world, element);
            let values: Vec<Rgb> = element.corners().iter().map(|&v| at_vertices[v as usize] / PI).collect();
            let per_pixel = size * steepest(&corners, &values);
            let tolerance = |value: f32| HALF_ROUNDING * value + SNAP * per_pixel;
            assert_near(pixel(&picture, x, y), interpolated(&corners, &values, point), tolerance, &format!("{x} {y}"));
            checked += 1;
        }
        assert!(checked > 600, "{checked} pixels");
    }
}

/// Parallelogram or triangle coordinates of `point` from the first corner, then the mean of the corners' values.
fn interpolated(corners: &[Vec2], values: &[Rgb], point: Vec2) -> Rgb {
    let (along, across) = (corners[1] - corners[0], corners[corners.len() - 1] - corners[0]);
    let determinant = along.perp_dot(across);
    let u = (point - corners[0]).perp_dot(across) / determinant;
    let v = along.perp_dot(point - corners[0]) / determinant;
    match values {
        [a, b, c] => a * (1.0 - u - v) + b * u + c * v,
        [a, b, c, d] => a.lerp(*b, u).lerp(d.lerp(*c, u), v),
        _ => unreachable!("elements have three or four corners"),
    }
}

/// Largest change of a value for one unit of length, in any channel.
fn steepest(corners: &[Vec2], values: &[Rgb]) -> f32 {
    let largest = values.iter().copied().fold(Rgb::NEG_INFINITY, Rgb::max);
    let smallest = values.iter().copied().fold(Rgb::INFINITY, Rgb::min);
    let shortest = corners.iter().zip(&corners[1..]).map(|(a, b)| a.distance(*b)).fold(f32::INFINITY, f32::min);
    (largest - smallest).max_element() / shortest
}

#[test]
fn a_closed_room_is_seen_into_from_outside() {
    let Some(gpu) = gpu() else { return };
    let world = build(Scene::open("furnace").expect("a built-in scene"), 1.0);
    let solution = solution(&world, |element| {
        let facing = world.mesh.patches[world.mesh.elements[element].patch as usize].normal.z;
        if facing > 0.9 { Rgb::new(1.0, 2.0, 3.0) } else { Rgb::splat(0.1) }
    });
    // Before the front wall of the cube between 0 and 1, whose outside has no elements and whose inside looks away.
    let viewpoint =
        Viewpoint { eye: Vec3::new(0.5, 0.5, 4.0), target: Vec3::splat(0.5), up: Vec3::Y, vertical_fov: 30.0 };
    let mut frame = frame(&world, View::Patches);
    frame.camera = Camera::new(&viewpoint, &world.bounds);
    let picture = render_picture(&gpu, &world, &light(&solution), &frame, 4).expect("a picture");
    let back_wall = pixel(&picture, SIZE[0] / 2, SIZE[1] / 2);
    assert_near(back_wall, Rgb::new(1.0, 2.0, 3.0) / PI, |value| HALF_ROUNDING * value, "the back wall");
}

#[test]
fn pictures_do_not_depend_on_the_size_of_the_scene_or_its_distance_from_the_origin() {
    let Some(gpu) = gpu() else { return };
    let reference = square();
    let picture = |world: &Arc<World>| {
        let solution = solution(world, motley);
        render_picture(&gpu, world, &light(&solution), &frame(world, View::Patches), 4).expect("a picture")
    };
    let expected = picture(&reference);
    // Powers of two, and offsets in which the corners are exact, so that only the drawing may differ.
    let cases = [(2f32.powi(-20), Vec3::ZERO), (2f32.powi(20), Vec3::ZERO), (1.0, Vec3::splat(2f32.powi(18)))];
    for (scale, offset) in cases {
        let world = plane(&[0, 1, 2, 3], scale, offset);
        assert!(picture(&world).linear == expected.linear, "scaled by {scale}, moved by {offset}");
    }
}

#[test]
fn bright_and_dark_light_both_fit_into_the_picture() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let bright = |element: usize| if element.is_multiple_of(2) { 4e9 } else { 4e3 };
    let solution = solution(&world, |element| Rgb::splat(bright(element)));
    let picture = render_picture(&gpu, &world, &light(&solution), &frame(&world, View::Patches), 4).expect("a picture");
    for (x, y) in pixels() {
        if let Some(element) = element_at(&world, x, y) {
            let expected = Rgb::splat(bright(element) / PI);
            assert_near(pixel(&picture, x, y), expected, |value| HALF_ROUNDING * value, &format!("{x} {y}"));
        }
    }
}

#[test]
fn more_samples_are_the_mean_of_more_places_in_a_pixel() {
    let Some(gpu) = gpu() else { return };
    let world = plane(&[0, 1, 2], 1.0, Vec3::ZERO);
    let solution = solution(&world, |_| Rgb::splat(PI));
    let mut frame = frame(&world, View::Patches);
    // Rolled, so that edges cross pixels in many ways.
    frame.camera = Camera::new(&Viewpoint { up: Vec3::new(0.3, 1.0, 0.0), ..world.viewpoint }, &world.bounds);
    let size = on_plane(0, 0).1;
    // Of the triangle, which is half the square of 2 x 2, in pixels.
    let exact = 2.0 / (size * size);
    let outline = (4.0 + 8f32.sqrt()) / size;
    let [few, many] =
        [4, 64].map(|samples| render_picture(&gpu, &world, &light(&solution), &frame, samples).expect("a picture"));
    for (picture, samples) in [(&few, 4.0_f32), (&many, 64.0)] {
        let covered: f32 = picture.linear.iter().map(|value| value[3]).sum();
        // n samples miss the share of a pixel by 1/n at most, in every pixel of the outline.
        assert!(
            (covered - exact).abs() < 2.0 * outline / samples,
            "{covered} pixels with {samples} samples, not {exact}"
        );
        // Everything has radiance 1, so radiance is coverage.
        for value in &picture.linear {
            assert!((value[0] - value[3]).abs() <= 2.0 * HALF_ROUNDING * value[3], "{value:?}");
        }
    }
    let levels = |picture: &Picture| {
        let mut shares: Vec<u32> = picture.linear.iter().map(|value| (value[3] * 256.0).round() as u32).collect();
        shares.sort_unstable();
        shares.dedup();
        shares.len()
    };
    assert!(levels(&few) <= 5, "4 samples give quarters");
    assert!(levels(&many) > 20, "64 samples give {} shares", levels(&many));
}
