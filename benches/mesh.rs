//! What a mesh costs: carrying 100,000 elements over to vertices, as the window does for every solution, and cutting scenes.
//!
//! `cargo bench --bench mesh` prints milliseconds.

use criterion::{Criterion, criterion_group, criterion_main};
use glam::Vec3A;
use lightwell::cancel::Cancel;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::MeshSettings;
use lightwell::scene::Scene;
use lightwell::world::World;
use std::f32::consts::{PI, TAU};
use std::fmt::Write;
use std::hint::black_box;

/// Element sizes at which scenes have about 100,000 elements.
const ELEMENT_SIZES: [(&str, f32); 3] = [("cornell-box", 0.0049), ("gallery", 0.0495), ("two-rooms", 0.0345)];
/// Rings of the tessellated sphere, and triangles in each half of one.
const RINGS: u32 = 224;

fn world(name: &str, element_size: Option<f32>) -> World {
    let settings = MeshSettings { element_size, ..MeshSettings::default() };
    World::build(Scene::open(name).expect("a scene"), &settings, &Cancel::default()).expect("a world")
}

/// A sphere of some 100,000 triangles that glows inside, as an OBJ file, each triangle with corners of its own, as scanners
/// write them.
fn sphere() -> String {
    let corner = |ring: u32, step: u32| {
        let (polar, azimuth) = (PI * ring as f32 / RINGS as f32, TAU * (step % RINGS) as f32 / RINGS as f32);
        Vec3A::new(polar.sin() * azimuth.cos(), polar.cos(), polar.sin() * azimuth.sin())
    };
    let mut obj = "mtllib sphere.mtl\nusemtl glow\n".to_owned();
    for (ring, step) in (0..RINGS).flat_map(|ring| (0..RINGS).map(move |step| (ring, step))) {
        let [a, b, c, d] = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(down, on)| corner(ring + down, step + on));
        for corners in [[a, d, c], [a, c, b]] {
            for corner in corners {
                writeln!(obj, "v {} {} {}", corner.x, corner.y, corner.z).expect("memory");
            }
            writeln!(obj, "f -3 -2 -1").expect("memory");
        }
    }
    obj
}

fn smoothing(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("smooth");
    for (name, element_size) in ELEMENT_SIZES {
        let mesh = world(name, Some(element_size)).mesh;
        println!("smooth/{name}: {} elements", mesh.elements.len());
        let values: Vec<Rgb> = mesh.elements.iter().map(|element| Rgb::from(element.center)).collect();
        let mut smoothed = Vec::new();
        group.bench_function(name, |bencher| bencher.iter(|| mesh.smooth(black_box(&values), &mut smoothed)));
    }
    group.finish();
}

fn cutting(criterion: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("sphere.obj");
    std::fs::write(&file, sphere()).expect("a file");
    std::fs::write(folder.path().join("sphere.mtl"), "newmtl glow\nKd 0.5 0.5 0.5\nKe 1 1 1\n").expect("a file");
    let sphere = (file.to_str().expect("a name"), None);
    let mut group = criterion.benchmark_group("remesh");
    group.sample_size(10);
    for (name, element_size) in ELEMENT_SIZES.map(|(name, size)| (name, Some(size))).into_iter().chain([sphere]) {
        let world = world(name, element_size);
        let label = if name == sphere.0 { "sphere" } else { name };
        println!("remesh/{label}: {} polygons, {} elements", world.scene.polygons.len(), world.mesh.elements.len());
        let settings = MeshSettings { element_size, ..MeshSettings::default() };
        group.bench_function(label, |bencher| {
            bencher.iter(|| world.remeshed(&settings, &Cancel::default()).expect("a world"));
        });
    }
    group.finish();
}

criterion_group!(benches, smoothing, cutting);
criterion_main!(benches);
