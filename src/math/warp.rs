//! Maps from the unit square to shapes.

use glam::{Mat3A, Vec2, Vec3A};
use std::f32::consts::FRAC_PI_4;

/// An orthonormal right-handed frame whose z axis is the unit vector `normal` (Duff et al. 2017).
pub fn frame(normal: Vec3A) -> Mat3A {
    let sign = 1.0_f32.copysign(normal.z);
    let a = -1.0 / (sign + normal.z);
    let b = normal.x * normal.y * a;
    Mat3A::from_cols(
        Vec3A::new(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x),
        Vec3A::new(b, sign + normal.y * normal.y * a, -normal.y),
        normal,
    )
}

/// Maps the unit square onto the unit disc, keeping ratios of areas (Shirley, Chiu 1997).
pub fn disc(point: Vec2) -> Vec2 {
    let offset = 2.0 * point - Vec2::ONE;
    if offset == Vec2::ZERO {
        return Vec2::ZERO;
    }
    let (radius, angle) = if offset.x.abs() > offset.y.abs() {
        (offset.x, FRAC_PI_4 * (offset.y / offset.x))
    } else {
        (offset.y, 2.0 * FRAC_PI_4 - FRAC_PI_4 * (offset.x / offset.y))
    };
    radius * Vec2::from_angle(angle)
}

/// Unit direction around +z with the density cos θ / π (Malley's method): a disc lifted onto the hemisphere.
pub fn cosine_hemisphere(point: Vec2) -> Vec3A {
    let on_disc = disc(point);
    Vec3A::new(on_disc.x, on_disc.y, (1.0 - on_disc.length_squared()).max(0.0).sqrt())
}

/// Unit direction with a density in proportion to the cosine to `normal`, of those that are above the plane of `facing`
/// also: cos θ / (π · [`share_above`]). Both are unit vectors with an angle below 90° between them.
///
/// Seen along `normal`, the hemisphere is a disc, and what is above the plane a half disc and half an ellipse. Each of its
/// chords in the direction in which `facing` is tilted is the same share of that of the disc, so that stretching these keeps
/// ratios of areas.
#[inline]
pub fn cosine_above(normal: Vec3A, facing: Vec3A, point: Vec2) -> Vec3A {
    if normal == facing { frame(normal) * cosine_hemisphere(point) } else { cut_cosine(normal, facing, point) }
}

fn cut_cosine(normal: Vec3A, facing: Vec3A, point: Vec2) -> Vec3A {
    let around = frame(normal);
    let towards = around.transpose() * facing;
    let tilt = towards.truncate().try_normalize().unwrap_or(Vec2::X);
    let on_disc = disc(point);
    let half_chord = (1.0 - on_disc.y * on_disc.y).max(0.0).sqrt();
    let along = if half_chord > 0.0 { (on_disc.x / half_chord).clamp(-1.0, 1.0) } else { 0.0 };
    let share = share_above(normal, facing);
    let along = share * along + (1.0 - share);
    let height = half_chord * (1.0 - along * along).max(0.0).sqrt();
    let turned = tilt.rotate(Vec2::new(half_chord * along, on_disc.y));
    around * turned.extend(height).to_vec3a()
}

/// Share of a cosine lobe round `normal` that is above the plane of `facing`, in [1/2, 1]; unit vectors as in
/// [`cosine_above`].
#[inline]
pub fn share_above(normal: Vec3A, facing: Vec3A) -> f32 {
    if normal == facing { 1.0 } else { 0.5 + 0.5 * normal.dot(facing).clamp(0.0, 1.0) }
}

/// Barycentric weights of the second and third corner of a triangle, uniform by area (Heitz 2019: no folded square).
pub fn triangle(point: Vec2) -> Vec2 {
    if point.y > point.x {
        let second = point.x * 0.5;
        Vec2::new(second, point.y - second)
    } else {
        let third = point.y * 0.5;
        Vec2::new(point.x - third, third)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::{Stream, sobol2};
    use glam::DVec3;

    /// Of the density cos θ / (π · share) with share = (1 + cos δ)/2, by quadrature over a hemisphere: the mean height over
    /// each of the two planes, and that all is above both.
    #[test]
    fn a_tilted_cosine_lobe_is_cut_off_at_the_surface_and_keeps_its_shape() {
        for tilt in [0.0_f32, 1e-7, 1e-3, 0.2, 0.7, 1.5] {
            let (normal, facing) = (Vec3A::new(tilt.sin(), 0.0, tilt.cos()), Vec3A::Z);
            let share = share_above(normal, facing);
            assert!((share - 0.5 - 0.5 * tilt.cos()).abs() < 1e-6);
            let (mut expected, mut whole, rings) = (DVec3::ZERO, 0.0, 512);
            for (ring, step) in (0..rings).flat_map(|ring| (0..4 * rings).map(move |step| (ring, step))) {
                let height = (ring as f32 + 0.5) / rings as f32;
                let around = Vec2::from_angle(std::f32::consts::TAU * (step as f32 + 0.5) / (4 * rings) as f32);
                let direction = (around * (1.0 - height * height).sqrt()).extend(height).to_vec3a();
                let weight = direction.dot(normal).max(0.0);
                whole += f64::from(weight);
                expected += (weight * direction).as_dvec3();
            }
            let (mut sum, count) = (DVec3::ZERO, 1 << 16);
            for i in 0..count {
                let direction = cosine_above(normal, facing, sobol2(i, 0, 7));
                assert!((direction.length() - 1.0).abs() < 1e-5, "{tilt}: {direction}");
                assert!(direction.dot(normal) >= -1e-6 && direction.dot(facing) >= -1e-6, "{tilt}: {direction}");
                sum += direction.as_dvec3();
            }
            // The midpoint rule is right to some 1/512² here, and 65,536 points of a sequence to about one over their number.
            let (got, expected) = (sum / f64::from(count), expected / whole);
            assert!(got.distance(expected) < 1e-4, "{tilt}: {got} {expected}");
        }
    }

    #[test]
    fn frames_are_orthonormal_and_right_handed_in_every_direction() {
        let mut stream = Stream::new(1, 0, 0);
        for _ in 0..1000 {
            let normal = Vec3A::new(stream.uniform(), stream.uniform(), stream.uniform()) - 0.5;
            let frame = frame(normal.normalize());
            // Each entry is a sum of a few products of numbers up to 1.
            assert!((frame.determinant() - 1.0).abs() < 1e-5);
            assert!((frame * frame.transpose()).abs_diff_eq(Mat3A::IDENTITY, 1e-5));
        }
        assert!(frame(Vec3A::NEG_Z).is_finite() && frame(Vec3A::Z).is_finite());
    }

    #[test]
    fn cosine_directions_have_the_moments_of_their_density() {
        // ∫ cos θ · cos θ/π dω = 2/3 and ∫ cos² θ · cos θ/π dω = 1/2; 4096 Sobol points are good to about 1e-4.
        let n = 4096;
        let (mut first, mut second) = (0.0, 0.0);
        for i in 0..n {
            let z = f64::from(cosine_hemisphere(sobol2(i, 0, 3)).z);
            first += z / f64::from(n);
            second += z * z / f64::from(n);
        }
        assert!((first - 2.0 / 3.0).abs() < 1e-3 && (second - 0.5).abs() < 1e-3, "{first} {second}");
    }

    #[test]
    fn triangle_points_stay_inside_and_average_to_the_centroid() {
        let n = 4096;
        let mut mean = Vec2::ZERO;
        for i in 0..n {
            let weights = triangle(sobol2(i, 0, 9));
            assert!(weights.min_element() >= 0.0 && weights.element_sum() <= 1.0);
            mean += weights / n as f32;
        }
        assert!(mean.abs_diff_eq(Vec2::splat(1.0 / 3.0), 1e-3), "{mean}");
    }

    #[test]
    fn the_centre_of_the_square_is_the_centre_of_the_disc() {
        assert_eq!(disc(Vec2::splat(0.5)), Vec2::ZERO);
        assert!((disc(Vec2::new(1.0, 0.5)).length() - 1.0).abs() < 1e-6);
    }
}
