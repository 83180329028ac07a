//! What a method hands out: light per element, its ledger of energy, and what it cost.

mod probe;

pub use probe::SurfaceProbe;

use crate::math::rgb::{Rgb, Rgb64, total};
use std::time::Duration;

/// A finished copy of what a method knows at one moment.
#[derive(Clone, Debug)]
pub struct Solution {
    /// Steps done so far; for progressive radiosity, shots.
    pub steps: u64,
    /// Time spent in steps, filled in by whoever runs the method.
    pub elapsed: Duration,
    /// Whether the stop rule of the settings holds.
    pub converged: bool,
    pub energy: Energy,
    pub closure: Closure,
    pub counters: Counters,
    /// The patch that shot last.
    pub shooter: Option<u32>,
    pub light: ElementLight,
}

/// Light on every element of the mesh, in the order of its elements.
#[derive(Clone, Debug, Default)]
pub struct ElementLight {
    /// E, W/m².
    pub irradiance: Vec<Rgb>,
    /// B = M_e + ρ E, W/m².
    pub radiosity: Vec<Rgb>,
    /// ΔB of the element's patch, W/m²: radiosity that has not been shot yet.
    pub unshot: Vec<Rgb>,
}

/// Where the emitted flux is, W per channel, in double precision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    pub emitted: Rgb64,
    pub absorbed: Rgb64,
    pub unshot: Rgb64,
    pub escaped: Rgb64,
}

impl Energy {
    /// What the ledger lost or made up: emitted − absorbed − unshot − escaped. Rounding, or a bug.
    pub fn defect(&self) -> Rgb64 {
        self.emitted - self.absorbed - self.unshot - self.escaped
    }

    /// Unshot share of the emitted flux in [0, 1]; 0 where nothing is emitted.
    pub fn unshot_share(&self) -> f64 {
        let emitted = total(self.emitted);
        if emitted > 0.0 { total(self.unshot) / emitted } else { 0.0 }
    }
}

/// How far the rows of form factors were from closing before they were scaled: |ΣF + escaped − 1| of each shot.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Closure {
    pub mean: f64,
    pub worst: f64,
}

/// Work done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Counters {
    /// Rays that carry light: shadow and escape rays.
    pub rays: u64,
    /// Visibility rays between a receiver and a shooter.
    pub shadow_rays: u64,
    /// Rays that estimate how much of a shooter's flux leaves the scene.
    pub escape_rays: u64,
    /// Point-to-polygon form factors in closed form.
    pub form_factors: u64,
}
