//! The dialogs: saving a picture, typing a path, the keys, and what this program is.

use super::diagrams;
use super::widgets::{Segment, heading, labelled, primary_button, row, segmented};
use crate::app::action::Action;
use crate::app::keys::BINDINGS;
use crate::app::model::{Dialog, Model, PathPurpose, PictureRequest};
use crate::app::theme::UNIT;
use crate::cli::picture::Format;
use egui::{Align, Button, DragValue, Frame, Grid, Id, Key, Layout, Modal, RichText, TextEdit, Ui};
use std::path::PathBuf;

/// Largest side of a picture, in pixels: what every graphics adapter can draw.
const MAX_SIDE: u32 = 8192;

/// Width of dialogs that are not as wide as their picture.
const FORM_WIDTH: f32 = 100.0 * UNIT;

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let Some(dialog) = model.dialog else { return };
    // Each kind of dialog has a size of its own.
    let id = Id::unique(("dialog", std::mem::discriminant(dialog)));
    let modal = Modal::new(id).frame(Frame::window(ui.style())).show(ui.ctx(), |ui| {
        let is_picture = matches!(dialog, Dialog::Matrix | Dialog::ItemBuffer);
        if !is_picture {
            ui.set_width(FORM_WIDTH);
        }
        match dialog {
            Dialog::Picture(request) => picture(ui, model, *request, actions),
            Dialog::Path { purpose, text } => path(ui, *purpose, text, actions),
            Dialog::Matrix => diagrams::matrix(ui, model, actions),
            Dialog::ItemBuffer => diagrams::item_buffer(ui, model.item_buffer),
            Dialog::Keys => keys(ui, actions),
            Dialog::About => about(ui, model, actions),
        }
        if is_picture {
            close_button(ui, actions);
        }
    });
    if modal.should_close() {
        actions.push(Action::CloseDialog);
    }
}

fn picture(ui: &mut Ui, model: &Model, request: PictureRequest, actions: &mut Vec<Action>) {
    heading(ui, "Save a picture");
    let mut edited = request;
    sizes(ui, model, &mut edited);
    labelled(ui, "Width", "In pixels", |ui| ui.add(side(&mut edited.size[0])));
    labelled(ui, "Height", "In pixels", |ui| ui.add(side(&mut edited.size[1])));
    row(ui, "Samples", "Samples a pixel", |ui, _| {
        let choices = SAMPLES.map(|(samples, name)| Segment {
            name,
            hover: "More samples make smoother edges and take longer",
            shortcut: None,
            is_chosen: edited.samples == samples,
        });
        if let Some(chosen) = segmented(ui, 12.0 * UNIT, &choices) {
            edited.samples = SAMPLES[chosen].0;
        }
    });
    row(ui, "Format", "What is written", |ui, _| {
        let choices = FORMATS.map(|(format, name, hover)| Segment {
            name,
            hover,
            shortcut: None,
            is_chosen: edited.format == format,
        });
        if let Some(chosen) = segmented(ui, 18.0 * UNIT, &choices) {
            edited.format = FORMATS[chosen].0;
        }
    });
    if edited != request {
        actions.push(Action::ShowDialog(Dialog::Picture(edited)));
    }
    buttons(ui, "Save as…", model.solution.is_some(), actions, || Action::BrowseForPicture(edited));
}

const SAMPLES: [(u32, &str); 3] = [(4, "4"), (16, "16"), (64, "64")];

const FORMATS: [(Format, &str, &str); 2] = [
    (Format::Png, "PNG", "As it looks on the screen"),
    (Format::Exr, "EXR", "Linear radiance, without exposure and tone curve"),
];

fn sizes(ui: &mut Ui, model: &Model, request: &mut PictureRequest) {
    let sizes = [
        ("This view", model.viewport_size),
        ("1280 × 960", [1280, 960]),
        ("1920 × 1080", [1920, 1080]),
        ("3840 × 2160", [3840, 2160]),
    ];
    let choices = sizes.map(|(name, size)| Segment {
        name,
        hover: "Width × height in pixels",
        shortcut: None,
        is_chosen: request.size == size,
    });
    if let Some(chosen) = segmented(ui, 24.0 * UNIT, &choices) {
        request.size = sizes[chosen].1;
    }
}

fn side(pixels: &mut u32) -> DragValue<'_> {
    DragValue::new(pixels).range(16..=MAX_SIDE).update_while_editing(false).suffix(" px")
}

/// A path in a text field, for systems without a file dialog of their own.
fn path(ui: &mut Ui, purpose: PathPurpose, text: &str, actions: &mut Vec<Action>) {
    heading(
        ui,
        match purpose {
            PathPurpose::OpenScene => "Open a scene",
            PathPurpose::SavePicture(_) => "Save a picture",
        },
    );
    ui.label(RichText::new("This system has no file dialog (xdg-desktop-portal or zenity would be one).").weak());
    let label = ui.label("Path of the file");
    let mut edited = text.to_owned();
    let field = ui.add(TextEdit::singleline(&mut edited).desired_width(f32::INFINITY)).labelled_by(label.id);
    let entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    if ui.memory(|memory| memory.focused().is_none()) && !entered {
        field.request_focus();
    }
    if edited != text {
        actions.push(Action::ShowDialog(Dialog::Path { purpose, text: edited.clone() }));
    }
    let done = || match purpose {
        PathPurpose::OpenScene => Action::Open(edited.clone()),
        PathPurpose::SavePicture(request) => Action::SavePicture(request, PathBuf::from(&edited)),
    };
    let name = if purpose == PathPurpose::OpenScene { "Open" } else { "Save" };
    let is_given = !edited.trim().is_empty();
    buttons(ui, name, is_given, actions, done);
    if entered && is_given {
        actions.push(Action::CloseDialog);
        actions.push(done());
    }
}

fn keys(ui: &mut Ui, actions: &mut Vec<Action>) {
    heading(ui, "Keys");
    let rows = BINDINGS.iter().map(|binding| (ui.ctx().format_shortcut(&binding.shortcut), binding.purpose));
    two_columns(ui, "keys", &rows.collect::<Vec<_>>());
    heading(ui, "Mouse in the viewport");
    let mouse = [
        ("Drag", "Turn around the scene"),
        ("Shift+drag or right drag", "Move sideways"),
        ("Wheel", "Move closer or away"),
        ("Click", "Pick a patch, or a photon where photons are seen"),
        ("Shift+click", "Pick a second point, or one among photons"),
        ("Double click", "Fit the scene into the view"),
    ];
    two_columns(ui, "mouse", &mouse.map(|(gesture, purpose)| (gesture.to_owned(), purpose)));
    close_button(ui, actions);
}

/// One column would be higher than the smallest window.
fn two_columns(ui: &mut Ui, id: &str, rows: &[(String, &'static str)]) {
    let halves = rows.split_at(rows.len().div_ceil(2));
    ui.horizontal_top(|ui| {
        for (side, half) in [("left", halves.0), ("right", halves.1)] {
            table(ui, (id, side), half);
            ui.add_space(4.0 * UNIT);
        }
    });
}

fn table(ui: &mut Ui, id: impl egui::AsIdSalt, rows: &[(String, &'static str)]) {
    ui.spacing_mut().interact_size.y = 4.0 * UNIT;
    Grid::new(id).num_columns(2).spacing([6.0 * UNIT, 0.5 * UNIT]).show(ui, |ui| {
        for (left, right) in rows {
            ui.label(RichText::new(left).strong());
            ui.label(*right);
            ui.end_row();
        }
    });
}

fn about(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    heading(ui, concat!("Lightwell ", env!("CARGO_PKG_VERSION")));
    ui.label(env!("CARGO_PKG_DESCRIPTION"));
    ui.label(RichText::new(format!("Draws on {}", model.adapter)).weak());
    ui.label(RichText::new(concat!("Licence: ", env!("CARGO_PKG_LICENSE"))).weak());
    close_button(ui, actions);
}

/// `Cancel` and the button that does what the dialog is for; both close it.
fn buttons(ui: &mut Ui, name: &str, enabled: bool, actions: &mut Vec<Action>, done: impl FnOnce() -> Action) {
    ui.add_space(2.0 * UNIT);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if ui.add_enabled(enabled, primary_button(ui, name)).clicked() {
            actions.push(Action::CloseDialog);
            actions.push(done());
        }
        if ui.button("Cancel").clicked() {
            actions.push(Action::CloseDialog);
        }
    });
}

fn close_button(ui: &mut Ui, actions: &mut Vec<Action>) {
    ui.add_space(2.0 * UNIT);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if ui.add(Button::new("Close")).clicked() {
            actions.push(Action::CloseDialog);
        }
    });
}
