//! Where the radiosity of the picked patch comes from: emission, the patches that contribute most, and what is left.

use super::legend;
use super::widgets::{chip, figure_row};
use crate::app::action::Action;
use crate::app::equation::EquationFacts;
use crate::app::format;
use crate::app::theme::UNIT;
use crate::math::rgb::Rgb64;
use egui::{Align, Button, Color32, Label, Layout, RichText, Ui, vec2};

/// Of a list of them, beside the equation.
pub const WIDTH: f32 = 84.0 * UNIT;
/// Of a share.
const SHARE_WIDTH: f32 = 15.0 * UNIT;

/// The radiosity, and of what the patch makes and others send the largest parts.
pub fn largest(ui: &mut Ui, facts: &EquationFacts, actions: &mut Vec<Action>) {
    let balance = &facts.equation.balance;
    figure_row(ui, "M + ρ E, the mean over the patch of x', and which share of it comes from where", |ui| {
        ui.label(RichText::new("Radiosity B").strong());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(watts_per_area(balance.radiosity)));
    });
    if balance.emission != Rgb64::ZERO {
        part(ui, facts, "Emission M", balance.emission, "Light that the patch makes");
    }
    for contribution in &balance.largest {
        let name = format!("{}, {}", facts.name_of_patch(contribution.patch), format::count(contribution.patch.into()));
        let hover = format!(
            "ρ F B = {} with F = {}. Click to look at what it sends.",
            watts_per_area(contribution.light),
            format::percent(contribution.form_factor)
        );
        row(ui, facts, contribution.light, &hover, |ui| {
            if ui.add(Button::new(&name).frame(false).truncate()).on_hover_text(&hover).clicked() {
                actions.push(Action::PickSource(contribution.patch));
            }
        });
    }
}

/// What is left, and that it is all.
pub fn rest(ui: &mut Ui, facts: &EquationFacts) {
    let balance = &facts.equation.balance;
    if balance.other_count > 0 {
        let others = format::counted(balance.other_count as u64, "other patch");
        part(ui, facts, &others, balance.others, "ρ Σ F B over all other patches");
    }
    if balance.unshot != Rgb64::ZERO {
        let hover =
            "The part of the light above that these patches have not shot yet, which is not in the radiosity shown";
        part(ui, facts, "Not shot yet", -balance.unshot, hover);
    }
    let hover = if balance.is_by_matrix {
        "Rounding, and direct light where it is switched off"
    } else {
        "The form factors of this list are computed anew, from this patch; the solver had those of each shot, scaled so that \
         no light is lost. Direct light that is switched off is here, too."
    };
    part(ui, facts, "Form factors differ", balance.difference, hover);
    let parts = balance.emission + balance.gathered() - balance.unshot + balance.difference;
    part(ui, facts, "Together", parts, "All that is listed, which is the radiosity B");
}

/// A line with a name that is no patch.
fn part(ui: &mut Ui, facts: &EquationFacts, name: &str, light: Rgb64, hover: &str) {
    let hover = format!("{hover}: {}", watts_per_area(light));
    row(ui, facts, light, &hover, |ui| {
        ui.add(Label::new(RichText::new(name).weak()).truncate());
    });
}

/// The colour of some light, its name, and its share of the radiosity.
fn row(ui: &mut Ui, facts: &EquationFacts, light: Rgb64, hover: &str, name: impl FnOnce(&mut Ui)) {
    figure_row(ui, hover, |ui| {
        match color(light) {
            Some(color) => chip(ui, color),
            None => ui.add_space(3.0 * UNIT + ui.spacing().item_spacing.x),
        }
        let size = vec2(ui.available_width() - SHARE_WIDTH, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(size.x);
            name(ui);
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label(facts.share(light).map_or(format::NO_VALUE.to_owned(), format::percent));
        });
    });
}

/// As bright as it can be shown; none of what is taken away, or is nothing.
fn color(light: Rgb64) -> Option<Color32> {
    let largest = light.max_element();
    (largest > 0.0).then(|| legend::color((light / largest).max(Rgb64::ZERO).as_vec3()))
}

fn watts_per_area(light: Rgb64) -> String {
    format::rgb(light.as_vec3(), "W/m²")
}
