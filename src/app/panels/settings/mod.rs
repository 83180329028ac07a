//! What the solver is told. Only what the view on show depends on is shown. A slider takes effect when it is let go, a
//! number when it is entered.

mod filter;
mod image;
mod occlusion;
mod photons;
mod radiosity;

use super::widgets::{labelled, slider};
use crate::app::action::Action;
use crate::app::format;
use crate::app::model::Model;
use crate::methods::Settings;
use crate::worker::{LightKind, Subject};
use egui::{DragValue, Response, RichText, Ui};
use std::ops::RangeInclusive;

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    if let Subject::Camera(view) = model.subject() {
        image::show(ui, view, model.settings, actions);
        if view.is_occluded() {
            occlusion::show(ui, model, actions);
        }
    }
    if model.subject() == Subject::Occlusion {
        occlusion::rounds(ui, model.settings, actions);
        occlusion::show(ui, model, actions);
    }
    let has_paths = match model.subject() {
        Subject::Radiosity | Subject::Occlusion => false,
        Subject::Photons => true,
        Subject::Camera(view) => view.has_paths(),
    };
    if has_paths {
        filter::show(ui, model, actions);
    }
    match model.light() {
        Some(LightKind::Radiosity) => radiosity::show(ui, model, actions),
        Some(LightKind::Photons) => photons::show(ui, model, actions),
        Some(LightKind::Occlusion) | None => {}
    }
    seed(ui, model.settings, actions);
    let note = match model.light() {
        Some(LightKind::Radiosity) => "Sliders take effect when let go. All but the stop limit start the light over.",
        Some(LightKind::Photons) => "Sliders take effect when let go. Other photons start the light over.",
        Some(LightKind::Occlusion) => "Sliders take effect when let go. All but the rounds start over.",
        None => "Sliders take effect when let go, and start the picture over.",
    };
    ui.label(RichText::new(note).small().weak());
}

/// A slider for a number of things, on a logarithmic scale.
fn count(ui: &mut Ui, label: &str, hover: &str, value: &mut u32, range: RangeInclusive<u32>) -> Response {
    labelled(ui, label, hover, |ui| {
        slider(ui, value, range, true, |value| format::count(value as u64), |text| format::parse(text, ""))
    })
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
