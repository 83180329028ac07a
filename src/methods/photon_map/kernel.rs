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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::choice::Choice;

    #[test]
    fn kernels_have_an_integral_of_1_and_grow_to_it_from_the_middle() {
        let (radius, rings) = (0.7_f32, 4096);
        for &kernel in Kernel::ALL {
            let mut integral = 0.0;
            for ring in 0..rings {
                let (middle, end) = ((ring as f32 + 0.5) / rings as f32, (ring as f32 + 1.0) / rings as f32);
                let distance = radius * middle;
                integral += value(kernel, distance * distance, radius) * 2.0 * PI * distance * radius / rings as f32;
                // The midpoint rule is good to 1/n², the sums in single precision to 1e-5.
                assert!((integral - share_within(kernel, end)).abs() < 2e-5, "{kernel:?} {end}: {integral}");
            }
            assert!((integral - 1.0).abs() < 2e-5, "{kernel:?} {integral}");
            assert_eq!(value(kernel, 1.01 * radius * radius, radius), 0.0);
        }
    }
}
