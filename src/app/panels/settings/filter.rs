//! Which paths of light are shown.

use crate::app::action::Action;
use crate::app::model::Model;
use crate::app::panels::widgets::row;
use crate::app::theme::{Palette, UNIT};
use crate::methods::{ImageSettings, Settings};
use crate::solution::PathFilter;
use egui::{Button, RichText, TextEdit, Ui};

/// Patterns to begin with, and what they let pass.
const EXAMPLES: [(&str, &str); 3] = [
    ("LDE", "Light that comes straight from an emitter to a diffuse surface, which the eye sees"),
    ("LS+DE", "Caustics: light that comes to a diffuse surface over mirrors and glass alone"),
    ("LDDE", "Light that one diffuse surface sends to another: the first bounce of colour bleeding"),
];

const HOVER: &str = "Shows only the light of these paths, in Heckbert's notation: from the light L over diffuse (D) and \
                     specular (S) surfaces to the eye E, with * + ? | ( ) and . as in regular expressions. Empty shows \
                     all.";

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let settings = model.settings;
    let in_force = settings.image.filter;
    let mut text = model.filter_draft.unwrap_or(in_force.as_str()).to_owned();
    row(ui, "Paths", HOVER, |ui, label| {
        let field = TextEdit::singleline(&mut text).hint_text("all").desired_width(ui.available_width() - UNIT);
        let response = ui.add(field).labelled_by(label.id).on_hover_text(HOVER);
        if response.lost_focus() {
            enter(&text, settings, actions);
        } else if response.changed() {
            actions.push(Action::EditFilter(Some(text.clone())));
        }
    });
    if let Err(reason) = text.parse::<PathFilter>() {
        ui.label(RichText::new(reason).small().color(Palette::of(ui.visuals()).error));
    }
    row(ui, "", "", |ui, _| {
        ui.spacing_mut().item_spacing.x = UNIT;
        for (pattern, meaning) in EXAMPLES {
            let is_chosen = in_force.as_str() == pattern;
            if ui.add(Button::new(pattern).selected(is_chosen)).on_hover_text(meaning).clicked() {
                enter(if is_chosen { "" } else { pattern }, settings, actions);
            }
        }
    });
}

/// Filters by a pattern, if it is one; else it stays to be mended.
fn enter(text: &str, settings: Settings, actions: &mut Vec<Action>) {
    match text.parse::<PathFilter>() {
        Ok(filter) => {
            actions.push(Action::EditFilter(None));
            if filter != settings.image.filter {
                let image = ImageSettings { filter, ..settings.image };
                actions.push(Action::ApplySettings(Settings { image, ..settings }));
            }
        }
        Err(_) => actions.push(Action::EditFilter(Some(text.to_owned()))),
    }
}
