//! How much photons count by their distance: kernels over a disc whose integral is 1 (Silverman 1986).

use crate::methods::Kernel;
use std::f32::consts::PI;

/// The kernel of a disc of this radius, m, at a square distance from its middle, m²: 1/m².
pub fn value(kernel: Kernel, square_distance: f32, radius: f32) -> f32 {
    let square = square_distance / (radius * radius);
    if square >= 1.0 {
        return 0.0;
    }
    let shape = match kernel {
        Kernel::Constant => 1.0,
        Kernel::Cone => 3.0 * (1.0 - square.sqrt()),
        Kernel::Epanechnikov => 2.0 * (1.0 - square),
    };
    shape / (PI * radius * radius)
}

/// Integral of a kernel over a sector up to a share `reach` of its radius, in [0, 1], by that up to the radius.
pub fn share_within(kernel: Kernel, reach: f32) -> f32 {
    let square = reach * reach;
    match kernel {
        Kernel::Constant => square,
        Kernel::Cone => square * (3.0 - 2.0 * reach),
        Kernel::Epanechnikov => square * (2.0 - square),
    }
}
