//! Published values, and where the rough methods are wrong by how much.

use crate::{ceiling, center, facet, floor, pieces, rectangle, wall};
use glam::{DVec3, Vec3, Vec3A};
use lightwell::math::polygon::known::{coaxial_discs, hinged_strips, inside_of_sphere, perpendicular_rectangles};
use lightwell::math::polygon::{Plate, area_form_factor, form_factor};
use lightwell::math::random::Stream;
use lightwell::methods::radiosity::form_factor::centroid::{Facet, centroid, disc};
use lightwell::methods::radiosity::form_factor::hemicube::{Hemicube, Item};
use std::f64::consts::{PI, TAU};

/// Gap, exact F, centroid, disc, and F of the centre point of the facing unit squares.
const FACING: [(f64, f64, f64, f64, f64); 6] = [
    (10.0, 0.003_162_056_838_757_60, 1.006_7, 1.003_5, 0.003_172_525_532_555_43),
    (2.0, 0.068_589_588_818_552_4, 1.160, 1.075, 0.073_477_634_812_521_4),
    (1.0, 0.199_824_895_698_387, 1.593, 1.208, 0.239_456_470_460_774),
    (0.5, 0.415_253_283_577_147, 3.07, 1.35, 0.554_126_423_979_572),
    (0.1, 0.826_994_522_397_257, 31.83 / 0.826_994_522, 0.969_5 / 0.826_994_522, 0.968_339_556_974_04),
    (0.01, 0.980_416_602_925_973, 3183.0 / 0.980_416_603, 0.999_69 / 0.980_416_603, 0.999_672_786_936_448),
];

#[test]
fn facing_squares() {
    let from = floor();
    for (gap, exact, rough, rough_disc, point) in FACING {
        let to = ceiling(gap);
        assert!((area_form_factor(&from, &to) - exact).abs() < 1e-12, "gap {gap}");
        assert!((form_factor(center(&from), DVec3::Z, &to) - point).abs() < 1e-13, "gap {gap}");
        // The ratios are given to three or four digits.
        let (by_centroid, by_disc) = (centroid(&facet(&from), &facet(&to)), disc(&facet(&from), &facet(&to)));
        assert!((by_centroid / exact / rough - 1.0).abs() < 2e-3, "gap {gap}: {by_centroid}");
        assert!((by_disc / exact / rough_disc - 1.0).abs() < 2e-3, "gap {gap}: {by_disc}");
        assert!(by_disc < 1.0 && (by_centroid > 1.0) == (gap <= 0.5));
    }
}

#[test]
fn perpendicular_rectangles_with_a_common_edge() {
    for (size, exact) in [
        (0.1, 0.281_887_806_787_901),
        (0.4, 0.250_319_555_056_282),
        (1.0, 0.200_043_776_075_403),
        (2.0, 0.149_299_795_886_762),
        (10.0, 0.055_023_979_528_411),
    ] {
        let from = rectangle(DVec3::ZERO, size * DVec3::X, DVec3::Y);
        assert!((area_form_factor(&from, &wall(size)) - exact).abs() < 1e-12, "size {size}");
        assert!((perpendicular_rectangles(size, size, 1.0) - exact).abs() < 1e-13, "size {size}");
    }
}

#[test]
fn the_walls_of_a_cube_take_all_that_its_floor_sends() {
    let sides = [
        wall(1.0),
        rectangle(DVec3::X, DVec3::Z, DVec3::Y),
        rectangle(DVec3::ZERO, DVec3::Z, DVec3::X),
        rectangle(DVec3::Y, DVec3::X, DVec3::Z),
        ceiling(1.0),
    ];
    let sum: f64 = sides.iter().map(|side| area_form_factor(&floor(), side)).sum();
    assert!((sum - 1.0).abs() < 1e-12, "{sum}");
    // With 2 π in place of π it would be one half.
    let by_pieces: f64 = pieces(&floor(), 24)
        .iter()
        .flat_map(|piece| {
            sides.iter().flat_map(|side| pieces(side, 24)).map(move |other| centroid(&facet(piece), &facet(&other)))
        })
        .sum::<f64>()
        / (24.0 * 24.0);
    assert!((by_pieces - 1.0).abs() < 0.03, "{by_pieces}");
}

#[test]
fn discs_strips_and_spheres() {
    assert!((coaxial_discs(1.0, 1.0, 1.0) - 0.381_966_011_250_105).abs() < 1e-14);
    assert!((coaxial_discs(0.5, 0.5, 1.0) - 0.171_572_875_253_81).abs() < 1e-14);
    // Twelve-sided polygons of the same area as the discs: the error of a polygon's outline is of the second order.
    let radius = (PI / (6.0 * (TAU / 12.0).sin())).sqrt();
    let ring = |height: f64| {
        let angle = |i: i32| {
            DVec3::new(radius * (f64::from(i) * TAU / 12.0).cos(), radius * (f64::from(i) * TAU / 12.0).sin(), height)
        };
        (0..12).map(angle).collect::<Vec<_>>()
    };
    let upper: Vec<DVec3> = ring(1.0).into_iter().rev().collect();
    assert!((area_form_factor(&ring(0.0), &upper) - coaxial_discs(1.0, 1.0, 1.0)).abs() < 1e-3);
    // Strips of width 1 at an angle, so long that their ends take no more than the share width / length.
    for angle in [0.1, 1.0, PI / 2.0, 2.0, 3.0] {
        let length = 1e4 * DVec3::Y;
        let from = rectangle(DVec3::ZERO, DVec3::X, length);
        let to = rectangle(DVec3::ZERO, length, DVec3::new(f64::cos(angle), 0.0, f64::sin(angle)));
        assert!((area_form_factor(&from, &to) - hinged_strips(angle)).abs() < 1e-4, "angle {angle}");
    }
    // Small parts of the inside of a sphere: the same for every pair.
    let mut stream = Stream::new(1, 0, 0);
    let mut uniform = || 2.0 * f64::from(stream.uniform()) - 1.0;
    for _ in 0..100 {
        let [one, other] = [(), ()].map(|()| {
            let normal = DVec3::new(uniform(), uniform(), uniform()).normalize();
            Facet { center: -3.0 * normal, normal, area: 0.01 }
        });
        assert!((centroid(&one, &other) / inside_of_sphere(0.01, 3.0) - 1.0).abs() < 1e-9);
    }
}

#[test]
fn a_point_before_a_wall_and_an_octant() {
    assert!((form_factor(DVec3::ZERO, DVec3::Z, &[DVec3::X, DVec3::Z, DVec3::Y]) - 0.25).abs() < 1e-15);
    for (distance, exact) in [
        (0.5, 0.190_135_882_384_807),
        (0.1, 0.422_544_860_239_058),
        (1e-3, 0.499_215_797_596_26),
        (1e-6, 0.499_999_215_796_61),
        (1e-9, 0.499_999_999_215_796_63),
    ] {
        let got = form_factor(DVec3::new(distance, 0.5, 0.0), DVec3::Z, &wall(1.0));
        assert!((got - exact).abs() < 1e-14, "distance {distance}: {got}");
    }
    // A disc of radius R at height h: R² / (R² + h²), here of 4 triangles in 1000 each of which the outline is a chord.
    let chords = 4000;
    let rim = |i: i32| {
        DVec3::new((f64::from(i) * TAU / f64::from(chords)).cos(), (f64::from(i) * TAU / f64::from(chords)).sin(), 2.0)
    };
    let parts = (0..chords).map(|i| form_factor(DVec3::ZERO, DVec3::Z, &[2.0 * DVec3::Z, rim(i + 1), rim(i)]));
    // A polygon of n sides in a circle lacks 2 π² / (3 n²) of its area.
    assert!((parts.sum::<f64>() - 0.2).abs() < 0.2 * 2.0 * PI * PI / (3.0 * 16e6));
}

/// F by the centroid estimate between all pairs of n × n pieces of two squares, in percent above the exact one.
fn centroid_error(to: &[DVec3], n: usize, exact: f64) -> f64 {
    let (from, to) = (pieces(&floor(), n), pieces(to, n));
    let pairs = from.iter().flat_map(|one| to.iter().map(move |other| centroid(&facet(one), &facet(other))));
    100.0 * (pairs.sum::<f64>() / (n * n) as f64 / exact - 1.0)
}

#[test]
fn the_centroid_quadrature_converges_by_its_order() {
    for (to, exact, percents) in [
        (wall(1.0), 0.200_043_776_075_403, [59.12, 31.99, 16.47, 8.35, 4.20]),
        (ceiling(1.0), 0.199_824_895_698_387, [59.29, 8.50, 1.93, 0.474, 0.118]),
        (ceiling(0.1), 0.826_994_522_397_257, [3749.0, 865.0, 159.0, 14.6, 0.886]),
    ] {
        for (n, percent) in [1, 2, 4, 8, 16].into_iter().zip(percents) {
            let got = centroid_error(&to, n, exact);
            // Half a unit of the last of three or four digits.
            assert!((got / percent - 1.0).abs() < 5e-3, "n {n}: {got} % for {percent} %");
        }
    }
    // First order because of the shared edge, second order without.
    let order = |to: &[DVec3], exact| (centroid_error(to, 8, exact) / centroid_error(to, 16, exact)).log2();
    assert!((order(&wall(1.0), 0.200_043_776_075_403) - 1.0).abs() < 0.05);
    assert!((order(&ceiling(1.0), 0.199_824_895_698_387) - 2.0).abs() < 0.05);
}

#[test]
fn a_hemicube_is_as_wrong_as_its_centre_point_and_no_more() {
    for (gap, exact, _, _, point) in &FACING[1..4] {
        let corners: Vec<Vec3> = ceiling(*gap).iter().map(|corner| corner.as_vec3()).collect();
        let mut hemicube = Hemicube::new(512);
        hemicube.draw(Vec3A::new(0.5, 0.5, 0.0), Vec3A::Z, &[Item::new(&corners, 0)]);
        let mut sums = [0.0];
        hemicube.add_form_factors(&mut sums);
        // At these gaps the outline lies between cells; 0.542 / 512² is the error of the midpoint rule.
        assert!((sums[0] - point).abs() < 3e-6, "gap {gap}: {}", sums[0]);
        assert!((sums[0] - exact).abs() > 4e-3);
    }
}

#[test]
fn plates_close_the_rows_of_a_cube() {
    let faces = [
        floor(),
        ceiling(1.0),
        wall(1.0),
        rectangle(DVec3::X, DVec3::Z, DVec3::Y),
        rectangle(DVec3::ZERO, DVec3::Z, DVec3::X),
        rectangle(DVec3::Y, DVec3::X, DVec3::Z),
    ];
    let plates: Vec<Plate> = faces.iter().flat_map(|face| pieces(face, 6)).map(|piece| Plate::new(&piece)).collect();
    for tolerance in [1e-3, 1e-6, 1e-9] {
        for one in &plates {
            let row: f64 = plates.iter().map(|other| one.exchange(other, tolerance)).sum::<f64>() / one.area();
            // The bound is in units of A' / (π r²), whose sum over all that is beyond some plates is below 10.
            assert!((row - 1.0).abs() < 10.0 * tolerance, "{tolerance}: {row}");
        }
    }
}
