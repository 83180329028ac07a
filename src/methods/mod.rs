//! The ways to simulate light. Each is plain state and a step: no threads of its own, no clock, no file, no window.

pub mod ambient_occlusion;
mod cost;
pub mod image;
mod mis;
pub mod path_trace;
pub mod photon_map;
pub mod radiosity;
pub mod repertoire;
mod settings;
mod shadows;
pub mod transport;

pub use ambient_occlusion::{Falloff, OcclusionSettings, Range};
pub use cost::Cost;
pub use settings::{FormFactorMethod, ImageSettings, Kernel, PhotonSettings, Settings, Solver};

use crate::cancel::Cancel;
use crate::solution::{Progress, Solution};

/// What one step did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// A part of what the first step needs is done: of a matrix, one column.
    Prepared,
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

    /// Starts over from the emitters with these settings and what is prepared; false, and nothing changes, if that is
    /// nothing, or of no use for them.
    fn restart(&mut self, _settings: &Settings) -> bool {
        false
    }

    /// How far it has come: cheap enough to be asked after every step.
    fn progress(&self) -> Progress {
        self.solution().progress()
    }

    /// Copies out what is known so far. Its `elapsed` is zero: whoever steps the method holds the clock.
    fn solution(&self) -> Solution;
}
