//! Against brute force, and one run against another.

use crate::oracle::Oracle;
use crate::{irradiance, transport, truth};
use glam::{DVec3, Vec3A};
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::math::stats::Moments;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::path_trace::{Sensor, Sensors};
use lightwell::methods::{ImageSettings, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::{CameraImage, CameraView};
use rayon::prelude::*;

/// Whether light comes to this side: sides that nothing reaches are dark for both.
fn is_lit(oracle: &Oracle, point: DVec3, normal: DVec3) -> bool {
    oracle.irradiance(point, normal, 64, 0).iter().any(|channel| channel.mean() > 0.0)
}

/// Each point and channel within 3 standard errors of the difference as often as chance allows, and their squares 1 on
/// average.
#[test]
fn irradiance_at_200_points_is_that_of_brute_force() {
    let transport = transport(Scene::open("cornell-box").expect("a built-in scene"));
    let oracle = Oracle::new(&transport.world.scene);
    let points = oracle.points(200, 1, |point, normal| is_lit(&oracle, point, normal));
    let single: Vec<(Vec3A, Vec3A)> = points.iter().map(|&(p, n)| (p.as_vec3a(), n.as_vec3a())).collect();
    let found = irradiance(&transport, &single, 256, 3);
    let truth: Vec<[Moments; 3]> = points
        .par_iter()
        .enumerate()
        .map(|(index, &(point, normal))| oracle.irradiance(point, normal, 8192, index as u64))
        .collect();
    let (mut squares, mut outside, mut count) = (0.0, 0, 0);
    for (found, truth) in found.iter().flatten().zip(truth.iter().flatten()) {
        let error = found.standard_error().hypot(truth.standard_error());
        let away = (found.mean() - truth.mean()) / error;
        squares += away * away;
        outside += u32::from(away.abs() > 3.0);
        count += 1;
    }
    let mean_square = squares / f64::from(count);
    println!("{count} values: mean square {mean_square:.3}, {outside} beyond 3 standard errors");
    // Channels of one path are all but the same number, so that 600 values are worth 200: their mean square is 1 ± 0.1, and
    // 0.5 of 200 are beyond 3. Chance exceeds both limits once in some thousand.
    assert!(mean_square < 1.4 && outside <= 3 * 4, "{mean_square} {outside}");
}

/// The mean of many short runs is the mean of a long one: nothing depends on how many paths there are. Only where there are no
/// caustics: paths find these so seldom that some thousand do not know their own error.
#[test]
fn short_runs_are_no_different_from_long_ones() {
    for name in ["cornell-box", "glossy-floor"] {
        let transport = transport(Scene::open(name).expect("a built-in scene"));
        let oracle = Oracle::new(&transport.world.scene);
        let points: Vec<(Vec3A, Vec3A)> = oracle
            .points(16, 2, |point, normal| is_lit(&oracle, point, normal))
            .iter()
            .map(|&(p, n)| (p.as_vec3a(), n.as_vec3a()))
            .collect();
        let long = irradiance(&transport, &points, 1024, 0);
        let mut short = vec![[Moments::default(); 3]; points.len()];
        for seed in 1..=128 {
            for (all, found) in short.iter_mut().zip(irradiance(&transport, &points, 1, seed)) {
                (0..3).for_each(|channel| all[channel].add(found[channel].mean()));
            }
        }
        for (short, long) in short.iter().flatten().zip(long.iter().flatten()) {
            let error = short.standard_error().hypot(long.standard_error());
            let away = (short.mean() - long.mean()) / error;
            // 48 values of a scene; Student's distribution with some 100 degrees of freedom is beyond 4.5 once in 50,000.
            assert!(away.abs() < 4.5, "{name}: {short:?} {long:?}: {away}");
        }
    }
}

/// Stopping in between, and any number of threads, change nothing.
#[test]
fn steps_and_threads_do_not_matter() {
    let transport = transport(Scene::open("cornell-spheres").expect("a built-in scene"));
    let sensors = || {
        let world = &transport.world;
        let centers = world.mesh.elements.iter().step_by(97);
        let normals = centers.map(|e| (e.center, world.mesh.patches[e.patch as usize].normal));
        let sensors = normals.map(|(center, normal)| Sensor::new(&transport, center, normal)).collect();
        Sensors::new(transport.clone(), sensors, 11)
    };
    let mut whole = sensors();
    assert!(whole.step(8, &Cancel::default()));
    let mut parts = sensors();
    let stopped = Cancel::default();
    stopped.request();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    pool.install(|| {
        assert!(parts.step(5, &Cancel::default()));
        assert!(!parts.step(3, &stopped));
        assert!(parts.step(3, &Cancel::default()));
    });
    assert_eq!((whole.rays(), whole.paths()), (parts.rays(), parts.paths()));
    for (whole, parts) in whole.irradiance().iter().flatten().zip(parts.irradiance().iter().flatten()) {
        assert!((whole.mean() - parts.mean()).abs() <= 1e-12 * whole.mean(), "{whole:?} {parts:?}");
    }
}

fn picture(sources: &Sources, camera: Camera, size: [u32; 2], samples: u32) -> CameraImage {
    let settings = Settings { image: ImageSettings { samples, ..ImageSettings::default() }, ..Settings::default() };
    let mut run = ImageRun::new(sources, CameraView::Reference, camera, size, &settings).expect("it needs nothing");
    while run.step(&Cancel::default()) == Step::Advanced {}
    run.image().expect("a picture")
}

/// Quarters of pictures with mirrors, glass and gloss against plain path tracing, which knows no weights.
#[test]
fn pictures_are_those_of_plain_path_tracing() {
    for name in ["cornell-spheres", "glossy-floor", "caustic-ring", "gallery"] {
        let transport = transport(Scene::open(name).expect("a built-in scene"));
        let camera = Camera::new(&transport.world.viewpoint, &transport.world.bounds);
        let sources = Sources { transport: transport.clone(), radiosity: None, photons: None };
        let image = picture(&sources, camera, [128, 128], 64);
        for (x, y) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let range = |i: usize| [0.5 * i as f32, 0.5 * (i + 1) as f32];
            let truth = truth::region(&transport, &camera, range(x), range(y), 1 << 19).total;
            let pixels =
                (64 * y..64 * (y + 1)).flat_map(|row| (64 * x..64 * (x + 1)).map(move |column| row * 128 + column));
            let mean = pixels.map(|pixel| f64::from(image.radiance[pixel].element_sum())).sum::<f64>() / 4096.0;
            let miss = (mean - truth.mean()).abs();
            // The picture has half as many paths as the truth, and a smaller variance; so its error is below √2 of that.
            let error = 3f64.sqrt() * truth.standard_error();
            println!("{name} {x} {y}: {:.5} {:.5} ± {error:.5}", mean, truth.mean());
            assert!(miss < 4.0 * error, "{name}, quarter {x} {y}: {mean} {truth:?}");
        }
    }
}
