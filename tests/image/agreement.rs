//! Views against brute force, where they should agree, and where they should not.

use super::truth::{Region, region};
use super::{builtin, finished, home, mean, sources, with_photons};
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::choice::Choice;
use lightwell::math::rgb::Rgb;
use lightwell::methods::image::Sources;
use lightwell::methods::radiosity;
use lightwell::methods::{ImageSettings, PhotonSettings, Settings, Solver, Step};
use lightwell::solution::{CameraImage, CameraView};
use std::sync::Arc;

/// A rectangle of a picture, in pixels of a square of 64: name, x, y.
pub type Part = (&'static str, [f32; 2], [f32; 2]);

const BACK_WALL: Part = ("back wall", [26.0, 38.0], [16.0, 22.0]);
const RED_WALL: Part = ("red wall", [2.0, 8.0], [26.0, 38.0]);
const GREEN_WALL: Part = ("green wall", [56.0, 62.0], [26.0, 38.0]);
const CEILING: Part = ("ceiling", [20.0, 44.0], [1.0, 3.0]);
/// White, beside the red wall and beside the green one.
const BESIDE_RED: Part = ("floor beside the red wall", [6.0, 10.0], [58.0, 61.0]);
const BESIDE_GREEN: Part = ("floor beside the green wall", [54.0, 58.0], [58.0, 61.0]);
/// Where two white surfaces and a coloured one meet.
const CORNER: Part = ("back corner", [17.0, 19.0], [18.0, 22.0]);

const SIZE: [u32; 2] = [128, 128];
const PATHS: u64 = 100_000;

pub fn settings() -> Settings {
    Settings {
        photons: PhotonSettings { count: 400_000, ..PhotonSettings::default() },
        image: ImageSettings { samples: 4, gather_rays: 64, light_rays: 4, ..ImageSettings::default() },
        ..Settings::default()
    }
}

pub fn mean_of(image: &CameraImage, (_, x, y): Part) -> Rgb {
    mean(image, x.map(|pixel| pixel / 64.0), y.map(|pixel| pixel / 64.0))
}

fn truth_of(sources: &Sources, camera: &Camera, (_, x, y): Part) -> Region {
    region(&sources.transport, camera, x.map(|pixel| pixel / 64.0), y.map(|pixel| pixel / 64.0), PATHS)
}

/// Compares parts with brute force: within 3 standard errors of that and `tolerance`, a share, for the view's own.
pub fn check(sources: &Sources, camera: &Camera, image: &CameraImage, parts: &[Part], tolerance: f64) {
    for &part in parts {
        let truth = truth_of(sources, camera, part).total;
        let got = f64::from(mean_of(image, part).element_sum());
        let (error, noise) = (got / truth.mean() - 1.0, truth.standard_error() / truth.mean());
        println!("{}, {}: {got:.4}, off by {error:+.4}; noise of the truth {noise:.4}", image.view.name(), part.0);
        assert!(error.abs() < tolerance + 3.0 * noise, "{}: off by {error:+.4}", part.0);
    }
}

fn red_over_green(value: Rgb) -> f32 {
    value.x / value.y
}

#[test]
fn final_gather_agrees_with_brute_force() {
    let world = builtin("cornell-box");
    let settings = settings();
    let sources = with_photons(sources(&world), &settings);
    let image = finished(&sources, CameraView::FinalGather, home(&world), SIZE, &settings);
    let parts = [BACK_WALL, RED_WALL, GREEN_WALL, CEILING, BESIDE_RED, BESIDE_GREEN, CORNER];
    // Each part has at least 32 pixels of 256 gathering rays. Light that is gathered is about half of all and varies by its
    // own size: 3 · 0.5 / √8192 = 1.7 % for the smallest part, if rays were not stratified.
    check(&sources, &home(&world), &image, &parts, 0.017);
}

#[test]
fn photons_agree_with_brute_force_away_from_edges() {
    let world = builtin("cornell-box");
    let settings = settings();
    let sources = with_photons(sources(&world), &settings);
    let image = finished(&sources, CameraView::PhotonRadiance, home(&world), SIZE, &settings);
    // Each part is at least half a percent of the 1.9 m² on which some 800,000 photons land: 3 / √4000 = 4.7 %.
    check(&sources, &home(&world), &image, &[BACK_WALL, RED_WALL, GREEN_WALL], 0.047);
}

#[test]
fn rays_alone_bring_no_light_from_wall_to_wall() {
    let world = builtin("cornell-box");
    let settings = settings();
    let sources = with_photons(sources(&world), &settings);
    let camera = home(&world);
    let traced = finished(&sources, CameraView::RayTraced, camera, SIZE, &settings);
    assert_eq!(mean_of(&traced, CEILING), Rgb::ZERO, "the lamp does not shine on the ceiling that it is in");
    // White under the lamp and nothing else: the colours of both.
    let direct = (0.725 * 17.0) / (0.71 * 12.0);
    for part in [BESIDE_RED, BESIDE_GREEN] {
        assert!((red_over_green(mean_of(&traced, part)) / direct - 1.0).abs() < 1e-4, "{}", part.0);
    }
    let gathered = finished(&sources, CameraView::FinalGather, camera, SIZE, &settings);
    for part in [BESIDE_RED, BESIDE_GREEN] {
        let truth = red_over_green(truth_of(&sources, &camera, part).mean);
        let got = red_over_green(mean_of(&gathered, part));
        println!("{}: red over green {got:.4}, in truth {truth:.4}, in direct light {direct:.4}", part.0);
        // Both colours come along the same rays, so that their quotient is less noisy than either: the bleeding itself is
        // some 20 % here.
        assert!((got / truth - 1.0).abs() < 0.02);
    }
    let bleeding = red_over_green(mean_of(&gathered, BESIDE_RED)) / red_over_green(mean_of(&gathered, BESIDE_GREEN));
    assert!(bleeding > 1.15, "red and green walls colour the floor beside them: {bleeding}");
}

/// What shadow rays find is what ray tracing shows; the rest is light between surfaces, by whichever solver.
#[test]
fn radiosity_with_direct_rays_agrees_with_brute_force_by_every_solver() {
    let world = builtin("cornell-box");
    let camera = home(&world);
    let traced = finished(&sources(&world), CameraView::RayTraced, camera, SIZE, &settings());
    for solver in [Solver::Progressive, Solver::GaussSeidel] {
        let settings = Settings { solver, ..settings() };
        let mut method = radiosity::start(world.clone(), &settings);
        while matches!(method.step(&Cancel::default()), Step::Advanced | Step::Prepared) {}
        let solution = Arc::new(method.solution());
        let light = &solution.light;
        assert!(
            light
                .irradiance
                .iter()
                .zip(&light.direct)
                .all(|(all, direct)| { (*all - *direct).min_element() >= -1e-5 * all.max_element() })
        );
        let sources = Sources { radiosity: Some(solution), ..sources(&world) };
        let image = finished(&sources, CameraView::RadiosityDirect, camera, SIZE, &settings);
        // The same shadow rays to the same points: what is left is never below 0 but for rounding, and smooth.
        for (whole, direct) in image.radiance.iter().zip(&traced.radiance) {
            assert!((*whole - *direct).min_element() >= -1e-5 * whole.max_element(), "{whole} {direct}");
        }
        let parts = [BACK_WALL, RED_WALL, GREEN_WALL, CEILING, BESIDE_RED, BESIDE_GREEN];
        // Of the half of the light that comes from surfaces, elements of 19 mm are right to some percent.
        check(&sources, &camera, &image, &parts, 0.03);
    }
}
