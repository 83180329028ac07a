//! How far an estimate looks for photons.

use std::f64::consts::PI;

/// α: which share of the photons of a pass are kept, so to say, while the disc shrinks (Hachisuka, Ogaki, Jensen 2008).
const KEPT: f64 = 2.0 / 3.0;

/// Radius of a pass (from 0) over that of the first: r²ᵢ₊₁ / r²ᵢ = (i + α) / (i + 1), counted from 1. All passes have
/// one radius each and photons of their own, and the mean of their estimates converges (Knaus, Zwicker 2011).
pub fn shrinkage(pass: u64) -> f64 {
    let steps = (1..=pass).map(|i| (i as f64 + KEPT) / (i as f64 + 1.0));
    steps.product::<f64>().sqrt()
}

/// Radius of the disc, m, that holds `wanted` of `landings` which are spread over `area`, m²; infinite where there are none.
pub fn radius_for(wanted: f64, landings: f64, area: f64) -> f64 {
    (wanted * area / (PI * landings)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radii_shrink_as_published() {
        assert_eq!(shrinkage(0), 1.0);
        assert!((shrinkage(9) - 0.713_103).abs() < 1e-6 && (shrinkage(99) - 0.488_251).abs() < 1e-6);
    }

    #[test]
    fn a_disc_of_the_radius_holds_what_is_wanted() {
        let radius = radius_for(50.0, 2000.0, 3.0);
        assert!((PI * radius * radius / 3.0 * 2000.0 - 50.0).abs() < 1e-9);
    }
}
