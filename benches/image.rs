//! Pictures from a camera: `cargo bench --bench image` prints the rays per second of whole passes. `tracer/closest` of the
//! bench `light` traces rays of the same kind and nothing else.

#[path = "common/pictures.rs"]
mod pictures;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use lightwell::camera::Camera;
use lightwell::effects::Switches;
use lightwell::methods::image::ImageRun;
use lightwell::methods::transport::Transport;
use lightwell::solution::CameraView;
use pictures::{SIZE, cornell_box, pass, settings, with_photons};
use std::sync::Arc;

fn views(criterion: &mut Criterion) {
    let world = cornell_box();
    let transport = Arc::new(Transport::new(world.clone(), Switches::default()));
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
