//! The matrix of form factors and the item buffer, large.

use super::legend;
use super::widgets::{chip, figure_row, heading, primary_button};
use crate::app::action::Action;
use crate::app::diagrams::MatrixTexture;
use crate::app::format;
use crate::app::model::Model;
use crate::app::theme::UNIT;
use crate::choice::Choice;
use crate::methods::{Settings, Solver};
use crate::viewport::diagram::Diagram;
use crate::worker::Command;
use egui::{Align, Color32, Image, Layout, RichText, Spinner, TextureHandle, Ui, vec2};

/// Width of what explains the matrix beside it.
const KEY_WIDTH: f32 = 56.0 * UNIT;
/// What the dialog needs around its picture.
const AROUND: egui::Vec2 = vec2(24.0 * UNIT, 48.0 * UNIT);

/// Contents of the dialog of the matrix.
pub fn matrix(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    heading(ui, "Matrix of form factors");
    if let Some(matrix) = model.matrix {
        ui.horizontal_top(|ui| {
            let room = ui.ctx().content_rect().size() - AROUND - vec2(KEY_WIDTH, 0.0);
            let side = room.min_elem();
            let image = Image::from_texture(&matrix.texture).fit_to_exact_size(vec2(side, side));
            ui.add(image.alt_text("The matrix as a picture"));
            ui.vertical(|ui| key(ui, matrix));
        });
    } else if model.solution.is_some_and(|solution| solution.matrix.is_some()) {
        ui.add(Spinner::new().size(6.0 * UNIT));
    } else if model.settings.solver.needs_matrix() {
        unfinished(ui, model, actions);
    } else {
        no_matrix(ui, model, actions);
    }
}

/// Which colour means what, and how much of the matrix it is.
fn key(ui: &mut Ui, matrix: &MatrixTexture) {
    ui.set_max_width(KEY_WIDTH);
    let size = format::count(matrix.size as u64);
    ui.label(format!("{size} × {size} patches: row i, column j is the share of the light of i that arrives at j."));
    ui.add_space(2.0 * UNIT);
    ui.label(RichText::new("It is sparse, and why").strong());
    for zero in &matrix.zeros {
        share(ui, legend::color(zero.colour), zero.label, zero.share);
    }
    let Some(scale) = &matrix.legend else { return };
    share(ui, legend::color(scale.colour(scale.high)), "Not zero", matrix.filled);
    ui.add_space(2.0 * UNIT);
    legend::scale(ui, scale);
}

fn share(ui: &mut Ui, color: Color32, label: &str, share: f64) {
    figure_row(ui, "", |ui| {
        chip(ui, color);
        ui.label(label);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(format::percent(share)));
    });
}

/// The solver has not come to its first step.
fn unfinished(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    match model.preparation().filter(|share| *share > 0.0) {
        Some(share) => ui.label(format!("Building matrix {}", format::percent_whole(share))),
        None => ui.label("The matrix is built before the first step."),
    };
    if !model.is_running() {
        let step = ui.add_enabled(model.can_run(), primary_button(ui, "Do the first step"));
        if step.on_hover_text("Builds the matrix, does one step and pauses").clicked() {
            actions.push(Action::Send(Command::Step(1)));
        }
    }
}

/// Which solvers have one, each a click away.
fn no_matrix(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ui.label(Diagram::Matrix.remedy());
    ui.add_space(UNIT);
    ui.horizontal(|ui| {
        for &solver in Solver::ALL.iter().filter(|solver| solver.needs_matrix()) {
            let button = primary_button(ui, format!("Use {}", solver.label()));
            if ui.add(button).on_hover_text(solver.meaning()).clicked() {
                actions.push(Action::ApplySettings(Settings { solver, ..model.settings }));
            }
        }
    });
}

/// Contents of the dialog of the item buffer.
pub fn item_buffer(ui: &mut Ui, texture: Option<&TextureHandle>) {
    heading(ui, "Item buffer");
    let Some(texture) = texture else {
        ui.label(Diagram::ItemBuffer.remedy());
        return;
    };
    ui.label(Diagram::ItemBuffer.meaning());
    let side = (ui.ctx().content_rect().size() - AROUND).min_elem();
    let image = Image::from_texture(texture).fit_to_exact_size(vec2(side, side));
    ui.add(image.alt_text("The item buffer, large"));
}
