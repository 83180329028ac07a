//! What it saves to simulate only what a scene calls for. `cargo bench --bench effects` prints, for scenes and methods, the
//! time with all effects, with those of the plan, and the ratio of the two: medians of several rounds that take turns.

#[path = "../tests/common/quads.rs"]
mod quads;

use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::choice::Choice;
use lightwell::effects::{Effect, Effects, Switches};
use lightwell::mesh::MeshSettings;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::photon_map::PhotonMapping;
use lightwell::methods::transport::Transport;
use lightwell::methods::{ImageSettings, Settings, Step, radiosity, repertoire};
use lightwell::scene::Scene;
use lightwell::solution::CameraView;
use lightwell::world::World;
use quads::Quads;
use std::sync::Arc;
use std::time::Instant;

/// All of a scene with all effects, and with the planned ones.
const ROUNDS: usize = 5;
/// Width and height, pixels.
const SIZE: [u32; 2] = [256, 256];

#[derive(Clone, Copy)]
enum Work {
    /// Until a hundredth of the light is unshot.
    Radiosity,
    /// All photons of a pass.
    Photons,
    /// A sample of every pixel.
    RayTraced,
}

impl Work {
    fn name(self) -> &'static str {
        match self {
            Self::Radiosity => "radiosity",
            Self::Photons => "photon map",
            Self::RayTraced => "ray-traced",
        }
    }

    fn repertoire(self, settings: &Settings) -> Effects {
        match self {
            Self::Radiosity => repertoire::of_radiosity(settings.form_factor),
            Self::Photons => repertoire::of_photons(),
            Self::RayTraced => repertoire::of_view(CameraView::RayTraced, settings.form_factor),
        }
    }

    /// Seconds that it takes.
    fn time(self, world: &Arc<World>, settings: &Settings) -> f64 {
        let transport = Arc::new(Transport::new(world.clone(), settings.effects));
        let start = Instant::now();
        match self {
            Self::Radiosity => {
                let mut run = radiosity::start(world.clone(), settings);
                while run.step(&Cancel::default()) == Step::Advanced {}
            }
            Self::Photons => {
                let mut run = PhotonMapping::new(transport, settings);
                while run.step(&Cancel::default()) == Step::Advanced {}
            }
            Self::RayTraced => {
                let sources = Sources { transport, radiosity: None, photons: None };
                let camera = Camera::new(&world.viewpoint, &world.bounds);
                let mut run = ImageRun::new(&sources, CameraView::RayTraced, camera, SIZE, settings).expect("a run");
                while run.step(&Cancel::default()) == Step::Advanced {}
            }
        }
        start.elapsed().as_secs_f64()
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn compare(name: &str, world: &Arc<World>, work: Work) {
    let settings = |effects| Settings {
        effects,
        unshot_limit: 1e-2,
        image: ImageSettings { samples: 1, light_rays: 16, ..ImageSettings::default() },
        ..Settings::default()
    };
    let [planned, all] = [settings(Switches::default()), settings(Switches::ALL)];
    let skipped = work.repertoire(&all).but(planned.effects.simulated_in(world));
    if skipped.is_empty() {
        return;
    }
    let times = (0..ROUNDS).map(|_| (work.time(world, &all), work.time(world, &planned)));
    let (all, planned): (Vec<f64>, Vec<f64>) = times.unzip();
    let (all, planned) = (median(all), median(planned));
    let skipped: Vec<_> = skipped.iter().map(Effect::name).collect();
    println!(
        "{name:18} {:10} {all:8.3} s {planned:8.3} s {:6.2} ×  without {}",
        work.name(),
        all / planned,
        skipped.join(", ")
    );
}

fn main() {
    let quads = |name, quads: Quads| (name, quads.scene());
    let builtin = |name| (name, Scene::open(name).expect("a built-in scene"));
    println!("scene              method           all    planned   ratio");
    for (name, scene) in [
        quads("empty room", Quads::room("grey", "glow", "grey")),
        quads("black room", Quads::room("black", "lamp", "black")),
        quads("room with a block", Quads::room("grey", "glow", "grey").block("grey")),
        builtin("furnace"),
        builtin("cornell-box"),
        builtin("two-rooms"),
        builtin("glossy-floor"),
        builtin("caustic-ring"),
    ] {
        let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
        let world = Arc::new(world);
        for work in [Work::Radiosity, Work::RayTraced, Work::Photons] {
            compare(name, &world, work);
        }
    }
}
