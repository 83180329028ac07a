//! From radiance to the screen.

use crate::{build, frame, gpu, light, motley, solution, square};
use lightwell::cancel::Cancel;
use lightwell::choice::Choice;
use lightwell::math::rgb::Rgb;
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{Method, Settings, Step};
use lightwell::scene::Scene;
use lightwell::viewport::{Frame, ToneCurve, View, automatic_exposure, render_picture};
use std::f32::consts::PI;
use std::sync::Arc;

#[test]
fn the_screen_shows_the_tone_curve_in_the_encoding_of_srgb() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let solution = solution(&world, motley);
    for &tone in ToneCurve::ALL {
        let frame = Frame { tone, ..frame(&world, View::Smooth) };
        let picture = render_picture(&gpu, &world, &light(&solution), &frame, 4).expect("a picture");
        for (value, shown) in picture.linear.iter().zip(&picture.srgb).filter(|(value, _)| value[3] == 1.0) {
            for channel in 0..3 {
                let expected = 255.0 * encoded(toned(tone, value[channel] / 8.0));
                let error = (f32::from(shown[channel]) - expected).abs();
                // Half a step of rounding, and 1 % of one for powers that adapters may compute in less precision.
                assert!(error <= 0.51, "{tone:?}: {value:?} is shown as {shown:?}");
            }
            assert_eq!(shown[3], 255);
        }
    }
}

fn toned(tone: ToneCurve, x: f32) -> f32 {
    match tone {
        ToneCurve::Linear => x.clamp(0.0, 1.0),
        ToneCurve::Filmic => ((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)).clamp(0.0, 1.0),
    }
}

fn encoded(linear: f32) -> f32 {
    if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[test]
fn the_automatic_exposure_of_a_furnace_foresees_its_radiosity() {
    // M_e = 1 and ρ = 0.5 everywhere: B = 2 in the end.
    let world = build(Scene::open("furnace").expect("a built-in scene"), 0.5);
    let mid_grey = (0.18 * PI / 2.0).log2();
    let mut method = Progressive::new(Arc::clone(&world), Settings::default());
    for shot in 0..100 {
        let exposure = automatic_exposure(&world, Some(&method.solution()));
        // A shot leaves the ledger closed, but spreads light as evenly as its form factors allow.
        let tolerance = if shot == 0 { 1e-6 } else { 0.02 };
        assert!((exposure - mid_grey).abs() < tolerance, "{exposure} after {shot} shots, not {mid_grey}");
        method.step(&Cancel::default());
    }
}

#[test]
fn the_automatic_exposure_hardly_changes_while_light_spreads() {
    // Open to one side, so some light leaves, which only the first shot tells.
    let world = build(Scene::open("empty-box").expect("a built-in scene"), 0.5);
    let mut method = Progressive::new(Arc::clone(&world), Settings::default());
    method.step(&Cancel::default());
    let first = automatic_exposure(&world, Some(&method.solution()));
    while method.step(&Cancel::default()) == Step::Advanced {
        let exposure = automatic_exposure(&world, Some(&method.solution()));
        assert!((exposure - first).abs() < 0.25, "{exposure}, after {first} at first: more than a quarter of a stop");
    }
    assert!(method.solution().converged);
}

#[test]
fn a_dark_world_has_an_exposure_of_zero() {
    let world = square();
    assert_eq!(automatic_exposure(&world, Some(&solution(&world, |_| Rgb::ZERO))), 0.0);
}
