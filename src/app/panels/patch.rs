//! The patch that was picked: what it is made of, its light, and what it sees.

use super::widgets::{figure, section, with_key};
use crate::app::action::Action;
use crate::app::format;
use crate::app::keys;
use crate::app::model::{Dialog, LowerPanel, Model};
use crate::app::patch::PatchFacts;
use crate::app::theme::UNIT;
use crate::choice::Choice;
use crate::math::rgb::Rgb;
use egui::{Button, Image, Ui, vec2};

/// Edge of the picture of its item buffer.
const SIDE: f32 = 48.0 * UNIT;

/// Shows its section of the side panel, where a patch is picked.
pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let Some(patch) = model.patch else { return };
    section(ui, &format!("Patch {}", format::count(patch.index.into())), |ui| {
        surface(ui, &patch);
        light(ui, &patch);
        form_factors(ui, &patch);
        ui.add_space(UNIT);
        buttons(ui, model, actions);
        item_buffer(ui, model);
    });
}

/// A small picture of what it sees.
fn item_buffer(ui: &mut Ui, model: &Model) {
    let Some(texture) = model.item_buffer else { return };
    let image = Image::from_texture(texture).fit_to_exact_size(vec2(SIDE, SIDE));
    ui.add(image.alt_text("Item buffer")).on_hover_text("What it sees through its hemicube, unfolded");
}

fn buttons(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let is_open = model.lower == Some(LowerPanel::Equation);
        let hover = with_key(ui, LowerPanel::Equation.meaning(), Some(&keys::EQUATION));
        if ui.add(Button::new("Its light").selected(is_open)).on_hover_text(hover).clicked() {
            actions.push(Action::ShowLowerPanel((!is_open).then_some(LowerPanel::Equation)));
        }
        if ui.button("Enlarge").on_hover_text("Shows the item buffer in a dialog").clicked() {
            actions.push(Action::ShowDialog(Dialog::ItemBuffer));
        }
        let hover = with_key(ui, "Takes the outline and this section away", Some(&keys::UNPICK));
        if ui.button("Forget patch").on_hover_text(hover).clicked() {
            actions.push(Action::Unpick);
        }
    });
}

fn surface(ui: &mut Ui, patch: &PatchFacts) {
    figure(ui, "Material", patch.material, "What the scene file calls it");
    figure(ui, "Area", format::area(patch.area), "What light can reach of it");
    let reflectance = format::rgb(patch.reflectance, "");
    figure(ui, "Reflectance ρ", reflectance, "Share of the light that it hands on, in red, green and blue");
    figure(ui, "Emission M", watts_per_area(patch.exitance), "Light that it makes, by area, in red, green and blue");
}

fn light(ui: &mut Ui, patch: &PatchFacts) {
    let Some(light) = patch.light else { return };
    figure(ui, "Radiosity B", watts_per_area(light.radiosity), "M + ρ E: all light that leaves it, by area");
    figure(ui, "Irradiance E", watts_per_area(light.irradiance), "All light that arrived, by area");
    figure(ui, "Unshot ΔB", watts_per_area(light.unshot), "Of its radiosity, what others have not received yet");
}

fn form_factors(ui: &mut Ui, patch: &PatchFacts) {
    let hover = "The sum of its form factors to all patches, as the chosen method computes them. With what escapes it \
                 should be 100 %.";
    figure(ui, "Form factors", format::percent(patch.row_sum), hover);
    figure(ui, "Escapes", format::percent(patch.escaping), "Share of its light that leaves the scene");
}

fn watts_per_area(value: Rgb) -> String {
    format::rgb(value, "W/m²")
}
