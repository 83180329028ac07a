//! Pictures of the Cornell box by the light of its photons, pass by pass.

use lightwell::cancel::Cancel;
use lightwell::mesh::MeshSettings;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::photon_map::PhotonMapping;
use lightwell::methods::transport::Transport;
use lightwell::methods::{ImageSettings, PhotonSettings, Settings, Step};
use lightwell::scene::Scene;
use lightwell::world::World;
use std::sync::Arc;

/// Width and height, pixels.
pub const SIZE: [u32; 2] = [256, 256];

pub fn settings(photons: u32, gather_rays: u32) -> Settings {
    Settings {
        photons: PhotonSettings { count: photons, ..PhotonSettings::default() },
        image: ImageSettings { samples: u32::MAX, gather_rays, light_rays: 4, ..ImageSettings::default() },
        ..Settings::default()
    }
}

pub fn cornell_box() -> Arc<World> {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    Arc::new(World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world"))
}

pub fn with_photons(transport: &Arc<Transport>, settings: &Settings) -> Sources {
    let mut photons = PhotonMapping::new(transport.clone(), settings);
    while photons.step(&Cancel::default()) == Step::Advanced {}
    Sources { transport: transport.clone(), radiosity: None, photons: Some(photons.maps()) }
}

/// One pass over all pixels, after the coarse ones; returns its rays.
pub fn pass(run: &mut ImageRun) -> u64 {
    let before = run.image().map_or(0, |image| image.rays);
    let samples = run.samples();
    while run.samples() == samples {
        run.step(&Cancel::default());
    }
    run.image().map_or(0, |image| image.rays) - before
}
