//! Why a search ended with nothing.

use super::attempt::CannotTry;
use crate::world::World;

/// Why there is no light, or no picture, for a wish.
#[derive(Debug, thiserror::Error)]
pub enum NotFound {
    #[error("there is no light: no surface of the scene emits any, so there is nothing to measure errors by")]
    Dark,
    #[error(
        "no light arrives at any surface: what emits lights nothing, so there is no mean irradiance to state errors by"
    )]
    Unlit,
    #[error(
        "no light arrives at the points where errors are measured, so there is no mean irradiance to state them by"
    )]
    DarkPoints,
    #[error("the camera sees no light, so there is nothing to measure errors by; look elsewhere, or add an emitter")]
    Unseen,
    #[error("no way to compute light came to an end in the time allowed")]
    NoTime,
    #[error("no way to compute light could be followed")]
    CannotTry(#[source] CannotTry),
}

impl NotFound {
    /// Why no light was found at points of surfaces.
    pub fn without_light(world: &World) -> Self {
        match world.census.emitters {
            0 => Self::Dark,
            _ if world.census.light_may_arrive => Self::DarkPoints,
            _ => Self::Unlit,
        }
    }

    /// What came of ways none of which came to an end.
    pub fn after(last_refusal: Option<CannotTry>) -> Self {
        last_refusal.map_or(Self::NoTime, Self::CannotTry)
    }
}
