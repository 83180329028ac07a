//! What photon mapping hands out: photons where they landed, and the books of their flux.

use super::{Path, Scattering};
use crate::effects::Bill;
use crate::math::rgb::{Rgb, Rgb64, total};
use glam::Vec3;
use std::sync::Arc;
use std::time::Duration;

/// A photon where it landed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photon {
    /// Where it landed, m.
    pub position: Vec3,
    /// Φ, W.
    pub flux: Rgb,
    /// Unit direction in which it flew.
    pub direction: Vec3,
    /// The side on which it landed, as in [`crate::mesh::Mesh::sides`].
    pub side: u32,
    /// The surfaces that it met before it landed here.
    pub path: Path,
    /// Which photon of its pass and map it is, counted as they left the emitters: its whole way can be traced again.
    pub emission: u32,
}

/// A plane that divides a cell of the tree in which photons are looked up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Split {
    /// Of the cell; the whole map is at 0.
    pub depth: u8,
    /// 0, 1 or 2 for x, y or z.
    pub axis: u8,
    /// Where the plane is on that axis, m.
    pub at: f32,
    /// The cell that it divides, m.
    pub min: Vec3,
    pub max: Vec3,
}

/// The way of one photon, from the emitter on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PhotonTrail {
    pub places: Vec<TrailPlace>,
    /// Where it flew into the void, if it did: a unit direction.
    pub escape: Option<Vec3>,
}

/// A place of a photon's way, and the roulette that was played there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrailPlace {
    pub point: Vec3,
    /// With which it arrived, or left the emitter, W.
    pub flux: Rgb,
    /// Chance that it goes on, in [0, 1]; 1 at the emitter.
    pub survival: f32,
    /// How it went on; `None` where it was absorbed.
    pub scattering: Option<Scattering>,
}

/// What the estimate of irradiance at one point is made of.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gathered {
    pub point: Vec3,
    /// Unit normal on the side that was looked at.
    pub normal: Vec3,
    /// E, W/m².
    pub irradiance: Rgb,
    /// Radius of the disc, m.
    pub radius: f32,
    /// Share of the disc that is surface on which photons can land, in (0, 1].
    pub inside: f32,
    /// Relative standard error of the estimate.
    pub relative_error: f32,
    /// How many photons count.
    pub photons: u32,
    /// Indices of those of them that are handed out: on surfaces without a diffuse lobe photons count, but are not shown.
    pub used: Vec<u32>,
    /// Indices of photons as near that do not belong: on a side turned away, off the plane, behind a wall, round a corner.
    pub rejected: Vec<u32>,
}

/// A finished copy of what photon mapping knows at one moment.
#[derive(Clone, Debug, Default)]
pub struct PhotonSolution {
    /// Batches of photons emitted so far, of those that the present pass is made of.
    pub batches: u64,
    /// Passes that are done: each has photons of its own and, if progressive, a smaller radius than the one before.
    pub passes: u64,
    /// Time spent on photons, filled in by whoever runs the method.
    pub elapsed: Duration,
    /// Whether all photons of the present pass are there.
    pub is_complete: bool,
    /// The photons of the present pass on diffuse surfaces, those of the caustic map included. While they are still coming, the last few may be
    /// missing that the counters know of already; those that are there keep their places.
    pub photons: Arc<Vec<Photon>>,
    /// How the tree divides them, from the root down to a depth that can still be drawn.
    pub splits: Arc<Vec<Split>>,
    /// Largest radius within which photons are looked for in the present pass, m.
    pub max_radius: f32,
    /// Of all photons of the global map.
    pub energy: PhotonEnergy,
    pub counters: PhotonCounters,
}

impl PhotonSolution {
    /// The share of the emitted flux that may be truncated without a word: the relative standard error of the flux of a
    /// million photons. More would be an error that more photons do not mend.
    const TOLERATED_TRUNCATION: f64 = 1e-3;

    /// What must be known of the light although all photons are there, if anything: what happened, why, and what to do.
    pub fn warning(&self) -> Option<String> {
        let emitted = total(self.energy.emitted);
        let share = total(self.energy.truncated) / emitted;
        (emitted > 0.0 && share > Self::TOLERATED_TRUNCATION).then(|| {
            format!(
                "{:.1} % of the emitted flux is truncated and missing in this light: surfaces reflect so much that these \
                 photons reached the largest number of bounces; radiosity has no such bound",
                100.0 * share
            )
        })
    }
}

/// Where the flux of the photons is, W per channel, in double precision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PhotonEnergy {
    pub emitted: Rgb64,
    pub absorbed: Rgb64,
    pub escaped: Rgb64,
    /// Given up after the largest number of bounces.
    pub truncated: Rgb64,
}

impl PhotonEnergy {
    /// What the ledger lost or made up: rounding, or a bug.
    pub fn defect(&self) -> Rgb64 {
        self.emitted - self.absorbed - self.escaped - self.truncated
    }
}

/// What became of photons, as counts. `stored` counts landings, so one photon may be stored several times.
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct PhotonCounters {
    /// Photons of the global map that left an emitter.
    pub emitted: u64,
    /// Photons of the caustic map that left an emitter.
    pub caustic_emitted: u64,
    /// Landings on diffuse surfaces that were kept in the global map.
    pub stored: u64,
    /// Landings that were kept in the caustic map.
    pub caustic_stored: u64,
    pub absorbed: u64,
    pub escaped: u64,
    pub truncated: u64,
    pub rays: u64,
    /// Of the rays, those for one effect; and those that skipping effects saved.
    #[serde(skip)]
    pub bill: Bill,
    /// Landings on diffuse surfaces of global photons after 0, 1, 2 … surfaces.
    pub by_bounce: Vec<u64>,
    /// The same by path, as in `LSD`, in the order of their names; what is longer than a few letters is taken together.
    pub by_path: Vec<(String, u64)>,
}
