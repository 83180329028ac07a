//! Ambient occlusion against closed forms, at points and in pictures.

mod pictures;
mod points;
#[path = "../common/shapes.rs"]
mod shapes;
mod vertices;

use glam::{Vec3, Vec3A};
use lightwell::cancel::Cancel;
use lightwell::effects::Switches;
use lightwell::math::random::sobol2;
use lightwell::mesh::MeshSettings;
use lightwell::methods::ambient_occlusion::{AmbientOcclusion, Visibility};
use lightwell::methods::transport::Transport;
use lightwell::methods::{Falloff, OcclusionSettings, Range};
use lightwell::scene::Scene;
use lightwell::tracer::Ray;
use lightwell::world::World;
use std::fmt::Write;
use std::sync::Arc;

/// What stands for infinity, m. Of the sky, 1/FAR² = 3e-5 is beyond it at a height of 1.
const FAR: f32 = 200.0;
/// How far closed forms may be missed because points are rounded to 4 ulps of FAR, 6e-5 m: no share here changes by more than
/// 1.4 a metre.
const ROUNDED: f64 = 1e-4;

/// A closed form for each fall-off: occlusion by an infinite ceiling at height 1 with a range.
const UNDER_A_CEILING: [(Falloff, f32, f64); 5] = [
    // 1 − (h/D)²
    (Falloff::None, 2.0, 0.75),
    // (1 − h/D)²
    (Falloff::Linear, 2.0, 0.25),
    // 1 − ln 2
    (Falloff::Quadratic, 1.0, 0.306_852_819_440_055),
    // 2 E₃(1)
    (Falloff::Exponential, 1.0, 0.219_383_934_395_520),
    // The ceiling is out of reach.
    (Falloff::None, 0.9, 0.0),
];

fn transport(obj: &str) -> Arc<Transport> {
    let scene = Scene::from_text("test", obj, "").expect("a scene");
    let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
    Arc::new(Transport::new(Arc::new(world), Switches::default()))
}

/// A quad in OBJ text.
fn quad(corners: [Vec3; 4]) -> String {
    let mut text = String::new();
    for corner in corners {
        let _ = writeln!(text, "v {} {} {}", corner.x, corner.y, corner.z);
    }
    text + "f -4 -3 -2 -1\n"
}

/// A square plane of half this extent at a height, seen from both sides.
fn plane(height: f32, extent: f32) -> String {
    let corner = |x: f32, z: f32| Vec3::new(x * extent, height, z * extent);
    quad([corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)])
}

/// A wall of this height in the plane z = 0, of infinite length.
fn wall(height: f32) -> String {
    let corner = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    quad([corner(-FAR, 0.0), corner(FAR, 0.0), corner(FAR, height), corner(-FAR, height)])
}

fn settings(rays: u32, range: Range, falloff: Falloff) -> OcclusionSettings {
    OcclusionSettings { rays, range, falloff }
}

/// What arrives at the first surface below or beside a point.
fn at(transport: &Arc<Transport>, eye: Vec3, towards: Vec3, settings: &OcclusionSettings, seed: u32) -> Visibility {
    let surface = transport.meet(&Ray::new(eye.into(), Vec3A::from(towards.normalize())));
    let surface = surface.expect("a surface");
    AmbientOcclusion::new(transport.clone(), settings).visibility(&surface, |i| sobol2(i, 0, seed))
}
