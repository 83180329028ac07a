//! A triangle as it is seen from a point: its solid angle, and directions that are uniform over it.

use glam::{DVec2, DVec3};

/// The directions from a point to a triangle.
///
/// Arvo (1995) samples such triangles by angles at their corners, which lose all digits where a triangle is thin. This is the
/// form of Peters (2021), which needs half the solid angle alone; it holds for slivers and for triangles that fill all but a
/// half-space. Where an edge runs over the point at a height h of its length, 16 digits are good for 1e-15/h² of all.
#[derive(Clone, Copy, Debug)]
pub struct SphericalTriangle {
    /// Unit vectors to the corners.
    corners: [DVec3; 3],
    /// The determinant of the corners.
    volume: f64,
    /// a·c + b·c and 1 + a·b for the corners a, b, c.
    sum_of_cosines: f64,
    one_plus_cosine: f64,
    solid_angle: f64,
}

impl SphericalTriangle {
    /// Of a triangle whose corners are given relative to the point. Its solid angle is 0 where the point is behind it, in its
    /// plane or at a corner; corners run counter-clockwise seen from the front.
    pub fn new(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let product = a.length() * b.length() * c.length();
        // By edges and not by corners, so that points close to the plane keep their digits. Negative seen from the front.
        let volume = -a.dot((b - a).cross(c - a)) / product;
        let units = corners.map(DVec3::normalize_or_zero);
        let [a, b, c] = units;
        let (sum_of_cosines, one_plus_cosine) = (c.dot(a + b), 1.0 + a.dot(b));
        // Van Oosterom, Strackee (1983).
        let solid_angle =
            if volume > 0.0 && product > 0.0 { 2.0 * volume.atan2(sum_of_cosines + one_plus_cosine) } else { 0.0 };
        Self { corners: units, volume, sum_of_cosines, one_plus_cosine, solid_angle }
    }

    /// sr, in [0, 2π].
    pub fn solid_angle(&self) -> f64 {
        self.solid_angle
    }

    /// The unit direction for a point in [0, 1)², uniform over the solid angle, which must not be 0.
    pub fn direction(&self, at: DVec2) -> DVec3 {
        let [a, b, c] = self.corners;
        // On the edge from a to c there is a place d for which the triangle a, b, d has a share at.x of the solid angle.
        let (sine, cosine) = (0.5 * at.x * self.solid_angle).sin_cos();
        let half_way = a * (self.volume * cosine - self.sum_of_cosines * sine) + c * (self.one_plus_cosine * sine);
        let d = (2.0 * a.dot(half_way) / half_way.length_squared() * half_way - a).normalize();
        // From b to d, uniform in the cosine of the angle to b; small angles are known by their chord alone.
        let drop = 0.5 * (d - b).length_squared();
        let across = (d - (1.0 - drop) * b).normalize_or_zero();
        let drop = at.y * drop;
        (1.0 - drop) * b + (drop * (2.0 - drop)).max(0.0).sqrt() * across
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Stream;
    use std::f64::consts::{FRAC_PI_2, TAU};

    /// From fat to thin, from far to so near that all but a half-space is filled.
    fn triangles() -> Vec<[DVec3; 3]> {
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        let mut triangles = vec![
            [at(1.0, 0.0, 0.0), at(0.0, 0.0, 1.0), at(0.0, 1.0, 0.0)],
            [at(-1.0, -1.0, 9.0), at(0.0, 2.0, 9.0), at(1.0, -1.0, 9.0)],
            // Slivers, along and across, seen from near by.
            [at(-1.0, -1e-6, 0.1), at(0.3, 1e-6, 0.1), at(1.0, -1e-6, 0.1)],
            [at(-1.0, 0.0, 1e-6), at(-1.0, 1e-6, 1e-6), at(1.0, 0.0, 1e-6)],
        ];
        // Before the middle, an edge and a corner.
        for height in [1.0, 1e-2, 1e-4, 1e-6] {
            triangles.push([at(-1.0, -1.0, height), at(0.0, 2.0, height), at(1.0, -1.0, height)]);
            triangles.push([at(-1.0, 0.0, height), at(0.0, 2.0, height), at(1.0, 0.0, height)]);
            triangles.push([at(0.0, 0.0, height), at(0.5, 2.0, height), at(1.0, 0.0, height)]);
        }
        triangles
    }

    #[test]
    fn solid_angles_have_their_known_values() {
        let octant = SphericalTriangle::new([DVec3::X, DVec3::Z, DVec3::Y]);
        assert!((octant.solid_angle() - FRAC_PI_2).abs() < 1e-15);
        assert_eq!(SphericalTriangle::new([DVec3::X, DVec3::Y, DVec3::Z]).solid_angle(), 0.0);
        // In the plane, and at a corner.
        let flat = [DVec3::new(1.0, 0.0, 0.0), DVec3::new(2.0, 1.0, 0.0), DVec3::new(2.0, 0.0, 0.0)];
        assert_eq!(SphericalTriangle::new(flat).solid_angle(), 0.0);
        assert_eq!(SphericalTriangle::new([DVec3::ZERO, DVec3::Y, DVec3::X]).solid_angle(), 0.0);
        // A wall that is all but touched fills a half-space, but for the strip that its nearest edge leaves open.
        let near = SphericalTriangle::new(triangles()[13]);
        assert!((near.solid_angle() - TAU).abs() < 1e-5, "{}", near.solid_angle());
        // A sliver as long as 2 with the mean width 2e-6 at 0.1: ∫ w(x) h / (x² + h²)^1.5 dx over its length.
        let sliver: f64 = (0..100_000)
            .map(|i| {
                let x = -1.0 + (f64::from(i) + 0.5) * 2e-5;
                let width = 2e-6 * if x < 0.3 { (x + 1.0) / 1.3 } else { (1.0 - x) / 0.7 };
                width * 0.1 / (x * x + 0.01).powf(1.5) * 2e-5
            })
            .sum();
        let got = SphericalTriangle::new(triangles()[2]).solid_angle();
        assert!((got / sliver - 1.0).abs() < 1e-6, "{got} {sliver}");
    }

    /// ∫ ω dω over a polygon is half the sum of θ Γ over its edges (Lambert 1760): all moments of first order in closed form.
    #[test]
    fn directions_are_uniform_and_inside_however_thin_or_near_the_triangle_is() {
        let count = 40_000;
        for corners in triangles() {
            let triangle = SphericalTriangle::new(corners);
            let [a, b, c] = corners;
            let height = a.dot((b - a).cross(c - a).normalize());
            let rounding = 1e-15 / (height * height).min(1.0);
            let mut stream = Stream::new(5, 0, 0);
            let (mut mean, mut square) = (DVec3::ZERO, DVec3::ZERO);
            for _ in 0..count {
                let direction = triangle.direction(stream.uniform2().as_dvec2());
                assert!((direction.length() - 1.0).abs() < 1e-9, "{corners:?}: {direction}");
                for i in 0..3 {
                    let edge = corners[(i + 1) % 3].cross(corners[i]).normalize();
                    assert!(edge.dot(direction) > -1e-9 - rounding, "{corners:?}: {direction} is outside");
                }
                mean += direction / f64::from(count);
                square += direction * direction / f64::from(count);
            }
            let mut expected = DVec3::ZERO;
            for i in 0..3 {
                let (from, to) = (corners[i], corners[(i + 1) % 3]);
                let axis = to.cross(from);
                expected += 0.5 * axis.length().atan2(from.dot(to)) * axis.normalize();
            }
            expected /= triangle.solid_angle();
            let deviation = (square - mean * mean).max(DVec3::ZERO).map(f64::sqrt) / f64::from(count).sqrt();
            // 48 means: one of them is beyond 4.5 standard errors once in some 3,000. Single numbers have 24 bits.
            let miss = (mean - expected).abs();
            assert!(miss.cmple(4.5 * deviation + 1e-7 + rounding).all(), "{corners:?}: {mean} {expected} {deviation}");
        }
    }
}
