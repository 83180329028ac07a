//! Form factors on two threads: the matrix of a cube's faces by closed forms, and one hemicube of the Cornell box.
//!
//! `cargo bench --bench form_factor` prints times, and of the matrix the worst error of a row's sum, which should be 1.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{DQuat, DVec3, EulerRot, Vec3};
use lightwell::cancel::Cancel;
use lightwell::math::polygon::Plate;
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::form_factor::hemicube::{Hemicube, Item};
use lightwell::scene::Scene;
use lightwell::world::World;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::time::Duration;

/// Element size at which the Cornell box has about 20,000 elements.
const ELEMENT_SIZE: f32 = 0.0107;
const HEMICUBE_RESOLUTION: u32 = 256;
const PATCHES_PER_EDGE: u32 = 16;

fn two_threads() -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(2).build().expect("two threads")
}

fn cornell_box() -> World {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let settings = MeshSettings { element_size: Some(ELEMENT_SIZE), ..MeshSettings::default() };
    World::build(scene, &settings, &Cancel::default()).expect("a world")
}

fn elements(world: &World) -> Vec<Item> {
    let mesh = &world.mesh;
    let item = |element: &lightwell::mesh::Element| {
        let corners: Vec<Vec3> = element.corners().iter().map(|&corner| mesh.vertices[corner as usize]).collect();
        Item::new(&corners, element.patch)
    };
    mesh.elements.iter().map(item).collect()
}

fn hemicube(criterion: &mut Criterion) {
    let world = cornell_box();
    let items = elements(&world);
    let mut hemicube = Hemicube::new(HEMICUBE_RESOLUTION);
    let mut sums = vec![0.0; world.mesh.patches.len()];
    let mut group = criterion.benchmark_group("hemicube");
    group.throughput(Throughput::Elements(items.len() as u64));
    println!("hemicube: {} elements, {HEMICUBE_RESOLUTION} cells across, from every patch in turn", items.len());
    let mut patches = world.mesh.patches.iter().cycle();
    let pool = two_threads();
    group.bench_function("draw", |bencher| {
        bencher.iter(|| {
            let patch = patches.next().expect("a patch");
            let center = world.tracer.lift(patch.center, patch.normal);
            pool.install(|| hemicube.draw(center, patch.normal, &items));
        });
    });
    group.bench_function("add_form_factors", |bencher| bencher.iter(|| hemicube.add_form_factors(&mut sums)));
    group.finish();
}

/// The six faces of the unit cube, turned, seen from inside and each cut into 16 × 16 squares.
fn cube_patches(turn: impl Fn(DVec3) -> DVec3) -> Vec<Plate> {
    let size = 1.0 / f64::from(PATCHES_PER_EDGE);
    let mut patches = Vec::new();
    for face in 0..6 {
        let (axis, is_high) = (face / 2, face % 2 == 1);
        for cell in 0..PATCHES_PER_EDGE * PATCHES_PER_EDGE {
            let (u, v) = (f64::from(cell % PATCHES_PER_EDGE) * size, f64::from(cell / PATCHES_PER_EDGE) * size);
            let mut corners = [(u, v), (u + size, v), (u + size, v + size), (u, v + size)].map(|(u, v)| {
                let mut corner = DVec3::splat(if is_high { 1.0 } else { 0.0 });
                corner[(axis + 1) % 3] = u;
                corner[(axis + 2) % 3] = v;
                corner
            });
            if is_high {
                corners.reverse();
            }
            patches.push(Plate::new(&corners.map(&turn)));
        }
    }
    patches
}

/// All F_ij, row by row. Each pair is computed once: A_i F_ij = A_j F_ji.
fn matrix(patches: &[Plate], tolerance: f64) -> Vec<f64> {
    let size = patches.len();
    let mut matrix = vec![0.0; size * size];
    matrix.par_chunks_mut(size).enumerate().for_each(|(i, row)| {
        for j in i + 1..size {
            row[j] = patches[i].exchange(&patches[j], tolerance) / patches[i].area();
        }
    });
    for i in 0..size {
        for j in 0..i {
            matrix[i * size + j] = matrix[j * size + i] * patches[j].area() / patches[i].area();
        }
    }
    matrix
}

/// Upright, and turned with corners in single precision, so that nothing is parallel or at a right angle to the last
/// digit.
fn cube_matrix(criterion: &mut Criterion) {
    let turn = DQuat::from_euler(EulerRot::XYZ, 0.3, 0.7, 1.1);
    let upright = cube_patches(|corner| corner);
    let turned = cube_patches(|corner| (turn * corner).as_vec3().as_dvec3());
    let pool = two_threads();
    let mut group = criterion.benchmark_group("cube_matrix");
    group.sample_size(20);
    for (name, patches, tolerance) in [
        ("upright/1e-4", &upright, 1e-4),
        ("upright/1e-6", &upright, 1e-6),
        ("upright/1e-8", &upright, 1e-8),
        ("turned/1e-4", &turned, 1e-4),
        ("turned/1e-5", &turned, 1e-5),
    ] {
        let rows = pool.install(|| matrix(patches, tolerance));
        let errors = rows.chunks(patches.len()).map(|row| (row.iter().sum::<f64>() - 1.0).abs());
        println!("cube_matrix/{name}: worst row-sum error {:.2e}", errors.fold(0.0, f64::max));
        group.bench_function(name, |bencher| bencher.iter(|| pool.install(|| matrix(patches, tolerance))));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(4))
        .without_plots();
    targets = cube_matrix, hemicube
}
criterion_main!(benches);
