//! Pictures from a camera: the making of them, what rays bring, and views against each other and against brute force.

mod agreement;
mod contrast;
mod errors;
mod film;
mod near_emitters;
mod noise;
mod rays;
mod spheres;
mod truth;

use glam::Vec3;
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::effects::Switches;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::MeshSettings;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::photon_map::PhotonMapping;
use lightwell::methods::transport::Transport;
use lightwell::methods::{ImageSettings, Settings, Step};
use lightwell::scene::{Scene, Viewpoint};
use lightwell::solution::{CameraImage, CameraView};
use lightwell::world::World;
use std::sync::Arc;

fn world(scene: Scene) -> Arc<World> {
    Arc::new(World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world"))
}

fn builtin(name: &str) -> Arc<World> {
    world(Scene::open(name).expect("a built-in scene"))
}

/// A world of one's own making.
fn scene(obj: &str, mtl: &str) -> Arc<World> {
    world(Scene::from_text("test", obj, mtl).expect("a scene"))
}

fn sources(world: &Arc<World>) -> Sources {
    Sources { transport: Arc::new(Transport::new(world.clone(), Switches::default())), radiosity: None, photons: None }
}

/// The same with all photons of the settings.
fn with_photons(sources: Sources, settings: &Settings) -> Sources {
    let mut photons = PhotonMapping::new(sources.transport.clone(), settings);
    while photons.step(&Cancel::default()) == Step::Advanced {}
    Sources { photons: Some(photons.maps()), ..sources }
}

/// The scene's own first view.
fn home(world: &World) -> Camera {
    Camera::new(&world.viewpoint, &world.bounds)
}

fn camera(world: &World, eye: Vec3, target: Vec3, up: Vec3, vertical_fov: f32) -> Camera {
    Camera::new(&Viewpoint { eye, target, up, vertical_fov }, &world.bounds)
}

fn with_samples(samples: u32) -> Settings {
    Settings { image: ImageSettings { samples, ..ImageSettings::default() }, ..Settings::default() }
}

/// A view with all its samples.
fn finished(sources: &Sources, view: CameraView, camera: Camera, size: [u32; 2], settings: &Settings) -> CameraImage {
    let mut run = ImageRun::new(sources, view, camera, size, settings).expect("everything it needs");
    while run.step(&Cancel::default()) == Step::Advanced {}
    run.image().expect("a picture")
}

/// Mean over a rectangle, in shares of the picture's width and height from the top left.
fn mean(image: &CameraImage, x: [f32; 2], y: [f32; 2]) -> Rgb {
    let range = |share: [f32; 2], pixels: u32| {
        let [from, to] = share.map(|share| (share * pixels as f32).round() as u32);
        from..to
    };
    let [width, height] = image.resolution;
    let pixels = range(y, height).flat_map(|y| range(x, width).map(move |x| (y * width + x) as usize));
    let values: Vec<Rgb> = pixels.map(|pixel| image.radiance[pixel]).collect();
    values.iter().sum::<Rgb>() / values.len() as f32
}
