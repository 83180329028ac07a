//! What a picture says of itself in its file: how it was made, so that it can be made again.

use super::quality::percent;
use crate::choice::Choice;
use crate::effects::Effect;
use crate::methods::{OcclusionSettings, Settings};
use crate::solution::{CameraImage, CameraView, Comparison, PhotonSolution, PictureError, VertexShares};
use crate::viewport::diagram::Diagram;
use crate::viewport::{Frame, Light, View};
use crate::worker::Subject;
use crate::world::World;
use std::time::Duration;

/// Names and values.
#[derive(Default)]
struct Facts(Vec<(String, String)>);

impl Facts {
    fn add(&mut self, name: &str, value: impl ToString) {
        self.0.push((name.to_owned(), value.to_string()));
    }
}

/// Whose work a view shows.
pub fn subject(view: View) -> Subject {
    match view {
        View::Camera(view) => Subject::Camera(view),
        View::OcclusionVertices => Subject::Occlusion,
        view if view.shows_photons() => Subject::Photons,
        _ => Subject::Radiosity,
    }
}

/// What a picture of a view says of itself: names and values.
pub fn facts(world: &World, light: &Light, settings: &Settings, frame: &Frame) -> Vec<(String, String)> {
    let mut facts = Facts::of(world, settings, frame.view.name());
    match frame.view {
        View::Photons | View::KdTree => facts.add_photons(light.photons.as_deref(), settings),
        View::Camera(view) => facts.add_image(view, light, settings),
        View::OcclusionVertices => facts.add_occlusion(light.occlusion.as_deref(), settings),
        _ => facts.add_radiosity(light, settings),
    }
    facts.add_effects(subject(frame.view), settings);
    let has_filter = frame.view.shows_photons() && !frame.filter.passes_all();
    if has_filter {
        facts.add("Paths", frame.filter.as_str());
    }
    let viewpoint = frame.camera.viewpoint();
    facts.add("Eye", world.scene.file_from_scene(viewpoint.eye));
    facts.add("Target", world.scene.file_from_scene(viewpoint.target));
    facts.add("Up", viewpoint.up);
    facts.add("Vertical field of view", format!("{} deg", viewpoint.vertical_fov));
    match (frame.view, &light.picked) {
        (View::FormFactors, Some(picked)) => facts.add("Picked patch", picked.patch),
        (view, _) if view.is_false_colour() => {}
        _ => facts.add("Exposure", format!("{} EV, {}", frame.exposure_ev, frame.tone.name())),
    }
    if frame.view == View::Bounces {
        facts.add("Bounces", frame.bounce);
    }
    if let Some(solution) = light.solution.as_ref().filter(|_| frame.ambient)
        && matches!(frame.view, View::Patches | View::Smooth)
    {
        facts.add("Ambient", solution.ambient);
    }
    facts.0
}

/// What a diagram says of itself: names and values.
pub fn diagram_facts(world: &World, light: &Light, settings: &Settings, diagram: Diagram) -> Vec<(String, String)> {
    let mut facts = Facts::of(world, settings, diagram.name());
    facts.add_radiosity(light, settings);
    facts.add_effects(Subject::Radiosity, settings);
    if let (Diagram::ItemBuffer, Some(picked)) = (diagram, &light.picked) {
        facts.add("Picked patch", picked.patch);
        facts.add("Hemicube", settings.hemicube_resolution);
    }
    facts.0
}

impl Facts {
    /// What is true of every picture.
    fn of(world: &World, settings: &Settings, view: &str) -> Self {
        let mut facts = Self::default();
        facts.add("Software", concat!("Lightwell ", env!("CARGO_PKG_VERSION")));
        facts.add("Scene", &world.scene.name);
        facts.add("View", view);
        facts.add("Seed", settings.seed);
        facts.add("Element size", format!("{} m", world.element_size));
        facts
    }

    fn add_radiosity(&mut self, light: &Light, settings: &Settings) {
        self.add("Method", "radiosity");
        self.add("Solver", settings.solver.name());
        self.add("Form factors", settings.form_factor.name());
        self.add("Shadow rays", settings.shadow_rays);
        self.add("Stop limit", settings.unshot_limit);
        if let Some(solution) = &light.solution {
            self.add("Steps", solution.steps);
            self.add("Seconds", seconds(solution.elapsed));
        }
    }

    /// Effects that are not simulated, or are, whatever the scene calls for.
    fn add_effects(&mut self, subject: Subject, settings: &Settings) {
        let switches = settings.effects.among(subject.repertoire(settings));
        for (name, effects) in
            [("Effects forced", switches.forced.but(switches.off)), ("Effects left out", switches.off)]
        {
            if !effects.is_empty() {
                self.add(name, effects.iter().map(Effect::name).collect::<Vec<_>>().join(", "));
            }
        }
    }

    fn add_photons(&mut self, photons: Option<&PhotonSolution>, settings: &Settings) {
        let settings = &settings.photons;
        self.add("Method", "photon map");
        self.add("Photons", settings.count);
        self.add("Caustic photons", settings.caustic_count);
        self.add("Nearest", settings.nearest);
        self.add("Kernel", settings.kernel.name());
        if let Some(photons) = photons {
            self.add("Largest radius", format!("{} m", photons.max_radius));
            self.add("Passes", photons.passes);
            self.add("Stored", photons.counters.stored + photons.counters.caustic_stored);
            self.add("Seconds", seconds(photons.elapsed));
        }
    }

    fn add_occlusion(&mut self, occlusion: Option<&VertexShares>, settings: &Settings) {
        self.add("Method", "ambient occlusion on vertices");
        self.add_range(&settings.occlusion);
        if let Some(VertexShares { rounds, rays, elapsed, .. }) = occlusion {
            self.add("Rounds", rounds);
            self.add("Rays", rays);
            self.add("Seconds", seconds(*elapsed));
        }
    }

    /// Which rays look for what stands near, and how far.
    fn add_range(&mut self, settings: &OcclusionSettings) {
        self.add("Ambient rays", settings.rays);
        self.add("Ambient fall-off", settings.falloff.name());
        self.add("Ambient distance", settings.range);
    }

    fn add_image(&mut self, view: CameraView, light: &Light, settings: &Settings) {
        if view.needs_photons() {
            self.add_photons(light.photons.as_deref(), settings);
        } else if view.needs_radiosity() {
            self.add_radiosity(light, settings);
        } else {
            let method = match view {
                CameraView::AmbientOcclusion => "ambient occlusion",
                CameraView::AmbientMinusIndirect => "ambient occlusion against path tracing",
                CameraView::Reference => "path tracing",
                _ => "ray tracing",
            };
            self.add("Method", method);
        }
        if view.gathers() {
            self.add("Gather rays", settings.image.gather_rays);
        }
        if view.samples_emitters() {
            self.add("Light rays", settings.image.light_rays);
        }
        if view.is_occluded() {
            self.add_range(&settings.occlusion);
        }
        if let Some(comparison) = light.image_of(view).and_then(|image| image.comparison) {
            self.add("Range", comparison.range());
            if let Comparison::Error(PictureError { rms, uncertainty, offset, floor, .. }) = comparison {
                let [rms, uncertainty, offset, floor] = [rms, uncertainty, offset, floor].map(percent);
                self.add("Error", format!("{rms} ± {uncertainty} of the mean radiance"));
                self.add("Mean difference", offset);
                self.add("Error of the reference", floor);
            }
        }
        if view.has_paths() && !settings.image.filter.passes_all() {
            self.add("Paths", settings.image.filter.as_str());
        }
        if let Some(CameraImage { samples, rays, elapsed, .. }) = light.image_of(view).map(|image| &**image) {
            self.add("Samples", samples);
            self.add("Rays", rays);
            self.add("Picture seconds", seconds(*elapsed));
        }
    }
}

fn seconds(time: Duration) -> String {
    format!("{:.3}", time.as_secs_f64())
}
