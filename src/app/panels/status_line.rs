//! One line of figures about the scene, the run and the machine.

use crate::app::format;
use crate::app::model::{Model, SceneFacts};
use crate::app::theme::UNIT;
use crate::solution::Solution;
use crate::worker::Phase;
use egui::{Align, Layout, RichText, Ui};

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
                if let Some(solution) = model.solution {
                    run(ui, model, solution);
                }
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

fn run(ui: &mut Ui, model: &Model, solution: &Solution) {
    let hover = if model.sweeps() {
        "How often all patches have gathered light from all others"
    } else {
        "How often a patch has shot its light into the scene"
    };
    item(ui, format::counted(solution.steps, model.step_name()), hover);
    let seconds = solution.elapsed.as_secs_f64();
    let rate = if seconds > 0.0 { solution.counters.rays as f64 / seconds } else { 0.0 };
    item(
        ui,
        format::si(rate, "rays/s"),
        &format!("{} in the time of the solver", format::counted(solution.counters.rays, "ray")),
    );
    item(ui, format::duration(solution.elapsed), "Time that the solver has worked; drawing and waiting do not count");
    item(
        ui,
        format!("{} unshot", format::percent(solution.unshot_share)),
        "Share of the emitted flux that still waits to be passed on",
    );
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
