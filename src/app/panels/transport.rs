//! Run, step and reset, and how far the light has come.

use super::icons::Icon;
use super::progress;
use super::widgets::with_key;
use crate::app::action::Action;
use crate::app::format;
use crate::app::keys;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::worker::{Command, LightKind};
use egui::{Atom, Button, IdSalt, RichText, Ui, vec2};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.add_enabled_ui(model.can_run(), |ui| {
            run_button(ui, model, actions);
            ui.add_space(2.0 * UNIT);
            step_buttons(ui, model, actions);
        });
        ui.add_space(2.0 * UNIT);
        ui.add_enabled_ui(model.scene.is_some(), |ui| {
            let hover = with_key(ui, "Starts over from the emitters, paused", Some(&keys::RESET));
            if ui.button("Reset").on_hover_text(hover).clicked() {
                actions.push(Action::Send(Command::Reset));
            }
        });
        ui.add_space(4.0 * UNIT);
        progress::show(ui, model);
    });
}

fn run_button(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let palette = Palette::of(ui.visuals());
    let (icon, name, hover, color) = if model.is_running() {
        let hover = format!("Stops before the next {}", model.step_name());
        (Icon::Pause, "Pause", hover, ui.visuals().text_color())
    } else {
        let hover = match model.light() {
            Some(LightKind::Radiosity) => "Spreads light until the stop limit is reached",
            Some(LightKind::Photons) => "Emits photons until all that are wanted are there",
            Some(LightKind::Occlusion) => "Looks for open sky from every vertex, until all rays are there",
            None => "This picture is made by itself: it needs neither radiosity nor photons",
        };
        (Icon::Run, "Run", hover.to_owned(), palette.on_accent)
    };
    let icon_place = IdSalt::new("icon");
    let place = Atom::custom(icon_place, vec2(Icon::SIZE, Icon::SIZE));
    let mut button = Button::new((place, RichText::new(name).color(color)));
    if !model.is_running() {
        button = button.fill(palette.accent);
    }
    let button = button.min_size(vec2(24.0 * UNIT, ui.spacing().interact_size.y)).atom_ui(ui);
    if let Some(rect) = button.rect(icon_place) {
        icon.paint(ui.painter(), rect, color);
    }
    if button.response.on_hover_text(with_key(ui, &hover, Some(&keys::RUN))).clicked() {
        actions.push(keys::run_or_pause(model));
    }
}

fn step_buttons(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ui.label("Step");
    ui.spacing_mut().item_spacing.x = UNIT;
    let steps = [(1, keys::STEP_1), (10, keys::STEP_10), (100, keys::STEP_100)];
    for (steps, shortcut) in steps {
        let button = Button::new(steps.to_string()).min_size(ui.spacing().interact_size);
        let sentence = format!("Does {}, then pauses", format::counted(steps, model.step_name()));
        let hover = with_key(ui, &sentence, Some(&shortcut));
        if ui.add(button).accessible_name(format!("Step {steps}")).on_hover_text(hover).clicked() {
            actions.push(Action::Send(Command::Step(steps)));
        }
    }
}
