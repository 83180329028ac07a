//! Radiosity against closed forms, against itself by other ways, and against its own books.

mod agreement;
mod equation;
mod full_matrix;
mod furnace;
mod progressive;
#[path = "../common/quads.rs"]
mod quads;
mod relaxation;

use glam::Vec3;
use lightwell::cancel::Cancel;
use lightwell::math::rgb::{Rgb, total};
use lightwell::mesh::MeshSettings;
use lightwell::methods::{Method, Settings, Step, radiosity};
use lightwell::scene::{Polygon, Scene};
use lightwell::solution::{Energy, Solution};
use lightwell::world::World;
use std::sync::Arc;

fn world_of(scene: Scene, mesh: &MeshSettings) -> Arc<World> {
    Arc::new(World::build(scene, mesh, &Cancel::default()).expect("a world"))
}

fn world(name: &str, element_size: Option<f32>) -> Arc<World> {
    world_of(Scene::open(name).expect("a built-in scene"), &MeshSettings { element_size, ..MeshSettings::default() })
}

/// The built-in furnace, a closed cube that glows alike on all sides, with another reflectance.
fn furnace(reflectance: f32) -> Scene {
    let mut scene = Scene::open("furnace").expect("a built-in scene");
    for material in &mut scene.materials {
        material.diffuse = Rgb::splat(reflectance);
    }
    scene
}

/// A furnace that is no box: a room with the floor plan of an L, closed, in which not all walls see each other.
fn bent_furnace(reflectance: f32) -> Scene {
    let plan = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.5), (0.5, 0.5), (0.5, 1.0), (0.0, 1.0)];
    let at = |height: f32| plan.iter().map(move |&(x, z)| Vec3::new(x, height, z));
    let mut positions: Vec<Vec3> = at(0.0).chain(at(0.5)).collect();
    // Where the long walls go on behind the inner corner, so that floor and ceiling are quads.
    positions.extend([Vec3::new(0.0, 0.0, 0.5), Vec3::new(0.0, 0.5, 0.5)]);
    let walls = (0..6_u32).map(|i| {
        let j = (i + 1) % 6;
        vec![i, j, j + 6, i + 6]
    });
    let floors = [vec![0, 12, 2, 1], vec![12, 5, 4, 3], vec![6, 7, 8, 13], vec![13, 9, 10, 11]];
    let mut scene = furnace(reflectance);
    scene.positions = positions;
    scene.polygons = walls.chain(floors).map(|corners| Polygon::new(&corners, 0, 0, 0)).collect();
    scene.viewpoint = None;
    scene
}

fn run_to_end(world: &Arc<World>, settings: &Settings) -> Solution {
    let mut method = radiosity::start(world.clone(), settings);
    finish(&mut *method);
    method.solution()
}

fn finish(method: &mut dyn Method) {
    while matches!(method.step(&Cancel::default()), Step::Advanced | Step::Prepared) {}
}

/// The ledger closes to rounding.
fn check_ledger(energy: &Energy) {
    assert!(total(energy.defect()).abs() <= 1e-12 * total(energy.emitted), "{energy:?}");
    assert!([energy.absorbed, energy.unshot, energy.escaped].iter().all(|part| part.is_finite()), "{energy:?}");
}

/// Area-weighted mean of B over all elements, W/m² summed over RGB, and the largest relative deviation from `expected`.
fn mean_and_worst(world: &World, solution: &Solution, expected: f64) -> (f64, f64) {
    let light = || world.mesh.elements.iter().zip(&solution.light.radiosity).filter(|(element, _)| element.area > 0.0);
    let value = |radiosity: &Rgb| f64::from(radiosity.element_sum());
    let flux: f64 = light().map(|(element, radiosity)| element.area * value(radiosity)).sum();
    let worst = light().map(|(_, radiosity)| (value(radiosity) / expected - 1.0).abs()).fold(0.0, f64::max);
    (flux / world.mesh.area(), worst)
}
