//! Small pictures, painted: the fonts of the window have no symbols.

use egui::{Align2, Color32, FontId, Painter, Rect, Response, Sense, Shape, Stroke, Ui, vec2};

/// Something that can be painted in a small square.
#[derive(Clone, Copy)]
pub enum Icon {
    Run,
    Pause,
    Warning,
    Note,
    /// A tick.
    Chosen,
}

impl Icon {
    /// Side of the square.
    pub const SIZE: f32 = 14.0;

    pub fn paint(self, painter: &Painter, rect: Rect, color: Color32) {
        let rect = Rect::from_center_size(rect.center(), vec2(Self::SIZE, Self::SIZE)).shrink(1.0);
        match self {
            Self::Run => {
                let corners = vec![rect.left_top(), rect.right_center(), rect.left_bottom()];
                painter.add(Shape::convex_polygon(corners, color, Stroke::NONE));
            }
            Self::Pause => {
                let third = rect.width() / 3.0;
                painter.rect_filled(rect.with_max_x(rect.left() + third), 1, color);
                painter.rect_filled(rect.with_min_x(rect.right() - third), 1, color);
            }
            Self::Warning => {
                let corners = vec![rect.center_top(), rect.right_bottom(), rect.left_bottom()];
                painter.add(Shape::closed_line(corners, Stroke::new(1.5, color)));
                letter(painter, rect.translate(vec2(0.0, 2.0)), "!", color);
            }
            Self::Chosen => {
                let at = |x: f32, y: f32| rect.lerp_inside(vec2(x, y));
                let tick = vec![at(0.1, 0.55), at(0.4, 0.85), at(0.95, 0.15)];
                painter.add(Shape::line(tick, Stroke::new(1.5, color)));
            }
            Self::Note => {
                painter.circle_stroke(rect.center(), 0.5 * rect.width(), Stroke::new(1.5, color));
                letter(painter, rect, "i", color);
            }
        }
    }

    /// The icon as a widget that only shows.
    pub fn show(self, ui: &mut Ui, color: Color32) -> Response {
        let size = vec2(Self::SIZE, ui.text_style_height(&egui::TextStyle::Body));
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        self.paint(ui.painter(), rect, color);
        response
    }
}

fn letter(painter: &Painter, rect: Rect, letter: &str, color: Color32) {
    painter.text(rect.center(), Align2::CENTER_CENTER, letter, FontId::proportional(9.0), color);
}
