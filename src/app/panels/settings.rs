//! What the solver is told: how finely to cut, how many rays to trace, when to stop. A slider takes effect when it is
//! let go, a number when it is entered.

use super::widgets::{labelled, row, slider};
use crate::app::action::Action;
use crate::app::format;
use crate::app::model::Model;
use crate::methods::Settings;
use egui::{Checkbox, DragValue, Response, RichText, Ui};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    element_size(ui, model, actions);
    shadow_rays(ui, model.settings, actions);
    stop_limit(ui, model.settings, actions);
    seed(ui, model.settings, actions);
    let note = "Sliders take effect when let go. All but the stop limit start the light over.";
    ui.label(RichText::new(note).small().weak());
}

fn element_size(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let Some(scene) = model.scene else { return };
    let mut settings = model.settings;
    let mut automatic = settings.mesh.element_size.is_none();
    let hover = "Chooses the size of the elements so that they show soft shadows and shots are quick";
    let response = row(ui, "Mesh", hover, |ui, _| ui.add(Checkbox::new(&mut automatic, "Automatic")));
    let response = response.accessible_name("Automatic mesh").on_hover_text(hover);
    if response.changed() {
        settings.mesh.element_size = (!automatic).then_some(scene.element_size);
        actions.push(Action::ApplySettings(settings));
    }
    let mut size = settings.mesh.element_size.unwrap_or(scene.element_size);
    let range = scene.radius / 1000.0..=scene.radius / 2.0;
    let hover = "Longest edge of an element. Half the size makes four times the elements.";
    let response = labelled(ui, "Element size", hover, |ui| {
        slider(ui, &mut size, range, true, |size| format::si(size, "m"), |text| format::parse(text, "m"))
    });
    settings.mesh.element_size = Some(size);
    apply_when_done(&response, settings, actions);
}

fn shadow_rays(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Rays from each receiving point to the shooter, which find out how much of it is in sight";
    let response = labelled(ui, "Shadow rays", hover, |ui| {
        let rays = &mut settings.shadow_rays;
        slider(
            ui,
            rays,
            1..=Settings::MAX_SHADOW_RAYS,
            true,
            |rays| format::count(rays as u64),
            |text| format::parse(text, ""),
        )
    });
    apply_when_done(&response, settings, actions);
}

fn stop_limit(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Stops when this share of the emitted flux is left unshot";
    let response = labelled(ui, "Stop at", hover, |ui| {
        let limit = &mut settings.unshot_limit;
        let parse = |text: &str| format::parse(text, "%").map(|percent| percent / 100.0);
        slider(ui, limit, 1e-5..=0.1, true, format::percent, parse)
    });
    apply_when_done(&response, settings, actions);
}

fn seed(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Every random number comes from it: the same seed gives the same light, to the bit";
    let value = DragValue::new(&mut settings.seed).range(0..=u32::MAX).update_while_editing(false);
    let response = labelled(ui, "Seed", hover, |ui| ui.add(value));
    apply_when_done(&response, settings, actions);
}

/// Sends the settings once a drag ends or a value is entered; until then the controls only show them.
fn apply_when_done(response: &Response, settings: Settings, actions: &mut Vec<Action>) {
    if response.drag_stopped() || (response.changed() && !response.dragged()) {
        actions.push(Action::ApplySettings(settings));
    } else if response.changed() {
        actions.push(Action::EditSettings(settings));
    }
}
