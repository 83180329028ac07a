//! Where the flux of photons went, and what became of them.

use super::{Balance, Entry};
use crate::app::format;
use crate::app::model::Model;
use crate::app::panels::widgets::figure;
use crate::app::theme::Palette;
use crate::math::rgb::total;
use crate::solution::{PhotonCounters, PhotonEnergy};
use egui::{CollapsingHeader, RichText, Ui};

const DEFECT: &str = "Emitted less absorbed, escaped and truncated. It is rounding only; anything larger than a millionth \
                      of the emitted flux would be a fault in the program.";

pub fn show(ui: &mut Ui, model: &Model) {
    let Some(photons) = model.photons else {
        ui.label(RichText::new("No photons yet").weak());
        return;
    };
    let balance = Balance {
        emitted: total(photons.energy.emitted),
        meaning: "The flux of the photons of the global map that left the emitters, summed over red, green and blue",
        entries: entries(&photons.energy, Palette::of(ui.visuals())),
        defect: total(photons.energy.defect()),
        meaning_of_defect: DEFECT,
    };
    balance.show(ui);
    if let Some(warning) = photons.warning() {
        ui.colored_label(ui.visuals().warn_fg_color, warning);
    }
    counts(ui, &photons.counters);
    tables(ui, &photons.counters);
}

fn entries(energy: &PhotonEnergy, palette: Palette) -> [Entry; 3] {
    [
        Entry {
            name: "Absorbed",
            meaning: "Turned into heat on surfaces",
            color: palette.absorbed,
            flux: total(energy.absorbed),
        },
        Entry {
            name: "Escaped",
            meaning: "Left the scene through an opening",
            color: palette.escaped,
            flux: total(energy.escaped),
        },
        Entry {
            name: "Truncated",
            meaning: "Given up after the largest number of bounces",
            color: palette.unshot,
            flux: total(energy.truncated),
        },
    ]
}

fn counts(ui: &mut Ui, counters: &PhotonCounters) {
    let stored = |stored: u64, emitted: u64| {
        format!("{} of {}", format::short(stored as f64, ""), format::short(emitted as f64, ""))
    };
    let hover = "Landings on diffuse surfaces that were kept, of photons emitted: one photon may land several times";
    figure(ui, "Stored", stored(counters.stored, counters.emitted), hover);
    if counters.caustic_emitted > 0 {
        let hover = "The same of the caustic map, which keeps what comes over mirrors and glass alone";
        figure(ui, "Caustic map", stored(counters.caustic_stored, counters.caustic_emitted), hover);
    }
}

/// Landings by bounce and by path, each with its share of all.
fn tables(ui: &mut Ui, counters: &PhotonCounters) {
    let bounces = counters.by_bounce.iter().enumerate().map(|(bounce, count)| (bounce.to_string(), *count));
    table(ui, "By bounce", bounces.filter(|(_, count)| *count > 0).collect());
    table(ui, "By path", counters.by_path.clone());
}

fn table(ui: &mut Ui, title: &str, rows: Vec<(String, u64)>) {
    let all: u64 = rows.iter().map(|(_, count)| count).sum();
    if all == 0 {
        return;
    }
    CollapsingHeader::new(title).id_salt(title).show_unindented(ui, |ui| {
        for (name, count) in rows {
            let share = format::percent(count as f64 / all as f64);
            figure(ui, &name, format!("{}  {share}", format::count(count)), "Landings, and their share of all");
        }
    });
}
