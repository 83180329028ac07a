//! Where the emitted light is, as a bar that closes: absorbed, unshot and escaped must add up to emitted.

use super::{Balance, Entry};
use crate::app::format;
use crate::app::model::Model;
use crate::app::panels::widgets::figure;
use crate::app::theme::Palette;
use crate::math::rgb::total;
use crate::solution::{Counters, Energy, Solution};
use egui::{RichText, Ui};

/// What else the defect could be.
const DEFECT: &str = "Emitted less absorbed, unshot and escaped. It is rounding only; anything larger than a millionth of \
                      the emitted flux would be a fault in the program.";

pub fn show(ui: &mut Ui, model: &Model) {
    let Some(solution) = model.solution else {
        ui.label(RichText::new("No light yet").weak());
        return;
    };
    let balance = Balance {
        emitted: total(solution.energy.emitted),
        meaning: "The flux of all emitters, summed over red, green and blue",
        entries: entries(&solution.energy, Palette::of(ui.visuals())),
        defect: total(solution.energy.defect()),
        meaning_of_defect: DEFECT,
    };
    balance.show(ui);
    closure(ui, solution);
    reciprocity(ui, solution.closure.reciprocity);
    troubles(ui, &solution.counters);
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
