//! Ambient occlusion against indirect light: what is compared, and how they differ.

use super::truth::region;
use super::{builtin, camera, finished, home, mean, scene, sources, with_samples};
use glam::Vec3;
use lightwell::math::rgb::luminance;
use lightwell::math::stats::Moments;
use lightwell::methods::{Falloff, ImageSettings, OcclusionSettings, Range, Settings};
use lightwell::solution::{CameraImage, CameraView, Comparison};
use std::f32::consts::PI;

const VIEW: CameraView = CameraView::AmbientMinusIndirect;

fn with_range(range: Range, samples: u32) -> Settings {
    Settings { occlusion: OcclusionSettings { rays: 16, range, falloff: Falloff::Linear }, ..with_samples(samples) }
}

/// The indirect irradiance of all pixels that show nothing but surfaces.
fn irradiance(image: &CameraImage) -> Moments {
    let mut pixels = Moments::default();
    for (value, coverage) in image.radiance.iter().zip(&image.coverage) {
        if *coverage == 1.0 {
            pixels.add(value.y.into());
        }
    }
    pixels
}

#[test]
fn in_a_furnace_indirect_light_is_what_it_must_be_and_an_unlimited_distance_leaves_nothing_to_compare() {
    let world = builtin("furnace");
    let material = &world.scene.materials[0];
    // All faces glow alike: M / (1 − ρ) arrives everywhere, of which M comes straight from emitters.
    let expected = f64::from(luminance(PI * material.emission * material.diffuse / (1.0 - material.diffuse)));
    let image = finished(&sources(&world), VIEW, home(&world), [32, 24], &with_range(Range::Automatic, 64));
    let found = irradiance(&image);
    // Pixels are independent; four standard errors, as their own spread tells them, and no more than a hundredth.
    let error = found.standard_error();
    assert!(found.count() > 700 && error < 0.01 * expected, "{found:?}");
    assert!((found.mean() - expected).abs() < 4.0 * error, "{found:?}, not {expected}");
    assert!(image.comparison.is_some());
    // Everything hides everything.
    let dark = finished(&sources(&world), VIEW, home(&world), [32, 24], &with_range(Range::Unlimited, 4));
    assert!(dark.radiance.iter().all(|value| value.x == 0.0) && dark.comparison.is_none());
}

#[test]
fn without_light_between_surfaces_there_is_nothing_to_compare() {
    let floor = "mtllib m.mtl\no floor\nusemtl white\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf -4 -3 -2 -1\n";
    let lamp = "o lamp\nusemtl lamp\nv -1 9 -1\nv 1 9 -1\nv 1 9 1\nv -1 9 1\nf -4 -3 -2 -1\n";
    let materials = "newmtl white\nKd 0.8 0.8 0.8\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\n";
    let eye = Vec3::new(0.0, 3.0, 3.0);
    for text in [floor.to_owned() + lamp, floor.to_owned()] {
        let world = scene(&text, materials);
        let camera = camera(&world, eye, Vec3::ZERO, Vec3::Y, 30.0);
        let image = finished(&sources(&world), VIEW, camera, [32, 24], &with_range(Range::Automatic, 2));
        let is_white = |(value, coverage): (&Vec3, &f32)| value.y == 0.0 && (value.x > 0.0 || *coverage == 0.0);
        assert!(image.radiance.iter().zip(&image.coverage).all(is_white));
        assert!(image.coverage.contains(&1.0) && image.comparison.is_none());
    }
}

#[test]
fn indirect_light_is_all_light_but_the_direct() {
    let world = builtin("cornell-box");
    let sources = sources(&world);
    let camera = home(&world);
    let size = [64, 64];
    let settings = Settings {
        image: ImageSettings { light_rays: 16, ..with_samples(64).image },
        ..with_range(Range::Automatic, 64)
    };
    let contrast = finished(&sources, VIEW, camera, size, &settings);
    let direct = finished(&sources, CameraView::Diffuse, camera, size, &settings);
    // White parts: back wall, ceiling, floor before the blocks; whole pixels, in shares of the picture.
    let white = Vec3::new(0.725, 0.71, 0.68);
    for (x, y) in [([26.0, 38.0], [16.0, 22.0]), ([20.0, 44.0], [1.0, 3.0]), ([28.0, 38.0], [60.0, 62.0])] {
        let [x, y] = [x, y].map(|pixels: [f32; 2]| pixels.map(|pixel| pixel / 64.0));
        let truth = region(&sources.transport, &camera, x, y, 200_000);
        let expected = luminance(PI * (truth.mean - mean(&direct, x, y)) / white);
        let found = mean(&contrast, x, y).y;
        // Brute force is about all light, and the direct light is less noisy than it. That of the view itself, of 20 pixels
        // or more and 256 paths each, whose light varies by its own size, is 1/√5120.
        let all = f64::from(PI * luminance(truth.mean / white) / expected);
        let noise = all * truth.total.standard_error() / truth.total.mean() + 1.0 / 5120_f64.sqrt();
        let error = f64::from(found / expected - 1.0);
        println!("{x:?} {y:?}: {found}, not {expected}: {error:+.4}, noise {noise:.4}");
        assert!(error.abs() < 3.0 * noise, "{x:?} {y:?}: {found}, not {expected}");
    }
}

/// A closed room of 2 m with walls of this reflectance, and a small lamp that shines up from its middle.
fn room(reflectance: f32) -> (String, String) {
    let mut obj = "mtllib m.mtl\no room\nusemtl wall\n".to_owned();
    for i in 0..8 {
        let at = |bit: i32| if i & bit == 0 { -1 } else { 1 };
        obj += &format!("v {} {} {}\n", at(1), at(2), at(4));
    }
    obj += "f 1 3 7 5\nf 2 6 8 4\nf 1 5 6 2\nf 3 4 8 7\nf 1 2 4 3\nf 5 7 8 6\n";
    obj += "o lamp\nusemtl lamp\nv -0.2 0 -0.2\nv -0.2 0 0.2\nv 0.2 0 0.2\nv 0.2 0 -0.2\nf -4 -3 -2 -1\n";
    let wall = format!("newmtl wall\nKd {reflectance} {reflectance} {reflectance}\n");
    (obj, wall + "newmtl lamp\nKd 0 0 0\nKe 10 10 10\n")
}

#[test]
fn a_white_corner_is_darker_under_ambient_occlusion_than_in_truth() {
    let (obj, mtl) = room(0.9);
    let world = scene(&obj, &mtl);
    // Down into a corner, where three walls meet in the middle of the picture.
    let corner = Vec3::new(-1.0, -1.0, -1.0);
    let camera = camera(&world, Vec3::new(0.0, -0.1, 0.0), corner, Vec3::Y, 100.0);
    let image = finished(&sources(&world), VIEW, camera, [64, 64], &with_range(Range::Metres(1.0), 64));
    let Some(Comparison::Ambient(contrast)) = image.comparison else { panic!("no contrast") };
    let mean_over = |is_in: &dyn Fn(f32) -> bool| {
        let mut differences = Moments::default();
        for (cell, _) in image.radiance.iter().enumerate() {
            let [x, y] = [cell % 64, cell / 64].map(|i| i as f32 - 31.5);
            if is_in(x.hypot(y)) {
                differences.add(image.difference(cell).expect("a surface everywhere"));
            }
        }
        differences
    };
    let (at, away) = (mean_over(&|distance| distance < 4.0), mean_over(&|distance| distance > 16.0));
    println!("{contrast:?}, {at:?}, {away:?}");
    // Three walls leave a quarter of the ambient light in the corner at an unlimited distance, while light that is reflected
    // between them is there nearly as bright as anywhere: the difference is far larger than its noise.
    assert!(at.mean() + 5.0 * at.standard_error() < -0.2, "{at:?}");
    assert!(away.mean() > at.mean() + 0.2, "{away:?}");
}
