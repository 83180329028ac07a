//! What went wrong last, above the viewport, with the way out of it.

use super::icons::Icon;
use super::widgets::primary_button;
use crate::app::action::Action;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::worker::{Command, Phase};
use egui::{Align, Layout, RichText, Ui};

/// What to say, if anything: a crashed solver says so even where its message was dismissed.
pub fn message<'a>(model: &Model<'a>) -> Option<&'a str> {
    match (model.error, model.phase) {
        (Some(error), _) => Some(error),
        (None, Phase::Crashed) => Some("The solver stopped because of a fault in the program."),
        (None, _) => None,
    }
}

pub fn show(ui: &mut Ui, model: &Model, message: &str, actions: &mut Vec<Action>) {
    let palette = Palette::of(ui.visuals());
    ui.horizontal(|ui| {
        Icon::Warning.show(ui, palette.error);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if *model.phase == Phase::Crashed {
                let hover = "Starts the solver afresh on the same scene; what it had computed is lost";
                if ui.add(primary_button(ui, "Restart solver")).on_hover_text(hover).clicked() {
                    actions.push(Action::Send(Command::Reset));
                }
            } else if ui.button("Dismiss").clicked() {
                actions.push(Action::DismissError);
            }
            ui.add_space(UNIT);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.label(RichText::new(message).color(palette.error)).on_hover_text(message);
            });
        });
    });
}
