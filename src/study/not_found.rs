//! Why a search ended with nothing.

use super::attempt::CannotTry;

/// Why there is no light, or no picture, for a wish.
#[derive(Debug, thiserror::Error)]
pub enum NotFound {
    #[error("no light was found in the scene: there is nothing to measure errors by")]
    Dark,
    #[error("no way to compute light came to an end in the time allowed")]
    NoTime,
    #[error("no way to compute light could be followed")]
    CannotTry(#[source] CannotTry),
}

impl NotFound {
    /// What came of ways none of which came to an end.
    pub fn after(last_refusal: Option<CannotTry>) -> Self {
        last_refusal.map_or(Self::NoTime, Self::CannotTry)
    }
}
