//! The way of one photon, traced again to be looked at.

use super::trace::{Arrival, MapKind, Roulette, Shower, Witness};
use crate::math::rgb::Rgb;
use crate::methods::Settings;
use crate::methods::transport::{Emission, Transport};
use crate::solution::{PhotonTrail, Scattering, TrailPlace};
use glam::Vec3A;

/// Traces a photon again: the one with this `emission` of a pass (counted from 0), of the caustic map or else of the global
/// one. Its roulette falls as it did then.
pub fn trail(transport: &Transport, settings: &Settings, pass: u64, emission: u32, is_caustic: bool) -> PhotonTrail {
    let shower = Shower::new(transport, settings, pass, if is_caustic { MapKind::Caustic } else { MapKind::Global });
    let mut trail = PhotonTrail::default();
    shower.trace(u64::from(emission), &mut trail);
    trail
}

impl Witness for PhotonTrail {
    fn emitted(&mut self, emission: &Emission) {
        let point = emission.ray.origin.into();
        // An emitter is no surface that scatters, but the photon goes on from it: evenly, as from a diffuse one.
        let scattering = Some(Scattering::Diffuse);
        self.places.push(TrailPlace { point, flux: emission.flux, survival: 1.0, scattering });
    }

    fn met(&mut self, arrival: &Arrival, roulette: &Roulette) {
        self.places.push(TrailPlace {
            point: arrival.surface.point.into(),
            flux: arrival.flux,
            survival: roulette.survival,
            scattering: roulette.scattering,
        });
    }

    fn escaped(&mut self, _flux: Rgb, direction: Vec3A) {
        self.escape = Some(direction.into());
    }

    fn truncated(&mut self, _flux: Rgb) {}
}
