//! The panels: each a function from what is on show to what the person wants. None of them changes anything itself.

mod accuracy;
mod banner;
mod chart;
mod contributors;
mod diagrams;
mod dialogs;
mod effects;
mod energy;
mod equation;
mod exposure;
mod findings;
mod hard_cases;
mod icons;
mod legend;
mod lower;
mod marks;
mod menu_bar;
mod notices;
mod patch;
mod photon_look;
mod picked_photon;
mod progress;
mod settings;
mod status_line;
mod transport;
mod view_bar;
mod viewport;
mod widgets;

use super::action::Action;
use super::keys;
use super::model::Model;
use super::theme::UNIT;
use super::views::ViewGroup;
use crate::choice::Choice as _;
use crate::viewport::View;
use egui::{CentralPanel, Frame, Margin, Panel, Rect, ScrollArea, Ui};

/// Lays out the whole window. `paint` draws the scene into the viewport's rectangle, below everything else there.
pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>, paint: impl FnOnce(&Ui, Rect)) {
    let focus = keys::Focus::of(ui.ctx());
    Panel::top("menu bar").frame(bar_frame(ui, 4)).show(ui, |ui| menu_bar::show(ui, model, actions));
    Panel::top("transport").frame(bar_frame(ui, 8)).show(ui, |ui| transport::show(ui, model, actions));
    Panel::bottom("status line").frame(bar_frame(ui, 6)).show(ui, |ui| status_line::show(ui, model));
    let side_frame = Frame::side_top_panel(ui.style()).inner_margin(Margin::ZERO);
    Panel::right("side panel")
        .frame(side_frame)
        .resizable(false)
        .exact_size(SIDE_PANEL_WIDTH)
        .show(ui, |ui| side_panel(ui, model, actions));
    CentralPanel::no_frame().show(ui, |ui| {
        Panel::top("view bar").frame(bar_frame(ui, 6)).show(ui, |ui| view_bar::show(ui, model, actions));
        if model.look.view == View::Bounces && model.missing.is_none() {
            let panel = Panel::top("bounces").frame(bar_frame(ui, 6));
            panel.show(ui, |ui| view_bar::bounces(ui, model, actions));
        }
        lower::show(ui, model, actions);
        for banner in banner::all(model) {
            let panel = Panel::top(("banner", &banner.message)).frame(bar_frame(ui, 8));
            panel.show(ui, |ui| banner::show(ui, &banner, actions));
        }
        let area = viewport::show(ui, model, actions, paint);
        if let Some(legend) = &model.legend {
            legend::show(ui, area, legend);
        }
        let classes = model.look.photons.colour.classes();
        if model.look.view.shows_photons() && !classes.is_empty() {
            photon_look::legend(ui, area, model.look.photons.colour.label(), &classes);
        }
        notices::show(ui, area, model, actions);
    });
    dialogs::show(ui, model, actions);
    keys::read(ui.ctx(), focus, model, actions);
}

/// Wide enough for the widest row of figures.
const SIDE_PANEL_WIDTH: f32 = 80.0 * UNIT;

fn bar_frame(ui: &Ui, vertical: i8) -> Frame {
    Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(12, vertical))
}

fn side_panel(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        Frame::new().inner_margin(Margin::symmetric(16, 12)).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = UNIT;
            widgets::section(ui, "Energy", |ui| energy::show(ui, model));
            match ViewGroup::of(model.look.view) {
                ViewGroup::Radiosity => patch::show(ui, model, actions),
                ViewGroup::PhotonMap => picked_photon::show(ui, model, actions),
                ViewGroup::Rays | ViewGroup::Occlusion | ViewGroup::Truth => {}
            }
            if model.look.view.shows_photons() {
                widgets::section(ui, "Photons on show", |ui| photon_look::show(ui, model, actions));
            }
            if !model.look.view.is_false_colour() {
                widgets::section(ui, "Exposure", |ui| exposure::show(ui, model, actions));
            }
            widgets::section(ui, "Settings", |ui| settings::show(ui, model, actions));
            widgets::section(ui, "Effects", |ui| effects::show(ui, model, actions));
            findings::show(ui, model);
        });
    });
}
