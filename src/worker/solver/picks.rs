//! What a picked patch sees, the way of a picked photon, and what an estimate at a picked spot is made of.

use super::{Part, Solver};
use crate::methods::radiosity;
use crate::solution::Photon;
use crate::worker::workshop::{PhotonMethod, Workshop};
use crate::worker::{LightKind, Place, Spot};
use std::sync::Arc;

impl<W: Workshop> Solver<W> {
    /// Wishes to look from a patch, or forgets about it.
    pub(super) fn pick(&mut self, place: Option<Place>) {
        let is_on_show =
            |place: &Place| self.snapshot.world.as_ref().is_some_and(|world| Arc::ptr_eq(world, &place.world));
        match place {
            Some(place) if is_on_show(&place) => self.wish = Some(place.patch),
            Some(_) => {}
            None => {
                self.wish = None;
                self.snapshot.picked = None;
                self.publish();
            }
        }
    }

    /// Computes what a patch sees by the method of the settings; if interrupted, the wish stays.
    pub(super) fn look_from(&mut self, patch: u32) {
        let Some(world) = self.snapshot.world.as_ref() else { return };
        // Should it panic, it is not tried again.
        self.wish = None;
        match radiosity::pick(world, &self.snapshot.settings, patch, self.mailbox.step_cancel()) {
            Some(picked) => {
                self.snapshot.picked = Some(Arc::new(picked));
                self.publish();
            }
            None => self.wish = Some(patch),
        }
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
