//! How light is followed as photons, and how it is read off them.

use super::{apply_when_done, count};
use crate::app::action::Action;
use crate::app::format;
use crate::app::model::Model;
use crate::app::panels::widgets::{choice, labelled, row, slider};
use crate::methods::{PhotonSettings, Settings};
use egui::{Checkbox, Ui};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let settings = model.settings;
    photons(ui, settings, actions);
    caustic_photons(ui, settings, actions);
    nearest(ui, settings, actions);
    radius(ui, model, actions);
    kernel(ui, settings, actions);
    progressive(ui, settings, actions);
    if settings.photons.is_progressive {
        passes(ui, settings, actions);
    }
}

fn photons(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Photons of the global map that leave the emitters in a pass. Four times as many halve the noise.";
    let response = count(ui, "Photons", hover, &mut settings.photons.count, 1..=PhotonSettings::MAX_COUNT);
    apply_when_done(&response, settings, actions);
}

fn caustic_photons(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Photons of a pass that are kept only where they come over mirrors and glass alone, for sharp caustics";
    let range = 0..=PhotonSettings::MAX_COUNT;
    let response = count(ui, "For caustics", hover, &mut settings.photons.caustic_count, range);
    apply_when_done(&response, settings, actions);
}

fn nearest(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "The most photons that an estimate uses. More are less noisy and more blurred.";
    let response = count(ui, "Nearest", hover, &mut settings.photons.nearest, 2..=PhotonSettings::MAX_NEAREST);
    apply_when_done(&response, settings, actions);
}

fn radius(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let mut settings = model.settings;
    let Some(scene) = model.scene else { return };
    // Until a run has chosen one, what it may choose at most.
    let chosen = model.photons.map(|photons| photons.max_radius).filter(|radius| *radius > 0.0);
    let shown = settings.photons.max_radius.or(chosen).unwrap_or(scene.radius / 20.0);
    let mut automatic = settings.photons.max_radius.is_none();
    let hover = "Chooses the largest radius by the number of photons and the area of the scene";
    let response = row(ui, "Radius", hover, |ui, _| ui.add(Checkbox::new(&mut automatic, "Automatic")));
    if response.accessible_name("Automatic radius").on_hover_text(hover).changed() {
        settings.photons.max_radius = (!automatic).then_some(shown);
        actions.push(Action::ApplySettings(settings));
    }
    let mut radius = shown;
    let range = scene.radius / 10_000.0..=scene.radius;
    let hover = "The farthest at which an estimate looks for photons";
    let response = labelled(ui, "Max radius", hover, |ui| {
        slider(ui, &mut radius, range, true, |radius| format::si(radius, "m"), |text| format::parse(text, "m"))
    });
    settings.photons.max_radius = Some(radius);
    apply_when_done(&response, settings, actions);
}

fn kernel(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "How much a photon counts by its distance from where light is estimated";
    if let Some(kernel) = choice(ui, "Kernel", hover, settings.photons.kernel) {
        settings.photons.kernel = kernel;
        actions.push(Action::ApplySettings(settings));
    }
}

fn progressive(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Goes on with new photons and a smaller radius in every pass, so that noise and blur both vanish. If \
                 not, the radius stays, and the blur with it.";
    let is_progressive = &mut settings.photons.is_progressive;
    let response = row(ui, "Progressive", hover, |ui, _| ui.add(Checkbox::new(is_progressive, "Shrink the radius")));
    if response.accessible_name("Progressive").on_hover_text(hover).changed() {
        actions.push(Action::ApplySettings(settings));
    }
}

fn passes(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Passes of a progressive run, each with photons of its own";
    let response = count(ui, "Passes", hover, &mut settings.photons.passes, 1..=PhotonSettings::MAX_PASSES);
    apply_when_done(&response, settings, actions);
}
