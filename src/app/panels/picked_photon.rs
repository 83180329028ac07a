//! The photon that was picked, with the roulette on its way, and what the estimate at the picked point is made of.

use super::widgets::{figure, section, with_key};
use crate::app::action::Action;
use crate::app::format;
use crate::app::keys;
use crate::app::model::Model;
use crate::app::theme::UNIT;
use crate::solution::{Gathered, PhotonTrail, Scattering, TrailPlace};
use egui::{Grid, RichText, Ui};

/// Shows its sections of the side panel, where something is picked.
pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    if let Some(trail) = model.trail {
        section(ui, "Picked photon", |ui| {
            way(ui, trail);
            forget(ui, actions);
        });
    }
    if let Some(gathered) = model.gathered {
        section(ui, "Picked point", |ui| {
            estimate(ui, gathered);
            forget(ui, actions);
        });
    }
}

fn forget(ui: &mut Ui, actions: &mut Vec<Action>) {
    ui.add_space(UNIT);
    let hover = with_key(ui, "Takes the marks and this section away", Some(&keys::UNPICK));
    if ui.button("Forget it").on_hover_text(hover).clicked() {
        actions.push(Action::Unpick);
    }
}

/// A row for each place of its way.
fn way(ui: &mut Ui, trail: &PhotonTrail) {
    Grid::new("way").num_columns(4).spacing([3.0 * UNIT, UNIT]).show(ui, |ui| {
        for title in ["", "Event", "Goes on", "Flux"] {
            ui.label(RichText::new(title).small().weak());
        }
        ui.end_row();
        for (number, place) in trail.places.iter().enumerate() {
            ui.label(format::count(number as u64));
            ui.label(event(number, place)).on_hover_text("What happened to the photon there");
            ui.label(format::percent(place.survival.into())).on_hover_text("The chance of the roulette to survive");
            let flux = format::si(f64::from(place.flux.element_sum()), "W");
            ui.label(flux).on_hover_text(format::rgb(place.flux, "W"));
            ui.end_row();
        }
    });
    if trail.escape.is_some() {
        ui.label(RichText::new("It left the scene.").weak());
    }
}

fn event(number: usize, place: &TrailPlace) -> &'static str {
    match place.scattering {
        _ if number == 0 => "Emitted",
        Some(Scattering::Diffuse) => "Diffuse",
        Some(Scattering::Specular) => "Specular",
        None => "Absorbed",
    }
}

fn estimate(ui: &mut Ui, gathered: &Gathered) {
    let irradiance = format::rgb(gathered.irradiance, "W/m²");
    figure(ui, "Irradiance E", irradiance, "The estimate from the photons, in red, green and blue");
    let used = format::count(gathered.photons.into());
    figure(ui, "Photons k", used, "Those that count, marked green");
    let rejected = format::count(gathered.rejected.len() as u64);
    let hover = "As near, but on a side turned away, off the plane, behind a wall or round a corner: marked red";
    figure(ui, "Rejected", rejected, hover);
    figure(ui, "Radius r", format::si(gathered.radius.into(), "m"), "Of the disc that holds them");
    let hover = "How much of the disc is surface on which photons can land; the estimate is for that part alone";
    figure(ui, "Disc inside", format::percent(gathered.inside.into()), hover);
    let hover = "Standard error of the estimate as a share of it: its noise, without its blur";
    figure(ui, "Standard error", format::percent(gathered.relative_error.into()), hover);
}
