//! What the panels say of the effects of light.

use super::model::Look;
use super::views::image;
use crate::cli::picture::subject;
use crate::effects::{Bill, Effect, Effects, Plan};
use crate::methods::Settings;
use crate::worker::{Entry, LightKind, Snapshot};
use std::time::Duration;

/// What the scene calls for, and what became of it in the view on show.
pub struct EffectFacts<'a> {
    pub plan: &'a Plan,
    /// What the scene or the view calls for.
    pub needed: Effects,
    /// Of the effects that the view tells apart.
    pub entries: Vec<Entry>,
    /// The time that the view and its light took.
    pub elapsed: Duration,
    /// What a ray takes by itself.
    pub seconds_per_ray: f64,
}

impl<'a> EffectFacts<'a> {
    pub fn of(snapshot: &'a Snapshot, look: &Look, settings: &Settings) -> Option<Self> {
        let (world, plan) = (snapshot.world.as_deref()?, snapshot.plan.as_deref()?);
        let subject = subject(look.view);
        let (mut elapsed, mut bill) = (Duration::ZERO, Bill::default());
        let mut add = |more_time, more: &Bill| {
            elapsed += more_time;
            bill += more;
        };
        match subject.light() {
            Some(LightKind::Radiosity) => {
                if let Some(solution) = &snapshot.solution {
                    add(solution.elapsed, &solution.counters.bill);
                }
            }
            Some(LightKind::Photons) => {
                if let Some(photons) = &snapshot.photons {
                    add(photons.elapsed, &photons.counters.bill);
                }
            }
            Some(LightKind::Occlusion) => {
                if let Some(occlusion) = &snapshot.occlusion {
                    add(occlusion.elapsed, &Bill::default());
                }
            }
            None => {}
        }
        if let Some(picture) = image(look.view, snapshot) {
            add(picture.elapsed, &picture.bill);
        }
        let entries = subject.account(world, settings, &bill);
        let needed = subject.needed(world);
        Some(Self { plan, needed, entries, elapsed, seconds_per_ray: snapshot.seconds_per_ray })
    }

    /// Effects that are called for and left out.
    pub fn missing(&self) -> Effects {
        let is_missing = |entry: &&Entry| !entry.is_simulated && self.needed.contains(entry.effect);
        self.entries.iter().filter(is_missing).map(|entry| entry.effect).collect()
    }

    pub fn entry(&self, effect: Effect) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.effect == effect)
    }

    /// About what so many of its rays took by themselves: not more than all of it.
    pub fn seconds_spent(&self, rays: u64) -> f64 {
        self.seconds_saved(rays).min(self.elapsed.as_secs_f64())
    }

    /// About what so many rays would have taken by themselves.
    pub fn seconds_saved(&self, rays: u64) -> f64 {
        rays as f64 * self.seconds_per_ray
    }
}
