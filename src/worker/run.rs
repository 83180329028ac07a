//! A method with a clock.

use crate::cancel::Cancel;
use crate::methods::radiosity::Radiosity;
use crate::methods::{Method, Settings, Step};
use crate::solution::Solution;
use crate::world::World;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A method at work, and the time that its steps took.
pub struct Run {
    method: Box<dyn Method>,
    elapsed: Duration,
}

impl Run {
    /// A run of the method that the settings ask for, before its first step.
    ///
    /// # Errors
    /// If it needs more memory than there is.
    pub fn start(world: Arc<World>, settings: &Settings) -> Result<Self, Refused> {
        Ok(Self::of(start_method(world, settings)?))
    }

    /// A run of this method, before its first step.
    pub fn of(method: Box<dyn Method>) -> Self {
        Self { method, elapsed: Duration::ZERO }
    }

    /// One step on the clock.
    pub fn step(&mut self, cancel: &Cancel) -> Step {
        let start = Instant::now();
        let step = self.method.step(cancel);
        self.elapsed += start.elapsed();
        step
    }

    /// Takes new settings over; false if they need a new run.
    pub fn configure(&mut self, settings: &Settings) -> bool {
        self.method.configure(settings)
    }

    pub fn elapsed(&self) -> Duration {
        self.elapsed
    }

    /// What the method knows, with the time that it took.
    pub fn solution(&self) -> Solution {
        Solution { elapsed: self.elapsed, ..self.method.solution() }
    }
}

/// Why a run cannot begin.
#[derive(Debug, thiserror::Error)]
pub enum Refused {
    #[error(
        "the matrix of {patches} patches and {elements} elements needs up to {needed_mib} MiB, and {available_mib} MiB are \
         free; larger elements or progressive radiosity need less"
    )]
    Memory { patches: usize, elements: usize, needed_mib: u64, available_mib: u64 },
}

/// The method that the settings ask for.
///
/// # Errors
/// If it needs more memory than there is.
pub fn start_method(world: Arc<World>, settings: &Settings) -> Result<Box<dyn Method>, Refused> {
    Ok(Box::new(Radiosity::new(world, *settings)))
}
