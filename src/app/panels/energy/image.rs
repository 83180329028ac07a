//! What a picture from a camera cost so far.

use crate::app::format;
use crate::app::panels::widgets::figure;
use crate::app::theme::UNIT;
use crate::solution::{CameraImage, Comparison, PictureError};
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
    if let Some(Comparison::Error(error)) = image.comparison {
        errors(ui, &error);
    }
    ui.add_space(UNIT);
}

fn errors(ui: &mut Ui, error: &PictureError) {
    let hover = "Root mean square difference between the light of the view and the reference, over all that is seen, as a \
                 share of the mean light. The reference's noise is taken out, and what emitters emit themselves does not \
                 count.";
    let (rms, uncertainty) = (format::percent(error.rms), format::percent_short(error.uncertainty));
    figure(ui, "Error", format!("{rms} ± {uncertainty}"), hover);
    let hover = "Mean difference: above 0 where the picture is too bright as a whole";
    figure(ui, "Offset", format::percent(error.offset), hover);
    let hover = "The noise of the reference, which speckles this view: more samples make it less";
    figure(ui, "Noise of the reference", format::percent(error.floor), hover);
}
