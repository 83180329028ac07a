//! One measure of error for every method.

use crate::math::rgb::Rgb;
use crate::math::stats::{Moments, root_of_square};

/// How far irradiance, or the radiance of pixels, is from the truth, as a share of the mean of the truth.
///
/// The error is the root of the mean of (E − E_ref)² over points that are spread by area and over channels. The reference's own
/// noise, which is part of what is seen, is taken out of it; `floor` says how much that was, and below it little can be told.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Error {
    pub rms: f64,
    /// Standard error of `rms`, by what is known of the noise of the reference and, where some points stand for others, by how
    /// their errors differ. Of a method's own noise it says nothing.
    pub uncertainty: f64,
    /// One-sided 95 % confidence limit of `rms`: the root of the mean square, or of 0 where that came out below, and 1.645 of
    /// its standard errors, which are taken for normal.
    pub upper: f64,
    /// The error of the reference itself.
    pub floor: f64,
    /// The part of `rms` that is noise of the method, where it tells how far its numbers scatter.
    pub noise: Option<f64>,
}

/// Standard errors that a normal number exceeds its mean by in 5 % of all cases.
const CONFIDENCE: f64 = 1.645;

/// Sums over points and channels.
#[derive(Default)]
struct Sums {
    /// Of (found − truth)².
    squares: f64,
    /// Of the truth's own variance, which is a part of them.
    noise: f64,
    /// Variance of `squares` less `noise`, by what is known of the noise of the truth.
    variance: f64,
    truth: f64,
    /// How the squares less the noise differ from point to point.
    scatter: Moments,
}

impl Sums {
    fn of(found: &[Rgb], truth: &[[Moments; 3]]) -> Self {
        let mut sums = Self::default();
        for (found, truth) in found.iter().zip(truth) {
            let (mut deviation, mut excess) = (0.0, 0.0);
            for (found, truth) in found.as_dvec3().to_array().into_iter().zip(truth) {
                let (square, own) = ((found - truth.mean()).powi(2), truth.standard_error().powi(2));
                sums.squares += square;
                sums.noise += own;
                sums.truth += truth.mean();
                excess += square - own;
                // The square of a known difference and a normal one has the variance 4 d² v + 2 v². Channels of a point, which
                // come along the same paths, may all be off to the same side.
                deviation += (4.0 * (square - own).max(0.0) * own + 2.0 * own * own).sqrt();
            }
            sums.variance += deviation * deviation;
            sums.scatter.add(excess);
        }
        sums
    }

    /// Where the difference of squares and noise has this variance; `None` where there are no points, or no light.
    fn error(&self, variance: f64) -> Option<Error> {
        let count = 3.0 * self.scatter.count() as f64;
        let mean = self.truth / count;
        if count == 0.0 || mean <= 0.0 {
            return None;
        }
        let (square, deviation) = ((self.squares - self.noise) / count, variance.sqrt() / count);
        let (rms, uncertainty) = root_of_square(square, deviation);
        let upper = (square.max(0.0) + CONFIDENCE * deviation).sqrt();
        let floor = (self.noise / count).sqrt() / mean;
        let [rms, uncertainty, upper] = [rms, uncertainty, upper].map(|root| root / mean);
        Some(Error { rms, uncertainty, upper, floor, noise: None })
    }
}

impl Error {
    /// Of what was `found` at points, or in pixels, where independent estimates of the truth are known; `None` where there are
    /// no points, or no light.
    pub fn of(found: &[Rgb], truth: &[[Moments; 3]]) -> Option<Self> {
        let sums = Sums::of(found, truth);
        sums.error(sums.variance)
    }

    /// The same where these are some of `all`, by chance, and all are meant: what the others are off by is known as well as the
    /// sizes of these errors agree, which takes in the noise of the truth.
    pub fn of_some(found: &[Rgb], truth: &[[Moments; 3]], all: u64) -> Option<Self> {
        let sums = Sums::of(found, truth);
        let count = sums.scatter.count() as f64;
        let seen = (count / all as f64).min(1.0);
        sums.error(seen * sums.variance + (1.0 - seen) * count * sums.scatter.variance())
    }

    /// Of estimates without a bias, by how far they scatter.
    pub fn of_noise(estimates: &[[Moments; 3]]) -> Option<Self> {
        let mut sums = Sums::default();
        for channels in estimates {
            let own: f64 = channels.iter().map(|channel| channel.standard_error().powi(2)).sum();
            sums.squares += own;
            sums.truth += channels.iter().map(Moments::mean).sum::<f64>();
            // Of n normal numbers the variance is known to 2/(n − 1) of its square.
            sums.variance += 2.0 * own * own / channels[0].count().saturating_sub(1).max(1) as f64;
            sums.scatter.add(own);
        }
        let error = sums.error(sums.variance)?;
        Some(Self { floor: error.rms, noise: Some(error.rms), ..error })
    }

    /// The same where a method says how far its numbers scatter: `variance` is the mean of their squared standard errors over
    /// points and channels, (W/m²)², and `mean` that of the truth, W/m².
    #[must_use]
    pub fn with_noise(self, variance: f64, mean: f64) -> Self {
        Self { noise: Some(variance.sqrt() / mean), ..self }
    }

    /// What the error is surely below, where it cannot be told from none: the mean square is at most as large as its own
    /// standard error, which is so where the uncertainty of its root is at least as large as the root.
    pub fn below(&self) -> Option<f64> {
        (self.uncertainty > 0.0 && self.uncertainty >= self.rms).then_some(self.upper)
    }

    /// In percent: `1.68 % ± 0.10 %`, or where it cannot be told from none `below 7.10 % (95 % confidence)`.
    pub fn in_words(&self) -> String {
        let percent = |share: f64| format!("{:.2} %", 100.0 * share);
        self.in_words_by(percent, percent)
    }

    /// The same with another way to write shares, and those that say how uncertain others are.
    pub fn in_words_by(&self, percent: impl Fn(f64) -> String, uncertain: impl Fn(f64) -> String) -> String {
        match self.below() {
            Some(limit) => format!("below {} (95 % confidence)", uncertain(limit)),
            None => format!("{} ± {}", percent(self.rms), uncertain(self.uncertainty)),
        }
    }

    /// The part of `rms` that more of the same would not take away, where it can be told from the noise.
    pub fn bias(&self) -> Option<f64> {
        self.noise.map(|noise| (self.rms * self.rms - noise * noise).max(0.0).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Stream, hash};

    /// Roughly normal, with mean 0 and variance 1.
    fn normal(stream: &mut Stream) -> f64 {
        (0..12).map(|_| f64::from(stream.uniform())).sum::<f64>() - 6.0
    }

    /// Estimates of 1, each off by `noise` times √32 at random, the same in all channels.
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
        // 1 with a standard deviation of √(2/60).
        assert!((0.4..1.6).contains(&mean_square), "{mean_square}");
    }

    #[test]
    fn nothing_is_said_to_be_exact_behind_noise() {
        for seed in 0..20 {
            let error = Error::of(&found(50, 0.0), &truth(50, 0.3, seed)).expect("light");
            // The mean square is known to the floor's, by 50 points whose channels may be alike.
            assert!(error.uncertainty > 0.3 * (2.0_f64 / 150.0).powf(0.25) / 2.0, "{error:?}");
        }
    }

    /// Of errors that are there, 95 % are below their limit, and so are those that are not there, which have none to exceed.
    #[test]
    fn an_error_behind_noise_is_said_to_be_below_a_limit_that_holds() {
        let (mut above, mut unseen, runs) = (0, 0, 400);
        for seed in 0..runs {
            let error = Error::of(&found(50, 0.05), &truth(50, 0.15, seed)).expect("light");
            unseen += u32::from(error.below().is_some());
            above += u32::from(error.upper < 0.05);
        }
        // 5 % of 400, with a standard deviation of √(400 · 0.05 · 0.95) = 4.4; channels that are alike make it fewer at most.
        assert!(above <= 20 + 3 * 5 && unseen > runs as u32 / 2, "{above} {unseen}");
        let none = Error { rms: 0.0, uncertainty: 0.071, upper: 0.0911, ..Error::default() };
        assert_eq!((none.below(), none.in_words()), (Some(0.0911), "below 9.11 % (95 % confidence)".to_owned()));
        let seen = Error { rms: 0.0168, uncertainty: 0.001, upper: 0.0183, ..Error::default() };
        assert_eq!((seen.below(), seen.in_words()), (None, "1.68 % ± 0.10 %".to_owned()));
        assert_eq!(Error::default().in_words(), "0.00 % ± 0.00 %");
    }

    /// A mean square of s ± d: its root is told where s exceeds d, and else the root of s + 1.645 d.
    #[test]
    fn a_square_that_is_no_larger_than_its_uncertainty_has_a_limit() {
        let error = |square: f64| {
            let mut sums = Sums { squares: 3.0 * square, truth: 3.0, ..Sums::default() };
            sums.scatter.add(0.0);
            sums.error(9.0 * 4.0).expect("light").below()
        };
        assert_eq!([error(-1.0), error(0.0)], [Some(3.29_f64.sqrt()); 2]);
        assert!((error(1.9).expect("a limit") - 5.19_f64.sqrt()).abs() < 1e-12);
        assert_eq!(error(2.1), None);
    }

    #[test]
    fn a_few_points_stand_for_all_as_well_as_their_errors_agree() {
        // One in eight is off by 0.8, the others by nothing.
        let light = |i| Rgb::splat(if hash(5, i, 0).is_multiple_of(8) { 1.8 } else { 1.0 });
        let (runs, points, mut squares) = (200, 64, 0.0);
        for run in 0..runs {
            let some: Vec<Rgb> = (0..points).map(|i| light(run * points + i)).collect();
            let error = Error::of_some(&some, &truth(points, 0.0, 1), 1 << 40).expect("light");
            squares += ((error.rms.powi(2) - 0.08) / (2.0 * error.rms * error.uncertainty)).powi(2);
        }
        // About 1: eight points or so decide on the uncertainty itself.
        let mean_square = squares / runs as f64;
        assert!((0.5..2.0).contains(&mean_square), "{mean_square}");
        let whole = Error::of_some(&found(64, 0.1), &truth(64, 0.0, 1), 64).expect("light");
        assert_eq!(whole.uncertainty, 0.0);
    }

    #[test]
    fn estimates_know_their_own_error_and_how_well() {
        let errors: Vec<Error> = (0..40).map(|seed| Error::of_noise(&truth(8, 0.03, seed)).expect("light")).collect();
        let mut rms = Moments::default();
        errors.iter().for_each(|error| rms.add(error.rms));
        assert!((rms.mean() / 0.03 - 1.0).abs() < 0.02, "{rms:?}");
        // Known to 1/√80.
        let spread = rms.variance().sqrt() / errors[0].uncertainty;
        assert!((0.6..1.4).contains(&spread), "{spread}");
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
