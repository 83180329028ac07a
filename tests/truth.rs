//! Radiosity against the brute-force oracle.

#[path = "common/oracle.rs"]
mod oracle;

use glam::DVec3;
use lightwell::cancel::Cancel;
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::irradiance_in_space;
use lightwell::methods::{FormFactorMethod, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::{Solution, SurfaceProbe};
use lightwell::worker::Run;
use lightwell::world::World;
use oracle::Oracle;
use rayon::prelude::*;
use std::sync::Arc;

const POINTS: usize = 200;
/// The noise of the oracle, which the tests print, is part of the error that is measured.
const PATHS: u64 = 8192;

fn solve(element_size: f32, form_factor: FormFactorMethod) -> (Arc<World>, Solution) {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let settings = Settings {
        mesh: MeshSettings { element_size: Some(element_size), ..MeshSettings::default() },
        form_factor,
        // At least a thousand to an element of ordinary brightness: 3 % noise if they were random, and they are stratified.
        light_rays: 40_000_000,
        ..Settings::default()
    };
    let world = Arc::new(World::build(scene, &settings.mesh, &Cancel::default()).expect("a world"));
    let mut run = Run::start(world.clone(), &settings).expect("enough memory");
    while run.step(&Cancel::default()) == Step::Advanced {}
    let solution = run.solution();
    (world, solution)
}

/// Relative errors of the sum over the channels.
struct Errors {
    mean: f64,
    /// Root of the mean square.
    rms: f64,
    /// The part of it that is the oracle's own, at most: the noise of the channels is taken to be of one sign.
    noise: f64,
}

fn errors(oracle: &Oracle, points: &[(DVec3, DVec3)], measured: impl Fn(DVec3, DVec3) -> f64 + Sync) -> Errors {
    let relative: Vec<(f64, f64)> = points
        .par_iter()
        .enumerate()
        .map(|(index, &(point, normal))| {
            let channels = oracle.irradiance(point, normal, PATHS, index as u64);
            let truth: f64 = channels.iter().map(|channel| channel.mean()).sum();
            let noise: f64 = channels.iter().map(|channel| channel.standard_error()).sum();
            (measured(point, normal) / truth - 1.0, noise / truth)
        })
        .collect();
    let count = relative.len() as f64;
    let rms = |part: fn(&(f64, f64)) -> f64| (relative.iter().map(|e| part(e).powi(2)).sum::<f64>() / count).sqrt();
    let mean = relative.iter().map(|(error, _)| error).sum::<f64>() / count;
    let errors = Errors { mean, rms: rms(|e| e.0), noise: rms(|e| e.1) };
    println!("{count} points: mean {mean:+.4}, RMS {:.4}, noise of the oracle {:.4}", errors.rms, errors.noise);
    errors
}

#[test]
fn the_irradiance_of_the_cornell_box_agrees_with_brute_force_by_polygons() {
    check_surfaces(FormFactorMethod::Polygon, 0.012);
}

#[test]
fn the_irradiance_of_the_cornell_box_agrees_with_brute_force_by_rays() {
    check_surfaces(FormFactorMethod::Rays, 0.012);
}

fn check_surfaces(form_factor: FormFactorMethod, element_size: f32) {
    let (world, solution) = solve(element_size, form_factor);
    let oracle = Oracle::new(&world.scene);
    let probe = SurfaceProbe::new(&world, &solution);
    let ask = |point: DVec3, normal: DVec3| probe.irradiance(point.as_vec3a(), normal.as_vec3a());
    // Everywhere that light comes: sides that nothing reaches have no truth to compare with.
    let points =
        oracle.points(POINTS, 1, |point, normal| ask(point, normal).is_some_and(|light| light.max_element() > 0.0));
    let Errors { mean, rms, noise } = errors(&oracle, &points, |point, normal| {
        f64::from(ask(point, normal).expect("only such points were chosen").element_sum())
    });
    assert!(noise < 0.02, "the oracle is too noisy to judge: {noise}");
    assert!(mean.abs() < 0.03 && rms < 0.05, "mean {mean}, RMS {rms}");
}

#[test]
fn a_light_meter_in_the_air_agrees_with_brute_force() {
    let (world, solution) = solve(0.02, FormFactorMethod::Polygon);
    let oracle = Oracle::new(&world.scene);
    let grid = (0..27).map(|i| [i % 3, i / 3 % 3, i / 9].map(|k| 0.12 + 0.16 * f64::from(k)));
    let places: Vec<(DVec3, DVec3)> = grid
        .flat_map(|place| [DVec3::Y, DVec3::NEG_Z, DVec3::X].map(|normal| (DVec3::from_array(place), normal)))
        .collect();
    // Those inside a block are dark, and dark is 0 on both sides.
    let lit: Vec<_> = places
        .iter()
        .copied()
        .filter(|&(point, normal)| oracle.irradiance(point, normal, 64, 0).iter().any(|channel| channel.mean() > 0.0))
        .collect();
    assert!(lit.len() > 60, "most of the room is air");
    let Errors { mean, rms, noise } = errors(&oracle, &lit, |point, normal| {
        f64::from(irradiance_in_space(&world, &solution, point.as_vec3a(), normal.as_vec3a(), 0).element_sum())
    });
    assert!(noise < 0.02, "the oracle is too noisy to judge: {noise}");
    assert!(mean.abs() < 0.03 && rms < 0.05, "mean {mean}, RMS {rms}");
}
