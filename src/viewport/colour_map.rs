//! Colours that stand for numbers.

use crate::math::rgb::Rgb;

/// The colour of a share in [0, 1], linear RGB: from dark violet over green to yellow. Equal steps of the share look
/// equally far apart, in lightness alone too, so that the order is seen without colours. What is outside is taken to the
/// nearest end.
///
/// The map is viridis (Smith, van der Walt 2015) in the polynomial fit of Zucker (2019, public domain).
pub fn colour(share: f32) -> Rgb {
    /// Of sRGB-encoded channels, constant term first.
    const COEFFICIENTS: [Rgb; 7] = [
        Rgb::new(0.277_727, 0.005_407_34, 0.334_1),
        Rgb::new(0.105_093, 1.404_61, 1.384_59),
        Rgb::new(-0.330_862, 0.214_848, 0.095_095_2),
        Rgb::new(-4.634_23, -5.799_1, -19.332_4),
        Rgb::new(6.228_27, 14.179_9, 56.690_6),
        Rgb::new(4.776_38, -13.745_1, -65.353),
        Rgb::new(-5.435_46, 4.645_85, 26.312_4),
    ];
    let t = share.clamp(0.0, 1.0);
    let encoded = COEFFICIENTS.iter().rev().fold(Rgb::ZERO, |sum, &coefficient| sum * t + coefficient);
    encoded.to_array().map(linear).into()
}

/// Which colours stand for the numbers of a scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ColourMap {
    /// [`colour`]: from little to much.
    Sequential,
    /// [`diverging`]: both ways from a middle.
    Diverging,
}

/// The colour of a share in [0, 1] that is far from 1/2 to either side, linear RGB: from blue over white to red. Equal steps
/// to both sides are equally far from white in each channel as a screen encodes it. The ends are those of the scheme RdBu
/// (Brewer 2003).
pub fn diverging(share: f32) -> Rgb {
    /// Encoded as sRGB.
    const BLUE: Rgb = Rgb::new(33.0 / 255.0, 102.0 / 255.0, 172.0 / 255.0);
    const RED: Rgb = Rgb::new(178.0 / 255.0, 24.0 / 255.0, 43.0 / 255.0);
    let from_middle = 2.0 * share.clamp(0.0, 1.0) - 1.0;
    let end = if from_middle < 0.0 { BLUE } else { RED };
    Rgb::ONE.lerp(end, from_middle.abs()).to_array().map(linear).into()
}

/// The colour of a screen that stands for nothing: neither a share nor light.
pub const GREY: Rgb = Rgb::splat(0.18);

/// From the encoding of sRGB in [0, 1] to linear (IEC 61966-2-1).
fn linear(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// From linear in [0, 1] to 8 bits in the encoding of sRGB (IEC 61966-2-1).
pub fn encoded(linear: f32) -> u8 {
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rgb::luminance;

    /// CIE 1976 lightness.
    fn lightness(colour: Rgb) -> f32 {
        116.0 * luminance(colour).cbrt() - 16.0
    }

    #[test]
    fn lightness_rises_evenly_with_the_share() {
        let shades: Vec<f32> = (0..=100).map(|percent| lightness(colour(percent as f32 / 100.0))).collect();
        assert!(shades.windows(2).all(|pair| pair[1] > pair[0]));
        for (percent, shade) in shades.iter().enumerate() {
            let even = shades[0] + (shades[100] - shades[0]) * percent as f32 / 100.0;
            // Viridis itself keeps within 1 of a straight line; the fit adds 1/128 of a channel, some 1 of lightness.
            assert!((shade - even).abs() < 2.0, "{shade} at {percent} %, not {even}");
        }
    }

    #[test]
    fn a_diverging_map_is_white_in_the_middle_and_falls_evenly_to_both_sides() {
        assert_eq!(diverging(0.5), Rgb::ONE);
        let shades: Vec<f32> = (0..=100).map(|percent| lightness(diverging(percent as f32 / 100.0))).collect();
        assert!(shades[..=50].windows(2).all(|pair| pair[1] > pair[0]));
        assert!(shades[50..].windows(2).all(|pair| pair[1] < pair[0]));
        // Of the scheme's ends red is the darker one, by 4 in lightness, and by up to 6.5 on the way.
        assert!((0..50).all(|i| (-0.1..7.0).contains(&(shades[i] - shades[100 - i]))), "{shades:?}");
        assert_eq!((diverging(-1.0), diverging(2.0)), (diverging(0.0), diverging(1.0)));
    }

    #[test]
    fn what_is_outside_has_the_colour_of_the_nearest_end() {
        assert_eq!((colour(-1.0), colour(2.0)), (colour(0.0), colour(1.0)));
    }

    #[test]
    fn encoding_and_decoding_are_inverse() {
        for byte in 0..=255 {
            assert_eq!(encoded(linear(f32::from(byte) / 255.0)), byte);
        }
    }
}
