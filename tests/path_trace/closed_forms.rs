//! Light that is known exactly.

use crate::{assert_all_near, irradiance, scene, unit_box};
use glam::{DVec3, Vec3A};
use lightwell::math::polygon::form_factor;
use lightwell::math::random::sobol2;
use lightwell::math::rgb::Rgb;
use lightwell::math::stats::Moments;
use std::f64::consts::PI;
use std::fmt::Write;

/// A black floor round the origin under a lamp of 1 × 1 which stands on it, upright, at this distance.
fn lamp_beside(distance: f64) -> String {
    let mut text = "usemtl black\nv -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9\nf 1 2 3 4\nusemtl lamp\n".to_owned();
    for corner in lamp_corners(distance) {
        let _ = writeln!(text, "v {} {} {}", corner.x, corner.y, corner.z);
    }
    text + "f 5 6 7 8\n"
}

/// Its front looks back along x.
fn lamp_corners(distance: f64) -> [DVec3; 4] {
    [(0.0, -0.5), (0.0, 0.5), (1.0, 0.5), (1.0, -0.5)].map(|(y, z)| DVec3::new(distance, y, z))
}

const MTL: &str = "\
newmtl black\nKd 0 0 0\nnewmtl lamp\nKd 0 0 0\nKe 3 2 1\nnewmtl half\nKd 0.5 0.5 0.5\nKe 1 1 1\nnewmtl most\nKd 0.9 0.9 0.9
Ke 1 1 1\nnewmtl wall\nKd 0.6 0.6 0.6\nnewmtl shining\nKd 0.6 0.6 0.6\nKe 5 5 5\n";

#[test]
fn direct_light_is_the_form_factor_of_the_lamp_however_near_it_is() {
    for distance in [2.0, 0.5, 0.1, 1e-2, 1e-3] {
        let transport = scene(&lamp_beside(distance), MTL);
        let found = irradiance(&transport, &[(Vec3A::ZERO, Vec3A::Y)], 1024, 0);
        let factor = form_factor(DVec3::ZERO, DVec3::Y, &lamp_corners(distance));
        assert_all_near(&found[0], Rgb::new(3.0, 2.0, 1.0) * (PI * factor) as f32);
        // A lamp that is chosen by area alone is seen at grazing angles from near by: its noise would grow without a bound.
        let relative = found[0][0].standard_error() / found[0][0].mean();
        assert!(relative < 2e-3, "at {distance} m: {relative}");
    }
}

/// Every face glows and reflects alike: after all bounces B = M/(1 − ρ), and of that (B − M)/ρ arrives.
#[test]
fn a_furnace_is_the_same_everywhere() {
    for (material, reflectance) in [("half", 0.5), ("most", 0.9)] {
        let transport = scene(&unit_box([material; 6]), MTL);
        let points = [(Vec3A::new(0.3, 0.0, 0.6), Vec3A::Y), (Vec3A::new(0.0, 0.999, 0.001), Vec3A::X)];
        let expected = PI / (1.0 - reflectance);
        for found in irradiance(&transport, &points, 512, 1) {
            assert_all_near(&found, Rgb::splat(expected as f32));
        }
    }
}

/// One of six faces emits: what is absorbed is what is emitted, so that the mean of E is Φ/(S (1 − ρ)).
#[test]
fn all_that_is_emitted_is_absorbed() {
    let transport = scene(&unit_box(["wall", "wall", "wall", "shining", "wall", "wall"]), MTL);
    let faces: [(Vec3A, Vec3A, Vec3A, Vec3A); 6] = [
        (Vec3A::ZERO, Vec3A::Y, Vec3A::Z, Vec3A::X),
        (Vec3A::X, Vec3A::Y, Vec3A::Z, Vec3A::NEG_X),
        (Vec3A::ZERO, Vec3A::X, Vec3A::Z, Vec3A::Y),
        (Vec3A::Y, Vec3A::X, Vec3A::Z, Vec3A::NEG_Y),
        (Vec3A::Z, Vec3A::X, Vec3A::Y, Vec3A::NEG_Z),
        (Vec3A::ZERO, Vec3A::X, Vec3A::Y, Vec3A::Z),
    ];
    // Eight independent sets of points on all faces, 64 on each.
    let mut means = Moments::default();
    for set in 0..8 {
        let points: Vec<(Vec3A, Vec3A)> = (0..6 * 64)
            .map(|i| {
                let (corner, along, up, normal) = faces[i / 64];
                let at = sobol2((i % 64) as u32, 0, (6 * set + i / 64) as u32);
                (corner + at.x * along + at.y * up, normal)
            })
            .collect();
        let found = irradiance(&transport, &points, 8, set as u64);
        means.add(found.iter().map(|channels| channels[0].mean()).sum::<f64>() / found.len() as f64);
    }
    let expected = 5.0 * PI / (6.0 * (1.0 - 0.6));
    // Student's distribution with 7 degrees of freedom: beyond 5.4 once in 1,000.
    assert!((means.mean() - expected).abs() < 5.4 * means.standard_error(), "{means:?}, {expected} expected");
    assert!(means.standard_error() < 0.01 * expected, "{means:?}");
}

/// A panel of two lamps back to back, a unit square each, shines on both of two black walls 1 m away.
#[test]
fn a_panel_shines_both_ways() {
    let square = |y: f32| format!("v -0.5 {y} -0.5\nv -0.5 {y} 0.5\nv 0.5 {y} 0.5\nv 0.5 {y} -0.5\n");
    let walls = format!("usemtl black\n{}f 4 3 2 1\n{}f 5 6 7 8\nusemtl lamp\n", square(1.0), square(-1.0));
    // As two quads, as triangles cut along one diagonal, and along both.
    for faces in [
        ["f 9 10 11 12", "f 16 15 14 13"],
        ["f 9 10 11\nf 9 11 12", "f 15 14 13\nf 16 15 13"],
        ["f 9 10 11\nf 9 11 12", "f 16 15 14\nf 16 14 13"],
    ] {
        let [up, down] = faces;
        let transport = scene(&format!("{walls}{}{up}\n{}{down}\n", square(0.0), square(0.0)), MTL);
        let points = [(Vec3A::Y, Vec3A::NEG_Y), (Vec3A::NEG_Y, Vec3A::Y)];
        for found in irradiance(&transport, &points, 1024, 0) {
            assert_all_near(&found, Rgb::new(3.0, 2.0, 1.0) * (PI * 0.239_456_470_460_774) as f32);
        }
    }
}

/// From this side nothing is lit, and from outside nothing is there.
#[test]
fn the_side_that_is_asked_is_the_side_that_counts() {
    let transport = scene(&lamp_beside(0.5), MTL);
    let found = irradiance(&transport, &[(Vec3A::ZERO, Vec3A::NEG_Y), (Vec3A::splat(50.0), Vec3A::Y)], 16, 0);
    assert!(found.iter().flatten().all(|channel| channel.mean() == 0.0), "{found:?}");
    // In the air half a metre before the middle of the lamp, which is a square of 1 × 1.
    let found = irradiance(&transport, &[(Vec3A::new(0.0, 0.5, 0.0), Vec3A::X)], 1024, 0);
    assert_all_near(&found[0], Rgb::new(3.0, 2.0, 1.0) * (PI * 0.554_126_423_979_572) as f32);
}
