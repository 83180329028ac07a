//! How far ambient occlusion looks, and how it fades, with its curve.

use super::{apply_when_done, count};
use crate::app::action::Action;
use crate::app::format;
use crate::app::model::Model;
use crate::app::panels::widgets::{choice, figure, labelled, slider};
use crate::app::theme::UNIT;
use crate::choice::Choice;
use crate::methods::{ImageSettings, OcclusionSettings, Range, Settings};
use egui::accesskit::Role;
use egui::{Align2, RichText, Sense, Shape, Stroke, TextStyle, Ui, WidgetInfo, pos2, vec2};

/// Points of the curve.
const POINTS: u32 = 64;
/// The curve is drawn up to so many times the range.
const SHOWN_RANGES: f32 = 2.5;

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let Some(scene) = model.scene else { return };
    rays(ui, model.settings, actions);
    falloff(ui, model.settings, actions);
    range(ui, model.settings, scene.radius, actions);
    if model.settings.occlusion.range == Range::Unlimited {
        let text = "Whatever stands in the way takes all light, however far it is: a closed room is black.";
        ui.label(RichText::new(text).small().weak());
    } else {
        curve(ui, &model.settings.occlusion, scene.radius);
    }
}

/// A vertex gets as many rays in all as a pixel of a picture.
pub fn rounds(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Rounds of rays from every vertex. Four times as many halve the noise.";
    let response = count(ui, "Rounds", hover, &mut settings.image.samples, 1..=ImageSettings::MAX_SAMPLES);
    apply_when_done(&response, settings, actions);
}

fn rays(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Rays that look for what stands near: of every sample of a picture, or of a vertex in every round";
    let response = count(ui, "AO rays", hover, &mut settings.occlusion.rays, 1..=OcclusionSettings::MAX_RAYS);
    apply_when_done(&response, settings, actions);
}

fn falloff(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "How much light something takes away, by its distance";
    if let Some(falloff) = choice(ui, "Fall-off", hover, settings.occlusion.falloff) {
        settings.occlusion.falloff = falloff;
        actions.push(Action::ApplySettings(settings));
    }
}

fn range(ui: &mut Ui, mut settings: Settings, radius: f32, actions: &mut Vec<Action>) {
    let automatic = Range::Automatic.metres(radius);
    let hover = "How far away something can be and still take light away";
    if let Some(kind) = choice(ui, "Distance", hover, Kind::of(settings.occlusion.range)) {
        settings.occlusion.range = match kind {
            Kind::Automatic => Range::Automatic,
            Kind::Chosen => Range::Metres(automatic),
            Kind::Unlimited => Range::Unlimited,
        };
        actions.push(Action::ApplySettings(settings));
        return;
    }
    if let Range::Metres(metres) = &mut settings.occlusion.range {
        let hover = "The distance D of the curve below";
        let span = radius / 1000.0..=4.0 * radius;
        let share = f64::from(*metres / radius);
        let response = labelled(ui, "At most", hover, |ui| {
            slider(ui, metres, span, true, |metres| format::si(metres, "m"), |text| format::parse(text, "m"))
        });
        figure(ui, "Of the scene's radius", format::percent(share), "The same distance as a share of the scene's size");
        apply_when_done(&response, settings, actions);
    }
}

/// Occlusion over distance, from 0 to 1 upwards.
fn curve(ui: &mut Ui, settings: &OcclusionSettings, radius: f32) {
    let range = settings.range.metres(radius);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width() - UNIT, 14.0 * UNIT), Sense::hover());
    let meaning = format!("Occlusion over distance, with D = {}", format::si(range.into(), "m"));
    response.widget_info(|| WidgetInfo::labeled(Role::Image, true, &meaning));
    let visuals = ui.visuals();
    let frame = rect.shrink(1.0);
    let at = |share: f32, occlusion: f32| {
        pos2(frame.left() + share * frame.width(), frame.bottom() - occlusion * frame.height())
    };
    let occlusion = |share: f32| settings.falloff.occlusion(share * SHOWN_RANGES * range, range);
    let points = (0..=POINTS).map(|i| i as f32 / POINTS as f32).map(|share| at(share, occlusion(share))).collect();
    let painter = ui.painter_at(rect);
    painter.rect_stroke(rect, 3, visuals.widgets.noninteractive.bg_stroke, egui::StrokeKind::Inside);
    let mark = at(1.0 / SHOWN_RANGES, 0.0);
    painter.vline(mark.x, frame.y_range(), visuals.widgets.noninteractive.bg_stroke);
    painter.add(Shape::line(points, Stroke::new(1.5, visuals.hyperlink_color)));
    let font = TextStyle::Small.resolve(ui.style());
    painter.text(mark + vec2(3.0, -2.0), Align2::LEFT_BOTTOM, "D", font, visuals.weak_text_color());
    response.on_hover_text(meaning);
}

/// The kinds of range.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Automatic,
    Chosen,
    Unlimited,
}

impl Kind {
    fn of(range: Range) -> Self {
        match range {
            Range::Automatic => Self::Automatic,
            Range::Metres(_) => Self::Chosen,
            Range::Unlimited => Self::Unlimited,
        }
    }
}

impl Choice for Kind {
    const ALL: &'static [Self] = &[Self::Automatic, Self::Chosen, Self::Unlimited];
    const KIND: &'static str = "distance";

    fn name(self) -> &'static str {
        match self {
            Self::Automatic => "automatic",
            Self::Chosen => "chosen",
            Self::Unlimited => "unlimited",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Automatic => "Automatic",
            Self::Chosen => "Chosen",
            Self::Unlimited => "Unlimited",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Automatic => "Half the radius of the scene",
            Self::Chosen => "As far as you say",
            Self::Unlimited => "Everything counts, however far away: only the open sky is bright",
        }
    }
}
