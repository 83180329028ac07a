//! What can be opened below the viewport: its tabs are always there, and a click on the open one closes it.

use super::widgets::with_key;
use super::{accuracy, chart, equation, hard_cases};
use crate::app::action::Action;
use crate::app::keys;
use crate::app::model::{LowerPanel, Model};
use crate::app::theme::UNIT;
use crate::choice::Choice;
use egui::{Button, Frame, Margin, Panel, Ui};

/// Heights of the open panel.
const DEFAULT_HEIGHT: f32 = 60.0 * UNIT;
const LEAST_HEIGHT: f32 = 40.0 * UNIT;
/// The viewport keeps at least this much.
const LEAST_VIEWPORT: f32 = 30.0 * UNIT;

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let frame = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(12, 4));
    let Some(open) = model.lower else {
        Panel::bottom("tabs").frame(frame).show(ui, |ui| tabs(ui, model, actions));
        return;
    };
    let most = (ui.available_height() - LEAST_VIEWPORT).max(LEAST_HEIGHT);
    let panel = Panel::bottom("lower panel").frame(frame).resizable(true).default_size(DEFAULT_HEIGHT);
    panel.size_range(LEAST_HEIGHT..=most).show(ui, |ui| {
        ui.horizontal(|ui| {
            tabs(ui, model, actions);
            ui.add_space(2.0 * UNIT);
            match open {
                LowerPanel::Equation => equation::head(ui, model),
                LowerPanel::Convergence | LowerPanel::Accuracy => {}
                LowerPanel::HardCases => hard_cases::controls(ui, model, actions),
            }
        });
        match open {
            LowerPanel::Equation => equation::show(ui, model, actions),
            LowerPanel::Convergence => chart::show(ui, model, actions),
            LowerPanel::Accuracy => accuracy::show(ui, model, actions),
            LowerPanel::HardCases => hard_cases::show(ui, model, actions),
        }
    });
}

fn tabs(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = UNIT;
        for &panel in LowerPanel::ALL {
            let is_open = model.lower == Some(panel);
            let hover = with_key(ui, panel.meaning(), Some(&keys::of_lower_panel(panel)));
            let tab = Button::new(panel.label()).selected(is_open).frame_when_inactive(is_open);
            if ui.add(tab).on_hover_text(hover).clicked() {
                actions.push(Action::ShowLowerPanel((!is_open).then_some(panel)));
            }
        }
    });
}
