//! The picture of the light, the camera under the mouse, and what to show where there is no picture.

use super::marks;
use crate::app::action::{Action, CameraMove};
use crate::app::model::Model;
use crate::app::theme::UNIT;
use crate::app::views::ViewGroup;
use crate::scene::BUILTINS;
use crate::worker::Phase;
use egui::accesskit::Role;
use egui::{
    Align, Align2, Area, Button, Color32, Event, Frame, Id, InputState, Layout, Order, PointerButton, Rect, Response,
    RichText, ScrollArea, Sense, Spinner, TextStyle, Ui, UiBuilder, WidgetInfo, vec2,
};

/// Zoom for a wheel's notch, which egui reports as some 40 points.
const ZOOM_PER_POINT: f32 = 0.003;

/// Shows the viewport in all the space there is, and returns its rectangle.
pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>, paint: impl FnOnce(&Ui, Rect)) -> Rect {
    let rect = ui.available_rect_before_wrap();
    let response = ui.allocate_rect(rect, Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Viewport"));
    ui.painter().rect_filled(rect, 0, ui.visuals().extreme_bg_color);
    if model.scene.is_some() {
        paint(ui, rect);
        if let Some(marks) = &model.marks {
            marks::show(ui, rect, marks);
        }
        camera(ui, &response, actions);
        pick(ui, model, &response, actions);
    } else if *model.phase == Phase::Empty {
        invitation(ui, rect, actions);
    }
    if let Phase::Loading(name) = model.phase {
        loading(ui, rect, name);
    }
    dropped_files(ui, rect, actions);
    rect
}

fn camera(ui: &Ui, response: &Response, actions: &mut Vec<Action>) {
    let drag = response.drag_delta() / response.rect.height();
    if drag != egui::Vec2::ZERO {
        let pans = ui.input(|input| input.modifiers.shift) || !response.dragged_by(PointerButton::Primary);
        actions.push(Action::Camera(if pans { CameraMove::Pan(drag) } else { CameraMove::Orbit(drag) }));
    }
    if response.double_clicked_by(PointerButton::Primary) {
        actions.push(Action::Camera(CameraMove::Fit));
    }
    if response.hovered() {
        let factor = ui.input(|input| (-ZOOM_PER_POINT * input.smooth_scroll_delta().y).exp() / input.zoom_delta());
        if factor != 1.0 {
            actions.push(Action::Camera(CameraMove::Zoom(factor)));
        }
    }
}

fn pick(ui: &Ui, model: &Model, response: &Response, actions: &mut Vec<Action>) {
    let clicked = response.interact_pointer_pos().filter(|_| response.clicked_by(PointerButton::Primary));
    let Some(position) = clicked else { return };
    let at = (position - response.rect.min) / response.rect.size();
    let has_points = matches!(ViewGroup::of(model.look.view), ViewGroup::PhotonMap | ViewGroup::Radiosity);
    let is_point = has_points && ui.input(was_with_shift);
    actions.push(if is_point { Action::PickPoint(at) } else { Action::Pick(at) });
}

/// Whether Shift was down when the button was let go last. By the end of a slow frame it may be up again.
fn was_with_shift(input: &InputState) -> bool {
    let released = input.events.iter().rev().find_map(|event| match event {
        Event::PointerButton { pressed: false, modifiers, .. } => Some(modifiers.shift),
        _ => None,
    });
    released.unwrap_or(false)
}

/// What there is to do before a scene is open.
fn invitation(ui: &mut Ui, rect: Rect, actions: &mut Vec<Action>) {
    let width = 100.0 * UNIT;
    let height = (26.0 + 10.0 * BUILTINS.len() as f32) * UNIT;
    let place = Rect::from_center_size(rect.center(), vec2(width, height).min(rect.size()));
    ui.scope_builder(UiBuilder::new().max_rect(place).layout(Layout::top_down(Align::Center)), |ui| {
        ui.label(RichText::new("Open a scene, or drop an OBJ file here").text_style(TextStyle::Heading).strong());
        ui.add_space(UNIT);
        if ui.button("Open…").clicked() {
            actions.push(Action::BrowseForScene);
        }
        ui.add_space(4.0 * UNIT);
        ui.label(RichText::new("or begin with a built-in one").weak());
        ScrollArea::vertical().show(ui, |ui| {
            for builtin in BUILTINS {
                let button = Button::new(builtin.name).min_size(vec2(60.0 * UNIT, 8.0 * UNIT));
                if ui.add(button).on_hover_text(builtin.description).clicked() {
                    actions.push(Action::Open(builtin.name.to_owned()));
                }
            }
        });
    });
}

fn loading(ui: &Ui, rect: Rect, name: &str) {
    overlay(ui, rect, "loading", |ui| {
        ui.horizontal(|ui| {
            ui.add(Spinner::new().size(6.0 * UNIT));
            ui.label(RichText::new(format!("Opening {name}")).text_style(TextStyle::Heading));
        });
    });
}

fn dropped_files(ui: &Ui, rect: Rect, actions: &mut Vec<Action>) {
    let (is_hovered, dropped) =
        ui.input(|input| (!input.raw.hovered_files.is_empty(), input.raw.dropped_files.first().cloned()));
    if is_hovered {
        ui.painter().rect_filled(rect, 0, Color32::from_black_alpha(120));
        overlay(ui, rect, "drop", |ui| {
            ui.label(RichText::new("Drop to open").text_style(TextStyle::Heading));
        });
    }
    if let Some(file) = dropped {
        actions.push(Action::Open(file.path().to_string_lossy().into_owned()));
    }
}

/// A box of text in the middle of the viewport, above everything in it.
fn overlay(ui: &Ui, rect: Rect, name: &str, contents: impl FnOnce(&mut Ui)) {
    Area::new(Id::unique(("viewport overlay", name)))
        .order(Order::Foreground)
        .pivot(Align2::CENTER_CENTER)
        .fixed_pos(rect.center())
        .interactable(false)
        .show(ui.ctx(), |ui| {
            Frame::window(ui.style()).inner_margin(16).show(ui, contents);
        });
}
