//! Ambient occlusion: `cargo bench --bench occlusion` prints the rays per second of whole passes over pictures of 512 × 512
//! pixels with 64 rays each, in scenes of 36 to a million triangles, and of the tracer alone with the same rays.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3A;
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::effects::Switches;
use lightwell::math::random::sobol2;
use lightwell::math::warp::{cosine_hemisphere, frame};
use lightwell::mesh::MeshSettings;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::transport::Transport;
use lightwell::methods::{Falloff, ImageSettings, OcclusionSettings, Range, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::CameraView;
use lightwell::tracer::Ray;
use lightwell::world::World;
use rayon::prelude::*;
use std::f32::consts::{PI, TAU};
use std::fmt::Write;
use std::sync::Arc;
use std::time::Duration;

/// Width and height, pixels.
const SIZE: [u32; 2] = [512, 512];
/// Of a pixel.
const RAYS: u32 = 64;
/// Rows and columns of balls.
const BALLS: u32 = 4;

fn built(scene: Scene) -> Arc<World> {
    Arc::new(World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world"))
}

/// Balls of `rings` rings each on a floor before a wall, without an emitter.
fn balls(rings: u32) -> String {
    let mut obj = "v -1 0 -1\nv -1 0 5\nv 5 0 5\nv 5 0 -1\nv -1 4 -1\nv 5 4 -1\nf 1 2 3 4\nf 1 4 6 5\n".to_owned();
    for (row, column) in (0..BALLS).flat_map(|row| (0..BALLS).map(move |column| (row, column))) {
        for (ring, step) in (0..=rings).flat_map(|ring| (0..2 * rings).map(move |step| (ring, step))) {
            let (polar, azimuth) = (PI * ring as f32 / rings as f32, TAU * step as f32 / (2 * rings) as f32);
            let point = 0.45 * Vec3A::new(polar.sin() * azimuth.cos(), polar.cos(), -polar.sin() * azimuth.sin());
            let point = point + Vec3A::new(column as f32, 0.46 + 0.2 * (row + column) as f32, row as f32);
            writeln!(obj, "v {} {} {}", point.x, point.y, point.z).expect("memory");
        }
        let first = 7 + (row * BALLS + column) * (rings + 1) * 2 * rings;
        let corner = |ring: u32, step: u32| first + ring * 2 * rings + step % (2 * rings);
        for (ring, step) in (0..rings).flat_map(|ring| (0..2 * rings).map(move |step| (ring, step))) {
            let [a, b, c, d] = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(down, on)| corner(ring + down, step + on));
            writeln!(obj, "f {a} {d} {c}\nf {a} {c} {b}").expect("memory");
        }
    }
    obj
}

/// Occlusion at any distance.
fn settings() -> Settings {
    Settings {
        image: ImageSettings { samples: u32::MAX, ..ImageSettings::default() },
        occlusion: OcclusionSettings { rays: RAYS, range: Range::Unlimited, falloff: Falloff::None },
        ..Settings::default()
    }
}

/// What a pass traces after the rays from the eye: of each pixel those from the surface in its middle.
fn occlusion_rays(transport: &Transport, camera: &Camera) -> Vec<Ray> {
    let eye_rays = camera.rays(SIZE);
    let surface = |pixel: u32| {
        let at = [(pixel % SIZE[0]) as f32 + 0.5, (pixel / SIZE[0]) as f32 + 0.5];
        transport.meet(&eye_rays.through(at))
    };
    let rays = |pixel: u32| {
        let surface = surface(pixel);
        surface.into_iter().flat_map(move |surface| {
            let around = frame(surface.normal);
            (0..RAYS).map(move |i| transport.leave(&surface, around * cosine_hemisphere(sobol2(i, 0, pixel))))
        })
    };
    (0..SIZE[0] * SIZE[1]).flat_map(rays).collect()
}

/// All rays of a picture so far.
fn rays(run: &ImageRun) -> u64 {
    run.image().map_or(0, |image| image.rays)
}

/// One pass over all pixels, after the coarse ones; returns its rays.
fn pass(run: &mut ImageRun) -> u64 {
    let before = rays(run);
    let samples = run.samples();
    while run.samples() == samples && run.step(&Cancel::default()) == Step::Advanced {}
    rays(run) - before
}

fn passes(criterion: &mut Criterion) {
    let scene = |rings: u32| Scene::from_text("balls", &balls(rings), "").expect("a scene");
    let mut group = criterion.benchmark_group("occlusion");
    group.sample_size(10);
    for scene in [Scene::open("cornell-box").expect("a built-in scene"), scene(63), scene(125)] {
        let world = built(scene);
        let transport = Arc::new(Transport::new(world.clone(), Switches::default()));
        let camera = Camera::new(&world.viewpoint, &world.bounds);
        let triangles = world.scene.polygons.iter().map(|polygon| polygon.corners().len() - 2).sum::<usize>();
        let rays = occlusion_rays(&transport, &camera);
        group.throughput(Throughput::Elements(rays.len() as u64));
        group.bench_with_input(BenchmarkId::new("tracer", triangles), &rays, |bencher, rays| {
            bencher.iter(|| rays.par_iter().filter(|ray| world.tracer.is_free(ray, f32::INFINITY)).count());
        });
        let sources = Sources { transport, radiosity: None, photons: None };
        let mut run = ImageRun::new(&sources, CameraView::AmbientOcclusion, camera, SIZE, &settings()).expect("a run");
        pass(&mut run);
        group.throughput(Throughput::Elements(pass(&mut run)));
        group.bench_with_input(BenchmarkId::new("pass", triangles), &(), |bencher, ()| {
            bencher.iter(|| pass(&mut run));
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(Duration::from_secs(1)).measurement_time(Duration::from_secs(5)).without_plots();
    targets = passes
}
criterion_main!(benches);
