//! How much of a shooter's flux leaves the scene, by rays.

use crate::math::random::{hash, sobol2};
use crate::math::warp::{cosine_hemisphere, frame};
use crate::mesh::Patch;
use crate::tracer::Ray;
use crate::world::World;
use glam::{Vec2, Vec3A};
use rayon::prelude::*;

/// Rays of one shot. They are stratified: the shares are good to about half a percent.
pub const ESCAPE_RAYS: u32 = 1024;
/// Marks this use of (seed, step) among the others.
const PASS: u64 = 0x65_7363_6170_65;

/// Shares of a shooter's cosine-distributed rays, each in [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outlook {
    /// Meet nothing.
    pub escaped: f64,
    /// Meet a side that light cannot reach. They start where something stands on the patch and hides it.
    pub hidden: f64,
}

/// Looks out from a patch with [`ESCAPE_RAYS`] rays.
pub fn look_out(world: &World, patch: &Patch, seed: u64, step: u64) -> Outlook {
    let seed = hash(seed, step, PASS) as u32;
    let count = |i: u32| {
        let origin = world.tracer.lift(point(patch, sobol2(i, 0, seed)), patch.normal);
        let direction = frame(patch.normal) * cosine_hemisphere(sobol2(i, 1, seed));
        match world.tracer.closest(&Ray { origin, direction }) {
            None => [1, 0],
            Some(hit) if world.mesh.side(hit.polygon, hit.is_front).is_none() => [0, 1],
            Some(_) => [0, 0],
        }
    };
    let [escaped, hidden] =
        (0..ESCAPE_RAYS).into_par_iter().map(count).reduce(|| [0_u32; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
    let share = |rays: u32| f64::from(rays) / f64::from(ESCAPE_RAYS);
    Outlook { escaped: share(escaped), hidden: share(hidden) }
}

fn point(patch: &Patch, at: Vec2) -> Vec3A {
    let corners = patch.corners();
    let corner = |i: usize| Vec3A::from(corners[i]);
    if corners.len() == 3 {
        let weights = crate::math::warp::triangle(at);
        corner(0) + weights.x * (corner(1) - corner(0)) + weights.y * (corner(2) - corner(0))
    } else {
        corner(0).lerp(corner(1), at.x).lerp(corner(3).lerp(corner(2), at.x), at.y)
    }
}
