//! The matrix of form factors as a picture.

use super::canvas::Canvas;
use crate::math::rgb::Rgb;
use crate::solution::{FormFactorMatrix, Zero};
use crate::viewport::colour_map::colour;
use crate::viewport::{Legend, Picture};

/// False colours are rounded to this many steps: as many as 8 bits tell apart.
const STEPS: usize = 256;

/// The picture of a matrix, and what its colours mean.
#[derive(Clone, Debug, PartialEq)]
pub struct MatrixDiagram {
    pub picture: Picture,
    /// Of the form factors that are not zero; `None` where all are.
    pub legend: Option<Legend>,
    /// Of those that are zero, by reason.
    pub zeros: [Swatch; 3],
}

/// The colour of a zero, linear RGB: dark grey, light grey and vermilion (Okabe, Ito 2008). They differ in lightness from
/// each other, and in hue from the map of colours, also for eyes that miss one kind of cones.
pub fn zero_colour(reason: Zero) -> Rgb {
    match reason {
        Zero::SamePlane => Rgb::splat(0.02),
        Zero::FacesAway => Rgb::splat(0.7),
        Zero::Occluded => Rgb::new(0.665, 0.112, 0.0),
    }
}

/// A colour and what it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swatch {
    pub label: &'static str,
    /// Linear RGB.
    pub colour: Rgb,
    /// How much of the picture it is, in [0, 1].
    pub share: f64,
}

/// Draws F_ij in row i and column j, from the top left, with at most `limit` pixels along each edge: form factors in false
/// colours on a logarithmic scale, zeros in the colour of their reason. Where there are more pairs than pixels, a pixel is
/// the mean of their colours.
pub fn matrix(matrix: &FormFactorMatrix, limit: u32) -> MatrixDiagram {
    let size = matrix.size();
    let entries = (0..size).flat_map(|row| matrix.form_factors.row(row).1);
    let legend = Legend::of_form_factors("Form factor", entries.copied());
    let last = (STEPS - 1) as f32;
    let shades: Vec<Rgb> = (0..STEPS).map(|step| colour(step as f32 / last)).collect();
    let shade = |form_factor: f64| {
        let share = legend.as_ref().map_or(0.0, |legend| legend.share(form_factor));
        shades[(share * last).round() as usize]
    };
    let mut canvas = Canvas::new([size, size], limit);
    for (row, zeros) in matrix.zeros.chunks(size.max(1)).enumerate() {
        for (column, zero) in zeros.iter().enumerate() {
            if let Some(reason) = zero {
                canvas.paint(column, row, zero_colour(*reason));
            }
        }
        let (columns, form_factors) = matrix.form_factors.row(row);
        for (&column, &form_factor) in columns.iter().zip(form_factors) {
            canvas.paint(column as usize, row, shade(form_factor));
        }
    }
    let swatch =
        |reason: Zero| Swatch { label: reason.label(), colour: zero_colour(reason), share: matrix.share(Some(reason)) };
    MatrixDiagram { picture: canvas.finish(), zeros: Zero::ALL.map(swatch), legend }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::sparse::Sparse;
    use crate::viewport::colour_map::encoded;
    use glam::Mat3;
    use std::sync::Arc;

    /// | plane 0.1 |
    /// | 0.001 away |
    fn small() -> FormFactorMatrix {
        let mut form_factors = Sparse::with_capacity(2, 2);
        form_factors.push(1, 0.1);
        form_factors.end_row();
        form_factors.push(0, 0.001);
        form_factors.end_row();
        let zeros = vec![Some(Zero::SamePlane), None, None, Some(Zero::FacesAway)];
        FormFactorMatrix { form_factors: Arc::new(form_factors), zeros: Arc::new(zeros) }
    }

    #[test]
    fn every_cell_has_its_colour() {
        let diagram = matrix(&small(), 2);
        let [plane, away] = [Zero::SamePlane, Zero::FacesAway].map(zero_colour);
        // The scale reaches four decades down from 0.1, so 0.001 is half-way; the steps between colours are 1/255.
        let half = colour((0.5_f32 * 255.0).round() / 255.0);
        let expected = [plane, colour(1.0), half, away].map(|colour| colour.extend(1.0).to_array());
        assert_eq!((diagram.picture.size, diagram.picture.linear), ([2, 2], expected.to_vec()));
        let bytes = plane.to_array().map(encoded);
        assert_eq!(diagram.picture.srgb[0], [bytes[0], bytes[1], bytes[2], 255]);
        let legend = diagram.legend.expect("there are form factors");
        assert!((legend.high - 0.1).abs() < 1e-8 && (legend.low - 1e-5).abs() < 1e-12);
        assert_eq!(diagram.zeros.map(|swatch| swatch.share), [0.25, 0.25, 0.0]);
    }

    #[test]
    fn more_pairs_than_pixels_are_averaged() {
        let picture = matrix(&small(), 1).picture;
        let full = matrix(&small(), 2).picture;
        let mean = |channel: usize| full.linear.iter().map(|colour| colour[channel]).sum::<f32>() / 4.0;
        assert_eq!(picture.size, [1, 1]);
        for (channel, value) in picture.linear[0].into_iter().enumerate() {
            assert!((value - mean(channel)).abs() < 1e-6);
        }
    }

    #[test]
    fn a_matrix_of_nothing_but_zeros_has_no_scale() {
        let mut form_factors = Sparse::with_capacity(1, 0);
        form_factors.end_row();
        let zeros = Arc::new(vec![Some(Zero::Occluded)]);
        let diagram = matrix(&FormFactorMatrix { form_factors: Arc::new(form_factors), zeros }, 3);
        assert_eq!(diagram.legend, None);
        assert_eq!((diagram.picture.size, diagram.zeros[2].share), ([3, 3], 1.0));
    }

    /// As eyes without red or without green cones see linear RGB (Viénot, Brettel, Mollon 1999, table 1).
    fn colour_blind() -> [Mat3; 2] {
        let simulated =
            |r: f32, b: f32| Mat3::from_cols_array_2d(&[[r, r, b], [1.0 - r, 1.0 - r, -b], [0.0, 0.0, 1.0]]);
        [simulated(0.11238, 0.004_01), simulated(0.29275, -0.022_34)]
    }

    /// In Oklab, in which 1 is from black to white (Ottosson 2020).
    fn perceived_distance(a: Rgb, b: Rgb) -> f32 {
        let lab = |colour: Rgb| {
            let cones = Mat3::from_cols_array_2d(&[
                [0.412_221_46, 0.211_903_5, 0.088_302_46],
                [0.536_332_55, 0.680_699_5, 0.281_718_85],
                [0.051_445_995, 0.107_396_96, 0.629_978_7],
            ]);
            let response = (cones * colour).map(f32::cbrt);
            Mat3::from_cols_array_2d(&[
                [0.210_454_26, 1.977_998_5, 0.025_904_037],
                [0.793_617_8, -2.428_592_2, 0.782_771_77],
                [-0.004_072_047, 0.450_593_7, -0.808_675_77],
            ]) * response
        };
        lab(a).distance(lab(b))
    }

    #[test]
    fn reasons_can_be_told_apart_from_each_other_and_from_form_factors_by_every_eye() {
        let zeros = Zero::ALL.map(zero_colour);
        let map = (0..=20).map(|step| colour(step as f32 / 20.0));
        let others: Vec<Rgb> = zeros.into_iter().chain(map).collect();
        for eye in [Mat3::IDENTITY].into_iter().chain(colour_blind()) {
            for (index, zero) in zeros.iter().enumerate() {
                for other in others.iter().skip(index + 1) {
                    // 0.02 is about what can just be told apart side by side.
                    let distance = perceived_distance(eye * *zero, eye * *other);
                    assert!(distance > 0.08, "{zero} and {other} are {distance} apart");
                }
            }
        }
    }
}
