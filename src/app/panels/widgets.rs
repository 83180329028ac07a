//! The few widgets that several panels share.

use crate::app::theme::{Palette, UNIT};
use crate::choice::Choice;
use egui::emath::Numeric;
use egui::{
    Align, Button, ComboBox, CornerRadius, KeyboardShortcut, Layout, Response, RichText, Sense, Slider, SliderClamping,
    StrokeKind, TextStyle, Ui, vec2,
};
use std::ops::RangeInclusive;

/// A titled part of the side panel, with a line below it.
pub fn section(ui: &mut Ui, title: &str, contents: impl FnOnce(&mut Ui)) {
    heading(ui, title);
    contents(ui);
    ui.add_space(2.0 * UNIT);
    ui.separator();
    ui.add_space(UNIT);
}

pub fn heading(ui: &mut Ui, title: &str) {
    ui.label(RichText::new(title).text_style(TextStyle::Heading).strong());
    ui.add_space(UNIT);
}

/// A row of a form: a label, and in a column of their own its controls. The label names the control for screen readers.
pub fn labelled(ui: &mut Ui, label: &str, hover: &str, control: impl FnOnce(&mut Ui) -> Response) -> Response {
    row(ui, label, hover, |ui, label| control(ui).labelled_by(label.id)).on_hover_text(hover)
}

/// A row of a form whose controls name themselves.
pub fn row<R>(ui: &mut Ui, label: &str, hover: &str, controls: impl FnOnce(&mut Ui, &Response) -> R) -> R {
    ui.horizontal(|ui| {
        let size = vec2(LABEL_WIDTH, ui.spacing().interact_size.y);
        let layout = Layout::left_to_right(Align::Center);
        let label = ui.allocate_ui_with_layout(size, layout, |ui| {
            ui.set_min_width(LABEL_WIDTH);
            ui.label(label).on_hover_text(hover)
        });
        controls(ui, &label.inner)
    })
    .inner
}

/// Width of the labels of a form.
const LABEL_WIDTH: f32 = 24.0 * UNIT;

/// A slider across the rest of its row, with its value as `format` writes it and `parse` reads it.
pub fn slider<'a, N: Numeric>(
    ui: &mut Ui,
    value: &'a mut N,
    range: RangeInclusive<N>,
    is_logarithmic: bool,
    format: impl Fn(f64) -> String + 'a,
    parse: impl Fn(&str) -> Option<f64> + 'a,
) -> Response {
    ui.spacing_mut().slider_width = ui.available_width() - VALUE_WIDTH - ui.spacing().item_spacing.x - UNIT;
    ui.spacing_mut().interact_size.x = VALUE_WIDTH;
    // A value that is out of range stays until it is edited: only the person changes settings.
    let slider = Slider::new(value, range)
        .clamping(SliderClamping::Edits)
        .logarithmic(is_logarithmic)
        .update_while_editing(false)
        .custom_formatter(move |value, _| format(value))
        .custom_parser(parse);
    ui.add(slider)
}

/// Width of a slider's value.
const VALUE_WIDTH: f32 = 18.0 * UNIT;

/// A row of a form in which one of a few is chosen; returns another one if it was.
pub fn choice<C: Choice>(ui: &mut Ui, label: &str, hover: &str, chosen: C) -> Option<C> {
    row(ui, label, hover, |ui, label| {
        let (picked, response) = combo(ui, ui.available_width() - UNIT, chosen);
        response.labelled_by(label.id);
        picked
    })
}

/// A box that drops down to show all of a few; returns another one if it was chosen.
pub fn combo<C: Choice>(ui: &mut Ui, width: f32, chosen: C) -> (Option<C>, Response) {
    let mut picked = None;
    let combo = ComboBox::from_id_salt(C::KIND).width(width).selected_text(chosen.label());
    let shown = combo.show_ui(ui, |ui| {
        for &choice in C::ALL {
            if ui.selectable_label(choice == chosen, choice.label()).on_hover_text(choice.meaning()).clicked() {
                picked = Some(choice).filter(|picked| *picked != chosen);
            }
        }
    });
    (picked, shown.response.on_hover_text(chosen.meaning()))
}

/// A row of a table of figures: a name at the left, a value at the right.
pub fn figure(ui: &mut Ui, name: &str, value: impl Into<RichText>, hover: &str) {
    figure_row(ui, hover, |ui| {
        ui.label(RichText::new(name).weak());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(value.into()));
    });
}

/// A row of a table of figures, lower than one with controls.
pub fn figure_row(ui: &mut Ui, hover: &str, contents: impl FnOnce(&mut Ui)) {
    ui.scope(|ui| {
        ui.spacing_mut().interact_size.y = 5.0 * UNIT;
        ui.horizontal(contents).response.on_hover_text(hover);
    });
}

/// One choice of a row of buttons.
pub struct Segment<'a> {
    pub name: &'a str,
    pub hover: &'a str,
    pub shortcut: Option<KeyboardShortcut>,
    pub is_chosen: bool,
}

/// Buttons of at least this width in one frame, of which one is chosen; returns the one that was clicked.
pub fn segmented(ui: &mut Ui, width: f32, segments: &[Segment]) -> Option<usize> {
    let mut clicked = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        let last = segments.len() - 1;
        let radius = |inner: bool| if inner { 0 } else { 6 };
        for (i, segment) in segments.iter().enumerate() {
            let (left, right) = (radius(i > 0), radius(i < last));
            let button = Button::new(segment.name)
                .selected(segment.is_chosen)
                .corner_radius(CornerRadius { nw: left, sw: left, ne: right, se: right })
                .min_size(vec2(width, ui.spacing().interact_size.y));
            let response = ui.add(button).on_hover_text(with_key(ui, segment.hover, segment.shortcut.as_ref()));
            if response.clicked() {
                clicked = Some(i);
            }
        }
    });
    clicked
}

/// A button that stays pressed while `is_on`.
pub fn toggle(ui: &mut Ui, name: &str, is_on: bool, hover: &str, shortcut: &KeyboardShortcut) -> Response {
    ui.add(Button::new(name).selected(is_on)).on_hover_text(with_key(ui, hover, Some(shortcut)))
}

/// A button in the accent colour, for what one most likely wants next.
pub fn primary_button(ui: &Ui, text: impl Into<String>) -> Button<'static> {
    let palette = Palette::of(ui.visuals());
    Button::new(RichText::new(text).color(palette.on_accent)).fill(palette.accent)
}

/// A sentence and the key that does the same: `Starts over (R)`.
pub fn with_key(ui: &Ui, sentence: &str, shortcut: Option<&KeyboardShortcut>) -> String {
    match shortcut {
        Some(shortcut) => format!("{sentence} ({})", ui.ctx().format_shortcut(shortcut)),
        None => sentence.to_owned(),
    }
}

/// A small square of a colour, as a legend has.
pub fn chip(ui: &mut Ui, color: egui::Color32) {
    let (rect, _) = ui.allocate_exact_size(vec2(3.0 * UNIT, 3.0 * UNIT), Sense::hover());
    ui.painter().rect(rect, 3, color, ui.visuals().widgets.noninteractive.bg_stroke, StrokeKind::Inside);
}
