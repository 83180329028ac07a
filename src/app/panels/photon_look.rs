//! How single photons are drawn.

use super::widgets::{Segment, chip, labelled, row, segmented, slider};
use crate::app::action::Action;
use crate::app::format;
use crate::app::model::{Look, Model};
use crate::app::theme::UNIT;
use crate::choice::Choice;
use crate::viewport::{ColourClass, PhotonColour, PhotonLook, View};
use egui::{Frame, Margin, Rect, RichText, Ui, UiBuilder, pos2, vec2};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let look = model.look.photons;
    let mut wanted = look;
    if let Some(colour) = colours(ui, look.colour) {
        wanted.colour = colour;
    }
    let hover = "Width of a photon on the screen";
    labelled(ui, "Size", hover, |ui| {
        let range = 1.0..=PhotonLook::MAX_SIZE;
        let write = |size: f64| format::decimal(size.round(), 0, "px");
        slider(ui, &mut wanted.size, range, false, write, |text| format::parse(text, "px"))
    });
    row(ui, "Draw", "Which photons, and what of them", |ui, _| {
        ui.checkbox(&mut wanted.thinned, "Fewer").on_hover_text(thinning(model));
        let hover = "Short lines that point to where each photon came from (T)";
        ui.checkbox(&mut wanted.ticks, "Ticks").on_hover_text(hover);
    });
    if model.look.view == View::KdTree {
        let hover = "How often the planes on show have divided the photons; the first one is the brightest";
        labelled(ui, "Tree depth", hover, |ui| {
            let write = |depth: f64| format::count(depth as u64);
            let range = 0..=PhotonLook::MAX_DEPTH;
            slider(ui, &mut wanted.depth, range, false, write, |text| format::parse(text, ""))
        });
    }
    if wanted != look {
        let photons = PhotonLook { size: wanted.size.round(), ..wanted };
        actions.push(Action::SetLook(Look { photons, ..model.look }));
    }
}

/// How many of the photons are drawn, if there are to be fewer.
fn thinning(model: &Model) -> String {
    let photons = model.photons.map_or(0, |photons| photons.photons.len());
    let thinned = PhotonLook { thinned: true, ..model.look.photons };
    let stride = thinned.stride(u32::try_from(photons).unwrap_or(u32::MAX), model.viewport_size);
    format!("Draws one photon of {}, so that there are gaps between them", format::count(stride.into()))
}

fn colours(ui: &mut Ui, chosen: PhotonColour) -> Option<PhotonColour> {
    let segment = |&colour: &PhotonColour| Segment {
        name: colour.label(),
        hover: colour.meaning(),
        shortcut: None,
        is_chosen: colour == chosen,
    };
    let segments: Vec<Segment> = PhotonColour::ALL.iter().map(segment).collect();
    let picked = row(ui, "Colour", "What the colour of a photon tells", |ui, _| segmented(ui, 0.0, &segments));
    picked.map(|picked| PhotonColour::ALL[picked])
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
