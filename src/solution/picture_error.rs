//! How far the light of a picture is off.

use super::comparison::range_of;
use crate::math::rgb::Rgb;
use crate::math::stats::root_of_square;

/// Light of one picture against the reference, both by how bright their colours are and without what emitters that are seen
/// emit themselves. Differences are shares of the reference's mean over the surfaces that are seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureError {
    /// Mean radiance of the reference, W/(m²·sr), weighed by how bright its colours are.
    pub mean: f64,
    /// A round number that few differences are larger than, with their noise.
    pub range: f64,
    /// Mean difference: above 0 where the picture is too bright as a whole.
    pub offset: f64,
    /// Root mean square difference, with the noise of the light as it is, and without that of the reference.
    pub rms: f64,
    /// Standard error of `rms`, by the noise of the reference.
    pub uncertainty: f64,
    /// What the reference's noise adds to the root mean square difference.
    pub floor: f64,
}

impl PictureError {
    /// Of cells that hold, as means over their samples, the light L, the reference R, and half the difference of the two
    /// independent estimates that R is the mean of; all are premultiplied with the coverage. `None` where there is no light.
    pub fn of(values: &[Rgb], coverage: &[f32]) -> Option<Self> {
        let seen = || values.iter().zip(coverage).filter(|(_, coverage)| **coverage > 0.0);
        let weight: f64 = seen().map(|(_, &coverage)| f64::from(coverage)).sum();
        let mean = seen().map(|(value, _)| f64::from(value.y)).sum::<f64>() / weight;
        if !(weight > 0.0 && mean > 0.0) {
            return None;
        }
        let measure = Self { mean, range: 0.0, offset: 0.0, rms: 0.0, uncertainty: 0.0, floor: 0.0 };
        let [mut offset, mut square, mut floor, mut variance] = [0.0; 4];
        let mut sizes: Vec<f64> = Vec::with_capacity(values.len());
        for (&value, &coverage) in seen() {
            let share = f64::from(coverage) / weight;
            let difference = measure.difference(value, coverage);
            offset += share * difference;
            square += share * difference * difference;
            // Half the difference of two varies as their mean does.
            let noise = f64::from(value.z / coverage) / mean;
            floor += share * noise * noise;
            // Of d² − z², where d = b + x, and x and z are normal with the variance v: 4 b² v + 4 v², the mean of 4 d² z².
            variance += (2.0 * share * difference * noise).powi(2);
            sizes.push(difference.abs());
        }
        let (rms, uncertainty) = root_of_square(square - floor, variance.sqrt());
        Some(Self { range: range_of(&mut sizes), offset, rms, uncertainty, floor: floor.sqrt(), ..measure })
    }

    /// (L − R)/R̄ of a cell: below 0 where the picture is too dark.
    pub fn difference(&self, value: Rgb, coverage: f32) -> f64 {
        f64::from((value.x - value.y) / coverage) / self.mean
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Stream, hash};

    #[test]
    fn errors_are_signed_shares_of_the_mean_light() {
        // A surface that is half as bright again as it should be, one that is half covered and too dark, and background.
        let values = [Rgb::new(6.0, 4.0, 0.0), 0.5 * Rgb::new(2.0, 4.0, 0.0), Rgb::ZERO];
        let coverage = [1.0, 0.5, 0.0];
        let error = PictureError::of(&values, &coverage).expect("an error");
        assert_eq!((error.mean, error.range, error.rms, error.floor), (4.0, 0.5, 0.5, 0.0));
        assert_eq!([0, 1].map(|i| error.difference(values[i], coverage[i])), [0.5, -0.5]);
        assert!((error.offset - 0.5 / 3.0).abs() < 1e-12, "{error:?}");
    }

    #[test]
    fn noise_of_the_reference_is_no_error_of_the_light() {
        // Light that is 0.2 too bright, against the mean of two estimates of 10 ± 1, in 10,000 pixels.
        let estimate = |pixel, set| if hash(7, pixel, set) & 1 == 0 { 9.0 } else { 11.0 };
        let cell = |pixel| {
            let [one, other] = [0, 1].map(|set| estimate(pixel, set));
            Rgb::new(10.2, (one + other) / 2.0, (one - other) / 2.0)
        };
        let values: Vec<Rgb> = (0..10_000).map(cell).collect();
        let error = PictureError::of(&values, &[1.0; 10_000]).expect("an error");
        // The mean of two varies by 1/√2, and its square as much as it is: over 10,000 pixels by a hundredth of it. Means
        // vary by 1/√20,000.
        assert!((error.offset - 0.02).abs() < 4.0 * 0.1 / 20_000_f64.sqrt(), "{error:?}");
        assert!((error.floor.powi(2) - 0.005).abs() < 4.0 * 0.005 / 100.0, "{error:?}");
        // What is left of the noise when one of two numbers is subtracted from the other.
        assert!(
            (error.rms.powi(2) - 0.02_f64.powi(2)).abs() < 4.0 * (2.0 * 0.02 * 0.07 + 1.5 * 0.005) / 100.0,
            "{error:?}"
        );
    }

    #[test]
    fn the_uncertainty_is_how_far_errors_scatter_from_one_reference_to_another() {
        // Light that is 0.05 too bright, in 400 pixels, some of them half covered, against estimates of 1 ± 0.1.
        let normal = |run, pixel, set| {
            let mut stream = Stream::new(run, pixel, set);
            (0..12).map(|_| stream.uniform()).sum::<f32>() - 6.0
        };
        let coverage: Vec<f32> = (0..400).map(|pixel| if pixel % 4 == 0 { 0.5 } else { 1.0 }).collect();
        let (runs, mut squares) = (200, 0.0);
        for run in 0..runs {
            let cell = |pixel: usize| {
                let [one, other] = [0, 1].map(|set| 1.0 + 0.1 * normal(run, pixel as u64, set));
                coverage[pixel] * Rgb::new(1.05, (one + other) / 2.0, (one - other) / 2.0)
            };
            let error = PictureError::of(&(0..400).map(cell).collect::<Vec<_>>(), &coverage).expect("an error");
            squares += ((error.rms.powi(2) - 0.05_f64.powi(2)) / (2.0 * error.rms * error.uncertainty)).powi(2);
        }
        let mean_square = squares / runs as f64;
        assert!((0.7..1.4).contains(&mean_square), "{mean_square}");
    }

    #[test]
    fn without_light_there_is_no_error() {
        assert_eq!(PictureError::of(&[Rgb::X; 4], &[1.0; 4]), None);
        assert_eq!(PictureError::of(&[Rgb::ONE; 4], &[0.0; 4]), None);
        assert_eq!(PictureError::of(&[], &[]), None);
    }
}
