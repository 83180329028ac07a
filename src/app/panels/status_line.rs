//! One line of figures about the scene, the run and the machine.

use crate::app::format;
use crate::app::model::{Model, SceneFacts};
use crate::app::theme::UNIT;
use crate::solution::{CameraImage, Comparison, PhotonSolution, Solution, VertexShares};
use crate::worker::{LightKind, Phase, TrackPoint};
use egui::{Align, Layout, RichText, Ui};
use std::time::Duration;

pub fn show(ui: &mut Ui, model: &Model) {
    ui.spacing_mut().interact_size.y = 5.0 * UNIT;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0 * UNIT;
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            window(ui, model);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                if let Some(facts) = &model.scene {
                    scene(ui, facts);
                }
                work(ui, model);
                ui.label(RichText::new(phase(model.phase)).small().weak());
            });
        });
    });
}

fn scene(ui: &mut Ui, facts: &SceneFacts) {
    ui.label(RichText::new(facts.name).small().strong());
    item(ui, format::counted(facts.patches as u64, "patch"), "Patches shoot light");
    item(ui, format::counted(facts.elements as u64, "element"), "Elements, the pieces of patches, receive light");
}

/// The price of what is on show: of a picture from a camera its own and that of the light that it is read off.
fn work(ui: &mut Ui, model: &Model) {
    if let Some(picture) = model.image {
        image(ui, picture);
    }
    if model.image.is_none() {
        error(ui, model);
    }
    match (model.light(), model.solution, model.photons, model.occlusion) {
        (Some(LightKind::Radiosity), Some(solution), ..) if model.image.is_none() => radiosity(ui, model, solution),
        (Some(LightKind::Photons), _, Some(found), _) => photons(ui, found, model.image.is_some()),
        (Some(LightKind::Occlusion), _, _, Some(found)) => occlusion(ui, found),
        _ => {}
    }
}

/// How far off the light on show is, as it was measured last.
fn error(ui: &mut Ui, model: &Model) {
    let track = model.tracks.iter().rfind(|track| Some(track.kind) == model.light());
    let Some(TrackPoint { seconds, error }) = track.and_then(|track| track.points.last()) else { return };
    let hover = format!(
        "Root mean square error of the irradiance at points spread over all surfaces, as a share of its mean: {} after \
         {}, against a path-traced reference",
        error.in_words_by(format::percent, format::percent_short),
        format::si(*seconds, "s"),
    );
    let short = match error.below() {
        Some(limit) => format!("error below {}", format::percent_short(limit)),
        None => format!("error {}", format::percent(error.rms)),
    };
    item(ui, short, &hover);
}

fn image(ui: &mut Ui, image: &CameraImage) {
    let samples = match image.samples {
        0 => "coarse".to_owned(),
        samples => format!("{} a pixel", format::counted(samples.into(), "sample")),
    };
    item(ui, samples, "Samples of this picture so far. Four times as many halve the noise.");
    if let Some(Comparison::Error(error)) = image.comparison {
        let hover =
            "Root mean square difference from the reference over all that is seen, as a share of the mean light";
        let (rms, uncertainty) = (format::percent(error.rms), format::percent_short(error.uncertainty));
        item(ui, format!("error {rms} ± {uncertainty}"), hover);
    }
    item(ui, format::duration(image.elapsed), "Time spent on this picture; drawing and waiting do not count");
    rays(ui, image.rays, image.elapsed);
}

fn photons(ui: &mut Ui, photons: &PhotonSolution, is_short: bool) {
    let counters = &photons.counters;
    let emitted = format::short((counters.emitted + counters.caustic_emitted) as f64, "");
    item(ui, format!("{emitted} photons"), "Photons that have left the emitters in this pass");
    item(ui, format::duration(photons.elapsed), "Time spent on photons; drawing and waiting do not count");
    if is_short {
        return;
    }
    item(ui, format!("{} stored", format::short(photons.photons.len() as f64, "")), "Landings that are kept and drawn");
    if photons.passes > 1 {
        item(ui, format::counted(photons.passes, "pass"), "Passes that are done, each with photons of its own");
    }
    rays(ui, counters.rays, photons.elapsed);
}

fn occlusion(ui: &mut Ui, occlusion: &VertexShares) {
    item(ui, format::counted(occlusion.rounds.into(), "round"), "Rounds of rays from every vertex that are done");
    item(ui, format::duration(occlusion.elapsed), "Time spent on these rays; drawing and waiting do not count");
    rays(ui, occlusion.rays, occlusion.elapsed);
}

fn radiosity(ui: &mut Ui, model: &Model, solution: &Solution) {
    let hover = if model.sweeps() {
        "How often all patches have gathered light from all others"
    } else {
        "How often a patch has shot its light into the scene"
    };
    item(ui, format::counted(solution.steps, model.step_name()), hover);
    rays(ui, solution.counters.rays, solution.elapsed);
    item(ui, format::duration(solution.elapsed), "Time that the solver has worked; drawing and waiting do not count");
    item(
        ui,
        format!("{} unshot", format::percent(solution.unshot_share)),
        "Share of the emitted flux that still waits to be passed on",
    );
}

fn rays(ui: &mut Ui, rays: u64, elapsed: Duration) {
    let seconds = elapsed.as_secs_f64();
    let rate = if seconds > 0.0 { rays as f64 / seconds } else { 0.0 };
    item(ui, format::si(rate, "rays/s"), &format!("{} in this time", format::counted(rays, "ray")));
}

fn window(ui: &mut Ui, model: &Model) {
    let hover = format!(
        "Draws on {}.\nThe window's own work takes {} a frame, at most {} in the last second.",
        model.adapter,
        format::duration(model.frame_time.mean),
        format::duration(model.frame_time.worst)
    );
    ui.label(RichText::new(model.adapter).small().weak()).on_hover_text(hover);
}

fn item(ui: &mut Ui, text: String, hover: &str) {
    ui.label(RichText::new(text).small()).on_hover_text(hover);
}

fn phase(phase: &Phase) -> &'static str {
    match phase {
        Phase::Empty => "no scene",
        Phase::Loading(_) => "loading",
        Phase::Paused => "paused",
        Phase::Running => "running",
        Phase::Converged => "converged",
        Phase::Crashed => "stopped by a fault",
    }
}
