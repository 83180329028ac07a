//! What photon mapping hands out: photons where they landed, and the books of their flux.

use super::Path;
use crate::math::rgb::{Rgb, Rgb64};
use glam::Vec3;
use std::sync::Arc;
use std::time::Duration;

/// A photon that landed on a diffuse surface.
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
    /// The photons of the present pass, those of the caustic map included.
    pub photons: Arc<Vec<Photon>>,
    /// Largest radius within which photons are looked for in the present pass, m.
    pub max_radius: f32,
    /// Of all photons of the global map.
    pub energy: PhotonEnergy,
    pub counters: PhotonCounters,
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
    /// Landings on diffuse surfaces of global photons after 0, 1, 2 … surfaces.
    pub by_bounce: Vec<u64>,
    /// The same by path, as in `LSD`, in the order of their names; what is longer than a few letters is taken together.
    pub by_path: Vec<(String, u64)>,
}
