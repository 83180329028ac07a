//! Ambient occlusion at one point, ray by ray, so that it can be said how sure the mean is.

use super::{AmbientOcclusion, OcclusionSettings};
use crate::math::random::{hash, sobol2};
use crate::math::stats::Moments;
use crate::methods::transport::{Surface, Transport};
use std::sync::Arc;

/// Marks this use of (seed, index) among the others.
const PASS: u64 = 0x0070_6f69_6e74;

/// The shares of ambient light, in [0, 1], that single rays from each surface let through.
///
/// The standard error of their mean is that of independent rays, √(v / n) with the variance v of one ray; where rays are
/// free or not and nothing in between, v = a (1 − a) n / (n − 1) for the mean share a. The rays are those of a scrambled
/// (0, m, 2)-net in base 2, whose mean has at most twice this variance (Owen 1997), and as a rule far less.
pub fn shares(
    transport: &Arc<Transport>,
    settings: &OcclusionSettings,
    surfaces: &[Surface],
    seed: u64,
) -> Vec<Moments> {
    let one_ray = AmbientOcclusion::new(transport.clone(), &OcclusionSettings { rays: 1, ..*settings });
    let of_surface = |(index, surface): (usize, &Surface)| {
        let scrambling = hash(seed, PASS, index as u64) as u32;
        let mut shares = Moments::default();
        for ray in 0..settings.rays {
            shares.add(one_ray.visibility(surface, |_| sobol2(ray, 0, scrambling)).share.into());
        }
        shares
    };
    surfaces.iter().enumerate().map(of_surface).collect()
}
