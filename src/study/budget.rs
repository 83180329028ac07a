//! What is asked of a search, and what it expects of its choice.

use std::time::{Duration, Instant};

/// When a search without a time limit is given up.
pub const LONGEST: Duration = Duration::from_secs(300);

/// An error that is wanted, a time that is allowed, or both: then the least error in the time, and no more than the error takes.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// As a share of the mean irradiance, or of the mean radiance of a picture.
    pub error: Option<f64>,
    /// When it must be over.
    pub end: Option<Instant>,
}

impl Budget {
    /// When a search that begins now is over at the latest.
    pub fn end_from(&self, start: Instant) -> Instant {
        self.end.unwrap_or(start + LONGEST)
    }
}

/// What was expected of a recipe when it was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// As a share of the mean light; `None` where nothing was known.
    pub error: Option<f64>,
    /// Of the solver, and of the picture if there is one.
    pub seconds: Option<f64>,
}
