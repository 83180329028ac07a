//! The few widgets that several panels share.

use crate::app::theme::{Palette, UNIT};
use egui::{
    Align, Button, CornerRadius, KeyboardShortcut, Layout, Response, RichText, Sense, Stroke, TextStyle, Ui, vec2,
};

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

/// A row with a label at the left and its control at the right, named by the label for screen readers.
pub fn labelled(ui: &mut Ui, label: &str, hover: &str, control: impl FnOnce(&mut Ui) -> Response) -> Response {
    ui.horizontal(|ui| {
        let label = ui.label(label).on_hover_text(hover);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| control(ui).labelled_by(label.id)).inner
    })
    .inner
    .on_hover_text(hover)
}

/// A row of a table of figures: a name at the left, a value at the right.
pub fn figure(ui: &mut Ui, name: &str, value: impl Into<RichText>, hover: &str) {
    ui.horizontal(|ui| {
        ui.label(RichText::new(name).weak());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(value.into()));
    })
    .response
    .on_hover_text(hover);
}

/// One choice of a row of buttons.
pub struct Choice<'a> {
    pub name: &'a str,
    pub hover: &'a str,
    pub shortcut: Option<KeyboardShortcut>,
    pub is_chosen: bool,
}

/// Buttons of equal width in one frame, of which one is chosen; returns the one that was clicked.
pub fn segmented(ui: &mut Ui, width: f32, choices: &[Choice]) -> Option<usize> {
    let mut clicked = None;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        let last = choices.len() - 1;
        let radius = |inner: bool| if inner { 0 } else { 6 };
        for (i, choice) in choices.iter().enumerate() {
            let (left, right) = (radius(i > 0), radius(i < last));
            let button = Button::new(choice.name)
                .selected(choice.is_chosen)
                .corner_radius(CornerRadius { nw: left, sw: left, ne: right, se: right })
                .min_size(vec2(width, ui.spacing().interact_size.y));
            let response = ui.add(button).on_hover_text(with_key(ui, choice.hover, choice.shortcut.as_ref()));
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
    ui.painter().rect_filled(rect, 3, color);
}

/// The line around a bar or a message.
pub fn outline(ui: &Ui) -> Stroke {
    ui.visuals().widgets.noninteractive.bg_stroke
}
