//! What stands between the person and the light, above the viewport, each with the way out of it.

use super::icons::Icon;
use super::widgets::primary_button;
use crate::app::action::Action;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::worker::{Command, Phase};
use egui::{Align, Button, Layout, RichText, Ui};

/// One message and what can be done about it.
pub struct Banner<'a> {
    pub message: &'a str,
    is_error: bool,
    remedy: &'static str,
    remedy_hover: &'static str,
    action: Action,
}

pub fn all<'a>(model: &Model<'a>) -> Vec<Banner<'a>> {
    let crash = (*model.phase == Phase::Crashed).then(|| Banner {
        message: model.error.unwrap_or("The solver stopped because of a fault in the program."),
        is_error: true,
        remedy: "Restart solver",
        remedy_hover: "Starts afresh on the same scene; the light that was computed is lost",
        action: Action::Send(Command::Reset),
    });
    let error = model.error.filter(|_| crash.is_none()).map(|message| Banner {
        message,
        is_error: true,
        remedy: "Dismiss",
        remedy_hover: "Takes this message away",
        action: Action::DismissError,
    });
    let dark = model.scene.filter(|scene| scene.is_dark()).map(|_| Banner {
        message: "Nothing in this scene emits light, so there is nothing to see.",
        is_error: false,
        remedy: "Add a ceiling light",
        remedy_hover: "Adds a rectangle of light below the ceiling, which is not in the file",
        action: Action::Send(Command::AddCeilingLight),
    });
    [crash, error, dark].into_iter().flatten().collect()
}

pub fn show(ui: &mut Ui, banner: &Banner, actions: &mut Vec<Action>) {
    let palette = Palette::of(ui.visuals());
    let color = if banner.is_error { palette.error } else { palette.warning };
    ui.horizontal(|ui| {
        Icon::Warning.show(ui, color);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let button = if banner.action == Action::DismissError {
                Button::new(banner.remedy)
            } else {
                primary_button(ui, banner.remedy)
            };
            if ui.add(button).on_hover_text(banner.remedy_hover).clicked() {
                actions.push(banner.action.clone());
            }
            ui.add_space(UNIT);
            ui.with_layout(Layout::left_to_right(Align::Center).with_main_wrap(true), |ui| {
                ui.label(RichText::new(banner.message).color(color));
            });
        });
    });
}
