//! What the accuracy of final gather costs in time. `cargo bench --bench accuracy` prints the error of the Cornell box after
//! each pass: the root of the mean of (I − R)² / (R² + 0.01) over pixels and channels, without the emitter. R is brute
//! force, whose own noise is taken out.

#[path = "../tests/image/truth.rs"]
mod truth;

use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::MeshSettings;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::photon_map::PhotonMapping;
use lightwell::methods::transport::Transport;
use lightwell::methods::{ImageSettings, PhotonSettings, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::CameraView;
use lightwell::world::World;
use rayon::prelude::*;
use std::sync::Arc;
use std::time::{Duration, Instant};

const SIZE: [u32; 2] = [256, 256];
/// Paths of each pixel of the truth.
const PATHS: u64 = 1024;

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

/// The truth, and the variance of each of its channels.
fn truth(transport: &Transport, camera: &Camera) -> Vec<(Rgb, Rgb)> {
    let pixel = |pixel: u32| truth::pixel(transport, camera, [pixel % SIZE[0], pixel / SIZE[0]], SIZE, PATHS);
    (0..SIZE[0] * SIZE[1]).into_par_iter().map(pixel).collect()
}

/// Relative error of a picture, and the part of it that is the truth's own noise. Pixels that show the emitter are left out.
fn error(image: &[Rgb], truth: &[(Rgb, Rgb)]) -> (f64, f64) {
    let (mut sum, mut noise, mut count) = (0.0, 0.0, 0.0);
    for (got, (truth, variance)) in image.iter().zip(truth).filter(|(_, (truth, _))| truth.max_element() < 2.0) {
        let weight = (*truth * *truth + 0.01).as_dvec3().recip();
        sum += ((*got - *truth).as_dvec3().powf(2.0) * weight).element_sum();
        noise += (variance.as_dvec3() * weight).element_sum();
        count += 3.0;
    }
    (sum / count, noise / count)
}

fn main() {
    let world = cornell_box();
    let transport = Arc::new(Transport::new(world.clone()));
    let camera = Camera::new(&world.viewpoint, &world.bounds);
    let start = Instant::now();
    let truth = truth(&transport, &camera);
    println!("truth: {PATHS} paths a pixel in {:.1} s", start.elapsed().as_secs_f64());
    for (photons, gather_rays) in [(100_000, 16), (300_000, 32), (1_000_000, 64)] {
        let settings = settings(photons, gather_rays);
        let start = Instant::now();
        let sources = with_photons(&transport, &settings);
        println!("{photons} photons, {gather_rays} gathering rays: {:.2} s of photons", start.elapsed().as_secs_f64());
        let mut run = ImageRun::new(&sources, CameraView::FinalGather, camera, SIZE, &settings).expect("photons");
        let mut done = Duration::ZERO;
        while done < Duration::from_secs(8) {
            pass(&mut run);
            done = start.elapsed();
            let (all, noise) = error(&run.image().expect("a picture").radiance, &truth);
            let own = (all - noise).max(0.0).sqrt();
            println!(
                "  {:6.2} s: {:.2} % ({:.2} % with the truth's noise)",
                done.as_secs_f64(),
                100.0 * own,
                100.0 * all.sqrt()
            );
        }
    }
}
