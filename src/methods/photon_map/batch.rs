//! Photons traced together: where they landed, and their books.

use super::tally::Tally;
use super::trace::{Arrival, MapKind, Roulette, Shower, Witness};
use crate::cancel::{Cancel, Cancelled};
use crate::math::rgb::Rgb;
use crate::methods::transport::Emission;
use crate::solution::Photon;
use glam::Vec3A;
use rayon::prelude::*;
use std::ops::Range;

/// Photons that one thread traces at a time. The parts are merged in their order, so that sums do not depend on threads.
const PART: u64 = 512;

/// What some photons left behind.
#[derive(Default)]
pub struct Batch {
    pub photons: Vec<Photon>,
    /// Those that arrived at surfaces without a diffuse lobe. They send no light on from there, but are irradiance all the
    /// same.
    pub arrivals: Vec<Photon>,
    pub tally: Tally,
}

impl Batch {
    /// Traces photons of a shower on all cores. `keeps_caustics`: whether the global map takes landings that belong to
    /// caustics.
    ///
    /// # Errors
    /// If cancelled.
    pub fn trace(
        shower: &Shower,
        photons: Range<u64>,
        keeps_caustics: bool,
        cancel: &Cancel,
    ) -> Result<Vec<Self>, Cancelled> {
        let parts = (photons.end - photons.start).div_ceil(PART);
        let part = |part: u64| {
            let start = photons.start + part * PART;
            let mut batch = Self::default();
            for index in start..photons.end.min(start + PART) {
                if cancel.is_requested() {
                    return Err(Cancelled);
                }
                let mut record = Record { batch: &mut batch, kind: shower.kind, index: index as u32, keeps_caustics };
                shower.trace(index, &mut record);
            }
            Ok(batch)
        };
        (0..parts).into_par_iter().map(part).collect()
    }
}

/// Writes down what one photon does.
struct Record<'a> {
    batch: &'a mut Batch,
    kind: MapKind,
    index: u32,
    keeps_caustics: bool,
}

impl Record<'_> {
    fn store(&mut self, arrival: &Arrival) {
        let lands = arrival.diffuse != Rgb::ZERO;
        let photons = if lands { &mut self.batch.photons } else { &mut self.batch.arrivals };
        photons.push(Photon {
            position: arrival.surface.point.into(),
            flux: arrival.flux,
            direction: arrival.direction.into(),
            side: arrival.surface.side(),
            path: arrival.path,
            emission: self.index,
        });
    }
}

impl Witness for Record<'_> {
    fn emitted(&mut self, emission: &Emission) {
        match self.kind {
            MapKind::Global => self.batch.tally.emit(emission.flux),
            MapKind::Caustic => self.batch.tally.emit_caustic(),
        }
    }

    fn met(&mut self, arrival: &Arrival, roulette: &Roulette) {
        let lands = arrival.diffuse != Rgb::ZERO;
        let is_caustic = arrival.path.is_caustic();
        match self.kind {
            MapKind::Global => {
                let is_stored = self.keeps_caustics || !is_caustic;
                if lands {
                    self.batch.tally.land(arrival.path, is_stored);
                }
                if is_stored {
                    self.store(arrival);
                }
                self.batch.tally.scatter(arrival, roulette);
            }
            MapKind::Caustic => {
                if lands && is_caustic {
                    self.batch.tally.land_caustic();
                }
                if is_caustic {
                    self.store(arrival);
                }
                if roulette.scattering.is_some() {
                    self.batch.tally.trace_caustic();
                }
            }
        }
    }

    fn escaped(&mut self, flux: Rgb, _direction: Vec3A) {
        if self.kind == MapKind::Global {
            self.batch.tally.escape(flux);
        }
    }

    fn truncated(&mut self, flux: Rgb) {
        if self.kind == MapKind::Global {
            self.batch.tally.truncate(flux);
        }
    }
}
