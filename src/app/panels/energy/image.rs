//! What a picture from a camera cost so far.

use crate::app::format;
use crate::app::panels::widgets::figure;
use crate::app::theme::UNIT;
use crate::solution::CameraImage;
use egui::Ui;

pub fn show(ui: &mut Ui, image: &CameraImage) {
    let samples = match image.samples {
        0 => "coarse".to_owned(),
        samples => format!("{} a pixel", format::count(samples.into())),
    };
    figure(ui, "Samples", samples, "Of every pixel, so far; a coarse picture has fewer samples than pixels");
    figure(ui, "Rays", format::short(image.rays as f64, ""), "All rays of this picture");
    let hover = "Time spent on this picture; drawing and waiting do not count";
    figure(ui, "Time", format::duration(image.elapsed), hover);
    ui.add_space(UNIT);
}
