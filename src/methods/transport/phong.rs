//! A glossy lobe: Phong's (1975), scaled so that it never reflects more than it should (Lewis 1994; Lafortune, Willems 1994).

use crate::math::warp::frame;
use glam::{Vec2, Vec3A};
use std::f32::consts::TAU;

/// f · (2π) / (n + 2): cosⁿ of the angle to the mirror direction. With the cosine of the incoming light and below the
/// horizon cut off, the lobe's albedo is at most 1, and 1 for light along the normal as n grows.
pub fn value(mirror: Vec3A, direction: Vec3A, exponent: f32) -> f32 {
    let cosine = mirror.dot(direction);
    // Not a matter of course where the exponent is 0.
    if cosine > 0.0 { (exponent + 2.0) / TAU * cosine.powf(exponent) } else { 0.0 }
}

/// The density with which [`sample`] chooses a direction, 1/sr.
pub fn density(mirror: Vec3A, direction: Vec3A, exponent: f32) -> f32 {
    (exponent + 1.0) / (exponent + 2.0) * value(mirror, direction, exponent)
}

/// A direction round the mirror direction with a density in proportion to cosⁿ; it may lie below the horizon.
pub fn sample(mirror: Vec3A, exponent: f32, at: Vec2) -> Vec3A {
    let cosine = (1.0 - at.x).powf(1.0 / (exponent + 1.0));
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let around = Vec2::from_angle(TAU * at.y);
    frame(mirror) * Vec3A::new(sine * around.x, sine * around.y, cosine)
}
