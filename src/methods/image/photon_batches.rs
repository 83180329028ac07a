//! How far off a value is for the noise of the photons that it is read off.
//!
//! All samples of a point are read off the same photons, so that the spread between samples says nothing of their noise. It is
//! told by batch means (Conway 1963): the photons of a map are divided into batches by the order in which they were emitted, each
//! of which makes an estimate of its own, and the spread of these is that of one of them. All landings of a photon are in one
//! batch, so that what they have in common is counted. What a density estimate is made of needs no batches: its photons hardly
//! ever belong to one emission, and the sum of their squares is its variance (Jensen 2001: 1/√k of k photons).

use crate::math::rgb::{Rgb, Rgb64};
use crate::math::stats::Moments;

/// Batches of a map. Of so many estimates the standard error is known to 18 %.
pub const BATCHES: usize = 16;

/// Of each channel, one number for each batch: in this order the sums are of vectors.
pub type ByBatch = [[f32; BATCHES]; 3];

/// What the batches of photons say of one sample of a value.
#[derive(Clone, Debug, Default)]
pub struct PhotonBatches {
    /// The parts of the value that the photons of each batch make up.
    parts: ByBatch,
    /// Variance of the density estimates in it.
    variance: Rgb,
}

impl PhotonBatches {
    /// Takes in light that is `weight` times the sum over batches.
    pub fn add(&mut self, weight: Rgb, light: &ByBatch) {
        for ((parts, light), weight) in self.parts.iter_mut().zip(light).zip(weight.to_array()) {
            for (part, light) in parts.iter_mut().zip(light) {
                *part += weight * light;
            }
        }
    }

    /// Takes in light that is `weight` times a density estimate with this variance, by channel.
    pub fn add_density(&mut self, weight: Rgb, variance: Rgb) {
        self.variance += weight * weight * variance;
    }
}

/// The noise of photons in the mean over samples of one value.
#[derive(Clone, Debug, Default)]
pub struct PhotonNoise {
    parts: [[f64; BATCHES]; 3],
    variance: Rgb64,
    samples: u32,
}

impl PhotonNoise {
    /// Takes in one more sample, which was read off the same photons as those before.
    pub fn add(&mut self, sample: &PhotonBatches) {
        for (sum, part) in self.parts.iter_mut().flatten().zip(sample.parts.iter().flatten()) {
            *sum += f64::from(*part);
        }
        self.variance += sample.variance.as_dvec3();
        self.samples += 1;
    }

    /// Variance of the mean over all samples, by channel, as far as it comes from photons.
    pub fn variance(&self) -> Rgb64 {
        let samples = f64::from(self.samples.max(1));
        let of_channel = |channel: usize| {
            let mut estimates = Moments::default();
            for part in self.parts[channel] {
                estimates.add(BATCHES as f64 * part / samples);
            }
            estimates.standard_error().powi(2)
        };
        Rgb64::from_array([0, 1, 2].map(of_channel)) + self.variance / samples
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variances_are_those_of_batch_means_and_of_densities_that_all_samples_share() {
        let mut batches = PhotonBatches::default();
        let light = [std::array::from_fn(|batch| batch as f32), [1.0; BATCHES], [0.0; BATCHES]];
        batches.add(Rgb::splat(2.0), &light);
        batches.add_density(Rgb::splat(0.5), Rgb::new(0.0, 4.0, 0.0));
        let mut noise = PhotonNoise::default();
        (0..3).for_each(|_| noise.add(&batches));
        // Of 0 … 15 the variance is 16 · 17 / 12, of estimates that are 2 · 16 times as large, 16 of them.
        let red = 16.0 * 17.0 / 12.0 * (2.0_f64 * 16.0).powi(2) / 16.0;
        let variance = noise.variance();
        assert!((variance.x / red - 1.0).abs() < 1e-12, "{variance}");
        assert_eq!((variance.y, variance.z), (1.0, 0.0));
    }
}
