//! What the doctor found in the scene and what it did about it.

use super::icons::Icon;
use super::widgets::heading;
use crate::app::model::{Model, SceneFacts};
use crate::app::theme::{Palette, UNIT};
use crate::scene::{Finding, Severity};
use egui::{RichText, Ui};

pub fn show(ui: &mut Ui, model: &Model) {
    let Some(scene) = model.scene else {
        heading(ui, "Findings");
        ui.label(RichText::new("No scene is open").weak());
        return;
    };
    match scene.findings.len() {
        0 => heading(ui, "Findings"),
        n => heading(ui, &format!("Findings ({n})")),
    }
    if scene.findings.is_empty() {
        ui.label(RichText::new("Nothing had to be mended").weak());
    }
    for finding in sorted(&scene) {
        entry(ui, finding);
    }
}

/// Warnings first, each kind in the order of the file.
fn sorted<'a>(scene: &SceneFacts<'a>) -> impl Iterator<Item = &'a Finding> {
    let of = |severity| scene.findings.iter().filter(move |finding| finding.severity == severity);
    of(Severity::Warning).chain(of(Severity::Note))
}

fn entry(ui: &mut Ui, finding: &Finding) {
    let (icon, color, name) = match finding.severity {
        Severity::Warning => (Icon::Warning, Palette::of(ui.visuals()).warning, "Warning"),
        Severity::Note => (Icon::Note, ui.visuals().weak_text_color(), "Note"),
    };
    ui.horizontal_top(|ui| {
        icon.show(ui, color).on_hover_text(name);
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = UNIT / 2.0;
            ui.label(RichText::new(&finding.subject).strong());
            ui.label(&finding.problem);
            ui.label(RichText::new(&finding.remedy).weak());
        });
    });
    ui.add_space(UNIT);
}
