//! How a guess at light differs from the truth over a picture, when both are made equally bright.

use super::comparison::range_of;
use crate::math::rgb::Rgb;
use crate::math::stats::Moments;

/// Ambient occlusion against indirect light in one picture of [`super::CameraView::AmbientMinusIndirect`]. Of each cell that
/// shows a surface, the share of ambient light `a` and the indirect irradiance `E` are divided by their means, ā and Ē.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contrast {
    /// ā, in [0, 1].
    pub mean_share: f64,
    /// Ē, W/m², weighed by how bright its colours are.
    pub mean_irradiance: f64,
    /// A round number that few differences are larger than.
    pub range: f64,
    /// Mean of |a/ā − E/Ē|, with the noise of the pixels.
    pub mean_difference: f64,
    /// Of a and E over the picture, in [−1, 1]: nearer to 0 the more noise there is, and 0 where one of them is the same
    /// everywhere.
    pub correlation: f64,
}

impl Contrast {
    /// `None` where one of the two is nothing, so that there is nothing to compare.
    pub fn of(values: &[Rgb], coverage: &[f32]) -> Option<Self> {
        let (mut share, mut irradiance, mut weight) = (0.0, 0.0, 0.0);
        for (value, &coverage) in values.iter().zip(coverage) {
            share += f64::from(value.x);
            irradiance += f64::from(value.y);
            weight += f64::from(coverage);
        }
        if share <= 0.0 || irradiance <= 0.0 || weight <= 0.0 {
            return None;
        }
        let means = Self {
            mean_share: share / weight,
            mean_irradiance: irradiance / weight,
            range: 0.0,
            mean_difference: 0.0,
            correlation: 0.0,
        };
        let cells = values.iter().zip(coverage).filter(|(_, coverage)| **coverage > 0.0);
        let (mut sizes, mut spread) = (Moments::default(), Spread::default());
        let mut differences: Vec<f64> = cells
            .map(|(&value, &coverage)| {
                let size = means.difference(value, coverage).abs();
                sizes.add(size);
                spread.add(f64::from(value.x / coverage), f64::from(value.y / coverage));
                size
            })
            .collect();
        let range = range_of(&mut differences);
        Some(Self { range, mean_difference: sizes.mean(), correlation: spread.correlation(), ..means })
    }

    /// a/ā − E/Ē of a cell: below 0 where ambient occlusion is darker than the truth. `value` has a and E, premultiplied with
    /// the coverage.
    pub fn difference(&self, value: Rgb, coverage: f32) -> f64 {
        let [share, irradiance] = [value.x, value.y].map(|part| f64::from(part / coverage));
        share / self.mean_share - irradiance / self.mean_irradiance
    }
}

/// How two numbers vary, and how they do so together (Welford 1962).
#[derive(Default)]
struct Spread {
    one: Moments,
    other: Moments,
    products: f64,
}

impl Spread {
    fn add(&mut self, one: f64, other: f64) {
        let from_old_mean = one - self.one.mean();
        self.one.add(one);
        self.other.add(other);
        self.products += from_old_mean * (other - self.other.mean());
    }

    fn correlation(&self) -> f64 {
        let count = self.one.count() as f64 - 1.0;
        let squares = self.one.variance() * self.other.variance();
        if squares > 0.0 { (self.products / (count * squares.sqrt())).clamp(-1.0, 1.0) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_of_what_is_equally_bright_on_average() {
        // Two surfaces that are half covered, and background. Means: a = 1/2, E = 4.
        let values = [Rgb::new(0.125, 3.0, 0.0), Rgb::new(0.375, 1.0, 0.0), Rgb::ZERO];
        let contrast = Contrast::of(&values, &[0.5, 0.5, 0.0]).expect("a contrast");
        assert_eq!((contrast.mean_share, contrast.mean_irradiance), (0.5, 4.0));
        assert_eq!([0, 1].map(|i| contrast.difference(values[i], 0.5)), [0.5 - 1.5, 1.5 - 0.5]);
        assert_eq!((contrast.mean_difference, contrast.range), (1.0, 1.0));
        assert!((contrast.correlation + 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_alike_has_no_differences() {
        let values: Vec<Rgb> = (1..=8).map(|i| Rgb::new(0.125 * i as f32, 3.0 * i as f32, 0.0)).collect();
        let contrast = Contrast::of(&values, &[1.0; 8]).expect("a contrast");
        assert!(contrast.mean_difference < 1e-12 && (contrast.correlation - 1.0).abs() < 1e-12, "{contrast:?}");
        assert_eq!(contrast.range, 0.01);
        // One of them is the same everywhere.
        let values: Vec<Rgb> = (1..=8).map(|i| Rgb::new(0.125 * i as f32, 3.0, 0.0)).collect();
        assert_eq!(Contrast::of(&values, &[1.0; 8]).expect("a contrast").correlation, 0.0);
    }

    #[test]
    fn with_nothing_there_is_nothing_to_compare() {
        for value in [Rgb::ZERO, Rgb::new(0.5, 0.0, 0.0), Rgb::new(0.0, 0.5, 0.0)] {
            assert_eq!(Contrast::of(&[value; 4], &[1.0; 4]), None);
        }
        assert_eq!(Contrast::of(&[], &[]), None);
    }
}
