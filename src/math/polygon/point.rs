//! Form factor from a point to a polygon.

use super::clip_above;
use glam::DVec3;
use std::f64::consts::TAU;

/// The most corners that a polygon may have in [`form_factor`].
pub const MAX_CORNERS: usize = 4;

/// Form factor from a small surface at `point` with unit `normal` to a polygon, F in [0, 1]: the share of the flux
/// that leaves the point and arrives, and at once the irradiance there per radiosity of the polygon.
///
/// Lambert (1760) in the form of Nishita and Nakamae (1985): a sum over the edges, exact for any polygon; what lies
/// below the receiver's horizon is clipped away first. `corners` are three or four, counter-clockwise seen from the
/// front of the polygon; the result is 0 for a point that is not in front of it. Angles come from atan2, since acos
/// loses half its digits for short edges.
pub fn form_factor(point: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let mut clipped = [DVec3::ZERO; 2 * MAX_CORNERS];
    let count = clip_above(point, normal, corners, &mut clipped);
    if count < 3 {
        return 0.0;
    }
    contour_sum(normal, &clipped[..count]).clamp(0.0, 1.0)
}

/// The sum over the edges of a polygon above the horizon, whose corners are relative to the point.
pub(super) fn contour_sum(normal: DVec3, corners: &[DVec3]) -> f64 {
    let mut sum = 0.0;
    let mut from = corners[corners.len() - 1];
    for &to in corners {
        let axis = from.cross(to);
        sum += angle_over_sine(axis.length_squared(), from.dot(to)) * normal.dot(axis);
        from = to;
    }
    // Seen from the front the corners run counter-clockwise, so each axis points away from the normal's side.
    -sum / TAU
}

/// θ / s for the angle θ in [0, π] with the sine s and a cosine, both times the same positive number. An edge that
/// points at the receiver spans no angle and counts 0.
///
/// Most receivers see an edge under a small angle, for which nine terms of the series of the arc tangent need no root
/// and are as good: the first that is left out is below 0.25^18 / 19 = 8e-13 of the sum.
fn angle_over_sine(squared_sine: f64, cosine: f64) -> f64 {
    if cosine > 0.0 && squared_sine < cosine * cosine / 16.0 {
        let inverse = 1.0 / cosine;
        let squared_tangent = squared_sine * inverse * inverse;
        return inverse * ARC_TANGENT.iter().rev().fold(0.0, |sum, term| term + squared_tangent * sum);
    }
    let sine = squared_sine.sqrt();
    if sine > 0.0 { sine.atan2(cosine) / sine } else { 0.0 }
}

/// Coefficients of x, x³, x⁵ … of the arc tangent.
const ARC_TANGENT: [f64; 9] =
    [1.0, -1.0 / 3.0, 1.0 / 5.0, -1.0 / 7.0, 1.0 / 9.0, -1.0 / 11.0, 1.0 / 13.0, -1.0 / 15.0, 1.0 / 17.0];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polygon::vector_area;

    /// A unit square in the plane z = `height`, facing down.
    fn square_above(height: f64) -> [DVec3; 4] {
        [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)].map(|(x, y)| DVec3::new(x, y, height))
    }

    #[test]
    fn an_octant_seen_from_the_origin_is_a_quarter() {
        let corners = [DVec3::X, DVec3::Z, DVec3::Y];
        assert!((form_factor(DVec3::ZERO, DVec3::Z, &corners) - 0.25).abs() < 1e-15);
    }

    #[test]
    fn a_polygon_seen_from_behind_sends_nothing() {
        assert_eq!(form_factor(DVec3::ZERO, DVec3::Z, &[DVec3::X, DVec3::Y, DVec3::Z]), 0.0);
        assert_eq!(form_factor(DVec3::new(0.5, 0.5, 0.0), DVec3::NEG_Z, &square_above(1.0)), 0.0);
    }

    #[test]
    fn a_square_above_the_middle_has_the_published_values() {
        for (gap, expected) in [
            (10.0, 0.003_172_525_532_555_43),
            (2.0, 0.073_477_634_812_521_4),
            (1.0, 0.239_456_470_460_774),
            (0.5, 0.554_126_423_979_572),
            (0.1, 0.968_339_556_974_04),
            (0.01, 0.999_672_786_936_448),
        ] {
            let got = form_factor(DVec3::new(0.5, 0.5, 0.0), DVec3::Z, &square_above(gap));
            assert!((got - expected).abs() < 1e-14, "gap {gap}: {got}");
        }
    }

    #[test]
    fn at_the_foot_of_a_wall_the_horizon_clips_and_digits_survive() {
        // The wall stands on the floor's plane and reaches below it, so half of it must be clipped away.
        let wall = [(-1.0, 0.0), (-1.0, 1.0), (1.0, 1.0), (1.0, 0.0)].map(|(z, y)| DVec3::new(0.0, y, z));
        for (distance, expected) in [
            (0.5, 0.190_135_882_384_807),
            (0.1, 0.422_544_860_239_058),
            (1e-3, 0.499_215_797_596_26),
            (1e-6, 0.499_999_215_796_61),
            (1e-9, 0.499_999_999_215_796_63),
        ] {
            let got = form_factor(DVec3::new(distance, 0.5, 0.0), DVec3::Z, &wall);
            assert!((got - expected).abs() < 1e-14, "distance {distance}: {got}");
        }
    }

    #[test]
    fn the_six_walls_of_a_cube_close_round_any_inner_point() {
        let corner = |i: usize| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64);
        let faces =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]].map(|f| f.map(corner));
        let point = DVec3::new(0.21, 0.37, 0.68);
        let normal = DVec3::new(0.3, -0.5, 0.8).normalize();
        let sum: f64 = faces
            .iter()
            .map(|face| {
                let mut inward = *face;
                if vector_area(face).dot(DVec3::splat(0.5) - face[0]) < 0.0 {
                    inward.reverse();
                }
                form_factor(point, normal, &inward)
            })
            .sum();
        assert!((sum - 1.0).abs() < 1e-14, "{sum}");
    }

    #[test]
    fn small_angles_agree_with_the_arc_tangent() {
        for i in 1..1000 {
            let exact = 0.3 * f64::from(i) / 1000.0;
            let (sine, cosine) = (2.0 * exact.sin(), 2.0 * exact.cos());
            let got = angle_over_sine(sine * sine, cosine) * sine;
            assert!((got / exact - 1.0).abs() < 1e-12, "{exact}: {got}");
        }
        assert_eq!((angle_over_sine(0.0, 2.0), angle_over_sine(0.0, -1.0)), (0.5, 0.0));
    }
}
