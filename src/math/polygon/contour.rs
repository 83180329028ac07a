//! Form factor from polygon to polygon by their contours.
//!
//! By Stokes' theorem F = 1 / (2 π A) ∮∮ ln r dx · dx', a sum over all pairs of edges (Sparrow 1963). The integral over
//! one edge of a pair has a closed form (Mitalas, Stephenson 1966), and here the one over both has too wherever the
//! edges lie in one plane: if they are parallel, and by Euler's theorem on homogeneous functions if their lines meet.
//! This holds for all edges that touch, so no integrand is ever singular. What is left are edges that pass each other
//! at a distance. Where their integrand has its singularities in the complex plane is known, so Gauss-Legendre
//! quadrature on intervals that keep away from them converges at a known rate.

use super::gauss::GAUSS_8;
use super::{clip_above, vector_area};
use glam::DVec3;
use std::f64::consts::TAU;

/// Corners of a polygon clipped at a plane: twice those of the largest in [`area_form_factor`].
const MAX_CORNERS: usize = 24;
/// Rounding of a form factor.
const ROUNDING: f64 = 1e-14;
/// Lines that pass each other within this share of the edges' length, times the root of the sine of their angle, meet.
/// That neglects the area c² / sin of where they are nearer than that gap c, times a logarithm.
const MEETING: f64 = 1e-7;
/// Where lines meet, in lengths of the longer edge. The closed form is a difference of terms that grow with the square.
const FARTHEST_MEETING: f64 = 32.0;
/// An interval of quadrature is this many times farther from the next singularity than its half length. With n points
/// the error is in proportion to (3 + √8)^(−2 n), with 8 to 6e-13.
const SEPARATION: f64 = 3.0;
/// Form factor from one planar convex polygon to another, F in [0, 1], with nothing between them: the share of the
/// diffuse flux that leaves the front of `from` and arrives at the front of `to`. Each has three to twelve corners,
/// counter-clockwise seen from its front.
///
/// The error is about 1e-13 of the larger of 1 and the ratio of their areas; whether they touch or are very near makes
/// no difference.
pub fn area_form_factor(from: &[DVec3], to: &[DVec3]) -> f64 {
    let area = vector_area(from).length();
    if area > 0.0 { (exchange(from, to, ROUNDING) / area).clamp(0.0, 1.0) } else { 0.0 }
}

/// Area of either polygon times its form factor to the other, m²; it may be negative by rounding. Edges whose
/// directions differ by less than `angle` (rad) are taken for parallel, and those that are as near to a right angle do
/// not count.
pub(super) fn exchange(one: &[DVec3], other: &[DVec3], angle: f64) -> f64 {
    // What two polygons see of each other is what each has in front of the other.
    let (origin, one_normal, other_normal) = (one[0], vector_area(one), vector_area(other));
    let (mut first, mut second) = ([DVec3::ZERO; MAX_CORNERS], [DVec3::ZERO; MAX_CORNERS]);
    let first_count = clip_above(other[0], other_normal, one, &mut first);
    let second_count = clip_above(origin, one_normal, other, &mut second);
    let (first, second) = (&mut first[..first_count], &second[..second_count]);
    if first.len() < 3 || second.len() < 3 {
        return 0.0;
    }
    first.iter_mut().for_each(|corner| *corner += other[0] - origin);
    // Any constant may be added to the logarithm, since each contour is closed: this one keeps its values small.
    let unit = mean(second).distance_squared(mean(first)).max(one_normal.length());
    let pairs = edges(first).flat_map(|edge| edges(second).map(move |other| (edge, other)));
    pairs.map(|(edge, other)| edge_exchange(&edge, &other, unit, angle)).sum::<f64>() / TAU
}

fn mean(corners: &[DVec3]) -> DVec3 {
    corners.iter().sum::<DVec3>() / corners.len() as f64
}

/// Edges of a polygon, but for those without length.
fn edges(corners: &[DVec3]) -> impl Iterator<Item = Edge> {
    let ends = corners.iter().cycle().skip(1);
    corners.iter().zip(ends).filter_map(|(&start, &end)| {
        let length = start.distance(end);
        (length > 0.0).then(|| Edge { start, direction: (end - start) / length, length })
    })
}

#[derive(Clone, Copy)]
struct Edge {
    start: DVec3,
    /// Unit length.
    direction: DVec3,
    length: f64,
}

impl Edge {
    fn reversed(self) -> Self {
        Self { start: self.start + self.length * self.direction, direction: -self.direction, length: self.length }
    }
}

/// ∫∫ ½ ln(r² / unit) dx · dx' along two edges.
fn edge_exchange(edge: &Edge, other: &Edge, unit: f64, angle: f64) -> f64 {
    let cosine = edge.direction.dot(other.direction);
    if cosine.abs() < angle {
        return 0.0;
    }
    let axis = edge.direction.cross(other.direction);
    let sine = axis.length();
    if sine < angle {
        let aligned = if cosine < 0.0 { other.reversed() } else { *other };
        return cosine.signum() * parallel_edges(edge, &aligned, unit);
    }
    // Places on the two lines where they are nearest, measured from the starts along the directions. The first is known
    // badly where the lines are almost parallel; the second and the gap are those that belong to it.
    let way = other.start - edge.start;
    let near = way.cross(other.direction).dot(axis) / (sine * sine);
    let apart = near * edge.direction - way;
    let other_near = apart.dot(other.direction);
    let gap = (apart - other_near * other.direction).length();
    let longer = edge.length.max(other.length);
    let farthest = near.abs().max(other_near.abs());
    cosine
        * if gap <= MEETING * sine.sqrt() * longer && farthest <= FARTHEST_MEETING * longer {
            meeting_edges([-near, edge.length - near], [-other_near, other.length - other_near], (cosine, sine), unit)
        } else if edge.length <= other.length {
            passing_edges(edge, other, (near, gap / sine), unit)
        } else {
            passing_edges(other, edge, (other_near, gap / sine), unit)
        }
}

/// ∫∫ ½ ln(r² / unit) ds dt over two edges of one direction.
fn parallel_edges(edge: &Edge, other: &Edge, unit: f64) -> f64 {
    let way = other.start - edge.start;
    let shift = way.dot(edge.direction);
    let square = way.cross(edge.direction).length_squared();
    let distance = square.sqrt();
    // Its second derivative is the integrand, as a function of the difference of the places on the two edges.
    let twice_integrated = |x: f64| {
        0.25 * (x * x - square) * logarithm(x * x + square, unit) - 0.75 * x * x + distance * x * x.atan2(distance)
    };
    twice_integrated(shift + other.length)
        - twice_integrated(shift)
        - twice_integrated(shift + other.length - edge.length)
        + twice_integrated(shift - edge.length)
}

/// ∫∫ ½ ln(r² / unit) ds dt over two edges on lines that meet at an angle of this cosine and sine. `ends` are the
/// places of an edge's start and end, measured along it from the meeting point.
///
/// Over [0, a] × [0, b] from the meeting point the integral D is homogeneous up to a logarithm: D(k a, k b) = k² (D(a,
/// b) + a b ln k). The derivative by k is a ∂D/∂a + b ∂D/∂b = 2 D + a b, and ∂D/∂a is an integral along one edge alone.
fn meeting_edges(
    [start, end]: [f64; 2],
    [other_start, other_end]: [f64; 2],
    (cosine, sine): (f64, f64),
    unit: f64,
) -> f64 {
    // ∂D/∂a: along the other line from the meeting point to b, seen from a.
    let along = |a: f64, b: f64| line_integral(-a * cosine, b - a * cosine, (a * sine).powi(2), unit);
    let from_meeting = |a: f64, b: f64| 0.5 * (a * along(a, b) + b * along(b, a) - a * b);
    from_meeting(end, other_end) - from_meeting(start, other_end) - from_meeting(end, other_start)
        + from_meeting(start, other_start)
}

/// ln(square / unit), or 0 for 0: what it is multiplied with is 0 then.
fn logarithm(square: f64, unit: f64) -> f64 {
    if square > 0.0 { (square / unit).ln() } else { 0.0 }
}

/// ∫ ½ ln((t² + square) / unit) dt from `low` to `high`, places on a line measured from the foot of the point that is
/// √`square` off it.
fn line_integral(low: f64, high: f64, square: f64, unit: f64) -> f64 {
    let term = |t: f64| 0.5 * t * logarithm(t * t + square, unit);
    let distance = square.sqrt();
    let angle = if distance > 0.0 { (distance * (high - low)).atan2(square + low * high) } else { 0.0 };
    term(high) - term(low) - (high - low) + distance * angle
}

/// ∫∫ ½ ln(r² / unit) ds dt over two edges on lines that do not meet. `nearest` is the place on the line of `edge` that
/// is nearest to the other line, and how far from it in the imaginary direction the two would meet.
fn passing_edges(edge: &Edge, other: &Edge, nearest: (f64, f64), unit: f64) -> f64 {
    // Seen from the start of `edge`, and per length along it: the start of `other`.
    let way = other.start - edge.start;
    let along = |s: f64| {
        let way = way - s * edge.direction;
        let low = way.dot(other.direction);
        line_integral(low, low + other.length, (way - low * other.direction).length_squared(), unit)
    };
    let foot = |point: DVec3| {
        let place = point.dot(edge.direction);
        (place, (point - place * edge.direction).length())
    };
    let at_nearest = (nearest.0 * edge.direction - way).dot(other.direction);
    // The integrand has no singularity where the lines are nearest unless that is within the other edge.
    let crosses = at_nearest > 0.0 && at_nearest < other.length;
    let [start, end] = [foot(way), foot(way + other.length * other.direction)];
    let singularities = [start, end, if crosses { nearest } else { start }];
    integrate(&along, 0.0, edge.length, &singularities)
}

/// ∫ f from `low` to `high`, in intervals that keep away from the singularities: (real part, imaginary part > 0).
fn integrate(f: &impl Fn(f64) -> f64, low: f64, high: f64, singularities: &[(f64, f64); 3]) -> f64 {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let is_near = |&(real, imaginary): &(f64, f64)| (real - middle).hypot(imaginary) < SEPARATION * half;
    if singularities.iter().any(is_near) && middle > low && middle < high {
        return integrate(f, low, middle, singularities) + integrate(f, middle, high, singularities);
    }
    (high - low) * GAUSS_8.iter().map(|(x, weight)| weight * f(low + x * (high - low))).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polygon::known::{parallel_rectangles, perpendicular_rectangles};
    use crate::math::random::Stream;
    use glam::DQuat;

    /// A rectangle in the plane z = `height` that faces up.
    fn floor(low: [f64; 2], high: [f64; 2], height: f64) -> [DVec3; 4] {
        [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
            .map(|(x, y)| DVec3::new(x, y, height))
    }

    fn turned_over(mut corners: [DVec3; 4]) -> [DVec3; 4] {
        corners.reverse();
        corners
    }

    #[test]
    fn facing_squares_have_the_published_values_at_every_gap() {
        let unit = floor([0.0, 0.0], [1.0, 1.0], 0.0);
        for gap in [100.0, 10.0, 2.0, 1.0, 0.5, 0.1, 0.01, 1e-3, 1e-6, 1e-9] {
            let got = area_form_factor(&unit, &turned_over(floor([0.0, 0.0], [1.0, 1.0], gap)));
            let exact = parallel_rectangles(1.0, 1.0, gap);
            assert!((got - exact).abs() < 1e-12, "gap {gap}: {got} for {exact}");
        }
    }

    /// A rectangle in the plane x = 0 that faces x and stands on y from 0 to `length`.
    fn wall(length: f64, height: f64) -> [DVec3; 4] {
        [(0.0, 0.0), (length, 0.0), (length, height), (0.0, height)].map(|(y, z)| DVec3::new(0.0, y, z))
    }

    #[test]
    fn perpendicular_rectangles_with_a_common_edge_have_the_published_values() {
        for size in [0.1, 0.4, 1.0, 2.0, 10.0] {
            let got = area_form_factor(&floor([0.0, 0.0], [size, 1.0], 0.0), &wall(1.0, size));
            let exact = perpendicular_rectangles(size, size, 1.0);
            assert!((got - exact).abs() < 1e-13, "size {size}: {got} for {exact}");
        }
    }

    /// The triangles between the edges of a quad and a point of it.
    fn fan(corners: &[DVec3; 4], apex: DVec3) -> [[DVec3; 3]; 4] {
        std::array::from_fn(|i| [apex, corners[i], corners[(i + 1) % 4]])
    }

    #[test]
    fn parts_cut_in_any_way_exchange_as_much_as_the_whole() {
        // The cuts make edges that pass each other at any angle and distance, and edges that meet at any angle.
        let mut stream = Stream::new(1, 0, 0);
        let mut uniform = move || f64::from(stream.uniform());
        for round in 0..200 {
            let gap = 10f64.powf(-7.0 * uniform());
            let lower = floor([0.0, 0.0], [1.0, 1.0], 0.0);
            let (other, exact) = if round % 2 == 0 {
                (turned_over(floor([0.0, 0.0], [1.0, 1.0], gap)), parallel_rectangles(1.0, 1.0, gap))
            } else {
                (wall(1.0, 1.0), perpendicular_rectangles(1.0, 1.0, 1.0))
            };
            let turn = DQuat::from_euler(glam::EulerRot::XYZ, uniform() * TAU, uniform() * TAU, uniform() * TAU);
            let mut parts = |corners: &[DVec3; 4]| {
                let [a, b, _, d] = *corners;
                let apex = a + uniform() * (b - a) + uniform() * (d - a);
                fan(corners, apex).map(|triangle| triangle.map(|corner| turn * corner))
            };
            let (ones, others) = (parts(&lower), parts(&other));
            let sum: f64 = ones.iter().flat_map(|one| others.iter().map(|other| exchange(one, other, ROUNDING))).sum();
            // 16 pairs, each of 9 pairs of edges, each good to some 1e-13.
            assert!((sum - exact).abs() < 1e-11, "round {round}, gap {gap}: {sum} for {exact}");
        }
    }

    #[test]
    fn only_what_is_in_front_counts() {
        // A wall that goes through the floor, and a floor that goes on behind the wall.
        let exact = perpendicular_rectangles(1.0, 1.0, 1.0);
        let through = wall(1.0, 2.0).map(|corner| corner - DVec3::Z);
        let got = area_form_factor(&floor([0.0, 0.0], [1.0, 1.0], 0.0), &through);
        assert!((got - exact).abs() < 1e-13, "{got}");
        let got = area_form_factor(&floor([-1.0, 0.0], [1.0, 1.0], 0.0), &through);
        assert!((got - 0.5 * exact).abs() < 1e-13, "{got}");
        let back = turned_over(wall(1.0, 1.0));
        assert_eq!(area_form_factor(&floor([0.0, 0.0], [1.0, 1.0], 0.0), &back), 0.0);
        assert_eq!(area_form_factor(&[DVec3::ZERO; 3], &back), 0.0);
    }

    #[test]
    fn edges_on_lines_that_meet_agree_with_quadrature_at_every_angle() {
        let edge = Edge { start: DVec3::ZERO, direction: DVec3::X, length: 1.0 };
        for exponent in 0..=16 {
            for (place, other_place) in [(0.0, 0.0), (0.0, 0.4), (0.3, 0.4), (1.0, 0.0), (-0.5, 1.0), (1.7, 0.0)] {
                let angle = 10f64.powi(-exponent);
                let direction = DVec3::new(angle.cos(), angle.sin(), 0.0);
                let other = Edge { start: place * DVec3::X - other_place * direction, direction, length: 0.8 };
                let got = edge_exchange(&edge, &other, 1.0, ROUNDING);
                // Intervals that halve towards the meeting point down to the last digit.
                let expected = angle.cos() * passing_edges(&edge, &other, (place, 0.0), 1.0);
                assert!((got - expected).abs() < 1e-12, "{angle} {place} {other_place}: {got} for {expected}");
            }
        }
    }
}
