//! Pictures from a camera: `cargo bench --bench image` prints the rays per second of whole passes. `tracer/closest` of the
//! bench `light` traces rays of the same kind and nothing else.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::mesh::MeshSettings;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::photon_map::PhotonMapping;
use lightwell::methods::transport::Transport;
use lightwell::methods::{ImageSettings, PhotonSettings, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::CameraView;
use lightwell::world::World;
use std::sync::Arc;

const SIZE: [u32; 2] = [256, 256];

fn settings(photons: u32, gather_rays: u32) -> Settings {
    Settings {
        photons: PhotonSettings { count: photons, ..PhotonSettings::default() },
        image: ImageSettings { samples: u32::MAX, gather_rays, light_rays: 4, ..ImageSettings::default() },
        ..Settings::default()
    }
}

fn cornell_box() -> Arc<World> {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    Arc::new(World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world"))
}

fn with_photons(transport: &Arc<Transport>, settings: &Settings) -> Sources {
    let mut photons = PhotonMapping::new(transport.clone(), settings);
    while photons.step(&Cancel::default()) == Step::Advanced {}
    Sources { transport: transport.clone(), radiosity: None, photons: Some(photons.maps()) }
}

/// One pass over all pixels, after the coarse ones.
fn pass(run: &mut ImageRun) -> u64 {
    let before = run.image().map_or(0, |image| image.rays);
    let samples = run.samples();
    while run.samples() == samples {
        run.step(&Cancel::default());
    }
    run.image().map_or(0, |image| image.rays) - before
}

fn views(criterion: &mut Criterion) {
    let world = cornell_box();
    let transport = Arc::new(Transport::new(world.clone()));
    let camera = Camera::new(&world.viewpoint, &world.bounds);
    let settings = settings(200_000, 64);
    let sources = with_photons(&transport, &settings);
    let mut group = criterion.benchmark_group("view");
    group.sample_size(10);
    for (name, view) in [
        ("ray-traced", CameraView::RayTraced),
        ("photon-radiance", CameraView::PhotonRadiance),
        ("final-gather", CameraView::FinalGather),
    ] {
        let mut run = ImageRun::new(&sources, view, camera, SIZE, &settings).expect("all it needs");
        pass(&mut run);
        group.throughput(Throughput::Elements(pass(&mut run)));
        group.bench_function(name, |bencher| bencher.iter(|| pass(&mut run)));
    }
    group.finish();
}

criterion_group!(benches, views);
criterion_main!(benches);
