//! Random numbers that depend on (seed, pass, index) alone, so that a result is the same on any number of threads.

use glam::{Vec2, Vec4};

/// SplitMix64 (Steele, Lea, Flood 2014): a counter whose successive states are scrambled to 64 random bits.
#[derive(Clone, Debug)]
pub struct Stream(u64);

impl Stream {
    /// The stream of item `index` in pass `pass` of the run with this `seed`. Streams of different items do not overlap
    /// in practice: their starting points are spread over 2^64 by [`hash`].
    pub fn new(seed: u64, pass: u64, index: u64) -> Self {
        Self(hash(seed, pass, index))
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(GOLDEN);
        scramble(self.0)
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f32 {
        unit_f32(self.bits())
    }

    /// Uniform in [0, 1)².
    pub fn uniform2(&mut self) -> Vec2 {
        let bits = self.bits();
        Vec2::new(unit_f32(bits), unit_f32(bits << 32))
    }
}

/// 64 bits that depend on all bits of the three numbers.
pub fn hash(seed: u64, pass: u64, index: u64) -> u64 {
    let mut state = scramble(seed.wrapping_add(GOLDEN));
    state = scramble(state ^ pass.wrapping_mul(GOLDEN));
    scramble(state ^ index.wrapping_mul(GOLDEN))
}

/// A point of [0, 1)⁴ made of 16 bits each: enough to shift a pattern of points.
pub fn unit_vec4(bits: u64) -> Vec4 {
    let part = |i: u64| (bits >> (16 * i) & 0xffff) as f32 * (1.0 / 65536.0);
    Vec4::new(part(0), part(1), part(2), part(3))
}

/// Point `index` of an Owen-scrambled Sobol sequence (Burley 2020) in dimensions `2 pair` and `2 pair + 1`, in [0, 1)².
/// Sequences of different seeds are independent; any power-of-two run of one sequence is stratified.
pub fn sobol2(index: u32, pair: u32, seed: u32) -> Vec2 {
    // Four at once take less time than two one by one.
    let [x, y, z, w] = sobol_burley::sample_4d(index, pair / 2, seed);
    if pair.is_multiple_of(2) { Vec2::new(x, y) } else { Vec2::new(z, w) }
}

/// The point of one sample in as many dimensions as a path needs, four at a time: each four are those of a Sobol sequence
/// with a scrambling of its own (padding; Burley 2020). Samples of one seed together are low-discrepancy in each four.
#[derive(Clone, Copy, Debug)]
pub struct PaddedPoint {
    seed: u64,
    index: u64,
}

impl PaddedPoint {
    /// Points of one sequence; the next ones belong to another.
    const SEQUENCE: u64 = 1 << 16;

    /// Of sample `index`.
    pub fn new(seed: u64, index: u64) -> Self {
        Self { seed: hash(seed, index / Self::SEQUENCE, 0), index: index % Self::SEQUENCE }
    }

    /// The coordinates in dimensions `4 set` to `4 set + 3`, in [0, 1)⁴.
    pub fn four(&self, set: u64) -> [f32; 4] {
        // Number `set` of a stream: see [`Stream::bits`].
        let seed = scramble(self.seed.wrapping_add((set + 1).wrapping_mul(GOLDEN)));
        sobol_burley::sample_4d(self.index as u32, 0, seed as u32)
    }
}

/// 2^64 divided by the golden ratio, made odd.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// The finaliser of SplitMix64 (Stafford 2011, variant 13).
fn scramble(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// The top 24 bits as a number in [0, 1): all that an f32 holds.
fn unit_f32(bits: u64) -> f32 {
    (bits >> 40) as f32 * (1.0 / (1 << 24) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::stats::Moments;

    #[test]
    fn a_stream_depends_on_each_of_its_three_numbers() {
        let first = Stream::new(1, 2, 3).bits();
        assert_eq!(first, Stream::new(1, 2, 3).bits());
        for other in [Stream::new(2, 2, 3), Stream::new(1, 3, 3), Stream::new(1, 2, 4)] {
            assert_ne!(first, other.clone().bits());
        }
    }

    #[test]
    fn neighbouring_streams_are_uniform_together() {
        // The first number of each of n streams: their mean has a standard deviation of 1/√(12 n); 4 of them are allowed.
        let n = 1 << 16;
        let mean = (0..n).map(|i| f64::from(Stream::new(7, 0, i).uniform())).sum::<f64>() / n as f64;
        assert!((mean - 0.5).abs() < 4.0 / (12.0 * n as f64).sqrt(), "mean {mean}");
    }

    #[test]
    fn padded_points_fill_strata_in_each_four_and_are_independent_between_them() {
        let (mut within, mut between) = ([0; 64], Moments::default());
        for i in 0..64 {
            let point = PaddedPoint::new(3, i);
            let [x, y, ..] = point.four(0);
            within[(y * 8.0) as usize * 8 + (x * 8.0) as usize] += 1;
        }
        assert_eq!(within, [1; 64]);
        // The products of independent coordinates of 1,000 seeds: mean 1/4, variance 1/9 − 1/16.
        for seed in 0..1000 {
            let point = PaddedPoint::new(seed, 5);
            between.add(f64::from(point.four(0)[0] * point.four(1)[0]));
        }
        assert!((between.mean() - 0.25).abs() < 4.0 * ((1.0 / 9.0 - 1.0 / 16.0) / 1000.0_f64).sqrt(), "{between:?}");
    }

    #[test]
    fn a_power_of_two_of_sobol_points_fills_every_stratum_once() {
        let mut cells = [0; 64];
        for i in 0..64 {
            let point = sobol2(i, 0, 5) * 8.0;
            cells[point.y as usize * 8 + point.x as usize] += 1;
        }
        assert_eq!(cells, [1; 64]);
    }
}
