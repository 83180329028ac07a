//! What a click picks, by what the view shows.

use super::Explorer;
use crate::app::views::ViewGroup;
use crate::worker::{Command, Place, Spot};
use egui::Vec2;

impl Explorer {
    /// Picks what the view shows at a point.
    pub(super) fn pick_at(&self, at: Vec2) {
        match ViewGroup::of(self.look.view) {
            ViewGroup::Radiosity => self.worker.send(Command::Pick(self.pane.place_at(at))),
            ViewGroup::PhotonMap => {
                let photon = self.pane.photon_at(at, &self.look, self.snapshot.settings.image.filter);
                self.pick_photons(photon, self.pane.spot_at(at).filter(|_| photon.is_none()));
            }
            // What rays bring to a point is not kept.
            ViewGroup::Rays | ViewGroup::Occlusion | ViewGroup::Truth => {}
        }
    }

    /// Picks the point of the surface that the view shows there.
    pub(super) fn pick_point(&self, at: Vec2) {
        if ViewGroup::of(self.look.view) == ViewGroup::Radiosity {
            self.pick_source(self.pane.place_at(at));
        } else {
            self.pick_photons(None, self.pane.spot_at(at));
        }
    }

    pub(super) fn pick_source(&self, place: Option<Place>) {
        if let Some(place) = place {
            self.worker.send(Command::PickSource(place));
        }
    }

    pub(super) fn unpick(&self) {
        match ViewGroup::of(self.look.view) {
            ViewGroup::Radiosity => self.worker.send(Command::Pick(None)),
            ViewGroup::PhotonMap | ViewGroup::Rays | ViewGroup::Occlusion | ViewGroup::Truth => {
                self.pick_photons(None, None);
            }
        }
    }

    /// One of the two, or neither. The photon is an index among those on show.
    fn pick_photons(&self, photon: Option<u32>, spot: Option<Spot>) {
        let photons = self.snapshot.photons.as_ref().map(|solution| &solution.photons);
        let photon = photon.and_then(|index| photons?.get(index as usize).copied());
        self.worker.send(Command::PickPhoton(photon));
        self.worker.send(Command::Gather(spot));
    }
}
