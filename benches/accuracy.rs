//! What the accuracy of pictures costs in time. `cargo bench --bench accuracy` prints the error of the Cornell box after each
//! pass, method by method: the root of the mean of (I − R)² / (R² + 0.01) over pixels and channels, without the emitter. R is
//! path traced, and its own noise is taken out. Times are of everything after the scene was opened.

#[path = "common/pictures.rs"]
mod pictures;

use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::effects::Switches;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::MeshSettings;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::radiosity;
use lightwell::methods::transport::Transport;
use lightwell::methods::{ImageSettings, Settings, Step};
use lightwell::solution::CameraView;
use lightwell::world::World;
use pictures::{SIZE, cornell_box, pass, settings, with_photons};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Samples a pixel of each half of the truth.
const SAMPLES: u32 = 512;
/// When a method has had its turn.
const LONGEST: Duration = Duration::from_secs(8);
/// Longest edge of an element, m; light that may be left unshot; rays to the lamp.
const RADIOSITY: [(f32, f64, u32); 4] = [(0.1, 0.05, 1), (0.06, 0.02, 2), (0.03, 0.005, 4), (0.015, 0.002, 8)];

/// The truth as the mean of two halves, whose difference tells its noise.
struct Truth([Vec<Rgb>; 2]);

impl Truth {
    fn trace(sources: &Sources, camera: Camera) -> Self {
        let half = |seed| {
            let settings = Settings {
                seed,
                image: ImageSettings { samples: SAMPLES, ..ImageSettings::default() },
                ..Settings::default()
            };
            let mut run =
                ImageRun::new(sources, CameraView::Reference, camera, SIZE, &settings).expect("it needs nothing");
            while run.step(&Cancel::default()) == Step::Advanced {}
            run.image().expect("a picture").radiance
        };
        Self([half(101), half(102)])
    }

    /// The relative error of a picture without that of the truth, and that.
    fn error(&self, image: &[Rgb]) -> (f64, f64) {
        let (mut sum, mut noise, mut count) = (0.0, 0.0, 0.0);
        for (got, (one, other)) in image.iter().zip(self.0[0].iter().zip(&self.0[1])) {
            let truth = (*one + *other) / 2.0;
            if truth.max_element() < 2.0 {
                let weight = (truth * truth + 0.01).as_dvec3().recip();
                sum += ((*got - truth).as_dvec3().powf(2.0) * weight).element_sum();
                noise += (((*one - *other) / 2.0).as_dvec3().powf(2.0) * weight).element_sum();
                count += 3.0;
            }
        }
        (((sum - noise) / count).max(0.0).sqrt(), (noise / count).sqrt())
    }
}

/// Prints the error after 1, 2, 4 … passes.
fn follow(truth: &Truth, run: &mut ImageRun, start: Instant) {
    let (mut next, mut done) = (1, 0);
    while start.elapsed() < LONGEST {
        pass(run);
        done += 1;
        if done == next {
            let seconds = start.elapsed().as_secs_f64();
            let (error, _) = truth.error(&run.image().expect("a picture").radiance);
            println!("  {done:5} samples, {seconds:6.2} s: {:.2} %", 100.0 * error);
            next *= 2;
        }
    }
}

fn main() {
    let world = cornell_box();
    let transport = Arc::new(Transport::new(world.clone(), Switches::default()));
    let camera = Camera::new(&world.viewpoint, &world.bounds);
    let sources = Sources { transport: transport.clone(), radiosity: None, photons: None };
    let start = Instant::now();
    let truth = Truth::trace(&sources, camera);
    let (_, noise) = truth.error(&truth.0[0]);
    println!(
        "truth: 2 × {SAMPLES} samples in {:.1} s, its error {:.2} %",
        start.elapsed().as_secs_f64(),
        100.0 * noise
    );

    println!("path tracing");
    let many = |light_rays| Settings {
        image: ImageSettings { samples: ImageSettings::MAX_SAMPLES, light_rays, ..ImageSettings::default() },
        ..Settings::default()
    };
    let start = Instant::now();
    let mut run = ImageRun::new(&sources, CameraView::Reference, camera, SIZE, &many(1)).expect("it needs nothing");
    follow(&truth, &mut run, start);

    for (photons, gather_rays) in [(100_000, 16), (300_000, 32), (1_000_000, 64)] {
        println!("final gather: {photons} photons, {gather_rays} gathering rays");
        let start = Instant::now();
        let settings = settings(photons, gather_rays);
        let sources = with_photons(&transport, &settings);
        let mut run = ImageRun::new(&sources, CameraView::FinalGather, camera, SIZE, &settings).expect("photons");
        follow(&truth, &mut run, start);
    }

    for (element_size, unshot_limit, light_rays) in RADIOSITY {
        println!(
            "radiosity with direct rays: elements of {element_size} m, {unshot_limit} unshot, {light_rays} lamp rays"
        );
        let start = Instant::now();
        let settings = Settings { unshot_limit, ..many(light_rays) };
        let mesh = MeshSettings { element_size: Some(element_size), ..MeshSettings::default() };
        let world: Arc<World> = Arc::new(world.remeshed(&mesh, &Cancel::default()).expect("a mesh"));
        let mut method = radiosity::start(world.clone(), &settings);
        while method.step(&Cancel::default()) == Step::Advanced {}
        println!("  solved in {:.2} s", start.elapsed().as_secs_f64());
        let sources = Sources {
            transport: Arc::new(Transport::new(world, Switches::default())),
            radiosity: Some(Arc::new(method.solution())),
            photons: None,
        };
        let mut run =
            ImageRun::new(&sources, CameraView::RadiosityDirect, camera, SIZE, &settings).expect("a solution");
        follow(&truth, &mut run, start);
    }
}
