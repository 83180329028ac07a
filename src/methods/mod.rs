//! The ways to simulate light. Each is plain state and a step.

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

    /// Copies out what is known so far.
    fn solution(&self) -> Solution;
}

/// Everything that a run depends on, beside the scene.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Settings {
    pub mesh: MeshSettings,
    /// Stop when at most this share of the emitted flux is unshot.
    pub unshot_limit: f64,
    /// Visibility rays from a receiver to a shooter.
    pub shadow_rays: u32,
    /// Every random number comes from this.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { mesh: MeshSettings { element_size: None }, unshot_limit: 1e-3, shadow_rays: 8, seed: 0 }
    }
}
