//! The path tracer: against closed forms, against brute force that shares nothing with it, and against itself.

mod agreement;
mod closed_forms;
mod emitters;
mod materials;
#[path = "../common/oracle.rs"]
mod oracle;
#[path = "../common/shapes.rs"]
#[allow(dead_code, reason = "only balls are needed")]
mod shapes;
#[path = "../image/truth.rs"]
mod truth;

use glam::Vec3A;
use lightwell::cancel::Cancel;
use lightwell::effects::Switches;
use lightwell::math::rgb::Rgb;
use lightwell::math::stats::Moments;
use lightwell::mesh::MeshSettings;
use lightwell::methods::path_trace::{Sensor, Sensors};
use lightwell::methods::transport::Transport;
use lightwell::scene::Scene;
use lightwell::world::World;
use std::sync::Arc;

fn transport(scene: Scene) -> Arc<Transport> {
    let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
    Arc::new(Transport::new(Arc::new(world), Switches::default()))
}

/// A scene from OBJ and MTL text.
fn scene(obj: &str, mtl: &str) -> Arc<Transport> {
    transport(Scene::from_text("test", &format!("mtllib m.mtl\n{obj}"), mtl).expect("a scene"))
}

/// The irradiance on the sides of surfaces that the normals face, by so many paths of each replicate.
fn irradiance(transport: &Arc<Transport>, points: &[(Vec3A, Vec3A)], paths: u64, seed: u64) -> Vec<[Moments; 3]> {
    let sensors = points.iter().map(|&(point, normal)| Sensor::new(transport, point, normal)).collect();
    let mut sensors = Sensors::new(transport.clone(), sensors, seed);
    assert!(sensors.step(paths, &Cancel::default()));
    assert_eq!(sensors.paths(), paths * Sensors::REPLICATES as u64);
    sensors.irradiance()
}

/// Says how many standard errors a mean of replicates is away. One of 32 replicates has a spread that is known to an
/// eighth, so that their mean follows Student's distribution with 31 degrees of freedom: beyond 5 once in 40,000.
fn deviation(channel: &Moments, expected: f64) -> f64 {
    // Rounding of single precision is left, where nothing is random.
    let error = channel.standard_error().max(1e-6 * expected.abs());
    (channel.mean() - expected) / error
}

fn assert_all_near(channels: &[Moments; 3], expected: Rgb) {
    for (channel, expected) in channels.iter().zip(expected.as_dvec3().to_array()) {
        let away = deviation(channel, expected);
        assert!(away.abs() < 5.0, "{channel:?}, {expected} expected: {away} standard errors");
    }
}

/// The same box every time: 1 m, its corner at the origin, its faces looking inwards; each of a material that is named.
fn unit_box(materials: [&str; 6]) -> String {
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
    // Left, right, floor, ceiling, front, back.
    let faces = ["1 4 8 5", "2 6 7 3", "1 5 6 2", "4 3 7 8", "5 8 7 6", "1 2 3 4"];
    let faces = materials.iter().zip(faces).map(|(material, face)| format!("usemtl {material}\nf {face}\n"));
    corners.to_owned() + &faces.collect::<String>()
}
