//! What scenes call for, that nothing else is simulated, and what is missing where something is switched off.

mod all_or_planned;
mod planned;
mod switched_off;

#[path = "../common/quads.rs"]
mod quads;

use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::effects::{Effect, Effects, Switches};
use lightwell::mesh::MeshSettings;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::photon_map::PhotonMapping;
use lightwell::methods::transport::Transport;
use lightwell::methods::{ImageSettings, OcclusionSettings, PhotonSettings, Settings, Step, radiosity};
use lightwell::scene::{Scene, Viewpoint};
use lightwell::solution::{CameraImage, CameraView, Solution};
use lightwell::world::World;
use quads::Quads;
use std::sync::Arc;

fn world(scene: Scene) -> World {
    World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world")
}

/// The same with a few elements only.
fn coarse(scene: Scene) -> Arc<World> {
    let mesh = MeshSettings { element_size: Some(scene_size(&scene) / 8.0), elements_per_patch_edge: 2 };
    Arc::new(World::build(scene, &mesh, &Cancel::default()).expect("a world"))
}

fn scene_size(scene: &Scene) -> f32 {
    let corners = || scene.positions.iter().copied();
    let (low, high) = (corners().reduce(glam::Vec3::min), corners().reduce(glam::Vec3::max));
    low.zip(high).map_or(1.0, |(low, high)| (high - low).max_element())
}

fn builtin(name: &str) -> Scene {
    Scene::open(name).expect("a built-in scene")
}

/// The same, seen from elsewhere.
fn seen_from(eye: [f32; 3], target: [f32; 3], scene: Scene) -> Scene {
    let viewpoint = Viewpoint { eye: eye.into(), target: target.into(), up: glam::Vec3::Y, vertical_fov: 60.0 };
    Scene { viewpoint: Some(viewpoint), ..scene }
}

/// A room with a lamp in it, on a red lawn that gets no light, seen from the lawn.
fn house() -> Scene {
    let quads = Quads::room("grey", "glow", "grey").up("red", 5.0, -0.01);
    seen_from([3.0, 2.0, 4.0], [0.0, 0.0, 0.0], quads.scene())
}

/// Coloured surfaces, and a lamp far above that shines away from them.
fn moonless_night() -> Scene {
    let quads = Quads::new().up("red", 1.0, 0.0).around("grey", 0.2, [0.0, 0.4], false).up("lamp", 0.01, 60.0);
    seen_from([2.0, 1.0, 2.0], [0.0, 0.0, 0.0], quads.scene())
}

fn without(effect: Effect) -> Switches {
    Switches { off: Effects::of(&[effect]), ..Switches::default() }
}

/// Few of everything.
fn settings(effects: Switches) -> Settings {
    Settings {
        effects,
        photons: PhotonSettings { count: 4_000, caustic_count: 4_000, nearest: 20, ..PhotonSettings::default() },
        image: ImageSettings { samples: 2, gather_rays: 4, light_rays: 2, ..ImageSettings::default() },
        occlusion: OcclusionSettings { rays: 4, ..OcclusionSettings::default() },
        ..Settings::default()
    }
}

/// So many steps of radiosity after the matrix, where there is one.
fn solved(world: &Arc<World>, settings: &Settings, steps: u32) -> Solution {
    let mut run = radiosity::start(world.clone(), settings);
    let mut done = 0;
    while done < steps {
        match run.step(&Cancel::default()) {
            Step::Prepared => {}
            Step::Advanced => done += 1,
            Step::Converged | Step::Cancelled => break,
        }
    }
    run.solution()
}

/// All photons of a pass.
fn traced(world: &Arc<World>, settings: &Settings) -> PhotonMapping {
    let mut mapping = PhotonMapping::new(Arc::new(Transport::new(world.clone(), settings.effects)), settings);
    while mapping.step(&Cancel::default()) == Step::Advanced {}
    mapping
}

/// A small picture with all of the light that a view may want.
fn picture(world: &Arc<World>, view: CameraView, settings: &Settings) -> CameraImage {
    let sources = Sources {
        transport: Arc::new(Transport::new(world.clone(), settings.effects)),
        radiosity: view.needs_radiosity().then(|| Arc::new(solved(world, settings, 10))),
        photons: view.needs_photons().then(|| traced(world, settings).maps()),
    };
    let camera = Camera::new(&world.viewpoint, &world.bounds);
    let mut run = ImageRun::new(&sources, view, camera, [24, 18], settings).expect("the light of the view is there");
    while run.step(&Cancel::default()) == Step::Advanced {}
    run.image().expect("a picture")
}
