//! Form factors on two threads: one hemicube of the Cornell box.
//!
//! `cargo bench --bench form_factor` prints times.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use lightwell::cancel::Cancel;
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::form_factor::hemicube::{Hemicube, Item};
use lightwell::scene::Scene;
use lightwell::world::World;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::time::Duration;

/// Element size at which the Cornell box has about 20,000 elements.
const ELEMENT_SIZE: f32 = 0.0107;
const HEMICUBE_RESOLUTION: u32 = 256;

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

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(4)).without_plots();
    targets = hemicube
}
criterion_main!(benches);
