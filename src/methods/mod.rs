//! The ways to simulate light. Each is plain state and a step: no threads of its own, no clock, no file, no window.

pub mod radiosity;

use crate::cancel::Cancel;
use crate::mesh::MeshSettings;
use crate::solution::Solution;

/// What one step did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// The solution is one bounded piece of work better.
    Advanced,
    /// The stop rule held before the step; nothing was done.
    Converged,
    /// The step was stopped; nothing changed.
    Cancelled,
}

/// A way to simulate light.
pub trait Method: Send {
    /// Does one bounded piece of work, all of it or nothing.
    fn step(&mut self, cancel: &Cancel) -> Step;

    /// Takes new settings over and goes on; false, and nothing changes, if they need a fresh start.
    fn configure(&mut self, settings: &Settings) -> bool;

    /// Copies out what is known so far. Its `elapsed` is zero: whoever steps the method holds the clock.
    fn solution(&self) -> Solution;
}

/// Everything that a run depends on, beside the scene.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Settings {
    pub mesh: MeshSettings,
    /// Stop when at most this share of the emitted flux is unshot.
    pub unshot_limit: f64,
    /// Visibility rays of a receiver for all the irradiance that is expected there. A shot that may bring a part of it
    /// gets that part of the rays, but at least [`Settings::MIN_SHADOW_RAYS`].
    pub shadow_rays: u32,
    /// Every random number comes from this.
    pub seed: u64,
}

impl Settings {
    /// The fewest visibility rays from a receiver to a shooter, unless [`Settings::shadow_rays`] is lower.
    pub const MIN_SHADOW_RAYS: u32 = 4;
    pub const MAX_SHADOW_RAYS: u32 = 1024;
}

impl Default for Settings {
    fn default() -> Self {
        Self { mesh: MeshSettings::default(), unshot_limit: 1e-3, shadow_rays: 64, seed: 0 }
    }
}
