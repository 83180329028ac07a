//! Short messages over the lower left of the viewport.

use crate::app::action::Action;
use crate::app::model::{Model, Notice};
use crate::app::theme::{Palette, UNIT};
use egui::{Align, Button, Frame, Layout, Margin, Rect, RichText, Ui, UiBuilder};

pub fn show(ui: &mut Ui, area: Rect, model: &Model, actions: &mut Vec<Action>) {
    if model.notices.is_empty() {
        return;
    }
    let place = UiBuilder::new().max_rect(area.shrink(4.0 * UNIT)).layout(Layout::bottom_up(Align::Min));
    ui.scope_builder(place, |ui| {
        for notice in model.notices.iter().rev() {
            entry(ui, notice, actions);
        }
    });
}

fn entry(ui: &mut Ui, notice: &Notice, actions: &mut Vec<Action>) {
    let palette = Palette::of(ui.visuals());
    let color = if notice.is_error { palette.error } else { ui.visuals().text_color() };
    let frame = Frame::window(ui.style()).fill(palette.notice).inner_margin(Margin::symmetric(12, 8));
    frame.show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.label(RichText::new(&notice.text).color(color));
            let close = ui.add(Button::new("×").frame(false)).accessible_name("Dismiss message");
            if close.on_hover_text("Dismiss").clicked() {
                actions.push(Action::DismissNotice(notice.id));
            }
        });
    });
}
