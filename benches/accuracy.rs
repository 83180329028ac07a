//! What the accuracy of final gather costs in time. `cargo bench --bench accuracy` prints the error of the Cornell box after
//! each pass: the root of the mean of (I − R)² / (R² + 0.01) over pixels and channels, without the emitter. R is brute
//! force, whose own noise is taken out.

#[path = "common/pictures.rs"]
mod pictures;
#[path = "../tests/image/truth.rs"]
mod truth;

use lightwell::camera::Camera;
use lightwell::effects::Switches;
use lightwell::math::rgb::Rgb;
use lightwell::methods::image::ImageRun;
use lightwell::methods::transport::Transport;
use lightwell::solution::CameraView;
use pictures::{SIZE, cornell_box, pass, settings, with_photons};
use rayon::prelude::*;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Paths of each pixel of the truth.
const PATHS: u64 = 1024;

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
    let transport = Arc::new(Transport::new(world.clone(), Switches::default()));
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
