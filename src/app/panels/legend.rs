//! The key to false colours, in a corner of the viewport: a bar from the last colour down to the first, with its numbers.

use crate::app::format;
use crate::app::theme::UNIT;
use crate::math::rgb::Rgb;
use crate::viewport::Legend;
use crate::viewport::colour_map::encoded;
use egui::accesskit::Role;
use egui::{
    Align2, Color32, FontId, Frame, Margin, Painter, Rect, Sense, Shape, Stroke, Ui, UiBuilder, WidgetInfo, pos2, vec2,
};

/// Of the bar.
const SIZE: egui::Vec2 = vec2(4.0 * UNIT, 32.0 * UNIT);
/// Room for a number beside the bar.
const NUMBER_WIDTH: f32 = 14.0 * UNIT;
/// Strips that the bar is made of.
const STRIPS: usize = 64;

/// Draws it into the lower right of `area`, the viewport.
pub fn show(ui: &mut Ui, area: Rect, legend: &Legend) {
    let margin = Margin::symmetric(12, 12);
    let size = vec2(SIZE.x + NUMBER_WIDTH, SIZE.y) + margin.sum();
    let place = Rect::from_min_size(area.max - size - vec2(4.0, 4.0) * UNIT, size);
    ui.scope_builder(UiBuilder::new().max_rect(place), |ui| {
        Frame::window(ui.style()).inner_margin(margin).show(ui, |ui| scale(ui, legend));
    });
}

/// A bar of the colours, and the numbers beside it.
pub fn scale(ui: &mut Ui, legend: &Legend) {
    let (rect, response) = ui.allocate_exact_size(vec2(SIZE.x + NUMBER_WIDTH, SIZE.y), Sense::hover());
    let place = Rect::from_min_size(rect.min, SIZE);
    bar(ui.painter(), place, legend);
    ticks(ui, place, legend);
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, format!("Legend: {}", legend.title)));
    response.on_hover_text(legend.title);
}

fn bar(painter: &Painter, rect: Rect, legend: &Legend) {
    let height = rect.height() / STRIPS as f32;
    for strip in 0..STRIPS {
        let share = (strip as f64 + 0.5) / STRIPS as f64;
        let value = if legend.is_logarithmic {
            legend.low * (legend.high / legend.low).powf(share)
        } else {
            legend.low + (legend.high - legend.low) * share
        };
        let bottom = rect.bottom() - strip as f32 * height;
        let part = Rect::from_min_max(pos2(rect.left(), bottom - height), pos2(rect.right(), bottom));
        painter.rect_filled(part, 0, color(legend.colour(value)));
    }
}

fn ticks(ui: &Ui, bar: Rect, legend: &Legend) {
    let color = ui.visuals().text_color();
    for &tick in &legend.ticks {
        let y = bar.bottom() - bar.height() * legend.share(tick);
        let mark = [pos2(bar.right(), y), pos2(bar.right() + UNIT, y)];
        ui.painter().add(Shape::line_segment(mark, Stroke::new(1.0, color)));
        let text = if legend.unit.is_empty() { format::percent_short(tick) } else { format::si(tick, legend.unit) };
        let at = pos2(bar.right() + 2.0 * UNIT, y);
        ui.painter().text(at, Align2::LEFT_CENTER, text, FontId::proportional(12.0), color);
    }
}

/// A linear colour as the screen takes it.
pub fn color(linear: Rgb) -> Color32 {
    let [r, g, b] = linear.to_array().map(encoded);
    Color32::from_rgb(r, g, b)
}
