//! How much of a shooter's flux leaves the scene, by rays.

use super::Shot;
use crate::math::random::{hash, sobol2};
use crate::math::warp::{cosine_hemisphere, frame};
use crate::tracer::Ray;
use rayon::prelude::*;

/// Rays of one shot. They are stratified: the shares are good to about half a percent.
pub const RAYS: u32 = 1024;
/// Marks this use of (seed, pass) among the others.
const PASS: u64 = 0x6573_6361_7065;

/// The share of the cosine-distributed rays from the shooter that meet nothing, in [0, 1]. Those that meet a side which
/// light cannot reach start where something stands on the patch and covers it: they do not count.
pub fn share(shot: &Shot) -> f64 {
    let (world, shooter) = (shot.world, shot.shooter());
    let seed = hash(shot.seed, shot.pass, PASS) as u32;
    let origins = shooter.region().sampler();
    let count = |i: u32| {
        let from = shooter.surface_point(origins.point(sobol2(i, 0, seed)));
        let direction = frame(shooter.normal) * cosine_hemisphere(sobol2(i, 1, seed));
        match world.tracer.closest(&Ray::leaving(from, direction)) {
            None => [1, 1],
            Some(hit) => [0, u32::from(world.mesh.side(hit.polygon, hit.is_front).is_some())],
        }
    };
    let [escaped, counted] = (0..RAYS).into_par_iter().map(count).reduce(|| [0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    f64::from(escaped) / f64::from(counted.max(1))
}
