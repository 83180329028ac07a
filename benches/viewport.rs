//! What the window itself does for a frame at 100,000 elements: taking over a new solution, and recording a draw.
//!
//! `cargo bench --bench viewport` prints milliseconds of the thread that calls; what the graphics adapter does afterwards
//! is not in them. Needs an adapter, software will do; without one it says so.

use criterion::{Criterion, criterion_group, criterion_main};
use glam::Vec3;
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::{MeshSettings, side_index};
use lightwell::methods::Settings;
use lightwell::scene::Scene;
use lightwell::solution::{Path, PathFilter, Photon, PhotonSolution};
use lightwell::viewport::{
    AdapterChoice, Frame, Gpu, Light, PhotonColour, PhotonLook, ToneCurve, View, Viewport, automatic_exposure,
};
use lightwell::worker::Run;
use lightwell::world::World;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Element size at which the Cornell box has about 100,000 elements.
const ELEMENT_SIZE: f32 = 0.0049;

/// The time to upload what a frame shows of new light, to record its draw and to choose the exposure. That the adapter
/// takes the upload over and draws is not in it.
fn take_over(gpu: &Gpu, viewport: &mut Viewport, world: &World, light: &Light, frame: &Frame) -> Duration {
    let start = Instant::now();
    viewport.set_light(light);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    viewport.draw(&mut encoder, frame);
    let commands = encoder.finish();
    black_box(automatic_exposure(world, light.solution.as_deref()));
    let elapsed = start.elapsed();
    gpu.queue.submit([commands]);
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device works");
    elapsed
}

fn frame(world: &World, view: View) -> Frame {
    Frame {
        camera: Camera::new(&world.viewpoint, &world.bounds),
        size: [640, 480],
        view,
        bounce: 0,
        ambient: false,
        wireframe: false,
        show_shooter: true,
        photons: PhotonLook::default(),
        filter: PathFilter::default(),
        exposure_ev: 0.0,
        tone: ToneCurve::Linear,
    }
}

fn window_work(criterion: &mut Criterion) {
    let gpu = match Gpu::new(&AdapterChoice::System) {
        Ok(gpu) => gpu,
        Err(error) => return println!("viewport: skipped: {error}"),
    };
    let settings = Settings {
        mesh: MeshSettings { element_size: Some(ELEMENT_SIZE), ..MeshSettings::default() },
        ..Settings::default()
    };
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let world = Arc::new(World::build(scene, &settings.mesh, &Cancel::default()).expect("a world"));
    let mut run = Run::start(world.clone(), &settings).expect("enough memory");
    for _ in 0..4 {
        run.step(&Cancel::default());
    }
    let light = Light::from(run.solution());
    println!("viewport: {} elements, {}", world.mesh.elements.len(), gpu.adapter_name());

    let mut viewport = Viewport::new(&gpu, wgpu::TextureFormat::Rgba8Unorm);
    viewport.set_world(&world);
    let mut frame = frame(&world, View::Smooth);
    let mut group = criterion.benchmark_group("window_at_100k_elements");
    group.sample_size(20);
    group.bench_function("take_over_a_solution", |bencher| {
        bencher.iter_custom(|rounds| (0..rounds).map(|_| take_over(&gpu, &mut viewport, &world, &light, &frame)).sum());
    });
    group.bench_function("record_a_draw", |bencher| {
        bencher.iter(|| {
            frame.camera.orbit(0.01, 0.0);
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            viewport.draw(&mut encoder, &frame);
            encoder.finish()
        });
    });
    group.finish();
}

/// A million photons spread over the surfaces of a world.
fn photons(world: &World) -> Light {
    let elements = &world.mesh.elements;
    let photon = |index: u32| {
        let element = &elements[(index as usize * 7919) % elements.len()];
        let patch = &world.mesh.patches[element.patch as usize];
        let side = side_index(patch.polygon, patch.is_front) as u32;
        let (position, direction) = (element.center.into(), Vec3::NEG_Y);
        Photon { position, flux: Rgb::ONE, direction, side, path: Path::LIGHT, emission: index }
    };
    let photons = Arc::new((0..1_000_000).map(photon).collect());
    Light { photons: Some(Arc::new(PhotonSolution { photons, ..PhotonSolution::default() })), ..Light::default() }
}

/// A frame of a million photons, and taking them over, both with the work of the adapter.
fn million_photons(criterion: &mut Criterion) {
    let Ok(gpu) = Gpu::new(&AdapterChoice::System) else { return };
    let settings = MeshSettings { element_size: Some(ELEMENT_SIZE), ..MeshSettings::default() };
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let world = Arc::new(World::build(scene, &settings, &Cancel::default()).expect("a world"));
    let light = photons(&world);
    let mut viewport = Viewport::new(&gpu, wgpu::TextureFormat::Rgba8Unorm);
    viewport.set_world(&world);
    viewport.set_light(&light);
    let mut frame = Frame { size: [960, 640], ..frame(&world, View::Photons) };
    let mut draw = |frame: &Frame| {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        viewport.draw(&mut encoder, frame);
        gpu.queue.submit([encoder.finish()]);
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device works");
    };
    let mut group = criterion.benchmark_group("million_photons");
    group.sample_size(10);
    group.bench_function("draw_from_another_place", |bencher| {
        bencher.iter(|| {
            frame.camera.orbit(0.001, 0.0);
            draw(&frame);
        });
    });
    group.bench_function("colour_and_upload", |bencher| {
        bencher.iter(|| {
            let colour = frame.photons.colour;
            frame.photons.colour = if colour == PhotonColour::Path { PhotonColour::Flux } else { PhotonColour::Path };
            draw(&frame);
        });
    });
    group.finish();
}

criterion_group!(benches, window_work, million_photons);
criterion_main!(benches);
