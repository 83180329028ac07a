//! Irradiance of the Cornell box by photons, by brute force and by radiosity.

use super::oracle::Oracle;
use super::{at, open, run_to_end};
use glam::DVec3;
use lightwell::cancel::Cancel;
use lightwell::methods::photon_map::{PhotonMaps, Scratch, Which};
use lightwell::methods::transport::Surface;
use lightwell::methods::{PhotonSettings, Settings, Step, radiosity};
use lightwell::solution::SurfaceProbe;
use rayon::prelude::*;

const POINTS: usize = 200;
const PATHS: u64 = 1024;

/// Of some relative errors: mean, root of the mean square, and that of what the noise of both makes of them.
#[derive(Debug)]
struct Errors {
    mean: f64,
    rms: f64,
    noise: f64,
}

fn errors(relative: &[(f64, f64)]) -> Errors {
    let count = relative.len() as f64;
    let rms = |part: fn(&(f64, f64)) -> f64| (relative.iter().map(|e| part(e).powi(2)).sum::<f64>() / count).sqrt();
    Errors { mean: relative.iter().map(|e| e.0).sum::<f64>() / count, rms: rms(|e| e.0), noise: rms(|e| e.1) }
}

fn photons(maps: &PhotonMaps, surface: &Surface) -> (f64, f64) {
    let estimate = maps.irradiance(surface, Which::All, &mut Scratch::default());
    (f64::from(estimate.irradiance.element_sum()), f64::from(estimate.relative_error))
}

#[test]
fn photons_agree_with_brute_force_and_with_radiosity() {
    let transport = open("cornell-box");
    let world = transport.world.clone();
    let maps =
        run_to_end(&transport, PhotonSettings { count: 1_000_000, nearest: 400, ..PhotonSettings::default() }).maps();
    let mut method = radiosity::start(world.clone(), &Settings::default());
    while method.step(&Cancel::default()) == Step::Advanced {}
    let solution = method.solution();
    let probe = SurfaceProbe::new(&world, &solution);
    let radiosity = |point: DVec3, normal: DVec3| probe.irradiance(point.as_vec3a(), normal.as_vec3a());
    let oracle = Oracle::new(&world.scene);
    let points =
        oracle.points(POINTS, 1, |point, normal| radiosity(point, normal).is_some_and(|e| e.max_element() > 0.0));
    let compared: Vec<[(f64, f64); 2]> = points
        .par_iter()
        .enumerate()
        .map(|(index, &(point, normal))| {
            let surface = at(&transport, point.as_vec3a(), normal.as_vec3a());
            let (photons, error) = photons(&maps, &surface);
            let channels = oracle.irradiance(point, normal, PATHS, index as u64);
            let truth: f64 = channels.iter().map(|channel| channel.mean()).sum();
            let noise: f64 = channels.iter().map(|channel| channel.standard_error()).sum::<f64>() / truth;
            let other = f64::from(radiosity(point, normal).expect("only such points").element_sum());
            [(photons / truth - 1.0, error.hypot(noise)), (photons / other - 1.0, error)]
        })
        .collect();
    let against = |which: usize| errors(&compared.iter().map(|both| both[which]).collect::<Vec<_>>());
    let (brute_force, radiosity) = (against(0), against(1));
    println!("against brute force {brute_force:?}, against radiosity {radiosity:?}");
    // Bias: light is blurred over a radius of about 1 cm, 2 % of the room, which matters at the edges of shadows only.
    let mean = 3.0 * brute_force.noise / (POINTS as f64).sqrt() + 0.005;
    assert!(brute_force.mean.abs() < mean && brute_force.rms < brute_force.noise.hypot(0.03), "{brute_force:?}");
    // What radiosity is allowed to be off (tests/truth.rs).
    assert!(radiosity.mean.abs() < 0.03 && radiosity.rms < radiosity.noise.hypot(0.05), "{radiosity:?}");
}
