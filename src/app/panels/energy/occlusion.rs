//! What ambient occlusion on the mesh cost so far. No light is emitted, so that there is no balance of energy.

use crate::app::format;
use crate::app::panels::widgets::figure;
use crate::solution::VertexShares;
use egui::{RichText, Ui};

pub fn show(ui: &mut Ui, occlusion: Option<&VertexShares>) {
    let Some(occlusion) = occlusion.filter(|occlusion| occlusion.rays > 0) else {
        ui.label(RichText::new("No rays yet").weak());
        return;
    };
    if !occlusion.shares.is_empty() {
        let vertices = format::count(occlusion.shares.len() as u64);
        figure(ui, "Vertices", vertices, "Each has a share of ambient light, which is interpolated between them");
    }
    let hover = "Of every vertex, so far; four times as many halve the noise";
    figure(ui, "Rounds", format::count(occlusion.rounds.into()), hover);
    figure(ui, "Rays", format::short(occlusion.rays as f64, ""), "All rays that looked for what stands near");
    let hover = "Time spent on these rays; drawing and waiting do not count";
    figure(ui, "Time", format::duration(occlusion.elapsed), hover);
}
