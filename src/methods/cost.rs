//! What pictures cost in rays.

use crate::effects::{Bill, Effect};

/// Rays so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    pub rays: u64,
    /// Of these, those for one effect; and those that were saved.
    pub bill: Bill,
}

impl Cost {
    /// One ray that is for no effect alone.
    pub fn look(&mut self) {
        self.rays += 1;
    }

    /// Rays for one effect.
    pub fn spend(&mut self, effect: Effect, rays: u32) {
        self.rays += u64::from(rays);
        self.bill.spend(effect, rays.into());
    }

    /// Rays that skipping an effect saves.
    pub fn save(&mut self, effect: Effect, rays: u32) {
        self.bill.save(effect, rays.into());
    }

    pub fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.bill += &other.bill;
    }
}
