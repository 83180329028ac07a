//! How the light is drawn: the view, what is drawn over it, and where the camera goes.

use super::widgets::{Segment, combo, segmented, slider, toggle, with_key};
use crate::app::action::{Action, CameraMove};
use crate::app::format;
use crate::app::keys;
use crate::app::model::{Look, Model};
use crate::app::theme::UNIT;
use crate::app::views::ViewGroup;
use crate::choice::Choice;
use crate::solution::CameraView;
use crate::viewport::View;
use egui::{Align, Button, Layout, Ui, vec2};

/// From this width on the groups of views are buttons, else a menu.
const ROOM_FOR_GROUPS: f32 = 225.0 * UNIT;
/// The same for the toggles.
const ROOM_FOR_TOGGLES: f32 = 280.0 * UNIT;
/// The same for the buttons of the camera.
const ROOM_FOR_CAMERA: f32 = 330.0 * UNIT;

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let look = model.look;
    let width = ui.available_width();
    ui.horizontal(|ui| {
        let group = ViewGroup::of(look.view);
        if width < ROOM_FOR_GROUPS {
            ui.menu_button(group.label(), |ui| groups(ui, look, actions)).response.on_hover_text(group.meaning());
        } else {
            groups(ui, look, actions);
            ui.separator();
        }
        views(ui, look, group, actions);
        if group == ViewGroup::Radiosity {
            fold(ui, "Show", width < ROOM_FOR_TOGGLES, |ui| toggles(ui, look, actions));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_enabled_ui(model.scene.is_some(), |ui| {
                fold(ui, "Camera", width < ROOM_FOR_CAMERA, |ui| camera_buttons(ui, actions));
            });
        });
    });
}

/// The groups of views; another one begins with its first view.
fn groups(ui: &mut Ui, look: Look, actions: &mut Vec<Action>) {
    let shown = ViewGroup::of(look.view);
    let segment = |&group: &ViewGroup| Segment {
        name: group.label(),
        hover: group.meaning(),
        shortcut: None,
        is_chosen: group == shown,
    };
    let segments: Vec<Segment> = ViewGroup::ALL.iter().map(segment).collect();
    let chosen = segmented(ui, 0.0, &segments).map(|chosen| ViewGroup::ALL[chosen]);
    if let Some(group) = chosen.filter(|group| *group != shown) {
        actions.push(Action::SetLook(Look { view: group.first(), ..look }));
    }
}

/// The contents, or a menu that opens to show them.
fn fold(ui: &mut Ui, name: &str, is_folded: bool, contents: impl FnOnce(&mut Ui)) {
    if is_folded {
        ui.menu_button(name, contents);
    } else {
        contents(ui);
    }
}

fn views(ui: &mut Ui, look: Look, group: ViewGroup, actions: &mut Vec<Action>) {
    // One button for all errors: what they are of is chosen beside it.
    let error = View::Camera(CameraView::Error(look.view.judged()));
    let is_shown = |view: &View| !matches!(view, View::Camera(CameraView::Error(_))) || *view == error;
    let views: Vec<View> = group.views().filter(is_shown).collect();
    let segment = |&view: &View| Segment {
        name: view.label(),
        hover: view.meaning(),
        shortcut: Some(keys::of_view(view)),
        is_chosen: look.view == view,
    };
    let segments: Vec<Segment> = views.iter().map(segment).collect();
    let chosen = ui.scope(|ui| {
        // Six of them have to fit into the smallest window.
        ui.spacing_mut().button_padding.x = 1.5 * UNIT;
        segmented(ui, 0.0, &segments)
    });
    if let Some(chosen) = chosen.inner {
        actions.push(Action::SetLook(Look { view: views[chosen], ..look }));
    }
    if look.view == error {
        judged(ui, look, actions);
    }
}

/// What the error on show is of.
fn judged(ui: &mut Ui, look: Look, actions: &mut Vec<Action>) {
    let label = ui.label("of");
    let (chosen, response) = combo(ui, 36.0 * UNIT, look.view.judged());
    response.labelled_by(label.id);
    if let Some(judged) = chosen {
        actions.push(Action::SetLook(Look { view: View::Camera(CameraView::Error(judged)), ..look }));
    }
}

fn toggles(ui: &mut Ui, look: Look, actions: &mut Vec<Action>) {
    let hover = "Draws the edges of the elements, which receive light";
    if toggle(ui, "Wireframe", look.wireframe, hover, &keys::WIREFRAME).clicked() {
        actions.push(Action::SetLook(Look { wireframe: !look.wireframe, ..look }));
    }
    let hover = "Outlines the patch that shot last";
    if toggle(ui, "Shooter", look.show_shooter, hover, &keys::SHOOTER).clicked() {
        actions.push(Action::SetLook(Look { show_shooter: !look.show_shooter, ..look }));
    }
    let hover = "Adds what the unshot light will bring on average, so that an unfinished picture is as bright as it will \
                 be. It is for display alone: no light is computed from it.";
    if toggle(ui, "Ambient", look.ambient, hover, &keys::AMBIENT).clicked() {
        actions.push(Action::SetLook(Look { ambient: !look.ambient, ..look }));
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

/// Which partial sum of Neumann's series is drawn.
pub fn bounces(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let most = model.last_bounce();
    let mut bounce = model.look.bounce.min(most);
    let shown = bounce;
    ui.horizontal(|ui| {
        ui.label("Bounces");
        let step = |name: &str| Button::new(name).min_size(vec2(8.0 * UNIT, 0.0));
        let hover = with_key(ui, "One bounce less", Some(&keys::LESS_BOUNCES));
        if ui.add_enabled(bounce > 0, step("−")).on_hover_text(hover).accessible_name("One bounce less").clicked() {
            bounce -= 1;
        }
        let hover = with_key(ui, "One bounce more", Some(&keys::MORE_BOUNCES));
        if ui.add_enabled(bounce < most, step("+")).on_hover_text(hover).accessible_name("One bounce more").clicked() {
            bounce += 1;
        }
        let write = |bounce: f64| format::count(bounce as u64);
        let response = slider(ui, &mut bounce, 0..=most, false, write, |text| format::parse(text, ""));
        response.accessible_name("Bounces shown").on_hover_text("0 is the light of the emitters alone");
    });
    if bounce != shown {
        actions.push(Action::SetLook(Look { bounce, ..model.look }));
    }
}
