//! Which number a false colour stands for.

use super::colour_map::colour;
use super::{Light, View};
use crate::math::rgb::Rgb;

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
    /// Round numbers in [low, high], ascending.
    pub ticks: Vec<f64>,
}

impl Legend {
    /// How many powers of ten a scale of form factors reaches down from the largest.
    const DECADES: i32 = 4;

    /// The scale of false colours of a view; `None` where it has none, or nothing to show by it.
    pub fn of(view: View, light: &Light) -> Option<Self> {
        let picked = light.picked.as_ref().filter(|_| view == View::FormFactors)?;
        Self::of_form_factors("Form factor from the picked patch", picked.form_factors.iter().copied())
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
        Some(Self { title, unit: "", low, high, is_logarithmic: true, ticks })
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
        colour(self.share(value))
    }
}
