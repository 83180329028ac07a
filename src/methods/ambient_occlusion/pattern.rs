//! Directions for very many questions: made once, and turned for each.

use crate::math::random::{hash, sobol2};
use crate::math::warp::cosine_hemisphere;
use glam::{Mat3A, Vec3A};
use rayon::prelude::*;
use std::f32::consts::TAU;

/// A pattern has at least so many directions, if a question does not take more: as many as stay in the cache.
const DIRECTIONS: u32 = 1 << 14;
/// Marks this use of (seed, pass) among the others.
const PASS: u64 = 0x7061_7474_6572;

/// A low-discrepancy sequence of directions with the density cos θ / π about z, cut into blocks, one for each question.
///
/// Who asks again gets further blocks of the sequence, which together are as well spread as one of them, until there are no
/// more: then it begins anew, turned about z by another angle. So all that is known of the slope of directions is in the
/// pattern, and what is missing of it, in the mean over all of its directions, is about one part in their number.
pub struct Pattern {
    directions: Vec<Vec3A>,
    /// Of a block.
    rays: usize,
    /// A power of two.
    blocks: u64,
    seed: u64,
}

impl Pattern {
    /// A pattern for questions of so many rays.
    pub fn new(rays: u32, seed: u64) -> Self {
        let rays = rays.max(1);
        let blocks = DIRECTIONS.div_ceil(rays).next_power_of_two();
        let scramble = hash(seed, PASS, 0) as u32;
        let direction = |i: u32| cosine_hemisphere(sobol2(i, 0, scramble));
        let mut directions: Vec<Vec3A> = (0..blocks * rays).into_par_iter().map(direction).collect();
        // Rays that follow one another should go the same way through the scene.
        let azimuth = |direction: &Vec3A| direction.y.atan2(direction.x);
        directions.par_chunks_mut(rays as usize).for_each(|block| {
            block.sort_by(|a, b| azimuth(a).total_cmp(&azimuth(b)));
        });
        Self { directions, rays: rays as usize, blocks: blocks.into(), seed }
    }

    /// The directions for question number `time` of `asker`, and how they are to be turned before they are used. Those for the
    /// first 2, 4, 8 … questions of an asker are next to each other in the sequence.
    pub fn block(&self, asker: u64, time: u64) -> (&[Vec3A], Mat3A) {
        let block = ((asker ^ time) % self.blocks) as usize * self.rays;
        let turn = hash(self.seed ^ asker, PASS, 1 + time / self.blocks);
        let angle = (turn >> 40) as f32 * (TAU / (1 << 24) as f32);
        (&self.directions[block..block + self.rays], Mat3A::from_rotation_z(angle))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_asker_gets_every_direction_once_before_it_gets_one_again() {
        for rays in [1, 3, 64, 1000, DIRECTIONS + 1] {
            let pattern = Pattern::new(rays, 7);
            let mut seen: Vec<_> =
                (0..pattern.blocks).map(|time| pattern.block(0x1234_5678_9abc, time).0.as_ptr() as usize).collect();
            seen.sort_unstable();
            seen.dedup();
            assert_eq!(seen.len() as u64, pattern.blocks, "{rays}");
            assert!(pattern.directions.len() >= DIRECTIONS as usize, "{rays}");
        }
    }

    #[test]
    fn a_block_is_turned_alike_until_the_pattern_begins_anew() {
        let pattern = Pattern::new(64, 3);
        let turn = |time| pattern.block(99, time).1;
        assert_eq!(turn(0), turn(pattern.blocks - 1));
        assert_ne!(turn(0), turn(pattern.blocks));
        assert_ne!(turn(0), pattern.block(98, 0).1);
    }

    #[test]
    fn directions_have_the_density_of_the_cosine() {
        // ∫ cos θ · cos θ / π dω = 2/3 and ∫ cos² θ · cos θ / π dω = 1/2; a net of n points is wrong by some (log n)/n.
        let pattern = Pattern::new(64, 11);
        let n = pattern.directions.len() as f64;
        let mean = |of: fn(f64) -> f64| pattern.directions.iter().map(|d| of(f64::from(d.z))).sum::<f64>() / n;
        assert!((mean(|z| z) - 2.0 / 3.0).abs() < 1e-3 && (mean(|z| z * z) - 0.5).abs() < 1e-3);
        let slant = pattern.directions.iter().copied().sum::<Vec3A>() / n as f32;
        assert!(slant.truncate().length() < 1e-3, "{slant}");
    }
}
