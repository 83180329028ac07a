//! Form factors of shapes for which the books have a formula (Howell, A Catalog of Radiation Heat Transfer
//! Configuration Factors). They share nothing with the rest, which is tested by them.

use std::f64::consts::PI;

/// Between two equal parallel rectangles `a` × `b`, face to face at distance `c` (C-11).
pub fn parallel_rectangles(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / c, b / c);
    let (x1, y1) = (1.0f64.hypot(x), 1.0f64.hypot(y));
    // ln √((1 + x²)(1 + y²) / (1 + x² + y²)), of a number that is near 1 where the distance is large.
    let logarithm = 0.5 * ((x * y).powi(2) / (1.0 + x * x + y * y)).ln_1p();
    let angles = x * y1 * (x / y1).atan() + y * x1 * (y / x1).atan() - x * x.atan() - y * y.atan();
    2.0 / (PI * x * y) * (logarithm + angles)
}

/// From a rectangle `width` × `length` to one of `height` × `length` that stands on its edge `length` at a right angle
/// (C-14).
pub fn perpendicular_rectangles(width: f64, height: f64, length: f64) -> f64 {
    let (w, h) = (width / length, height / length);
    let (w2, h2) = (w * w, h * h);
    let s = w2 + h2;
    let angles = w * (1.0 / w).atan() + h * (1.0 / h).atan() - s.sqrt() * (1.0 / s.sqrt()).atan();
    let logarithm = ((1.0 + w2) * (1.0 + h2) / (1.0 + s)).ln()
        + w2 * (w2 * (1.0 + s) / ((1.0 + w2) * s)).ln()
        + h2 * (h2 * (1.0 + s) / ((1.0 + h2) * s)).ln();
    (angles + 0.25 * logarithm) / (PI * w)
}

/// From a disc of this radius to another, face to face on one axis at this distance (C-41).
pub fn coaxial_discs(from_radius: f64, to_radius: f64, distance: f64) -> f64 {
    let (from, to) = (from_radius / distance, to_radius / distance);
    let s = 1.0 + (1.0 + to * to) / (from * from);
    // (s − √(s² − q)) / 2 without the difference of two large numbers.
    let q = 4.0 * (to_radius / from_radius).powi(2);
    0.5 * q / (s + (s * s - q).sqrt())
}

/// To a part of this area of a sphere from any other part of its inside, wherever both are.
pub fn inside_of_sphere(to_area: f64, radius: f64) -> f64 {
    to_area / (4.0 * PI * radius * radius)
}

/// From a strip without end to another of the same width that stands on its edge at this angle, rad.
pub fn hinged_strips(angle: f64) -> f64 {
    1.0 - (0.5 * angle).sin()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parallel_rectangles_have_the_published_values() {
        for (gap, expected) in [
            (10.0, 0.003_162_056_838_757_6),
            (2.0, 0.068_589_588_818_552_4),
            (1.0, 0.199_824_895_698_387),
            (0.5, 0.415_253_283_577_147),
            (0.1, 0.826_994_522_397_257),
            (0.01, 0.980_416_602_925_973),
        ] {
            assert!((parallel_rectangles(1.0, 1.0, gap) - expected).abs() < 1e-13, "{gap}");
        }
        // Far away, F = A / (π c²).
        assert!((parallel_rectangles(1.0, 1.0, 1e4) * PI * 1e8 - 1.0).abs() < 1e-6);
    }

    #[test]
    fn perpendicular_rectangles_have_the_published_values() {
        for (size, expected) in [
            (0.1, 0.281_887_806_787_901),
            (0.4, 0.250_319_555_056_282),
            (1.0, 0.200_043_776_075_403),
            (2.0, 0.149_299_795_886_762),
            (10.0, 0.055_023_979_528_411),
        ] {
            assert!((perpendicular_rectangles(size, size, 1.0) - expected).abs() < 1e-14, "{size}");
        }
        let cube = parallel_rectangles(1.0, 1.0, 1.0) + 4.0 * perpendicular_rectangles(1.0, 1.0, 1.0);
        assert!((cube - 1.0).abs() < 1e-14);
    }

    #[test]
    fn discs_spheres_and_strips_have_the_published_values() {
        assert!((coaxial_discs(1.0, 1.0, 1.0) - 0.381_966_011_250_105).abs() < 1e-15);
        assert!((coaxial_discs(0.5, 0.5, 1.0) - 0.171_572_875_253_81).abs() < 1e-14);
        // The rims of two such discs lie on a sphere, so from one cap to the other and from disc to disc is the same.
        let (radius, height) = (1.25f64.sqrt(), 1.25f64.sqrt() - 0.5);
        let cap = 2.0 * PI * radius * height;
        assert!((inside_of_sphere(cap, radius) * cap - coaxial_discs(1.0, 1.0, 1.0) * PI).abs() < 1e-14);
        assert_eq!((hinged_strips(0.0), hinged_strips(PI)), (1.0, 0.0));
        // Rectangles so long that their ends do not matter.
        assert!((perpendicular_rectangles(1e-6, 1e-6, 1.0) - hinged_strips(0.5 * PI)).abs() < 1e-6);
    }
}
