//! What the panels say of the effects of light.

use super::model::Look;
use super::views::image;
use crate::cli::picture::subject;
use crate::effects::{Bill, Effect, Effects, Plan};
use crate::methods::Settings;
use crate::solution::{Counters, PhotonCounters};
use crate::worker::{Entry, LightKind, Snapshot};
use std::time::Duration;

/// What the scene calls for, and what became of it in the view on show.
pub struct EffectFacts<'a> {
    pub plan: &'a Plan,
    /// Of the effects that the view tells apart.
    pub entries: Vec<Entry>,
    /// All rays of the view and of its light, and the time that these took.
    pub rays: u64,
    pub elapsed: Duration,
    /// What a ray takes at least.
    pub seconds_per_ray: f64,
}

impl<'a> EffectFacts<'a> {
    pub fn of(snapshot: &'a Snapshot, look: &Look, settings: &Settings) -> Option<Self> {
        let (world, plan) = (snapshot.world.as_deref()?, snapshot.plan.as_deref()?);
        let subject = subject(look.view);
        let (mut rays, mut elapsed, mut bill) = (0, Duration::ZERO, Bill::default());
        let mut add = |more_rays, more_time, more: &Bill| {
            rays += more_rays;
            elapsed += more_time;
            bill += more;
        };
        match subject.light() {
            Some(LightKind::Radiosity) => {
                if let Some(solution) = &snapshot.solution {
                    let Counters { rays, bill, .. } = &solution.counters;
                    add(*rays, solution.elapsed, bill);
                }
            }
            Some(LightKind::Photons) => {
                if let Some(photons) = &snapshot.photons {
                    let PhotonCounters { rays, bill, .. } = &photons.counters;
                    add(*rays, photons.elapsed, bill);
                }
            }
            Some(LightKind::Occlusion) => {
                if let Some(occlusion) = &snapshot.occlusion {
                    add(occlusion.rays, occlusion.elapsed, &Bill::default());
                }
            }
            None => {}
        }
        if let Some(picture) = image(look.view, snapshot) {
            add(picture.rays, picture.elapsed, &picture.bill);
        }
        let entries = subject.account(world, settings, &bill);
        Some(Self { plan, entries, rays, elapsed, seconds_per_ray: snapshot.seconds_per_ray })
    }

    /// Effects that the scene calls for and the view leaves out.
    pub fn missing(&self) -> Effects {
        let needed = self.plan.needed();
        let is_missing = |entry: &&Entry| !entry.is_simulated && needed.contains(entry.effect);
        self.entries.iter().filter(is_missing).map(|entry| entry.effect).collect()
    }

    pub fn entry(&self, effect: Effect) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.effect == effect)
    }

    /// What so many of its rays took, if all of them took as long and nothing else took time.
    pub fn seconds_spent(&self, rays: u64) -> f64 {
        if self.rays == 0 { 0.0 } else { self.elapsed.as_secs_f64() * rays as f64 / self.rays as f64 }
    }

    /// What so many rays would have taken at least.
    pub fn seconds_saved(&self, rays: u64) -> f64 {
        rays as f64 * self.seconds_per_ray
    }
}
