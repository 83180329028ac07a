//! What a picked patch sees and where its light comes from, the way of a picked photon, and what an estimate at a picked spot
//! is made of.

use super::{Part, Solver};
use crate::methods::radiosity::{self, PickedLight, Points};
use crate::solution::Photon;
use crate::worker::workshop::{PhotonMethod, Workshop};
use crate::worker::{LightKind, Place, Spot, Subject};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// While light grows, equations are at least this far apart: faster than anyone reads.
const EQUATION_INTERVAL: Duration = Duration::from_millis(100);
/// And at least so many times as far as one takes, so that the light loses little to them.
const REST: u32 = 20;

/// The places that are picked in the world on show, and what there is to find out about them.
#[derive(Default)]
pub(super) struct Picks {
    /// x′
    point: Option<Place>,
    /// x″
    source: Option<Place>,
    /// Whether light, eye or places are newer than the equation that was published.
    is_outdated: bool,
    /// Until when light that grows goes first.
    rests_until: Option<Instant>,
}

impl Picks {
    /// Is told that something that the equation depends on has changed.
    pub(super) fn outdate(&mut self) {
        self.is_outdated = true;
    }

    /// Is told that a person has picked something: that is looked into at once.
    fn hurry(&mut self) {
        self.is_outdated = true;
        self.rests_until = None;
    }
}

impl<W: Workshop> Solver<W> {
    /// Wishes to know what the patch at a place sees, or forgets about all places.
    pub(super) fn pick(&mut self, place: Option<Place>) {
        match place {
            Some(place) if self.is_on_show(&place) => {
                self.picks.point = Some(place);
                self.picks.hurry();
            }
            Some(_) => {}
            None => {
                self.forget_picked();
                self.publish();
            }
        }
    }

    /// Wishes to know what a second place sends to the first one.
    pub(super) fn pick_source(&mut self, place: Place) {
        if self.is_on_show(&place) {
            self.picks.source = Some(place);
            self.picks.hurry();
        }
    }

    fn is_on_show(&self, place: &Place) -> bool {
        self.snapshot.world.as_ref().is_some_and(|world| Arc::ptr_eq(world, &place.world))
    }

    /// The picked patch, until it is known what it sees.
    pub(super) fn patch_to_look_from(&self) -> Option<u32> {
        let patch = self.picks.point.as_ref()?.patch;
        let is_known = self.snapshot.picked.as_ref().is_some_and(|picked| picked.patch == patch);
        (!is_known).then_some(patch)
    }

    /// Computes what a patch sees by the method of the settings; if interrupted, the wish stays.
    pub(super) fn look_from(&mut self, patch: u32) {
        self.at_work = Part::Picks;
        let Some(world) = self.snapshot.world.as_ref() else { return };
        if let Some(picked) = radiosity::pick(world, &self.snapshot.settings, patch, self.mailbox.step_cancel()) {
            self.snapshot.picked = Some(Arc::new(picked));
            self.picks.hurry();
            self.publish();
        }
    }

    /// Whether there is something new to be said of the picked point, in a view that shows it.
    pub(super) fn is_equation_due(&self) -> bool {
        let Picks { point, is_outdated, rests_until, .. } = &self.picks;
        let is_resting = rests_until.is_some_and(|until| self.clock.now() < until);
        let waits = is_resting && self.radiosity.going.is_running();
        point.is_some() && *is_outdated && !waits && self.subject() == Subject::Radiosity
    }

    /// Says where the light at the picked point comes from; if interrupted, that is still to be done.
    pub(super) fn look_into_equation(&mut self) {
        self.at_work = Part::Picks;
        let start = self.clock.now();
        let snapshot = &self.snapshot;
        let (Some(world), Some(solution), Some(picked)) = (&snapshot.world, &snapshot.solution, &snapshot.picked)
        else {
            self.picks.is_outdated = false;
            return;
        };
        let Some(place) = &self.picks.point else { return };
        let light = PickedLight::new(world, &snapshot.settings, solution, picked);
        let Some(balance) = light.balance(self.mailbox.step_cancel()) else { return };
        let eye = self.sight.map_or(world.viewpoint.eye.as_dvec3(), |sight| sight.camera.eye());
        let source = self.picks.source.as_ref().map(|source| (source.point, source.patch));
        let equation = light.equation(&Points { eye, point: place.point, source }, balance);
        self.snapshot.equation = Some(Arc::new(equation));
        self.picks.is_outdated = false;
        self.picks.rests_until = Some(self.clock.now() + EQUATION_INTERVAL.max(REST * self.clock.since(start)));
        self.publish();
    }

    /// Has what is picked looked at anew: it is seen by another method now, or gone with its world.
    pub(super) fn look_again(&mut self, is_same_world: bool) {
        self.snapshot.picked = None;
        self.snapshot.equation = None;
        if !is_same_world {
            self.picks = Picks::default();
        }
    }

    /// Forgets what was picked in the light on surfaces.
    pub(super) fn forget_picked(&mut self) {
        self.picks = Picks::default();
        self.snapshot.picked = None;
        self.snapshot.equation = None;
    }

    /// Traces one of the photons that were published last once more, or forgets about it.
    pub(super) fn pick_photon(&mut self, photon: Option<Photon>) {
        self.at_work = Part::Light(LightKind::Photons);
        let photons = self.snapshot.photons.as_ref().map(|solution| &solution.photons);
        let photon = photon.filter(|photon| photons.is_some_and(|photons| photons.contains(photon)));
        let run = self.photons.run.as_mut();
        self.snapshot.trail = photon.and_then(|photon| run?.method().trail(&photon)).map(Arc::new);
        self.publish();
    }

    /// Looks into the estimate at a spot from now on, or forgets about it.
    pub(super) fn gather(&mut self, spot: Option<Spot>) {
        self.at_work = Part::Light(LightKind::Photons);
        self.spot = spot;
        self.look_into_estimate();
        self.publish();
    }

    /// Looks into the estimate at the spot with the photons that are about to be published.
    pub(super) fn look_into_estimate(&mut self) {
        // Should it panic, it is not tried again.
        let spot = self.spot.take();
        let run = self.photons.run.as_mut();
        let gathered = spot.and_then(|spot| run?.method().gathered(spot.point.into(), spot.normal.into()));
        self.snapshot.gathered = gathered.map(Arc::new);
        self.spot = spot;
    }

    /// Forgets what was picked among photons that are gone.
    pub(super) fn forget_photons(&mut self) {
        self.spot = None;
        self.snapshot.trail = None;
        self.snapshot.gathered = None;
        self.snapshot.photons = None;
    }
}
