//! How single photons are drawn.

use super::widgets::{Segment, chip, segmented, slider, toggle};
use crate::app::action::Action;
use crate::app::format;
use crate::app::keys;
use crate::app::model::{Look, Model};
use crate::app::theme::UNIT;
use crate::choice::Choice;
use crate::viewport::{ColourClass, PhotonColour, PhotonLook, View};
use egui::{Align, Frame, Layout, Margin, Rect, RichText, Ui, UiBuilder, pos2, vec2};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let look = model.look.photons;
    let mut wanted = look;
    ui.horizontal(|ui| {
        ui.label("Colour");
        if let Some(colour) = colours(ui, look.colour) {
            wanted.colour = colour;
        }
        let hover = "Short lines that point to where each photon came from";
        if toggle(ui, "Ticks", look.ticks, hover, &keys::TICKS).clicked() {
            wanted.ticks = !look.ticks;
        }
        ui.add_space(UNIT);
        let sliders = if model.look.view == View::KdTree { 2.0 } else { 1.0 };
        let width = (ui.available_width() / sliders - 2.0 * UNIT).min(80.0 * UNIT);
        if model.look.view == View::KdTree {
            part(ui, width, |ui| {
                ui.label("Depth");
                let write = |depth: f64| format::count(depth as u64);
                let range = 0..=PhotonLook::MAX_DEPTH;
                let response = slider(ui, &mut wanted.depth, range, false, write, |text| format::parse(text, ""));
                response
                    .accessible_name("Depth of the tree")
                    .on_hover_text("How often the planes on show have divided");
            });
        }
        part(ui, width, |ui| {
            ui.label("Size");
            let write = |size: f64| format::decimal(size.round(), 0, "px");
            let range = 1.0..=PhotonLook::MAX_SIZE;
            let response = slider(ui, &mut wanted.size, range, false, write, |text| format::parse(text, "px"));
            response.accessible_name("Size of photons").on_hover_text("Width of a photon on the screen");
        });
    });
    if wanted != look {
        let photons = PhotonLook { size: wanted.size.round(), ..wanted };
        actions.push(Action::SetLook(Look { photons, ..model.look }));
    }
}

/// A part of a row with a width of its own.
fn part(ui: &mut Ui, width: f32, contents: impl FnOnce(&mut Ui)) {
    let size = vec2(width, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), contents);
}

fn colours(ui: &mut Ui, chosen: PhotonColour) -> Option<PhotonColour> {
    let segment = |&colour: &PhotonColour| Segment {
        name: colour.label(),
        hover: colour.meaning(),
        shortcut: None,
        is_chosen: colour == chosen,
    };
    let segments: Vec<Segment> = PhotonColour::ALL.iter().map(segment).collect();
    segmented(ui, 0.0, &segments).map(|chosen| PhotonColour::ALL[chosen])
}

/// What the colours mean, in the lower right of `area`, the viewport.
pub fn legend(ui: &mut Ui, area: Rect, title: &str, classes: &[ColourClass]) {
    const WIDTH: f32 = 32.0 * UNIT;
    const ROW: f32 = 5.0 * UNIT;
    let margin = Margin::symmetric(12, 12);
    let size = vec2(WIDTH, ROW * (classes.len() + 1) as f32) + margin.sum();
    let corner = area.max - vec2(4.0, 4.0) * UNIT;
    let place = Rect::from_min_max(pos2(corner.x - size.x, corner.y - size.y), corner);
    ui.scope_builder(UiBuilder::new().max_rect(place), |ui| {
        Frame::window(ui.style()).inner_margin(margin).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            ui.spacing_mut().interact_size.y = ROW;
            ui.set_width(WIDTH);
            ui.label(RichText::new(title).small().weak());
            for (label, colour) in classes {
                ui.horizontal(|ui| {
                    chip(ui, super::legend::color(*colour));
                    ui.label(RichText::new(*label).small());
                });
            }
        });
    });
}
