//! How pictures from a camera are made.

use super::{apply_when_done, count};
use crate::app::action::Action;
use crate::methods::{ImageSettings, Settings};
use crate::solution::CameraView;
use egui::Ui;

pub fn show(ui: &mut Ui, view: CameraView, settings: Settings, actions: &mut Vec<Action>) {
    samples(ui, settings, actions);
    if view.gathers() {
        gather_rays(ui, settings, actions);
    }
    if view.samples_emitters() {
        light_rays(ui, settings, actions);
    }
}

fn samples(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover =
        "Rays through every pixel. Four times as many halve the noise. Of an error sixteen times as many are taken.";
    let response = count(ui, "Samples", hover, &mut settings.image.samples, 1..=ImageSettings::MAX_SAMPLES);
    apply_when_done(&response, settings, actions);
}

fn gather_rays(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Diffuse rays of every sample, each of which ends in the photon map";
    let range = 1..=ImageSettings::MAX_GATHER_RAYS;
    let response = count(ui, "Gather rays", hover, &mut settings.image.gather_rays, range);
    apply_when_done(&response, settings, actions);
}

fn light_rays(ui: &mut Ui, mut settings: Settings, actions: &mut Vec<Action>) {
    let hover = "Shadow rays to the emitters at every place that is seen";
    let range = 1..=ImageSettings::MAX_LIGHT_RAYS;
    let response = count(ui, "Lamp rays", hover, &mut settings.image.light_rays, range);
    apply_when_done(&response, settings, actions);
}
