//! One measure of error for every method.

use crate::math::rgb::Rgb;
use crate::math::stats::Moments;

/// How far irradiance, or the radiance of pixels, is from the truth, as a share of the mean of the truth.
///
/// The error is the root of the mean of (E − E_ref)² over points that are spread by area and over channels. The reference's own
/// noise, which is part of what is seen, is taken out of it; `floor` says how much that was, and below it little can be told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Error {
    pub rms: f64,
    /// Standard error of `rms`, by what is known of the noise of the reference. Of a method's own noise it says nothing.
    pub uncertainty: f64,
    /// The error of the reference itself.
    pub floor: f64,
    /// The part of `rms` that is noise of the method, where it tells how far its numbers scatter.
    pub noise: Option<f64>,
}

impl Error {
    /// Of what was `found` at points, or in pixels, where independent estimates of the truth are known; `None` where there are
    /// no points, or no light.
    pub fn of(found: &[Rgb], truth: &[[Moments; 3]]) -> Option<Self> {
        let (mut squares, mut noise, mut variance, mut sum) = (0.0, 0.0, 0.0, 0.0);
        for (found, truth) in found.iter().zip(truth) {
            let mut spread = 0.0;
            for (found, truth) in found.as_dvec3().to_array().into_iter().zip(truth) {
                let (square, own) = ((found - truth.mean()).powi(2), truth.standard_error().powi(2));
                squares += square;
                noise += own;
                sum += truth.mean();
                // The square of a known difference and a normal one has the variance 4 d² v + 2 v². Channels of a point, which
                // come along the same paths, may all be off to the same side.
                spread += (4.0 * (square - own).max(0.0) * own + 2.0 * own * own).sqrt();
            }
            variance += spread * spread;
        }
        let count = 3.0 * found.len().min(truth.len()) as f64;
        let mean = sum / count;
        if count == 0.0 || mean <= 0.0 {
            return None;
        }
        let (square, deviation) = ((squares - noise) / count, variance.sqrt() / count);
        let root = |square: f64| square.max(0.0).sqrt();
        let rms = root(square);
        let uncertainty = (root(square + deviation) - rms).max(rms - root(square - deviation));
        Some(Self { rms: rms / mean, uncertainty: uncertainty / mean, floor: root(noise / count) / mean, noise: None })
    }

    /// The same where a method says how far its numbers scatter: `variance` is the mean of their squared standard errors over
    /// points and channels, (W/m²)², and `mean` that of the truth, W/m².
    #[must_use]
    pub fn with_noise(self, variance: f64, mean: f64) -> Self {
        Self { noise: Some(variance.sqrt() / mean), ..self }
    }

    /// The part of `rms` that more of the same would not take away, where it can be told from the noise.
    pub fn bias(&self) -> Option<f64> {
        self.noise.map(|noise| (self.rms * self.rms - noise * noise).max(0.0).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Stream;

    /// Roughly normal, with mean 0 and variance 1.
    fn normal(stream: &mut Stream) -> f64 {
        (0..12).map(|_| f64::from(stream.uniform())).sum::<f64>() - 6.0
    }

    /// Estimates of 1 in each channel, each off by `noise` times √32 at random.
    fn truth(points: u64, noise: f64, seed: u64) -> Vec<[Moments; 3]> {
        let channel = |stream: &mut Stream| {
            let mut moments = Moments::default();
            (0..32).for_each(|_| moments.add(1.0 + noise * 32f64.sqrt() * normal(stream)));
            moments
        };
        (0..points).map(|point| std::array::from_fn(|_| channel(&mut Stream::new(seed, point, 0)))).collect()
    }

    /// One half too bright by `off`, the other too dark.
    fn found(points: usize, off: f32) -> Vec<Rgb> {
        (0..points).map(|i| Rgb::splat(if i % 2 == 0 { 1.0 + off } else { 1.0 - off })).collect()
    }

    #[test]
    fn a_known_error_is_found_behind_noise_that_is_larger() {
        let (mut squares, runs) = (0.0, 60);
        for seed in 0..runs {
            let error = Error::of(&found(400, 0.02), &truth(400, 0.03, seed)).expect("light");
            assert!((error.floor / 0.03 - 1.0).abs() < 0.05, "{error:?}");
            squares += ((error.rms - 0.02) / error.uncertainty).powi(2);
        }
        let mean_square = squares / runs as f64;
        // 1 with a standard deviation of √(2/60), but for channels that are taken to be alike here and are not.
        assert!((0.2..1.6).contains(&mean_square), "{mean_square}");
    }

    #[test]
    fn the_truth_has_no_error_and_darkness_none_that_could_be_told() {
        let exact = truth(10, 0.0, 1);
        assert_eq!(Error::of(&found(10, 0.0), &exact), Some(Error::default()));
        let far = Error::of(&found(10, 0.5), &exact).expect("light");
        assert!((far.rms - 0.5).abs() < 1e-12 && far.uncertainty == 0.0);
        assert_eq!(Error::of(&[], &[]), None);
        assert_eq!(Error::of(&[Rgb::ZERO], &[[Moments::default(); 3]]), None);
    }
}
