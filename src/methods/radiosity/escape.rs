//! How much of a shooter's flux leaves the scene, by rays.

use crate::math::random::{hash, sobol2};
use crate::math::warp::{cosine_hemisphere, frame};
use crate::mesh::Patch;
use crate::tracer::Ray;
use crate::world::World;
use rayon::prelude::*;

/// Rays of one shot. They are stratified: the shares are good to about half a percent.
pub const ESCAPE_RAYS: u32 = 1024;
/// Marks this use of (seed, step) among the others.
const PASS: u64 = 0x6573_6361_7065;

/// The share of the cosine-distributed rays from a patch that meet nothing, of [`ESCAPE_RAYS`], in [0, 1]. Rays that
/// meet a side which light cannot reach start where something stands on the patch and covers it: they do not count.
pub fn escaping_share(world: &World, patch: &Patch, seed: u64, step: u64) -> f64 {
    let seed = hash(seed, step, PASS) as u32;
    let origins = patch.region().sampler(world.tracer.offset() * patch.normal);
    let count = |i: u32| {
        let origin = origins.point(sobol2(i, 0, seed));
        let direction = frame(patch.normal) * cosine_hemisphere(sobol2(i, 1, seed));
        match world.tracer.closest(&Ray { origin, direction }) {
            None => [1, 1],
            Some(hit) => [0, u32::from(world.mesh.side(hit.polygon, hit.is_front).is_some())],
        }
    };
    let [escaped, counted] =
        (0..ESCAPE_RAYS).into_par_iter().map(count).reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    f64::from(escaped) / f64::from(counted.max(1))
}
