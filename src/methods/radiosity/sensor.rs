//! Irradiance at a point in space, gathered from all patches.

use crate::math::polygon::form_factor;
use crate::math::random::{hash, sobol2};
use crate::math::rgb::{Rgb, Rgb64};
use crate::mesh::Patch;
use crate::solution::Solution;
use crate::tracer::SurfacePoint;
use crate::world::World;
use glam::{DVec3, Vec3A};
use rayon::prelude::*;

/// Visibility rays to each patch.
const RAYS: u32 = 32;
/// Marks this use of (seed, index) among the others.
const PASS: u64 = 0x7365_6e73_6f72;

/// Irradiance E, W/m², on a small surface with unit `normal` at a `point` that need not lie on any surface: the sum over
/// all patches of radiosity times form factor times visibility.
pub fn irradiance_in_space(world: &World, solution: &Solution, point: Vec3A, normal: Vec3A, seed: u64) -> Rgb {
    let from_patches: Vec<Rgb64> = world
        .mesh
        .patches
        .par_iter()
        .enumerate()
        .map(|(index, patch)| {
            let mut corners = [DVec3::ZERO; 4];
            let count = patch.corners().len();
            for (to, from) in corners.iter_mut().zip(patch.corners()) {
                *to = from.as_dvec3();
            }
            let form_factor = form_factor(point.as_dvec3(), normal.as_dvec3(), &corners[..count]);
            if form_factor <= 0.0 {
                return Rgb64::ZERO;
            }
            let seed = hash(seed, index as u64, PASS) as u32;
            world.mesh.patch_mean(patch, &solution.light.radiosity)
                * form_factor
                * visible_share(world, patch, point, normal, seed)
        })
        .collect();
    from_patches.iter().sum::<Rgb64>().as_vec3()
}

/// Share of the patch's points above the horizon that the sensor sees.
fn visible_share(world: &World, patch: &Patch, point: Vec3A, normal: Vec3A, seed: u32) -> f64 {
    let targets = patch.region().sampler();
    let from = SurfacePoint::in_space(point);
    let (mut above, mut visible) = (0, 0);
    for i in 0..RAYS {
        let to = targets.point(sobol2(i, 0, seed));
        if (to - point).dot(normal) > 0.0 {
            above += 1;
            visible += u32::from(world.tracer.is_unoccluded(from, patch.surface_point(to)));
        }
    }
    if above > 0 { f64::from(visible) / f64::from(above) } else { 0.0 }
}
