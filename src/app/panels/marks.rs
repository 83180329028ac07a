//! The picked points over the picture, and the way between them: green where light gets through, red up to what stands on it.

use crate::app::marks::Marks;
use crate::app::theme::UNIT;
use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Ui, Vec2, vec2};

/// Seen before light and dark surfaces alike, with a dark edge round them.
const FREE: Color32 = Color32::from_rgb(0x6a, 0xe8, 0x8f);
const BLOCKED: Color32 = Color32::from_rgb(0xff, 0x5a, 0x4a);
const POINT: Color32 = Color32::WHITE;
const EDGE: Color32 = Color32::from_black_alpha(0xb0);

/// Points: of lines, of the edge round them, of the discs at points, of dashes and the gaps between them.
const WIDTH: f32 = 2.0;
const EDGE_WIDTH: f32 = 1.5;
const RADIUS: f32 = 4.0;
const DASH: f32 = 6.0;

/// Draws them over `area`, the viewport.
pub fn show(ui: &Ui, area: Rect, marks: &Marks) {
    let painter = ui.painter_at(area);
    let on_screen = |at: Vec2| area.min + at * area.size();
    for (way, color) in [(marks.free, FREE), (marks.blocked, BLOCKED)] {
        let Some(ends) = way.map(|ends| ends.map(on_screen)) else { continue };
        painter.line_segment(ends, Stroke::new(WIDTH + 2.0 * EDGE_WIDTH, EDGE));
        painter.line_segment(ends, Stroke::new(WIDTH, color));
    }
    if let Some(ends) = marks.beyond.map(|ends| ends.map(on_screen)) {
        for (width, color) in [(WIDTH + 2.0 * EDGE_WIDTH, EDGE), (WIDTH, BLOCKED)] {
            painter.extend(Shape::dashed_line(&ends, Stroke::new(width, color), DASH, DASH));
        }
    }
    if let Some(at) = marks.source.map(on_screen) {
        point(&painter, at, "x''", true);
    }
    if let Some(at) = marks.point.map(on_screen) {
        point(&painter, at, "x'", marks.is_seen);
    }
}

/// A disc, or a ring where the eye does not see the point, and its letter beside it.
fn point(painter: &Painter, at: Pos2, letter: &str, is_seen: bool) {
    painter.circle_filled(at, RADIUS + EDGE_WIDTH, EDGE);
    if is_seen {
        painter.circle_filled(at, RADIUS, POINT);
    } else {
        painter.circle_stroke(at, RADIUS - 0.5 * WIDTH, Stroke::new(WIDTH, POINT));
    }
    let beside = at + vec2(2.0 * UNIT, -2.0 * UNIT);
    let font = FontId::proportional(15.0);
    for (shift, color) in [(vec2(1.0, 1.0), EDGE), (vec2(-1.0, -1.0), EDGE), (Vec2::ZERO, POINT)] {
        painter.text(beside + shift, Align2::LEFT_BOTTOM, letter, font.clone(), color);
    }
}
