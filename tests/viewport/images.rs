//! Pictures from a camera: what was computed is what is shown and saved.

use crate::{SIZE, frame, gpu, light, motley, pixel, solution, square};
use lightwell::camera::Camera;
use lightwell::effects::Bill;
use lightwell::math::rgb::Rgb;
use lightwell::solution::{CameraImage, CameraView, Comparison};
use lightwell::viewport::{Frame, Legend, Light, ToneCurve, View, Viewport, render_picture};
use lightwell::world::World;
use std::sync::Arc;
use std::time::Duration;

/// A picture whose cell i has the radiance `value(i)`.
fn image(world: &World, resolution: [u32; 2], value: impl Fn(usize) -> (Rgb, f32)) -> CameraImage {
    let cells = (resolution[0] * resolution[1]) as usize;
    let (radiance, coverage) = (0..cells).map(value).unzip();
    CameraImage {
        view: CameraView::RayTraced,
        camera: Camera::new(&world.viewpoint, &world.bounds),
        size: SIZE,
        resolution,
        radiance,
        coverage,
        comparison: None,
        samples: 1,
        rays: 0,
        bill: Bill::default(),
        elapsed: Duration::ZERO,
        is_complete: true,
    }
}

/// Values that half floats cannot hold, and some background.
fn exact(cell: usize) -> (Rgb, f32) {
    let coverage = if cell.is_multiple_of(7) { 0.0 } else { 1.0 };
    (coverage * Rgb::new(1.0 + 1e-6 * cell as f32, 1e6 + cell as f32, 1e-9), coverage)
}

fn ray_traced(world: &World) -> Frame {
    frame(world, View::Camera(CameraView::RayTraced))
}

#[test]
fn every_pixel_is_what_was_computed_to_the_bit() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let light = Light { image: Some(Arc::new(image(&world, SIZE, exact))), ..Light::default() };
    let picture = render_picture(&gpu, &world, &light, &ray_traced(&world), 16).expect("a picture");
    assert_eq!(picture.linear.len(), (SIZE[0] * SIZE[1]) as usize);
    for (cell, value) in picture.linear.iter().enumerate() {
        let (radiance, coverage) = exact(cell);
        assert_eq!(*value, [radiance.x, radiance.y, radiance.z, coverage], "{cell}");
    }
}

#[test]
fn cells_of_a_coarse_picture_are_squares_that_may_reach_past_its_edge() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let resolution = SIZE.map(|pixels| pixels.div_ceil(16));
    let value = |cell: usize| (Rgb::splat(cell as f32), 1.0);
    let light = Light { image: Some(Arc::new(image(&world, resolution, value))), ..Light::default() };
    let picture = render_picture(&gpu, &world, &light, &ray_traced(&world), 4).expect("a picture");
    for (x, y) in [(0, 0), (15, 15), (16, 0), (SIZE[0] - 1, 0), (40, 33), (SIZE[0] - 1, SIZE[1] - 1)] {
        let cell = (y / 16) * resolution[0] + x / 16;
        assert_eq!(pixel(&picture, x, y)[0], cell as f32, "{x} {y}");
    }
}

#[test]
fn exposure_and_tone_curve_work_as_on_radiosity() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let radiosity = light(&solution(&world, |_| Rgb::new(3.0, 2.0, 1.0)));
    let even = Rgb::new(3.0, 2.0, 1.0) / std::f32::consts::PI;
    let image = Light { image: Some(Arc::new(image(&world, SIZE, |_| (even, 1.0)))), ..Light::default() };
    let middle = |light: &Light, view| {
        let frame = Frame { exposure_ev: -1.0, tone: ToneCurve::Filmic, ..frame(&world, view) };
        let picture = render_picture(&gpu, &world, light, &frame, 4).expect("a picture");
        picture.srgb[(SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize]
    };
    let [one, other] = [middle(&radiosity, View::Patches), middle(&image, View::Camera(CameraView::RayTraced))];
    let difference = one.iter().zip(other).map(|(a, b)| a.abs_diff(b)).max();
    assert!(difference <= Some(1), "{one:?} and {other:?}: half floats may cost one step");
}

#[test]
fn shares_are_shown_as_they_are_whatever_the_exposure() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    // Half of the light, and all of it: 188 and 255 in the encoding of sRGB.
    let share = |cell: usize| (Rgb::splat(if cell.is_multiple_of(2) { 0.5 } else { 1.0 }), 1.0);
    let view = CameraView::AmbientOcclusion;
    let light = Light { image: Some(Arc::new(CameraImage { view, ..image(&world, SIZE, share) })), ..Light::default() };
    let frame = Frame { exposure_ev: -3.0, tone: ToneCurve::Filmic, ..frame(&world, View::Camera(view)) };
    let picture = render_picture(&gpu, &world, &light, &frame, 4).expect("a picture");
    assert_eq!([picture.srgb[0][0], picture.srgb[1][0]], [188, 255]);
    assert_eq!([picture.linear[0][0], picture.linear[1][0]], [0.5, 1.0]);
}

#[test]
fn differences_have_the_colours_of_their_legend_and_are_missed_where_there_are_none() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let view = CameraView::AmbientMinusIndirect;
    // Shares from 0 to 1 and as much light everywhere, but for background.
    let value = |cell: usize| {
        let coverage = if cell.is_multiple_of(7) { 0.0 } else { 1.0 };
        (coverage * Rgb::new((cell % 100) as f32 / 99.0, 3.0, 0.0), coverage)
    };
    let image = image(&world, SIZE, value);
    let comparison = Comparison::of(view, &image.radiance, &image.coverage);
    let picture_of = |comparison| {
        let image = Arc::new(CameraImage { view, comparison, ..image.clone() });
        let light = Light { image: Some(image.clone()), ..Light::default() };
        let frame = Frame { exposure_ev: -3.0, tone: ToneCurve::Filmic, ..frame(&world, View::Camera(view)) };
        (render_picture(&gpu, &world, &light, &frame, 4).expect("a picture"), light, image)
    };
    let (picture, light, image) = picture_of(comparison);
    assert_eq!(View::Camera(view).missing(&light), None);
    let legend = Legend::of(View::Camera(view), &light).expect("a legend");
    // a/ā − 1 is between −1 and 1.
    assert_eq!((legend.low, legend.high), (-1.0, 1.0));
    for (cell, shown) in picture.linear.iter().enumerate() {
        let expected = image.difference(cell).map_or(Rgb::ZERO, |difference| legend.colour(difference));
        assert_eq!(Rgb::from_slice(&shown[..3]), expected, "{cell}");
    }
    let [dark, bright] = [100, 199].map(|cell| picture.srgb[cell]);
    assert!(dark[2] > dark[0] && bright[0] > bright[2], "{dark:?} is blue and {bright:?} red");
    let (plain, light, _) = picture_of(None);
    let reason = View::Camera(view).missing(&light).expect("a reason");
    assert!(reason.contains("nothing to compare") && Legend::of(View::Camera(view), &light).is_none());
    assert!(plain.linear.iter().all(|shown| shown[0] == shown[1] && shown[1] == shown[2]), "it is grey");
}

#[test]
fn a_picture_of_another_view_is_not_shown() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let light = Light { image: Some(Arc::new(image(&world, SIZE, exact))), ..light(&solution(&world, motley)) };
    let other = View::Camera(CameraView::FinalGather);
    assert!(other.missing(&light).is_some() && ray_traced(&world).view.missing(&light).is_none());
    let picture = render_picture(&gpu, &world, &light, &frame(&world, other), 4).expect("a picture");
    let middle = pixel(&picture, SIZE[0] / 2, SIZE[1] / 2);
    assert!(middle[0] == middle[1] && middle[1] == middle[2], "{middle:?} is plain");
}

#[test]
fn a_picture_is_uploaded_once() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let mut viewport = Viewport::new(&gpu, wgpu::TextureFormat::Rgba8Unorm);
    viewport.set_world(&world);
    let shown = Light { image: Some(Arc::new(image(&world, SIZE, exact))), ..Light::default() };
    let mut draws = |light: &Light, frame: &Frame| {
        viewport.set_light(light);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        viewport.draw(&mut encoder, frame);
        viewport.draws()
    };
    assert_eq!(draws(&shown, &ray_traced(&world)), 1);
    assert_eq!(draws(&shown, &Frame { exposure_ev: 2.0, ..ray_traced(&world) }), 1);
    let another = Light { image: Some(Arc::new(image(&world, SIZE, exact))), ..Light::default() };
    assert_eq!(draws(&another, &ray_traced(&world)), 2);
}
