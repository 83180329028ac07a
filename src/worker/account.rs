//! What became of each effect in what is on show.

use super::Subject;
use crate::effects::{Bill, Effect, Effects, needed};
use crate::methods::{Settings, radiosity, repertoire};
use crate::world::World;

/// An effect that could have been left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    pub effect: Effect,
    pub is_simulated: bool,
    /// Rays that were traced for it alone.
    pub spent: u64,
    /// Rays that were not traced, since it was skipped: those of which it is known that they would have been.
    pub saved: u64,
}

impl Subject {
    /// Effects that it tells apart, so that it can leave them out.
    pub fn repertoire(self, settings: &Settings) -> Effects {
        match self {
            Self::Radiosity => repertoire::of_radiosity(settings.form_factor),
            Self::Photons => repertoire::of_photons(),
            Self::Occlusion => Effects::default(),
            Self::Camera(view) => repertoire::of_view(view, settings.form_factor),
        }
    }

    /// Effects that the world or the view itself calls for.
    pub fn needed(self, world: &World) -> Effects {
        match self {
            Self::Radiosity | Self::Photons | Self::Occlusion => needed(world),
            Self::Camera(view) => needed(world).and(repertoire::asked_for_by(view)),
        }
    }

    /// What became of each effect that it tells apart, by a bill of all that it took.
    pub fn account(self, world: &World, settings: &Settings, bill: &Bill) -> Vec<Entry> {
        let simulated = match self {
            Self::Radiosity => radiosity::simulated(world, settings),
            Self::Photons | Self::Occlusion | Self::Camera(_) => settings.effects.simulated(self.needed(world)),
        };
        let entry = |effect| Entry {
            effect,
            is_simulated: simulated.contains(effect),
            spent: bill.spent(effect),
            saved: bill.saved(effect),
        };
        self.repertoire(settings).iter().map(entry).collect()
    }
}
