//! Where the emitted light is, as a bar that closes: absorbed, unshot and escaped must add up to emitted.

use super::widgets::{chip, figure, figure_row};
use crate::app::format;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::math::rgb::total;
use crate::solution::{Counters, Energy, Solution};
use egui::accesskit::Role;
use egui::{Align, Color32, CornerRadius, Layout, Rect, RichText, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

/// A ledger whose defect is a larger share of the emitted flux than this does not close: double precision loses some
/// 1e-16 a sum, and a run of a million shots stays below 1e-9.
const CLOSES: f64 = 1e-6;

pub fn show(ui: &mut Ui, model: &Model) {
    let Some(solution) = model.solution else {
        ui.label(RichText::new("No light yet").weak());
        return;
    };
    let entries = entries(&solution.energy, Palette::of(ui.visuals()));
    let emitted = total(solution.energy.emitted);
    figure(ui, "Emitted", strong(ui, watts(emitted)), "The flux of all emitters, summed over red, green and blue");
    bar(ui, &entries, emitted);
    for entry in &entries {
        row(ui, entry, emitted);
    }
    ui.add_space(UNIT);
    defect(ui, &solution.energy, emitted);
    closure(ui, solution);
    reciprocity(ui, solution.closure.reciprocity);
    troubles(ui, &solution.counters);
}

/// One share of the emitted flux.
struct Entry {
    name: &'static str,
    meaning: &'static str,
    color: Color32,
    /// W
    flux: f64,
}

fn entries(energy: &Energy, palette: Palette) -> [Entry; 3] {
    [
        Entry {
            name: "Absorbed",
            meaning: "Turned into heat on surfaces",
            color: palette.absorbed,
            flux: total(energy.absorbed),
        },
        Entry {
            name: "Unshot",
            meaning: "On surfaces, waiting to be passed on. Below zero where overshoot has passed on too much, which \
                      later shots take back.",
            color: palette.unshot,
            flux: total(energy.unshot),
        },
        Entry {
            name: "Escaped",
            meaning: "Left the scene through an opening",
            color: palette.escaped,
            flux: total(energy.escaped),
        },
    ]
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

fn defect(ui: &mut Ui, energy: &Energy, emitted: f64) {
    let defect = total(energy.defect());
    let closes = defect.abs() <= CLOSES * emitted;
    let (mark, color) = if closes {
        ("closes", ui.visuals().text_color())
    } else {
        ("does not close", Palette::of(ui.visuals()).error)
    };
    let text = format!("{} W, {mark}", format::scientific(defect));
    figure(
        ui,
        "Defect",
        RichText::new(text).color(color),
        "Emitted less absorbed, unshot and escaped. It is rounding only; anything larger than a millionth of the \
         emitted flux would be a fault in the program.",
    );
}

fn closure(ui: &mut Ui, solution: &Solution) {
    let text =
        format!("mean {}, worst {}", format::percent(solution.closure.mean), format::percent(solution.closure.worst));
    figure(
        ui,
        "Closure",
        text,
        "How far the form factors of a shot, with what escapes, were from adding up to 1 before they were scaled to do \
         so. Smaller elements and more shadow rays bring it down.",
    );
}

/// How far the two form factors of each pair were apart, where a solver compares them.
fn reciprocity(ui: &mut Ui, reciprocity: f64) {
    if reciprocity > 0.0 {
        let hover = "Two patches exchange the same light both ways: A F one way is A F the other way. So far apart were \
                     the two on average, as computed; the matrix has their mean.";
        figure(ui, "Reciprocity", format::percent(reciprocity), hover);
    }
}

/// What a method of form factors could not do, where that came up.
fn troubles(ui: &mut Ui, counters: &Counters) {
    if counters.clamped > 0 {
        let text = format!("The centroid estimate broke down on {}", format::counted(counters.clamped, "pair"));
        let hover = "It gave a form factor above 1, more light than was sent, which was cut down to 1. It takes both \
                     patches for far away.";
        ui.label(RichText::new(text).color(Palette::of(ui.visuals()).warning)).on_hover_text(hover);
    }
    if counters.near_field > 0 {
        let hover = "Too near for a hemicube, which looks from the middle of a patch; computed in closed form instead";
        figure(ui, "Near field", format::counted(counters.near_field, "pair"), hover);
    }
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
