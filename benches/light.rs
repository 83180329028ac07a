//! The hot paths of light: rays of the tracer alone, form factors, and whole shots, on all cores.
//!
//! `cargo bench --bench light` prints elements per second: rays, form factors, and the rays of shots. The rate of a shot over the
//! rate of `tracer/visibility`, which traces rays of the same kind and nothing else, is the share of the tracer's speed
//! that goes through a shot.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{DVec3, Vec3A};
use lightwell::cancel::Cancel;
use lightwell::choice::Choice;
use lightwell::math::polygon::form_factor;
use lightwell::math::random::Stream;
use lightwell::math::warp::{cosine_hemisphere, frame};
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::{FullMatrix, Progressive};
use lightwell::methods::{FormFactorMethod, Method, Settings, Solver};
use lightwell::scene::Scene;
use lightwell::tracer::{Ray, SurfacePoint};
use lightwell::world::World;
use rayon::prelude::*;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Rays of one round of the tracer.
const RAYS: u64 = 1 << 17;
/// Element size at which the Cornell box has about 20,000 elements.
const ELEMENT_SIZE: f32 = 0.0107;

fn cornell_box() -> Arc<World> {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let settings = MeshSettings { element_size: Some(ELEMENT_SIZE), ..MeshSettings::default() };
    Arc::new(World::build(scene, &settings, &Cancel::default()).expect("a world"))
}

/// A random element's centre, and its normal.
fn place(world: &World, stream: &mut Stream) -> (SurfacePoint, Vec3A) {
    let element = &world.mesh.elements[(stream.bits() % world.mesh.elements.len() as u64) as usize];
    let patch = &world.mesh.patches[element.patch as usize];
    (patch.surface_point(element.center), patch.normal)
}

/// Pairs of points on elements and one patch after the other that face each other, four for each element, as in shots.
fn facing_pairs(world: &World) -> Vec<(SurfacePoint, SurfacePoint)> {
    let mut stream = Stream::new(1, 0, 0);
    let mut pairs = Vec::new();
    let patches = &world.mesh.patches;
    while pairs.len() < RAYS as usize {
        let shooter = &patches[(stream.bits() % patches.len() as u64) as usize];
        let shooter_region = shooter.region();
        for element in &world.mesh.elements {
            let receiver = &patches[element.patch as usize];
            let region = world.mesh.region(element);
            for _ in 0..4 {
                let from = receiver.surface_point(region.point(stream.uniform2()));
                let to = shooter.surface_point(shooter_region.point(stream.uniform2()));
                let way = to.point - from.point;
                if element.exposed > 0.0 && way.dot(receiver.normal) > 0.0 && way.dot(shooter.normal) < 0.0 {
                    pairs.push((from, to));
                }
            }
        }
    }
    pairs.truncate(RAYS as usize);
    pairs
}

fn tracer(criterion: &mut Criterion) {
    let world = cornell_box();
    let mut group = criterion.benchmark_group("tracer");
    group.throughput(Throughput::Elements(RAYS));
    let pairs = facing_pairs(&world);
    group.bench_function("visibility", |bencher| {
        bencher.iter(|| pairs.par_iter().filter(|(from, to)| world.tracer.is_unoccluded(*from, *to)).count());
    });
    let mut stream = Stream::new(2, 0, 0);
    let rays: Vec<Ray> = (0..RAYS)
        .map(|_| {
            let (from, normal) = place(&world, &mut stream);
            Ray::leaving(from, frame(normal) * cosine_hemisphere(stream.uniform2()))
        })
        .collect();
    group.bench_function("closest", |bencher| {
        bencher.iter(|| rays.par_iter().filter(|ray| world.tracer.closest(ray).is_some()).count());
    });
    group.finish();
}

fn form_factors(criterion: &mut Criterion) {
    let world = cornell_box();
    let corners: Vec<DVec3> = world.mesh.patches[0].corners().iter().map(|corner| corner.as_dvec3()).collect();
    let mut group = criterion.benchmark_group("form_factor");
    group.throughput(Throughput::Elements(world.mesh.elements.len() as u64));
    group.bench_function("point_to_polygon", |bencher| {
        bencher.iter(|| {
            let sum = |element: &lightwell::mesh::Element| {
                let normal = world.mesh.patches[element.patch as usize].normal;
                form_factor(element.center.as_dvec3(), normal.as_dvec3(), black_box(&corners))
            };
            world.mesh.elements.iter().map(sum).sum::<f64>()
        });
    });
    group.finish();
}

/// The time of shots from a range of steps, and the rays in it.
fn shots(world: &Arc<World>, skip: u64, count: u64) -> (Duration, u64) {
    let mut method = Progressive::new(world.clone(), Settings::default());
    for _ in 0..skip {
        method.step(&Cancel::default());
    }
    let before = method.solution().counters.rays;
    let start = Instant::now();
    for _ in 0..count {
        method.step(&Cancel::default());
    }
    (start.elapsed(), method.solution().counters.rays - before)
}

fn shooting(criterion: &mut Criterion) {
    let world = cornell_box();
    let mut group = criterion.benchmark_group("shot");
    group.sample_size(10);
    for (name, skip, count) in [("first_16", 0, 16), ("next_256", 16, 256)] {
        let (_, rays) = shots(&world, skip, count);
        let elements = world.mesh.elements.len();
        println!("shot/{name}: {count} shots of {} rays each, {elements} elements", rays / count);
        group.throughput(Throughput::Elements(rays));
        group.bench_function(name, |bencher| {
            bencher.iter_custom(|rounds| (0..rounds).map(|_| shots(&world, skip, count).0).sum());
        });
    }
    group.finish();
}

/// All form factors of the Cornell box in about 2,000 patches, with visibility, made reciprocal and closed.
fn matrix(criterion: &mut Criterion) {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let mesh = MeshSettings { element_size: Some(0.0345), elements_per_patch_edge: 1 };
    let world = Arc::new(World::build(scene, &mesh, &Cancel::default()).expect("a world"));
    let mut group = criterion.benchmark_group("matrix");
    group.sample_size(10);
    for &form_factor in FormFactorMethod::ALL {
        let settings = Settings { solver: Solver::GaussSeidel, form_factor, ..Settings::default() };
        let built = || {
            let mut method = FullMatrix::new(world.clone(), settings);
            for _ in 0..=world.mesh.patches.len() {
                method.step(&Cancel::default());
            }
            method
        };
        let solution = built().solution();
        println!(
            "matrix/{}: {} patches, {} rays, rows wrong by {:.1e} in the mean before they are closed",
            form_factor.name(),
            world.mesh.patches.len(),
            solution.counters.rays,
            solution.closure.mean
        );
        group.bench_function(form_factor.name(), |bencher| bencher.iter(built));
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(4)).without_plots();
    targets = tracer, form_factors, shooting, matrix
}
criterion_main!(benches);
