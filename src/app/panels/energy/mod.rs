//! Where the emitted light is, and what was spent on it.

mod image;
mod occlusion;
mod photons;
mod radiosity;

use super::widgets::{chip, figure, figure_row};
use crate::app::format;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::worker::LightKind;
use egui::accesskit::Role;
use egui::{Align, Color32, CornerRadius, Layout, Rect, RichText, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

/// A ledger whose defect is a larger share of the emitted flux than this does not close: double precision loses some
/// 1e-16 a sum, and a run of a million shots stays below 1e-9.
const CLOSES: f64 = 1e-6;

pub fn show(ui: &mut Ui, model: &Model) {
    if let Some(image) = model.image {
        image::show(ui, image);
    }
    match model.light() {
        Some(LightKind::Radiosity) => radiosity::show(ui, model),
        Some(LightKind::Photons) => photons::show(ui, model),
        Some(LightKind::Occlusion) => occlusion::show(ui, model.occlusion),
        None if model.image.is_none() => {
            ui.label(RichText::new("No picture yet").weak());
        }
        None => {}
    }
}

/// The emitted flux and where it is, W.
struct Balance {
    emitted: f64,
    /// What `emitted` says to those who ask.
    meaning: &'static str,
    entries: [Entry; 3],
    defect: f64,
    /// The same of `defect`.
    meaning_of_defect: &'static str,
}

impl Balance {
    fn show(&self, ui: &mut Ui) {
        figure(ui, "Emitted", strong(ui, watts(self.emitted)), self.meaning);
        bar(ui, &self.entries, self.emitted);
        for entry in &self.entries {
            row(ui, entry, self.emitted);
        }
        ui.add_space(UNIT);
        defect(ui, self.defect, self.emitted, self.meaning_of_defect);
    }
}

/// One share of the emitted flux.
struct Entry {
    name: &'static str,
    meaning: &'static str,
    color: Color32,
    /// W
    flux: f64,
}

/// The shares side by side in a frame as wide as the emitted flux and what overshoot has lent: the unshot flux, where it
/// is negative, and a line marks the emitted flux then. A gap at the right, or a share past the frame, is a ledger that
/// does not close.
fn bar(ui: &mut Ui, entries: &[Entry], emitted: f64) {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 6.0 * UNIT), Sense::hover());
    let shares: Vec<_> = entries.iter().map(|entry| (entry, share(entry.flux, emitted))).collect();
    let text: Vec<_> = shares.iter().map(|(e, share)| format!("{} {}", e.name, format::percent(*share))).collect();
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, format!("Energy: {}", text.join(", "))));
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, UNIT, ui.visuals().widgets.inactive.bg_fill);
    let lent: f64 = shares.iter().map(|(_, share)| (-share).max(0.0)).sum();
    let emitted_width = rect.width() / (1.0 + lent) as f32;
    let mut left = rect.left();
    for (entry, share) in &shares {
        let right = left + emitted_width * share.max(0.0) as f32;
        let corners = CornerRadius {
            nw: if left <= rect.left() { 4 } else { 0 },
            sw: if left <= rect.left() { 4 } else { 0 },
            ne: if right >= rect.right() - 0.5 { 4 } else { 0 },
            se: if right >= rect.right() - 0.5 { 4 } else { 0 },
        };
        let part = Rect::from_min_max(pos2(left, rect.top()), pos2(right, rect.bottom()));
        painter.rect_filled(part, corners, entry.color);
        left = right;
    }
    if lent > CLOSES {
        let emitted = rect.left() + emitted_width;
        painter.vline(emitted, rect.y_range(), Stroke::new(2.0, ui.visuals().strong_text_color()));
    }
    response.on_hover_text(text.join("\n"));
}

fn row(ui: &mut Ui, entry: &Entry, emitted: f64) {
    figure_row(ui, entry.meaning, |ui| {
        chip(ui, entry.color);
        ui.label(entry.name);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            column(ui, 18.0 * UNIT, format::percent(share(entry.flux, emitted)));
            column(ui, 18.0 * UNIT, watts(entry.flux));
        });
    });
}

/// A figure at the right of a column of this width.
fn column(ui: &mut Ui, width: f32, text: String) {
    let size = vec2(width, ui.spacing().interact_size.y);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.set_min_width(width);
        ui.label(text);
    });
}

fn defect(ui: &mut Ui, defect: f64, emitted: f64, hover: &str) {
    let closes = defect.abs() <= CLOSES * emitted;
    let (mark, color) = if closes {
        ("closes", ui.visuals().text_color())
    } else {
        ("does not close", Palette::of(ui.visuals()).error)
    };
    let text = format!("{} W, {mark}", format::scientific(defect));
    figure(ui, "Defect", RichText::new(text).color(color), hover);
}

fn share(flux: f64, emitted: f64) -> f64 {
    if emitted > 0.0 { flux / emitted } else { 0.0 }
}

fn watts(flux: f64) -> String {
    format::si(flux, "W")
}

fn strong(ui: &Ui, text: String) -> RichText {
    RichText::new(text).color(ui.visuals().strong_text_color())
}
