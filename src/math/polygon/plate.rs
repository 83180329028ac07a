//! Form factors between many pairs of triangles and quads: each is made ready once, and of each pair as much is
//! computed as its distance calls for.

use super::gauss::{GAUSS_2, GAUSS_3, GAUSS_4};
use super::{are_opposed, contour, vector_area};
use glam::DVec3;
use std::f64::consts::PI;

/// A planar convex triangle or quad, made ready for form factors to others.
#[derive(Clone, Debug)]
pub struct Plate {
    corners: [DVec3; 4],
    corner_count: usize,
    center: DVec3,
    normal: DVec3,
    area: f64,
    /// Distance of the farthest corner from the centre.
    radius: f64,
    /// √(a² + b²) for half lengths a and b of its longer edges in either direction.
    extent: f64,
    /// How much the density of points changes across it, from 0 for a parallelogram to 1 for a triangle.
    skew: f64,
    coarse: Points<4>,
    medium: Points<9>,
    fine: Points<16>,
}

/// Points to integrate over; the weights sum to the area.
#[derive(Clone, Debug)]
struct Points<const N: usize> {
    x: [f64; N],
    y: [f64; N],
    z: [f64; N],
    weight: [f64; N],
}

/// How much of a plate is in front of another's plane.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum InFront {
    None,
    Part,
    All,
}

impl Plate {
    /// Three or four corners, counter-clockwise seen from the front.
    pub fn new(corners: &[DVec3]) -> Self {
        let corner_count = corners.len();
        let vector_area = vector_area(corners);
        let corners = [corners[0], corners[1], corners[2], corners[corner_count - 1]];
        let [a, b, c, d] = corners;
        let center = corners[..corner_count].iter().sum::<DVec3>() / corner_count as f64;
        let normal = vector_area.normalize_or_zero();
        let along = a.distance(b).max(c.distance(d));
        let across = b.distance(c).max(d.distance(a));
        // The density of the bilinear map is linear in either direction; of the four at the corners the lowest counts.
        let densities = [(a, b, d), (b, c, a), (c, d, b), (d, a, c)]
            .map(|(at, next, last)| (next - at).cross(last - at).dot(normal));
        let lowest = densities.iter().copied().fold(f64::INFINITY, f64::min);
        let area = vector_area.length();
        Self {
            corners,
            corner_count,
            center,
            normal,
            area,
            radius: corners.iter().map(|corner| corner.distance(center)).fold(0.0, f64::max),
            extent: 0.5 * along.hypot(across),
            skew: if area > 0.0 { (1.0 - lowest / area).clamp(0.0, 1.0) } else { 0.0 },
            coarse: Points::new(&corners, normal, &GAUSS_2),
            medium: Points::new(&corners, normal, &GAUSS_3),
            fine: Points::new(&corners, normal, &GAUSS_4),
        }
    }

    /// Area, m².
    pub fn area(&self) -> f64 {
        self.area
    }

    /// A F, m²: the area of either plate times its form factor to the other, with nothing between them.
    ///
    /// The error is at most `tolerance` · A A' / (π r²) for the areas A, A' and the least distance r that plates of
    /// their size could have; most are far below. Plates that are nearer than a few of their sizes are computed from
    /// their contours. Of those that touch, what rises above the other's plane by less than this share of its size is
    /// no part of it, and the error is at most some `tolerance` · A.
    pub fn exchange(&self, other: &Self, tolerance: f64) -> f64 {
        let in_front = self.shows(other, tolerance).min(other.shows(self, tolerance));
        if in_front == InFront::None {
            return 0.0;
        }
        let least_distance = self.center.distance(other.center) - self.radius - other.radius;
        // Errors of angles count at most with the distance in lengths of the edges, which is below 10 where there are
        // contours.
        let by_contour = || contour::exchange(self.corners(), other.corners(), tolerance / 64.0);
        if in_front == InFront::Part || least_distance <= 0.0 {
            return by_contour();
        }
        let relative_extent = self.extent.max(other.extent) / least_distance;
        let [coarse, medium, fine] = error_bounds(relative_extent, self.skew.max(other.skew));
        if coarse <= tolerance {
            kernel_sum(self, &self.coarse, other, &other.coarse)
        } else if medium <= tolerance {
            kernel_sum(self, &self.medium, other, &other.medium)
        } else if fine <= tolerance {
            kernel_sum(self, &self.fine, other, &other.fine)
        } else {
            by_contour()
        }
    }

    fn corners(&self) -> &[DVec3] {
        &self.corners[..self.corner_count]
    }

    /// How much of the other plate is in front of this one. What is within this share of their radius of its plane is
    /// in it, unless the two face each other like parallel plates.
    fn shows(&self, other: &Self, tolerance: f64) -> InFront {
        let height = (other.center - self.center).dot(self.normal);
        if height > other.radius {
            return InFront::All;
        }
        if height < -other.radius {
            return InFront::None;
        }
        let heights = other.corners.map(|corner| (corner - self.center).dot(self.normal));
        let is_facing = are_opposed(self.normal, other.normal);
        let rounding = if is_facing { 0.0 } else { tolerance * self.radius.min(other.radius) };
        if heights.iter().all(|&height| height <= rounding) {
            InFront::None
        } else if heights.iter().all(|&height| height >= -rounding) {
            InFront::All
        } else {
            InFront::Part
        }
    }
}

impl<const N: usize> Points<N> {
    /// The products of a rule's points on a quad, by its bilinear map; a triangle is a quad whose last corner stands
    /// twice.
    fn new(&[a, b, c, d]: &[DVec3; 4], normal: DVec3, rule: &[(f64, f64)]) -> Self {
        let mut points = Self { x: [0.0; N], y: [0.0; N], z: [0.0; N], weight: [0.0; N] };
        let (along, across, twist) = (b - a, d - a, a - b + c - d);
        let products = rule.iter().flat_map(|v| rule.iter().map(move |u| (u, v)));
        for (i, (&(u, u_weight), &(v, v_weight))) in products.enumerate() {
            let (du, dv) = (along + v * twist, across + u * twist);
            [points.x[i], points.y[i], points.z[i]] = (a + u * along + v * dv).to_array();
            points.weight[i] = u_weight * v_weight * du.cross(dv).dot(normal);
        }
        points
    }

    /// Weight times the height above a plane, of each point.
    fn weighted_heights(&self, plane: &Plate) -> [f64; N] {
        let Plate { center, normal, .. } = plane;
        std::array::from_fn(|i| {
            let (x, y, z) = (self.x[i] - center.x, self.y[i] - center.y, self.z[i] - center.z);
            self.weight[i] * (x * normal.x + y * normal.y + z * normal.z)
        })
    }
}

/// How wrong the sums over coarse, medium and fine points are at most, in units of A A' / (π r²), for plates whose
/// larger extent is `q` times the least distance r.
///
/// With n points on [0, 1] the error of an integral is κ f⁽²ⁿ⁾ with κ = 1/270, 1/31500, 1/6945750, times the half
/// length to the power 2 n. Along a line in one of the plates the kernel is linear over r⁴, whose derivatives are sums
/// of Gegenbauer polynomials; the numbers are twice their highest values over all angles, times κ. The terms with
/// `skew` come from the density of points, which is linear along such a line.
fn error_bounds(q: f64, skew: f64) -> [f64; 3] {
    let q3 = q * q * q;
    let q5 = q3 * q * q;
    let q7 = q5 * q * q;
    [q3 * (2.31 * q + 1.54 * skew), q5 * (1.12 * q + 0.84 * skew), q7 * (0.46 * q + 0.37 * skew)]
}

/// ∫∫ cos θ cos θ' / (π r²) by quadrature. The height of a point of one plate above the plane of the other is r cos θ,
/// wherever on the other one looks from.
fn kernel_sum<const N: usize>(one: &Plate, from: &Points<N>, other: &Plate, to: &Points<N>) -> f64 {
    let from_heights = from.weighted_heights(other);
    let to_heights = to.weighted_heights(one);
    // One sum for each point of `to`, so that they are computed side by side.
    let mut sums = [0.0; N];
    for (i, from_height) in from_heights.into_iter().enumerate() {
        for (j, sum) in sums.iter_mut().enumerate() {
            let (x, y, z) = (to.x[j] - from.x[i], to.y[j] - from.y[i], to.z[j] - from.z[i]);
            let square = x * x + y * y + z * z;
            *sum += from_height * to_heights[j] / (square * square);
        }
    }
    sums.iter().sum::<f64>() / PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Stream;

    fn random(stream: &mut Stream) -> DVec3 {
        2.0 * DVec3::from_array(std::array::from_fn(|_| f64::from(stream.uniform()))) - 1.0
    }

    /// A convex polygon of this shape at a random place, turned at random.
    fn plate(stream: &mut Stream, shape: u64, distance: f64) -> Plate {
        let (across, up) = random(stream).normalize().any_orthonormal_pair();
        let center = distance * random(stream);
        let mut corner = |x: f64, y: f64| {
            let jitter = if shape == 2 { 0.3 * random(stream) } else { DVec3::ZERO };
            center + (x + jitter.x) * across + (y + jitter.y) * up
        };
        let corners = [corner(-1.0, -0.5), corner(1.0, -0.5), corner(1.5, 0.5), corner(-0.5, 0.5)];
        Plate::new(if shape == 0 { &corners[..3] } else { &corners })
    }

    #[test]
    fn points_weigh_as_much_as_the_plate() {
        let mut stream = Stream::new(1, 0, 0);
        for round in 0..30 {
            let plate = plate(&mut stream, round % 3, 1.0);
            let weights = [
                plate.coarse.weight.iter().sum::<f64>(),
                plate.medium.weight.iter().sum(),
                plate.fine.weight.iter().sum(),
            ];
            assert!(weights.iter().all(|weight| (weight - plate.area()).abs() < 1e-14), "{weights:?}");
        }
    }

    #[test]
    fn the_error_stays_below_the_tolerance_at_any_distance() {
        let mut stream = Stream::new(2, 0, 0);
        let mut by_contour = 0;
        for round in 0..60_000 {
            let distance = 1.0 + 60.0 * f64::from(stream.uniform());
            let (one, other) = (plate(&mut stream, round % 3, distance), plate(&mut stream, round / 3 % 3, distance));
            let exact = contour::exchange(one.corners(), other.corners(), 1e-14);
            let least = one.center.distance(other.center) - one.radius - other.radius;
            let unit = one.area * other.area / (PI * least * least);
            for tolerance in [1e-2, 1e-4, 1e-6] {
                let error = (one.exchange(&other, tolerance) - exact).abs();
                by_contour += u32::from(error == 0.0 && exact > 0.0);
                // The contours themselves are good to rounding in proportion to the distance.
                assert!(
                    error <= tolerance * unit + 1e-14 * distance || least <= 0.0,
                    "{round} {tolerance}: {error} {unit}"
                );
            }
        }
        assert!(by_contour < 40_000, "{by_contour}");
    }

    #[test]
    fn error_bounds_hold_and_are_not_empty() {
        let mut stream = Stream::new(4, 0, 0);
        let mut worst = [[0.0f64; 3]; 2];
        for round in 0..200_000 {
            let shapes = round % 2;
            let one = plate(&mut stream, 1 - shapes, 4.0);
            let other = plate(&mut stream, 1, 6.0);
            let least = one.center.distance(other.center) - one.radius - other.radius;
            if least < one.extent || one.shows(&other, 0.0).min(other.shows(&one, 0.0)) != InFront::All {
                continue;
            }
            let exact = contour::exchange(one.corners(), other.corners(), 1e-14);
            let unit = one.area * other.area / (PI * least * least);
            let bounds = error_bounds(one.extent.max(other.extent) / least, one.skew.max(other.skew));
            let sums = [
                kernel_sum(&one, &one.coarse, &other, &other.coarse),
                kernel_sum(&one, &one.medium, &other, &other.medium),
                kernel_sum(&one, &one.fine, &other, &other.fine),
            ];
            for (worst, (sum, bound)) in worst[shapes as usize].iter_mut().zip(sums.iter().zip(bounds)) {
                *worst = worst.max((sum - exact).abs() / (bound * unit));
            }
        }
        // The highest values over all angles do not meet in one pair, so the worst of them stays far below the bound.
        assert!(worst.iter().flatten().all(|share| (1e-4..1.0).contains(share)), "{worst:?}");
    }

    #[test]
    fn exchange_is_the_same_both_ways() {
        // By contours that pass each other one of two edges is integrated by quadrature, which is good to 6e-13.
        let mut stream = Stream::new(3, 0, 0);
        for round in 0..3000 {
            let (one, other) = (plate(&mut stream, round % 3, 6.0), plate(&mut stream, 1, 6.0));
            let (there, back) = (one.exchange(&other, 1e-4), other.exchange(&one, 1e-4));
            assert!((there - back).abs() < 1e-12 * one.area, "{there} {back}");
        }
    }
}
