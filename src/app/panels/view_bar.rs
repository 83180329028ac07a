//! How the light is drawn: the view, what is drawn over it, and where the camera goes.

use super::widgets::{Choice, segmented, toggle, with_key};
use crate::app::action::{Action, CameraMove};
use crate::app::keys;
use crate::app::model::{Look, Model};
use crate::app::theme::UNIT;
use crate::choice::Choice as _;
use crate::viewport::View;
use egui::{Align, Layout, Ui};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let look = model.look;
    ui.horizontal(|ui| {
        views(ui, look, actions);
        ui.add_space(2.0 * UNIT);
        let hover = "Draws the edges of the elements, which receive light";
        if toggle(ui, "Wireframe", look.wireframe, hover, &keys::WIREFRAME).clicked() {
            actions.push(Action::SetLook(Look { wireframe: !look.wireframe, ..look }));
        }
        let hover = "Outlines the patch that shot last";
        if toggle(ui, "Shooter", look.show_shooter, hover, &keys::SHOOTER).clicked() {
            actions.push(Action::SetLook(Look { show_shooter: !look.show_shooter, ..look }));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_enabled_ui(model.scene.is_some(), |ui| camera_buttons(ui, actions));
        });
    });
}

fn views(ui: &mut Ui, look: Look, actions: &mut Vec<Action>) {
    let choice = |&view: &View| Choice {
        name: view.label(),
        hover: view.meaning(),
        shortcut: Some(keys::of_view(view)),
        is_chosen: look.view == view,
    };
    let choices: Vec<Choice> = View::ALL.iter().map(choice).collect();
    if let Some(chosen) = segmented(ui, 20.0 * UNIT, &choices) {
        actions.push(Action::SetLook(Look { view: View::ALL[chosen], ..look }));
    }
}

fn camera_buttons(ui: &mut Ui, actions: &mut Vec<Action>) {
    let hover = with_key(ui, "Saves a picture of this view at once", Some(&keys::SAVE_PICTURE));
    if ui.button("Save picture").on_hover_text(hover).clicked() {
        actions.push(Action::SavePictureNow);
    }
    let hover = with_key(ui, "Flies to a view of the whole scene", Some(&keys::FIT));
    if ui.button("Fit").on_hover_text(hover).clicked() {
        actions.push(Action::Camera(CameraMove::Fit));
    }
    let hover = with_key(ui, "Flies back to the first view of this scene", Some(&keys::HOME));
    if ui.button("First view").on_hover_text(hover).clicked() {
        actions.push(Action::Camera(CameraMove::Home));
    }
}
