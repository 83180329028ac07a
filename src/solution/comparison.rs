//! Pictures that hold one kind of light against another, cell by cell.

use super::{CameraImage, CameraView, Contrast, PictureError};
use crate::math::rgb::Rgb;

/// So much of a picture has differences within its range; the rest is beyond its ends.
const SHOWN: f64 = 0.95;
/// Ranges that are chosen from: round numbers.
const RANGES: [f64; 9] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0];

/// What a picture that compares two kinds of light shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Comparison {
    /// Of [`CameraView::AmbientMinusIndirect`].
    Ambient(Contrast),
    /// Of [`CameraView::Error`].
    Error(PictureError),
}

impl Comparison {
    /// Of the cells of a picture; `None` where the view compares nothing, or there is nothing to compare.
    pub fn of(view: CameraView, values: &[Rgb], coverage: &[f32]) -> Option<Self> {
        match view {
            CameraView::AmbientMinusIndirect => Contrast::of(values, coverage).map(Self::Ambient),
            CameraView::Error(_) => PictureError::of(values, coverage).map(Self::Error),
            _ => None,
        }
    }

    /// A round number that few differences are larger than.
    pub fn range(&self) -> f64 {
        match self {
            Self::Ambient(contrast) => contrast.range,
            Self::Error(error) => error.range,
        }
    }

    fn difference(&self, value: Rgb, coverage: f32) -> f64 {
        match self {
            Self::Ambient(contrast) => contrast.difference(value, coverage),
            Self::Error(error) => error.difference(value, coverage),
        }
    }
}

impl CameraImage {
    /// The difference that a cell shows; `None` where there is no surface, or nothing to compare.
    pub fn difference(&self, cell: usize) -> Option<f64> {
        let comparison = self.comparison.filter(|_| self.coverage[cell] > 0.0)?;
        Some(comparison.difference(self.radiance[cell], self.coverage[cell]))
    }
}

/// The least of the ranges that hold most of these sizes, of which there is one at least. Their order is lost.
pub fn range_of(sizes: &mut [f64]) -> f64 {
    let last = ((sizes.len() - 1) as f64 * SHOWN) as usize;
    let (_, largest, _) = sizes.select_nth_unstable_by(last, f64::total_cmp);
    RANGES.into_iter().find(|range| *range >= *largest).unwrap_or(RANGES[RANGES.len() - 1])
}
