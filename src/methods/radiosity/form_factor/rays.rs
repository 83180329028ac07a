//! Form factors counted by rays: each carries the same part of the shooter's flux to where it lands.

use super::{Outcome, Shot, clamped};
use crate::math::random::{hash, sobol2};
use crate::math::warp::{cosine_hemisphere, frame};
use crate::solution::Counters;
use crate::tracer::Ray;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering};

/// The weakest shot still gets this many rays.
const MIN_RAYS: f64 = 64.0;
/// No more than this many times the rays for a shooter that is almost covered.
const LEAST_EXPOSED: f64 = 1.0 / 64.0;
/// Rays of one stratified set. A sequence of Sobol points is good for 2^16; a longer shot takes several.
const BATCH: u64 = 1 << 12;
/// Marks this use of (seed, pass) among the others.
const PASS: u64 = 0x006c_6967_6874;

/// Hits of the rays of one shot, an entry for each element. They are whole numbers, so the order of counting leaves no
/// trace.
#[derive(Default)]
pub struct LightRays {
    hits: Vec<AtomicU32>,
}

impl LightRays {
    /// Sends the shooter's part of `rays`, those of all the emitted flux, and turns hits into form factors: of n rays, k
    /// that land on element e are F_se = k/n, and F_es = F_se A_s / A_e. The sum of a row is 1 less what escapes by
    /// construction. Rays that start where something covers the shooter do not count.
    pub fn shoot(&mut self, shot: &Shot, rays: u32, form_factors: &mut [f64]) -> Outcome {
        let mesh = &shot.world.mesh;
        self.hits.resize_with(mesh.elements.len(), AtomicU32::default);
        // Where something stands on the shooter, only rays that start beside it count: then there are more, so that no ray
        // carries more than others do.
        let elements = shot.shooter().elements.start as usize..shot.shooter().elements.end as usize;
        let exposed = mesh.elements[elements].iter().map(|element| f64::from(element.exposed)).sum::<f64>()
            / shot.shooter().elements.len() as f64;
        let wanted = (f64::from(rays) * shot.flux_share).max(MIN_RAYS);
        let count = ((wanted / exposed.max(LEAST_EXPOSED)).ceil() as u64).min(u64::from(u32::MAX));
        let batch = |batch: u64| self.shoot_batch(shot, batch, BATCH.min(count - batch * BATCH));
        let none = || Ends { escaped: 0, landed: 0 };
        let Ends { escaped, landed } = (0..count.div_ceil(BATCH)).into_par_iter().map(batch).reduce(none, Ends::and);
        let counted = (escaped + landed).max(1) as f64;
        let shooter_area = shot.shooter().area;
        let mut counters = Counters { rays: count, light_rays: count, ..Counters::default() };
        for ((hits, element), form_factor) in self.hits.iter_mut().zip(&mesh.elements).zip(form_factors) {
            let hits = std::mem::take(hits.get_mut());
            *form_factor = 0.0;
            if hits > 0 && element.area > 0.0 {
                let (bounded, is_cut) = clamped(f64::from(hits) / counted * shooter_area / element.area);
                *form_factor = bounded;
                counters.form_factors += 1;
                counters.clamped += u64::from(is_cut);
            }
        }
        Outcome { escaping: escaped as f64 / counted, counters }
    }

    fn shoot_batch(&self, shot: &Shot, batch: u64, count: u64) -> Ends {
        let (world, shooter) = (shot.world, shot.shooter());
        let mut ends = Ends { escaped: 0, landed: 0 };
        if shot.cancel.is_requested() {
            return ends;
        }
        let seed = hash(shot.seed ^ PASS, shot.pass, batch) as u32;
        let origins = shooter.region().sampler();
        let frame = frame(shooter.normal);
        for i in 0..count as u32 {
            let from = shooter.surface_point(origins.point(sobol2(i, 0, seed)));
            let direction = frame * cosine_hemisphere(sobol2(i, 1, seed));
            let Some(hit) = world.tracer.closest(&Ray::leaving(from, direction)) else {
                ends.escaped += 1;
                continue;
            };
            if let Some(location) = world.mesh.locate(hit.polygon, hit.is_front, hit.point) {
                self.hits[location.element as usize].fetch_add(1, Ordering::Relaxed);
                ends.landed += 1;
            }
        }
        ends
    }
}

/// Where rays ended.
struct Ends {
    escaped: u64,
    landed: u64,
}

impl Ends {
    fn and(self, other: Self) -> Self {
        Self { escaped: self.escaped + other.escaped, landed: self.landed + other.landed }
    }
}
