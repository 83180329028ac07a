//! `lightwell series`: one scene from one camera as the lecture shows it, from ray tracing to final gather.

use super::camera_options::CameraOptions;
use super::image_options::ImageOptions;
use super::photon_options::PhotonOptions;
use super::run_options::SceneOptions;
use super::tracing::{Tracing, photon_report};
use super::{CliError, picture, values};
use crate::choice::Choice;
use crate::mesh::MeshSettings;
use crate::methods::{ImageSettings, Settings};
use crate::solution::CameraView;
use crate::viewport::{Frame, Light, PhotonLook, View, render_picture};
use crate::worker::CameraShot;
use serde_json::{Value, json};
use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// In the order of the lecture: dark shadows and unlit corners; the photons themselves; irradiance read off them; the same
/// times the reflectance; and the picture that they are for.
const VIEWS: [View; 5] = [
    View::Camera(CameraView::RayTraced),
    View::Photons,
    View::Camera(CameraView::PhotonIrradiance),
    View::Camera(CameraView::PhotonRadiance),
    View::Camera(CameraView::FinalGather),
];

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    /// The folder of the pictures; it is made where there is none
    #[arg(short, long, value_name = "DIR", value_parser = values::folder)]
    output: PathBuf,
    /// Samples a pixel; where --passes asks for more passes than one, pictures read off photons have one from each
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = values::count::<4096>)]
    samples: u32,
    /// Shadow rays to the emitters at each place that is seen [default: 4]
    #[arg(long, value_name = "N", value_parser = values::count::<{ ImageSettings::MAX_LIGHT_RAYS }>)]
    light_rays: Option<u32>,
    #[command(flatten)]
    photons: PhotonOptions,
    #[command(flatten)]
    image: ImageOptions,
    #[command(flatten)]
    camera: CameraOptions,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

/// All pictures have the same exposure.
pub fn run(options: &Options) -> Result<(), CliError> {
    let gpu = options.camera.gpu()?;
    let settings = options.settings();
    let world = options.scene.open(settings.mesh.elements_per_patch_edge)?;
    let exposure_ev = options.camera.exposure_ev(&world, None);
    if !options.output.is_dir() {
        let folder = || options.output.clone();
        std::fs::create_dir(&options.output).map_err(|source| CliError::Folder { path: folder(), source })?;
    }
    let mut tracing = Tracing::new(world.clone(), settings, None);
    let mut pictures = Vec::new();
    for (index, view) in VIEWS.into_iter().enumerate() {
        let start = Instant::now();
        let frame = options.frame(&tracing, view, exposure_ev);
        let light = options.light(&mut tracing, &frame)?;
        if let Some(reason) = view.missing(&light) {
            return Err(CliError::Missing(reason));
        }
        let samples = if view.shows_photons() { options.samples } else { 1 };
        let drawn = render_picture(&gpu, &world, &light, &frame, samples)?;
        let path = options.output.join(format!("{}-{}.png", index + 1, view.name()));
        picture::save(&path, &drawn, &picture::facts(&world, &light, &settings, &frame))?;
        pictures.push(report(view, &path, &light, start.elapsed().as_secs_f64()));
    }
    print(&pictures, photon_report(&world, &settings, &tracing.photons()?.solution()), options.json)
}

fn report(view: View, path: &std::path::Path, light: &Light, seconds: f64) -> Value {
    let mut report = json!({ "view": view.name(), "file": path, "seconds": seconds });
    if let Some(image) = light.image.as_deref() {
        report["samples"] = json!(image.samples);
        report["rays"] = json!(image.rays);
    }
    report
}

fn print(pictures: &[Value], mut report: Value, as_json: bool) -> Result<(), CliError> {
    let mut out = std::io::stdout().lock();
    if as_json {
        report["pictures"] = json!(pictures);
        writeln!(out, "{report}")?;
    } else {
        for picture in pictures {
            let seconds = picture["seconds"].as_f64().unwrap_or_default();
            writeln!(out, "{:>8.2} s  {}", seconds, picture["file"].as_str().unwrap_or_default())?;
        }
    }
    Ok(())
}

impl Options {
    fn settings(&self) -> Settings {
        Settings {
            mesh: self.scene.mesh(MeshSettings::default().elements_per_patch_edge),
            seed: self.scene.seed,
            photons: self.photons.settings(),
            image: self.image.settings(self.light_rays),
            ..Settings::default()
        }
    }

    fn frame(&self, tracing: &Tracing, view: View, exposure_ev: f32) -> Frame {
        Frame {
            camera: self.camera.camera(&tracing.world),
            size: self.camera.size,
            view,
            bounce: 0,
            ambient: false,
            wireframe: false,
            show_shooter: false,
            photons: PhotonLook::default(),
            filter: tracing.settings.image.filter,
            exposure_ev,
            tone: self.camera.tone,
        }
    }

    /// What a view shows.
    fn light(&self, tracing: &mut Tracing, frame: &Frame) -> Result<Light, CliError> {
        if let View::Camera(view) = frame.view {
            let shot = CameraShot { view, camera: frame.camera, size: frame.size };
            let (image, photons) = tracing.picture(&shot, None, Some(self.samples))?;
            return Ok(Light { photons: photons.map(Arc::new), image: Some(Arc::new(image)), ..Light::default() });
        }
        Ok(Light { photons: Some(Arc::new(tracing.first_pass()?)), ..Light::default() })
    }
}
