//! Radiosity against the brute-force oracle.

#[path = "common/oracle.rs"]
mod oracle;

use glam::DVec3;
use lightwell::cancel::Cancel;
use lightwell::mesh::MeshSettings;
use lightwell::methods::Settings;
use lightwell::methods::Step;
use lightwell::methods::radiosity::irradiance_in_space;
use lightwell::scene::Scene;
use lightwell::solution::{Solution, SurfaceProbe};
use lightwell::worker::Run;
use lightwell::world::World;
use oracle::Oracle;
use rayon::prelude::*;
use std::sync::Arc;

const POINTS: usize = 200;
/// The noise of the oracle, about 1.2 % a point, is part of the error that is measured.
const PATHS: u64 = 8192;

fn solve(element_size: f32) -> (Arc<World>, Solution) {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let settings = Settings { mesh: MeshSettings { element_size: Some(element_size) }, ..Settings::default() };
    let world = Arc::new(World::build(scene, &settings.mesh, &Cancel::default()).expect("a world"));
    let mut run = Run::start(world.clone(), &settings);
    while run.step(&Cancel::default()) == Step::Advanced {}
    let solution = run.solution();
    (world, solution)
}

/// Mean and root of the mean square of relative errors, of the sum over the channels.
fn errors(oracle: &Oracle, points: &[(DVec3, DVec3)], measured: impl Fn(DVec3, DVec3) -> f64 + Sync) -> (f64, f64) {
    let relative: Vec<f64> = points
        .par_iter()
        .enumerate()
        .map(|(index, &(point, normal))| {
            let truth: f64 =
                oracle.irradiance(point, normal, PATHS, index as u64).iter().map(|channel| channel.mean()).sum();
            measured(point, normal) / truth - 1.0
        })
        .collect();
    let count = relative.len() as f64;
    let mean = relative.iter().sum::<f64>() / count;
    (mean, (relative.iter().map(|error| error * error).sum::<f64>() / count).sqrt())
}

#[test]
fn the_irradiance_of_the_cornell_box_agrees_with_brute_force() {
    let (world, solution) = solve(0.012);
    let oracle = Oracle::new(&world.scene);
    let probe = SurfaceProbe::new(&world, &solution);
    let ask = |point: DVec3, normal: DVec3| probe.irradiance(point.as_vec3a(), normal.as_vec3a());
    // Everywhere that light comes: sides that nothing reaches have no truth to compare with.
    let points =
        oracle.points(POINTS, 1, |point, normal| ask(point, normal).is_some_and(|light| light.max_element() > 0.0));
    let (mean, rms) = errors(&oracle, &points, |point, normal| {
        f64::from(ask(point, normal).expect("only such points were chosen").element_sum())
    });
    println!("{POINTS} points: mean {mean:+.4}, RMS {rms:.4}");
    assert!(mean.abs() < 0.03 && rms < 0.05, "mean {mean}, RMS {rms}");
}

#[test]
fn a_light_meter_in_the_air_agrees_with_brute_force() {
    let (world, solution) = solve(0.02);
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
    let (mean, rms) = errors(&oracle, &lit, |point, normal| {
        f64::from(irradiance_in_space(&world, &solution, point.as_vec3a(), normal.as_vec3a(), 0).element_sum())
    });
    println!("{} places: mean {mean:+.4}, RMS {rms:.4}", lit.len());
    assert!(mean.abs() < 0.03 && rms < 0.05, "mean {mean}, RMS {rms}");
}
