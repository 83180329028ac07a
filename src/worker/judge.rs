//! The truth about the scene on show, and how far off every run on it was.

use super::track::Tracks;
use crate::accuracy::{Cache, Reference, Truth};
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::world::World;
use std::sync::Arc;

/// The error of the truth that is wanted while nothing has been held against it.
const FIRST_FLOOR: f64 = 0.01;
/// An error as the first one of a run may be.
const FIRST_ERROR: f64 = 0.2;
/// Share of the time that methods work which goes into measuring them meanwhile.
const SHARE: f64 = 0.03;
/// Seconds that may be taken in advance.
const ADVANCE: f64 = 0.02;
/// What is known is kept on disk each time that it has doubled, from so many paths on.
const WORTH_KEEPING: u64 = 512;

/// See the module.
#[derive(Default)]
pub struct Judge {
    reference: Option<Reference>,
    cache: Option<Cache>,
    pub tracks: Tracks,
    /// Seconds that measuring has taken from methods at work and not made good.
    owed: f64,
    /// Paths of what is kept on disk.
    kept: u64,
    /// Whether it is given up in this scene.
    pub is_given_up: bool,
}

impl Judge {
    /// Has a truth for this world, made anew where that of before is about another scene. `None` says that there is to be
    /// no truth.
    pub fn turn_to(&mut self, reference: Option<(Reference, Option<Cache>)>) {
        let Some((reference, cache)) = reference else {
            self.is_given_up = true;
            return;
        };
        self.kept = reference.truth().paths;
        (self.reference, self.cache) = (Some(reference), cache);
    }

    /// Forgets about another scene than this one.
    pub fn follow(&mut self, world: &World) {
        if !self.reference.as_ref().is_some_and(|reference| reference.is_about(world)) {
            *self = Self::default();
        }
    }

    pub fn reference(&self) -> Option<&Reference> {
        self.reference.as_ref()
    }

    pub fn truth(&self) -> Option<&Arc<Truth>> {
        self.reference.as_ref().map(Reference::truth)
    }

    /// Whether the truth is not known well enough for what is held against it.
    pub fn wants_more(&self) -> bool {
        let Some(truth) = self.truth() else { return !self.is_given_up };
        let is_enough = self.tracks.smallest().map_or(truth.floor <= FIRST_FLOOR, |error| truth.is_enough_for(&error));
        !truth.is_dark() && !is_enough
    }

    /// Whether the truth is known too little to say anything, so that it cannot wait until methods rest.
    pub fn needs_more(&self) -> bool {
        let Some(truth) = self.truth() else { return !self.is_given_up };
        let error = self.tracks.smallest().map_or(FIRST_ERROR, |error| error.rms);
        !truth.is_dark() && truth.floor > error
    }

    /// Makes the truth better known.
    pub fn refine(&mut self, cancel: &Cancel) {
        let Some(reference) = &mut self.reference else { return };
        if !reference.refine(cancel) {
            return;
        }
        let paths = reference.truth().paths;
        if paths >= WORTH_KEEPING.max(2 * self.kept)
            && let Some(cache) = &self.cache
        {
            self.kept = paths;
            if let Err(error) = reference.keep(cache) {
                log::warn!("{}", with_causes(&error));
                self.cache = None;
            }
        }
        self.tracks.judge(reference.truth());
    }

    /// Whether measuring may go on although methods are at work.
    pub fn may_interrupt(&self) -> bool {
        self.owed < ADVANCE
    }

    /// Takes note of seconds that methods have worked.
    pub fn earn(&mut self, seconds: f64) {
        self.owed = (self.owed - SHARE * seconds).max(0.0);
    }

    /// Takes note of seconds that measuring has taken from methods.
    pub fn spend(&mut self, seconds: f64) {
        self.owed += seconds;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measuring_takes_its_share_of_the_time_and_no_more() {
        let mut judge = Judge::default();
        let (mut working, mut measuring) = (0.0, 0.0);
        for _ in 0..10_000 {
            if judge.may_interrupt() {
                judge.spend(0.1);
                measuring += 0.1;
            } else {
                judge.earn(0.03);
                working += 0.03;
            }
        }
        let share = measuring / working;
        assert!((share - SHARE).abs() < 1e-3, "{share}");
    }
}
