//! Multiple importance sampling (Veach, Guibas 1995).

/// The weight of what one of two ways to choose a direction found, by the power heuristic with β = 2. `own` and `other` are the
/// densities of the direction by that way and by the other one, 1/sr, each times the number of its samples.
pub fn power_heuristic(own: f32, other: f32) -> f32 {
    // As a quotient, since squares of densities overflow.
    let quotient = other / own;
    if own > 0.0 { 1.0 / (1.0 + quotient * quotient) } else { 0.0 }
}
