//! Views: of radiosity, of photons, and by rays from the camera.

use super::{Drawn, Options, SAMPLES};
use crate::choice::Choice;
use crate::cli::run_options::Solved;
use crate::cli::solve::report;
use crate::cli::tracing::{Tracing, photon_report};
use crate::cli::{CliError, effect_options, picture};
use crate::effects::Bill;
use crate::methods::{ImageSettings, Settings};
use crate::solution::{CameraImage, CameraView, Comparison, Solution};
use crate::viewport::{Frame, Gpu, Legend, Light, PhotonLook, View, render_picture};
use crate::worker::{CameraShot, Subject};
use crate::world::World;
use serde_json::{Value, json};
use std::sync::Arc;

impl Options {
    pub(super) fn draw_view(&self, view: View) -> Result<Drawn, CliError> {
        let gpu = self.camera.gpu()?;
        match view {
            View::Camera(view) => self.draw_by_rays(&gpu, view),
            View::Photons | View::KdTree => self.draw_photons(&gpu, view),
            View::OcclusionVertices => self.draw_occlusion(&gpu, view),
            _ => self.draw_radiosity(&gpu, view),
        }
    }

    fn draw_radiosity(&self, gpu: &Gpu, view: View) -> Result<Drawn, CliError> {
        let (solved, light) = self.solve()?;
        if let Some(reason) = view.missing(&light) {
            return Err(CliError::Missing(reason));
        }
        let kept = solved.solution.bounces.len();
        if view == View::Bounces && self.bounce >= kept {
            return Err(CliError::NoSuchBounce { kept: kept - 1 });
        }
        let Solved { world, settings, solution } = &solved;
        let frame = self.frame(world, settings, view, Some(solution));
        let mut report = report(&solved);
        report["picture"] = match &light.picked {
            Some(picked) if view.is_false_colour() => {
                let legend = Legend::of(view, &light).map(|legend| json!({ "low": legend.low, "high": legend.high }));
                json!({ "patch": picked.patch, "legend": legend })
            }
            _ => json!({ "exposure": frame.exposure_ev }),
        };
        self.draw(gpu, world, settings, &light, &frame, report)
    }

    fn draw_photons(&self, gpu: &Gpu, view: View) -> Result<Drawn, CliError> {
        let settings = self.settings();
        let mut tracing = Tracing::new(self.run.open()?, settings, self.run.time());
        let photons = tracing.trace(|_| ())?;
        let mut report = photon_report(&tracing.world, &settings, &photons);
        report["picture"] = json!({ "photons": photons.photons.len() });
        let light = Light { photons: Some(Arc::new(photons)), ..Light::default() };
        if let Some(reason) = view.missing(&light) {
            return Err(CliError::Missing(reason));
        }
        let frame = self.frame(&tracing.world, &settings, view, None);
        self.draw(gpu, &tracing.world, &settings, &light, &frame, report)
    }

    fn draw_occlusion(&self, gpu: &Gpu, view: View) -> Result<Drawn, CliError> {
        let default = if self.run.time().is_some() { ImageSettings::MAX_SAMPLES } else { SAMPLES };
        let mut settings = self.settings();
        settings.image.samples = self.samples.unwrap_or(default);
        let tracing = Tracing::new(self.run.open()?, settings, self.run.time());
        let shares = tracing.occlusion();
        let world = &tracing.world;
        let mut report = json!({
            "scene": world.scene.name,
            "method": view.name(),
            "elements": world.mesh.elements.len(),
            "vertices": world.mesh.vertices.len(),
        });
        effect_options::report(&mut report, Subject::Occlusion, world, &settings, &Bill::default());
        report["picture"] = json!({
            "rounds": shares.rounds,
            "rays": shares.rays,
            "seconds": shares.elapsed.as_secs_f64(),
        });
        let light = Light { occlusion: Some(Arc::new(shares)), ..Light::default() };
        if let Some(reason) = view.missing(&light) {
            return Err(CliError::Missing(reason));
        }
        let frame = self.frame(world, &settings, view, None);
        self.draw(gpu, world, &settings, &light, &frame, report)
    }

    fn draw_by_rays(&self, gpu: &Gpu, view: CameraView) -> Result<Drawn, CliError> {
        let settings = self.settings();
        let world = self.run.open()?;
        let solved = view.needs_radiosity().then(|| self.run.solve_in(world.clone(), settings)).transpose()?;
        let solution = solved.as_ref().map(|solved| Arc::new(solved.solution.clone()));
        let mut tracing = Tracing::new(world, settings, self.run.time().filter(|_| solved.is_none()));
        let shot = CameraShot { view, camera: self.camera.camera(&tracing.world), size: self.camera.size };
        let is_timed = self.run.time().is_some() && solved.is_none();
        let samples = self.samples.or((!is_timed).then_some(view.samples(SAMPLES)));
        let (image, photons) = tracing.picture(&shot, solution.clone(), samples)?;
        let light = Light { solution, photons: photons.map(Arc::new), ..Light::default() };
        self.draw_image(gpu, &tracing.world, &settings, light, image)
    }

    /// A picture by rays, and the light that it was read off.
    pub(super) fn draw_image(
        &self,
        gpu: &Gpu,
        world: &Arc<World>,
        settings: &Settings,
        light: Light,
        image: CameraImage,
    ) -> Result<Drawn, CliError> {
        let view = image.view;
        let frame = self.frame(world, settings, View::Camera(view), light.solution.as_deref());
        let mut bill = image.bill;
        let mut report = match (&light.solution, &light.photons) {
            (Some(solution), _) => {
                bill += &solution.counters.bill;
                let solution = Solution::clone(solution);
                report(&Solved { world: world.clone(), settings: *settings, solution })
            }
            (None, Some(photons)) => {
                bill += &photons.counters.bill;
                photon_report(world, settings, photons)
            }
            (None, None) => {
                let is_classic = view.is_light() && view != CameraView::Reference;
                let method = if is_classic { "ray-tracing" } else { view.name() };
                json!({ "scene": world.scene.name, "method": method })
            }
        };
        effect_options::report(&mut report, Subject::Camera(view), world, settings, &bill);
        report["picture"] = image_report(&image, view.is_light().then_some(frame.exposure_ev));
        let light = Light { image: Some(Arc::new(image)), ..light };
        if view.is_comparison()
            && let Some(reason) = frame.view.missing(&light)
        {
            return Err(CliError::Missing(reason));
        }
        self.draw(gpu, world, settings, &light, &frame, report)
    }

    fn frame(&self, world: &World, settings: &Settings, view: View, solution: Option<&Solution>) -> Frame {
        Frame {
            camera: self.camera.camera(world),
            size: self.camera.size,
            view,
            bounce: self.bounce,
            ambient: self.ambient,
            wireframe: self.wireframe,
            show_shooter: false,
            photons: PhotonLook::default(),
            filter: settings.image.filter,
            exposure_ev: self.camera.exposure_ev(world, solution),
            tone: self.camera.tone,
        }
    }

    fn draw(
        &self,
        gpu: &Gpu,
        world: &Arc<World>,
        settings: &Settings,
        light: &Light,
        frame: &Frame,
        mut report: Value,
    ) -> Result<Drawn, CliError> {
        let samples = match frame.view {
            // A picture by rays has its samples already.
            View::Camera(_) => 1,
            // Those that were asked for are of vertices.
            View::OcclusionVertices => SAMPLES,
            _ => self.samples.unwrap_or(SAMPLES),
        };
        let picture = render_picture(gpu, world, light, frame, samples)?;
        report["picture"]["view"] = json!(frame.view.name());
        Ok(Drawn { picture, facts: picture::facts(world, light, settings, frame), report, account: None })
    }
}

/// What there is to say of a picture by rays; `exposure_ev` where it is of light.
pub fn image_report(image: &CameraImage, exposure_ev: Option<f32>) -> Value {
    let mut report = json!({
        "exposure": exposure_ev,
        "samples": image.samples,
        "rays": image.rays,
        "seconds": image.elapsed.as_secs_f64(),
    });
    if let Some(comparison) = image.comparison {
        report["legend"] = json!({ "low": -comparison.range(), "high": comparison.range() });
    }
    match image.comparison {
        Some(Comparison::Ambient(contrast)) => {
            report["mean_share"] = json!(contrast.mean_share);
            report["mean_indirect_irradiance"] = json!(contrast.mean_irradiance);
            report["mean_absolute_difference"] = json!(contrast.mean_difference);
            report["correlation"] = json!(contrast.correlation);
        }
        Some(Comparison::Error(error)) => {
            report["error"] = json!({
                "rms": error.rms,
                "uncertainty": error.uncertainty,
                "floor": error.floor,
                "offset": error.offset,
                "mean_radiance": error.mean,
            });
        }
        None => {}
    }
    report
}
