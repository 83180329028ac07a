//! How bright the picture is, and how its range is bent to fit the screen.

use super::widgets::{Choice, labelled, segmented};
use crate::app::action::Action;
use crate::app::model::{Look, Model};
use crate::app::theme::UNIT;
use crate::viewport::{Exposure, ToneCurve};
use egui::{Align, Checkbox, Layout, Slider, Ui};

/// Darkest and brightest manual exposure, in EV: from a candle's room to a room lit by the sun, with room to spare.
const RANGE: std::ops::RangeInclusive<f32> = -16.0..=16.0;

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let look = model.look;
    let mut automatic = look.exposure == Exposure::Automatic;
    let hover = "Foresees how bright the scene will be in the end, so that light is seen to grow";
    let response = labelled(ui, "Automatic", hover, |ui| ui.add(Checkbox::without_text(&mut automatic)));
    if response.changed() {
        let exposure = if automatic { Exposure::Automatic } else { Exposure::Manual(model.exposure_ev) };
        actions.push(Action::SetLook(Look { exposure, ..look }));
    }
    let mut ev = model.exposure_ev;
    let hover = "Each stop (EV) doubles the brightness. Moving the slider turns automatic exposure off.";
    let response = labelled(ui, "Exposure", hover, |ui| {
        ui.add(Slider::new(&mut ev, RANGE).suffix(" EV").fixed_decimals(1).smart_aim(false))
    });
    if response.changed() {
        actions.push(Action::SetLook(Look { exposure: Exposure::Manual(ev), ..look }));
    }
    tone_curve(ui, look, actions);
}

fn tone_curve(ui: &mut Ui, look: Look, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.label("Tone curve");
        let choices = ToneCurve::ALL.map(|tone| Choice {
            name: tone.label(),
            hover: match tone {
                ToneCurve::Filmic => "Bright light fades to white as on film",
                ToneCurve::Linear => "In proportion to radiance; what is brighter than white is cut off",
            },
            shortcut: None,
            is_chosen: look.tone == tone,
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if let Some(chosen) = segmented(ui, 18.0 * UNIT, &choices) {
                actions.push(Action::SetLook(Look { tone: ToneCurve::ALL[chosen], ..look }));
            }
        });
    });
}
