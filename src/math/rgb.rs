//! Linear RGB, with the primaries of sRGB and ITU-R BT.709.

use glam::{DVec3, Vec3};

/// Three channels of one radiometric quantity; the unit is stated where one is used.
pub type Rgb = Vec3;
/// The same in double precision, for sums of energy.
pub type Rgb64 = DVec3;

/// Relative luminance of linear RGB (weights of ITU-R BT.709).
pub fn luminance(rgb: Rgb) -> f32 {
    rgb.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

/// The sum over the three channels, in which the ledger counts watts.
pub fn total(rgb: Rgb64) -> f64 {
    rgb.x + rgb.y + rgb.z
}
