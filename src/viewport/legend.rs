//! Which number a false colour stands for.

use super::colour_map::{ColourMap, colour, diverging};
use super::{Light, View};
use crate::math::rgb::Rgb;
use crate::solution::{CameraImage, Comparison};

/// A scale of false colours. With it a window draws a key beside a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    pub title: &'static str,
    /// Empty where the quantity has none.
    pub unit: &'static str,
    /// What has the first colour of the map; smaller numbers above 0 have it too.
    pub low: f64,
    /// What has the last colour of the map.
    pub high: f64,
    pub is_logarithmic: bool,
    pub map: ColourMap,
    /// Round numbers in [low, high], ascending.
    pub ticks: Vec<f64>,
}

impl Legend {
    /// How many powers of ten a scale of form factors reaches down from the largest.
    const DECADES: i32 = 4;

    /// The scale of false colours of a view; `None` where it has none, or nothing to show by it.
    pub fn of(view: View, light: &Light) -> Option<Self> {
        if let View::Camera(view) = view {
            return Self::of_image(light.image_of(view)?);
        }
        let picked = light.picked.as_ref().filter(|_| view == View::FormFactors)?;
        Self::of_form_factors("Form factor from the picked patch", picked.form_factors.iter().copied())
    }

    /// A scale of the differences that a picture shows, as far below 0 as above.
    pub(super) fn of_image(image: &CameraImage) -> Option<Self> {
        let comparison = image.comparison?;
        let high = comparison.range();
        let title = match comparison {
            Comparison::Ambient(_) => "Ambient occlusion less indirect light, in shares of their mean",
            Comparison::Error(_) => "Light less its reference, in shares of the mean light that is seen",
        };
        Some(Self {
            title,
            unit: "",
            low: -high,
            high,
            is_logarithmic: false,
            map: ColourMap::Diverging,
            ticks: [-1.0, -0.5, 0.0, 0.5, 1.0].map(|share| share * high).to_vec(),
        })
    }

    /// A logarithmic scale that ends at the largest of some form factors; `None` where all are 0.
    pub(super) fn of_form_factors(title: &'static str, form_factors: impl Iterator<Item = f64>) -> Option<Self> {
        let high = form_factors.fold(0.0, f64::max);
        if high == 0.0 {
            return None;
        }
        let low = high * 10f64.powi(-Self::DECADES);
        let powers = low.log10().ceil() as i32..=high.log10().floor() as i32;
        let ticks = powers.map(|power| 10f64.powi(power)).filter(|tick| (low..=high).contains(tick)).collect();
        Some(Self { title, unit: "", low, high, is_logarithmic: true, map: ColourMap::Sequential, ticks })
    }

    /// Where a number is between `low` and `high`, in [0, 1].
    pub fn share(&self, value: f64) -> f32 {
        let share = if self.is_logarithmic {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        };
        share.clamp(0.0, 1.0) as f32
    }

    /// The colour that stands for a number, linear RGB.
    pub fn colour(&self, value: f64) -> Rgb {
        match self.map {
            ColourMap::Sequential => colour(self.share(value)),
            ColourMap::Diverging => diverging(self.share(value)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_ends_at_the_largest_and_has_the_powers_of_ten_between_its_ends() {
        let legend = Legend::of_form_factors("", [0.0, 0.03, 0.2].into_iter()).expect("a scale");
        assert_eq!((legend.low, legend.high), (0.2e-4, 0.2));
        assert_eq!(legend.ticks, [1e-4, 1e-3, 1e-2, 1e-1]);
        assert_eq!([0.0, 1e-9, 0.2e-4, 0.2, 1.0].map(|value| legend.share(value)), [0.0, 0.0, 0.0, 1.0, 1.0]);
        assert!((legend.share(0.02) - 0.75).abs() < 1e-6, "one of four decades below the largest");
    }

    #[test]
    fn a_scale_of_differences_has_0_in_its_middle() {
        let contrast = crate::solution::Contrast::of(&[Rgb::new(1.0, 1.0, 0.0), Rgb::new(1.0, 2.0, 0.0)], &[1.0; 2]);
        let range = contrast.expect("a contrast").range;
        assert_eq!(range, 0.5);
        let map = ColourMap::Diverging;
        let legend =
            Legend { title: "", unit: "", low: -range, high: range, is_logarithmic: false, map, ticks: vec![] };
        assert_eq!([-1.0, -0.5, 0.0, 0.25, 9.0].map(|value| legend.share(value)), [0.0, 0.0, 0.5, 0.75, 1.0]);
        let [blue, white, red] = [-0.5, 0.0, 0.5].map(|value| legend.colour(value));
        assert!(blue.z > 2.0 * blue.x && red.x > 2.0 * red.z && white.min_element() > 0.9, "{blue} {white} {red}");
    }

    #[test]
    fn zeros_alone_have_no_scale() {
        assert_eq!(Legend::of_form_factors("", [0.0, 0.0].into_iter()), None);
    }
}
