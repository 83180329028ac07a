//! What effects cost: rays that were traced for them, and rays that were not.

use super::effect::Effect;
use crate::choice::Choice;
use std::ops::AddAssign;

const EFFECTS: usize = Effect::ALL.len();

/// Rays by effect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bill {
    spent: [u64; EFFECTS],
    saved: [u64; EFFECTS],
}

impl Bill {
    pub fn spend(&mut self, effect: Effect, rays: u64) {
        self.spent[effect as usize] += rays;
    }

    pub fn save(&mut self, effect: Effect, rays: u64) {
        self.saved[effect as usize] += rays;
    }

    /// Rays that were traced for an effect alone.
    pub fn spent(&self, effect: Effect) -> u64 {
        self.spent[effect as usize]
    }

    /// Rays that were not traced because the effect was skipped: those of which it is known that they would have been. What
    /// would have come after them is not counted.
    pub fn saved(&self, effect: Effect) -> u64 {
        self.saved[effect as usize]
    }
}

impl AddAssign<&Self> for Bill {
    fn add_assign(&mut self, other: &Self) {
        for (sum, more) in self.spent.iter_mut().zip(&other.spent).chain(self.saved.iter_mut().zip(&other.saved)) {
            *sum += more;
        }
    }
}
