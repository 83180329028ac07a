//! What a person makes of a plan: effects that are simulated although nothing calls for them, and effects that are not.

use super::effect::{Effect, Effects};
use super::plan::needed;
use crate::world::World;

/// Effects that are simulated or left out whatever the plan says; all others are as planned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Switches {
    /// Where the plan does not call for these, they cost time and change nothing.
    pub forced: Effects,
    /// Without these, something may be missing.
    pub off: Effects,
}

impl Switches {
    /// Every effect is simulated.
    pub const ALL: Self = Self { forced: Effects::ALL, off: Effects::of(&[]) };

    /// With this effect simulated, or not. What is as planned needs no switch.
    #[must_use]
    pub fn with(self, effect: Effect, is_on: bool, needed: Effects) -> Self {
        let this = Effects::of(&[effect]);
        let others = Self { forced: self.forced.but(this), off: self.off.but(this) };
        match (is_on, needed.contains(effect)) {
            (true, false) => Self { forced: others.forced.and(this), ..others },
            (false, true) => Self { off: others.off.and(this), ..others },
            (true, true) | (false, false) => others,
        }
    }

    /// Those of these effects; all others are as planned.
    #[must_use]
    pub fn among(self, effects: Effects) -> Self {
        Self { forced: self.forced.among(effects), off: self.off.among(effects) }
    }

    /// The effects that are simulated where so many are needed.
    pub fn simulated(self, needed: Effects) -> Effects {
        needed.and(self.forced).but(self.off)
    }

    /// The effects that are simulated in a world.
    pub fn simulated_in(self, world: &World) -> Effects {
        self.simulated(needed(world))
    }
}
