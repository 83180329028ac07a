//! What a method hands out: light per element, its ledger of energy, and what it cost.

mod comparison;
mod contrast;
mod equation;
mod exchange;
mod image;
mod judged;
mod occlusion;
mod path;
mod photons;
mod picture_error;
mod probe;

pub use comparison::Comparison;
pub use contrast::Contrast;
pub use equation::{Balance, Contribution, Equation, LightSource, Visibility};
pub use exchange::{FormFactorMatrix, ItemBuffer, Picked, Zero};
pub use image::{CameraImage, CameraView};
pub use judged::Judged;
pub use occlusion::VertexShares;
pub use path::{Path, PathFilter, PathMatcher, Scattering};
pub use photons::{Gathered, Photon, PhotonCounters, PhotonEnergy, PhotonSolution, PhotonTrail, Split, TrailPlace};
pub use picture_error::PictureError;
pub use probe::SurfaceProbe;

use crate::effects::Bill;
use crate::math::rgb::{Rgb, Rgb64, total};
use std::sync::Arc;
use std::time::Duration;

/// A finished copy of what a method knows at one moment.
#[derive(Clone, Debug, Default)]
pub struct Solution {
    /// Steps done so far: shots or sweeps.
    pub steps: u64,
    /// Time spent in steps, filled in by whoever runs the method.
    pub elapsed: Duration,
    /// Whether the stop rule of the settings holds.
    pub converged: bool,
    pub energy: Energy,
    pub closure: Closure,
    pub counters: Counters,
    /// Share of the emitted flux that is still to be shot, Σ A |ΔB| / Φ, in [0, 1]: what the stop rule looks at. Where more was
    /// shot than had arrived, that counts as well. 0 where nothing is emitted.
    pub unshot_share: f64,
    /// Mean irradiance of all surfaces, W/m² summed over RGB.
    pub mean_irradiance: f64,
    /// The patch that shot last.
    pub shooter: Option<u32>,
    pub light: ElementLight,
    /// The irradiance that unshot light will bring on average, with all its reflections to come, W/m²: the ambient term
    /// of Cohen, Chen, Wallace, Greenberg (1988). It is for display; no light is computed from it.
    pub ambient: Rgb,
    /// How much of the matrix is there, in [0, 1], while it is being built.
    pub preparation: Option<f32>,
    /// All form factors, where the solver keeps them and has them all.
    pub matrix: Option<FormFactorMatrix>,
    /// Radiosity of each element after 0, 1, 2 … bounces, W/m², where the solver goes bounce by bounce: the partial sums of
    /// Neumann's series. At most [`Solution::MAX_BOUNCES`] and the first.
    pub bounces: Vec<Arc<Vec<Rgb>>>,
}

impl Solution {
    /// Later bounces are not kept.
    pub const MAX_BOUNCES: usize = 32;

    /// The figures of it.
    pub fn progress(&self) -> Progress {
        Progress {
            steps: self.steps,
            updates: self.counters.updates,
            rays: self.counters.rays,
            unshot_share: self.unshot_share,
            missing_share: missing_share(self.ambient.as_dvec3(), self.mean_irradiance),
        }
    }
}

/// How far a run has come, in a few figures.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    /// Shots or sweeps.
    pub steps: u64,
    /// Patches that shot or gathered: a sweep is as many as there are patches.
    pub updates: u64,
    pub rays: u64,
    /// See [`Solution::unshot_share`].
    pub unshot_share: f64,
    /// Share of the light on surfaces that is expected to be still missing, in [0, 1].
    pub missing_share: f64,
}

/// Share of the light on surfaces that is still missing if what is unshot brings the irradiance `ambient` to all of them,
/// whose mean irradiance is `arrived` (W/m² summed over RGB) so far.
pub fn missing_share(ambient: Rgb64, arrived: f64) -> f64 {
    let missing = total(ambient);
    if missing > 0.0 { missing / (missing + arrived) } else { 0.0 }
}

/// Light on every element of the mesh, in the order of its elements.
#[derive(Clone, Debug, Default)]
pub struct ElementLight {
    /// E, W/m².
    pub irradiance: Vec<Rgb>,
    /// The part of it that comes straight from emitters, W/m².
    pub direct: Vec<Rgb>,
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
}

/// How far form factors were from what they must be, before they were made to be so.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Closure {
    /// Mean of |ΣF + escaped − 1| over the rows of all shots.
    pub mean: f64,
    /// The worst of them.
    pub worst: f64,
    /// Σ |A_i F_ij − A_j F_ji| / Σ (A_i F_ij + A_j F_ji) over all pairs; 0 where pairs are not compared.
    pub reciprocity: f64,
}

/// Work done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Counters {
    /// All rays that carry light.
    pub rays: u64,
    /// Visibility rays between a receiver and a shooter.
    pub shadow_rays: u64,
    /// Rays that estimate how much of a shooter's flux leaves the scene.
    pub escape_rays: u64,
    /// Rays from shooters that carry their flux.
    pub light_rays: u64,
    /// Pairs of an element and a patch whose form factor was computed.
    pub form_factors: u64,
    /// Patches that shot or gathered.
    pub updates: u64,
    /// Form factors above 1, before they were cut down to it.
    pub clamped: u64,
    /// Pairs too near for a hemicube, computed in closed form instead.
    pub near_field: u64,
    /// Of the rays, those for one effect; and those that skipping effects saved.
    #[serde(skip)]
    pub bill: Bill,
}

impl std::ops::AddAssign for Counters {
    fn add_assign(&mut self, other: Self) {
        let Self { rays, shadow_rays, escape_rays, light_rays, form_factors, updates, clamped, near_field, bill } =
            other;
        self.rays += rays;
        self.shadow_rays += shadow_rays;
        self.escape_rays += escape_rays;
        self.light_rays += light_rays;
        self.form_factors += form_factors;
        self.updates += updates;
        self.clamped += clamped;
        self.near_field += near_field;
        self.bill += &bill;
    }
}
