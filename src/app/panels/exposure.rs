//! How bright the picture is, and how its range is bent to fit the screen.

use super::widgets::{Segment, labelled, row, segmented, slider};
use crate::app::action::Action;
use crate::app::format;
use crate::app::model::{Look, Model};
use crate::app::theme::UNIT;
use crate::choice::Choice as _;
use crate::viewport::{Exposure, ToneCurve};
use egui::{Checkbox, Ui};

/// Darkest and brightest manual exposure, in EV: from a candle's room to a room lit by the sun, with room to spare.
const RANGE: std::ops::RangeInclusive<f32> = -16.0..=16.0;

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let look = model.look;
    let mut automatic = look.exposure == Exposure::Automatic;
    let hover = "Foresees how bright the scene will be in the end, so that light is seen to grow";
    let response = row(ui, "Exposure", hover, |ui, _| ui.add(Checkbox::new(&mut automatic, "Automatic")));
    let response = response.accessible_name("Automatic exposure").on_hover_text(hover);
    if response.changed() {
        let exposure = if automatic { Exposure::Automatic } else { Exposure::Manual(model.exposure_ev) };
        actions.push(Action::SetLook(Look { exposure, ..look }));
    }
    let mut ev = model.exposure_ev;
    let hover = "Each stop (EV) doubles the brightness. Moving the slider turns automatic exposure off.";
    let response = labelled(ui, "Stops", hover, |ui| {
        slider(ui, &mut ev, RANGE, false, |ev| format::decimal(ev, 1, "EV"), |text| format::parse(text, "EV"))
    });
    if response.changed() {
        actions.push(Action::SetLook(Look { exposure: Exposure::Manual(ev), ..look }));
    }
    let segment = |&tone: &ToneCurve| Segment {
        name: tone.label(),
        hover: tone.meaning(),
        shortcut: None,
        is_chosen: look.tone == tone,
    };
    let segments: Vec<Segment> = ToneCurve::ALL.iter().map(segment).collect();
    let hover = "How the range of the light is bent to fit that of the screen";
    if let Some(chosen) = row(ui, "Tone curve", hover, |ui, _| segmented(ui, 20.0 * UNIT, &segments)) {
        actions.push(Action::SetLook(Look { tone: ToneCurve::ALL[chosen], ..look }));
    }
}
