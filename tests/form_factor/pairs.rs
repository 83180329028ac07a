//! What holds for the form factors of any two polygons.

use crate::center;
use glam::{DQuat, DVec3};
use lightwell::math::polygon::{
    Plate, area_form_factor, form_factor, occluded_area_form_factor, vector_area, visible_form_factor,
};
use lightwell::math::random::Stream;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// Rounding of a contour integral, generously.
const ROUNDING: f64 = 1e-11;

fn direction() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0, 0.0..TAU).prop_map(|(z, angle): (f64, f64)| {
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
    })
}

fn rotation() -> impl Strategy<Value = DQuat> {
    (direction(), 0.0..TAU).prop_map(|(axis, angle)| DQuat::from_axis_angle(axis, angle))
}

fn point() -> impl Strategy<Value = DVec3> {
    (direction(), 0.0..1.0).prop_map(|(direction, radius)| radius * direction)
}

/// A convex polygon of three to six corners, which lie on an ellipse, with its centre up to 1 from the origin.
fn polygon() -> impl Strategy<Value = Vec<DVec3>> {
    let angles = prop::collection::vec(0.3..1.0, 3..=6);
    (angles, 0.2..1.0, 0.05..1.0, rotation(), point()).prop_map(|(steps, long, short, turn, center)| {
        let all: f64 = steps.iter().sum();
        let mut angle = 0.0;
        let corner = |step: &f64| {
            angle += step / all * TAU;
            center + turn * DVec3::new(long * f64::cos(angle), long * short * f64::sin(angle), 0.0)
        };
        steps.iter().map(corner).collect()
    })
}

/// A triangle or quad like those.
fn small_polygon() -> impl Strategy<Value = Vec<DVec3>> {
    polygon().prop_map(|mut corners| {
        corners.truncate(4);
        corners
    })
}

/// Two polygons, moved apart by up to three.
fn pair() -> impl Strategy<Value = (Vec<DVec3>, Vec<DVec3>)> {
    (polygon(), polygon(), direction(), 0.0..3.0)
        .prop_map(|(from, to, way, distance)| (from, to.iter().map(|corner| corner + distance * way).collect()))
}

/// Turned over where that makes it face the point.
fn facing(corners: &[DVec3], point: DVec3) -> Vec<DVec3> {
    let mut corners = corners.to_vec();
    if vector_area(&corners).dot(point - corners[0]) < 0.0 {
        corners.reverse();
    }
    corners
}

fn is_in_front(corners: &[DVec3], of: &[DVec3]) -> bool {
    corners.iter().all(|corner| vector_area(of).dot(corner - of[0]) > 0.0)
}

fn area(corners: &[DVec3]) -> f64 {
    vector_area(corners).length()
}

/// The share of cosine-distributed rays in double precision from random points of `from` that meet the front of `to`.
fn share_of_rays(from: &[DVec3], to: &[DVec3], rays: u64, seed: u64) -> f64 {
    let (normal, front) = (vector_area(from).normalize(), vector_area(to));
    let (across, up) = normal.any_orthonormal_pair();
    let all = area(from);
    let mut stream = Stream::new(seed, 0, 0);
    let mut arrives = || {
        let mut left = f64::from(stream.uniform()) * all;
        let triangle = from[1..].windows(2).find(|pair| {
            left -= area(&[from[0], pair[0], pair[1]]);
            left < 0.0
        });
        let pair = triangle.unwrap_or(&from[1..3]);
        let (u, v) = (f64::from(stream.uniform()).sqrt(), f64::from(stream.uniform()));
        let origin = from[0] + u * (pair[0] - from[0]) + u * v * (pair[1] - pair[0]);
        let (square, angle) = (f64::from(stream.uniform()), TAU * f64::from(stream.uniform()));
        let way = square.sqrt() * (angle.cos() * across + angle.sin() * up) + (1.0 - square).sqrt() * normal;
        let toward = way.dot(front);
        let distance = (to[0] - origin).dot(front) / toward;
        let hit = origin + distance * way;
        let ends = to.iter().cycle().skip(1);
        let inside = to.iter().zip(ends).all(|(a, b)| (b - a).cross(hit - a).dot(front) >= 0.0);
        toward < 0.0 && distance > 0.0 && inside
    };
    (0..rays).filter(|_| arrives()).count() as f64 / rays as f64
}

/// ∫∫ cosθ cosθ' / (π r²) over the triangles of both polygons, each cut into n × n by whose middles it counts.
fn product_quadrature(from: &[DVec3], to: &[DVec3], n: usize) -> f64 {
    let points = |corners: &[DVec3]| -> Vec<(DVec3, f64)> {
        corners[1..]
            .windows(2)
            .flat_map(|pair| {
                let (a, along, across) =
                    (corners[0], (pair[0] - corners[0]) / n as f64, (pair[1] - corners[0]) / n as f64);
                let weight = 0.5 * along.cross(across).length();
                // Middles of the small triangles, those that point up and those that point down.
                let up =
                    (0..n).flat_map(move |i| (0..n - i).map(move |j| (i as f64 + 1.0 / 3.0, j as f64 + 1.0 / 3.0)));
                let down = (0..n).flat_map(move |i| {
                    (0..n - 1 - i.min(n - 1)).map(move |j| (i as f64 + 2.0 / 3.0, j as f64 + 2.0 / 3.0))
                });
                up.chain(down).map(move |(u, v)| (a + u * along + v * across, weight)).collect::<Vec<_>>()
            })
            .collect()
    };
    let (normal, front) = (vector_area(from).normalize(), vector_area(to).normalize());
    let (ours, theirs) = (points(from), points(to));
    let kernel = |x: DVec3, y: DVec3| {
        let way = y - x;
        way.dot(normal).max(0.0) * (-way.dot(front)).max(0.0) / (PI * way.length_squared().powi(2))
    };
    let sum: f64 = ours.iter().map(|(x, w)| theirs.iter().map(|(y, v)| w * v * kernel(*x, *y)).sum::<f64>()).sum();
    sum / area(from)
}

/// The edges that two polygons get where each is cut at the other's plane lie on one line, but for rounding: here their
/// directions differ by 1e-14, so that where they meet cannot be told.
#[test]
fn edges_on_one_line_but_for_rounding_lose_no_digits() {
    let from = [
        DVec3::new(-0.03818429535014167, 0.456298585950905, -0.4827503886901052),
        DVec3::new(-0.19174586190161802, -0.2995913046184382, -0.5287238158062241),
        DVec3::new(0.5606341759373479, 0.06134147461392489, -0.5114006868110678),
    ];
    let to = [
        DVec3::new(1.0132651313254781, 0.1724617251796655, -0.7621264518842166),
        DVec3::new(0.4038490273869088, 0.15651196724261848, -0.7757001943588236),
        DVec3::new(0.7540322816438436, -0.12888810370123982, -0.5236511788467638),
        DVec3::new(1.5028853378595701, 0.014997798899122734, -0.6100285480529347),
    ];
    let (there, back) = (area_form_factor(&from, &to), area_form_factor(&to, &from));
    assert!((area(&from) * there - area(&to) * back).abs() < 1e-14, "{there} {back}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn form_factors_are_bounded_and_reciprocal((from, to) in pair()) {
        let (there, back) = (area_form_factor(&from, &to), area_form_factor(&to, &from));
        prop_assert!((0.0..=1.0).contains(&there));
        prop_assert!((area(&from) * there - area(&to) * back).abs() < ROUNDING, "{there} {back}");
    }

    #[test]
    fn form_factors_do_not_depend_on_place_direction_or_scale(
        (from, to) in pair(), turn in rotation(), shift in point(), scale in -6.0..6.0,
    ) {
        let scale = 10f64.powf(scale);
        let moved = |corners: &[DVec3]| -> Vec<DVec3> {
            corners.iter().map(|corner| scale * (turn * *corner + shift)).collect()
        };
        let (before, after) = (area_form_factor(&from, &to), area_form_factor(&moved(&from), &moved(&to)));
        prop_assert!((before - after).abs() < ROUNDING * (1.0 + 1.0 / area(&from)), "{before} {after}");
    }

    #[test]
    fn halves_exchange_as_much_as_the_whole((from, to) in pair(), share in 0.1..0.9) {
        // Cut from the first corner to a point of an edge.
        let cut = to[1].lerp(to[2], share);
        let one = [to[0], to[1], cut];
        let other: Vec<DVec3> = [to[0], cut].into_iter().chain(to[2..].iter().copied()).collect();
        let sum = area_form_factor(&from, &one) + area_form_factor(&from, &other);
        let whole = area_form_factor(&from, &to);
        prop_assert!((sum - whole).abs() < ROUNDING * (1.0 + 1.0 / area(&from)), "{sum} {whole}");
    }

    #[test]
    fn the_sides_of_a_skew_box_take_all_that_one_of_them_sends(
        turn in rotation(), [a, b, c] in [point(), point(), point()],
    ) {
        let edges = [DVec3::X + 0.4 * a, DVec3::Y + 0.4 * b, 0.5 * DVec3::Z + 0.4 * c].map(|edge| turn * edge);
        let middle = 0.5 * (edges[0] + edges[1] + edges[2]);
        let sides: Vec<Vec<DVec3>> = (0..6)
            .map(|side| {
                let (out, along, across) = (edges[side % 3], edges[(side + 1) % 3], edges[(side + 2) % 3]);
                facing(&crate::rectangle(if side < 3 { DVec3::ZERO } else { out }, along, across), middle)
            })
            .collect();
        for from in &sides {
            let sum: f64 = sides.iter().map(|to| area_form_factor(from, to)).sum();
            prop_assert!((sum - 1.0).abs() < ROUNDING, "{sum}");
        }
    }

    #[test]
    fn rays_agree_within_their_deviation((from, to) in pair(), seed in any::<u64>()) {
        let to = facing(&to, center(&from));
        let exact = area_form_factor(&from, &to);
        let rays = 20_000;
        let got = share_of_rays(&from, &to, rays, seed);
        // Five standard deviations of a share of independent rays, and one ray.
        let deviation = (exact * (1.0 - exact) / rays as f64).sqrt();
        prop_assert!((got - exact).abs() < 5.0 * deviation + 2.0 / rays as f64, "{got} for {exact}");
    }

    #[test]
    fn product_quadrature_converges_to_the_contours(from in polygon(), to in polygon(), way in direction()) {
        // Centres up to 1 from places that are 5 apart, and corners up to 1 from the centres: at least 1 apart.
        let to: Vec<DVec3> = to.iter().map(|corner| corner + 5.0 * way).collect();
        let (from, to) = (facing(&from, center(&to)), facing(&to, center(&from)));
        prop_assume!(is_in_front(&from, &to) && is_in_front(&to, &from));
        let exact = area_form_factor(&from, &to);
        let (coarse, fine) = (product_quadrature(&from, &to, 4), product_quadrature(&from, &to, 8));
        // The midpoint rule is of second order: the finer one is off by a third of the difference, but for terms of the
        // fourth order. Those are below 13 (w/r)⁴ A / (π r²) for pieces of radius w = 1/8 at distance r, here at least
        // 1.
        let fourth_order = 13.0 / 4096.0 * area(&to) / PI;
        prop_assert!((fine - exact).abs() < (coarse - fine).abs() + fourth_order, "{coarse} {fine} for {exact}");
        let plates = Plate::new(&from[..3]).exchange(&Plate::new(&to[..3]), 1e-6);
        let contours = area(&from[..3]) * area_form_factor(&from[..3], &to[..3]);
        prop_assert!((plates - contours).abs() < 1e-6 * area(&from[..3]));
    }

    #[test]
    fn a_point_sees_no_more_for_an_occluder(
        eye in point(), (_, to) in pair(), occluders in prop::collection::vec(polygon(), 0..4),
    ) {
        let to = facing(&to, eye);
        let normal = (center(&to) - eye).normalize_or(DVec3::Z);
        let whole = form_factor(eye, normal, &to[..3]);
        let mut before = visible_form_factor(eye, normal, &to[..3], &[]);
        prop_assert!((before - whole).abs() < 1e-14);
        for count in 1..=occluders.len() {
            let seen = visible_form_factor(eye, normal, &to[..3], &occluders[..count]);
            prop_assert!(seen <= before + 1e-13, "{seen} {before}");
            before = seen;
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn occlusion_takes_away_what_it_says(
        from in small_polygon(), to in polygon(), occluder in polygon(), way in direction(),
    ) {
        let to: Vec<DVec3> = to.iter().map(|corner| corner + 3.0 * way).collect();
        let from = facing(&from, center(&to));
        let to = facing(&to, center(&from));
        let occluders = [occluder.iter().map(|corner| corner + 1.5 * way).collect::<Vec<_>>()];
        let open = area_form_factor(&from, &to);
        let seen = occluded_area_form_factor(&from, &to, &occluders, 1e-5);
        prop_assert!(seen <= open + 1e-4, "{seen} {open}");
        let (back, fourth) = (center(&to), to.len() <= 4);
        if fourth && vector_area(&from).dot(back - from[0]) > 0.0 {
            let there = area(&to) * occluded_area_form_factor(&to, &from, &occluders, 1e-5);
            prop_assert!((area(&from) * seen - there).abs() < 1e-4, "{seen} {there}");
        }
    }
}
