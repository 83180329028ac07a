//! Radiosity against the brute-force oracle.

#[path = "common/oracle.rs"]
mod oracle;

use lightwell::cancel::Cancel;
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::Radiosity;
use lightwell::methods::{Method, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::SurfaceProbe;
use lightwell::world::World;
use oracle::Oracle;
use rayon::prelude::*;
use std::sync::Arc;

#[test]
fn the_irradiance_of_the_cornell_box_agrees_with_brute_force_at_200_points() {
    for size in [0.02, 0.014] {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let settings = MeshSettings { element_size: Some(size) };
    let world = Arc::new(World::build(scene, &settings, &Cancel::default()).expect("a world"));
    let t = std::time::Instant::now();
    let mut method = Radiosity::new(world.clone(), Settings::default());
    while method.step(&Cancel::default()) == Step::Advanced {}
    println!("{size} {} elements {:?}", world.mesh.elements.len(), t.elapsed());
    let t = std::time::Instant::now();
    let solution = method.solution();
    let probe = SurfaceProbe::new(&world, &solution);

    let oracle = Oracle::new(&world.scene);
    let ask = |point: glam::DVec3, normal: glam::DVec3| probe.irradiance(point.as_vec3a(), normal.as_vec3a());
    let points = oracle.points(200, 1, |point, normal| ask(point, normal).is_some_and(|e| e.max_element() > 0.0));
    let errors: Vec<(f64, f64, f64)> = points
        .par_iter()
        .enumerate()
        .map(|(i, &(point, normal))| {
            let truth = oracle.irradiance(point, normal, 4096, i as u64);
            let sum: f64 = truth.iter().map(|channel| channel.mean()).sum();
            let noise: f64 = truth.iter().map(|channel| channel.standard_error()).sum();
            let got = f64::from(ask(point, normal).expect("chosen so").element_sum());
            (got, sum, noise)
        })
        .collect();
    let mut w: Vec<(f64, f64, f64, glam::DVec3, glam::DVec3)> = errors.iter().zip(&points).map(|(e,p)| (e.0/e.1-1.0, e.1, e.2/e.1, p.0, p.1)).collect();
    w.sort_by(|a,b| b.0.abs().total_cmp(&a.0.abs()));
    for x in &w[..12] { println!("{x:?}"); }
    let n = errors.len() as f64;
    let mean = errors.iter().map(|e| e.0 / e.1 - 1.0).sum::<f64>() / n;
    let rms = (errors.iter().map(|e| (e.0 / e.1 - 1.0).powi(2)).sum::<f64>() / n).sqrt();
    let noise = (errors.iter().map(|e| (e.2 / e.1).powi(2)).sum::<f64>() / n).sqrt();
    println!("{size} mean {mean} rms {rms} noise {noise} {:?}", t.elapsed());
    }
}
