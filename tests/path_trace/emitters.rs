//! How directions to emitters are chosen: what a sample says is what is sampled, and no sample outweighs the rest by far.

use crate::scene;
use glam::{DVec3, EulerRot, Quat, Vec2, Vec3, Vec3A};
use lightwell::math::polygon::form_factor;
use lightwell::math::random::{Stream, sobol2};
use lightwell::math::stats::Moments;
use lightwell::methods::transport::{Surface, Transport};
use std::f64::consts::PI;
use std::fmt::Write;
use std::sync::Arc;

const MTL: &str =
    "newmtl black\nKd 0 0 0\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\nnewmtl bright\nKd 0 0 0\nKe 1000 1000 1000\n";

/// A floor of 2 m with these polygons above it, in the order of the scene.
fn over_a_floor(emitters: &[(&str, &[Vec3])]) -> Arc<Transport> {
    let mut obj = "usemtl black\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n".to_owned();
    let mut count = 4;
    for (material, corners) in emitters {
        let _ = writeln!(obj, "usemtl {material}");
        for corner in *corners {
            let _ = writeln!(obj, "v {} {} {}", corner.x, corner.y, corner.z);
        }
        let indices: Vec<String> = (1..=corners.len()).map(|i| (count + i).to_string()).collect();
        let _ = writeln!(obj, "f {}", indices.join(" "));
        count += corners.len();
    }
    scene(&obj, MTL)
}

/// As the scene was mended.
fn corners_of(transport: &Transport, polygon: usize) -> Vec<DVec3> {
    let scene = &transport.world.scene;
    scene.polygons[polygon].corners().iter().map(|&corner| scene.positions[corner as usize].as_dvec3()).collect()
}

fn floor_at(transport: &Transport, x: f32, z: f32) -> Surface {
    transport.surface_on(0, true, Vec3A::new(x, 0.0, z))
}

/// An upright square whose front looks along −x.
fn wall(x: f32) -> [Vec3; 4] {
    [Vec3::new(x, 0.0, -0.5), Vec3::new(x, 0.0, 0.5), Vec3::new(x, 1.0, 0.5), Vec3::new(x, 1.0, -0.5)]
}

/// A square whose front looks down.
fn ceiling(half: f32, y: f32) -> [Vec3; 4] {
    [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, z)| Vec3::new(x, y, z))
}

#[test]
fn samples_of_one_emitter_are_its_form_factor_and_bounded_however_near_it_is() {
    let sliver = |y: f32| [Vec3::new(-0.5, y, 0.0), Vec3::new(0.5, y, 0.0), Vec3::new(0.5, y, 1e-5)];
    let quad = |y: f32| [(-0.5, -0.4), (0.4, -0.5), (0.6, 0.5), (-0.1, 0.3)].map(|(x, z)| Vec3::new(x, y, z));
    for height in [2.0, 0.5, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 2e-6] {
        let shapes: [(&str, Vec<Vec3>); 5] = [
            ("wall", wall(height).into()),
            ("square", ceiling(0.5, height).into()),
            ("triangle", ceiling(0.5, height)[..3].into()),
            ("quad", quad(height).into()),
            ("sliver", sliver(height).into()),
        ];
        for (name, corners) in shapes {
            let transport = over_a_floor(&[("lamp", &corners)]);
            let place = floor_at(&transport, 0.0, 0.0);
            let precise = corners_of(&transport, 1);
            let expected = PI * form_factor(DVec3::ZERO, DVec3::Y, &precise);
            let mut stream = Stream::new(1, 2, 3);
            let (mut found, mut largest) = (Moments::default(), 0.0_f64);
            for _ in 0..20_000 {
                let sample = transport.emitters().sample(&place, stream.uniform(), stream.uniform2());
                let value = sample.map_or(0.0, |sample| {
                    assert!((sample.direction.length() - 1.0).abs() < 1e-6, "{name}, {height}: {sample:?}");
                    f64::from(sample.radiance.x * sample.direction.y.max(0.0))
                });
                found.add(value);
                largest = largest.max(value);
            }
            // 40 means: beyond 4.5 standard errors once in some 4,000. What is 2e-6 m away is
            // known to 1/20 of that at this size; of a half-space it fills all but such shares.
            let miss = (found.mean() - expected).abs() - 4.5 * found.standard_error();
            assert!(miss < 1e-4 * expected, "{name}, {height}: {found:?}, {expected} expected");
            // E is π at most, and a direction chosen from a half-space stands for 2π.
            assert!(largest <= 2.0 * PI + 1e-3, "{name}, {height}: {largest}");
        }
    }
}

/// For every place the density of a direction is the same whether the direction was chosen or came by chance.
#[test]
fn the_density_of_a_sample_is_that_of_the_ray_that_meets_it() {
    // Two emitters of different size and radiance, one of them a quad of two unlike triangles; places near both and neither.
    let quad = [(-0.9, -0.4), (0.4, -0.9), (0.9, 0.9), (-0.5, 0.3)].map(|(x, z)| Vec3::new(x, 0.9, z));
    let transport = over_a_floor(&[("lamp", &quad), ("bright", &ceiling(0.02, 0.5))]);
    let (mut near, mut far, mut stream) = (0, 0, Stream::new(1, 2, 4));
    for _ in 0..5000 {
        let place = floor_at(&transport, 1.9 * stream.uniform() - 0.95, 1.9 * stream.uniform() - 0.95);
        let Some(sample) = transport.emitters().sample(&place, stream.uniform(), stream.uniform2()) else { continue };
        let met = transport.meet(&transport.leave(&place, sample.direction)).expect("an emitter");
        // Where the small one hides the large one, or the ray passes an edge by rounding.
        if !met.point.abs_diff_eq(sample.point.point, 1e-4) {
            continue;
        }
        let pdf = transport.emitters().pdf(&place, &met, sample.direction);
        // Points are rounded to 1e-6 m, of distances of half a metre: their squares to 4e-6; cosines to as much near the plane.
        assert!((pdf / sample.pdf - 1.0).abs() < 1e-4, "{sample:?} {met:?} {pdf}");
        if met.polygon == 1 { near += 1 } else { far += 1 }
    }
    assert!(near > 500 && far > 500, "{near} {far}");
}

/// Where emitters are near is told by the place alone, in front of them and above its horizon.
#[test]
fn only_places_before_an_emitter_and_closer_than_its_size_are_near_it() {
    // Of one radiance and 0.01 m²: as far as √(0.01/π) = 0.056 m.
    let transport = over_a_floor(&[("lamp", &ceiling(0.05, 0.05))]);
    let is_near = |x: f32, z: f32| transport.emitters().are_near(&floor_at(&transport, x, z));
    assert!(is_near(0.0, 0.0) && is_near(0.1, 0.1) && !is_near(0.12, 0.0));
    let above = over_a_floor(&[("lamp", &ceiling(0.05, 0.06))]);
    assert!(!above.emitters().are_near(&floor_at(&above, 0.0, 0.0)));
    // Behind it, and where it is below the horizon.
    let behind = Surface { point: Vec3A::new(0.0, 0.06, 0.0), facing: Vec3A::NEG_Y, ..floor_at(&transport, 0.0, 0.0) };
    assert!(!transport.emitters().are_near(&behind));
    assert!(!transport.emitters().are_near(&transport.surface_on(0, false, Vec3A::ZERO)));
    // A small lamp that is seldom chosen beside a strong one is near as far as it outshines what its choice would find.
    let pair = over_a_floor(&[("lamp", &ceiling(0.05, 0.06)), ("bright", &ceiling(0.05, 1.0))]);
    assert!(pair.emitters().are_near(&floor_at(&pair, 0.0, 0.0)));
}

/// Two hundred lamps that look anywhere, of radiances that differ by a thousand, in places that differ by their distance.
fn many_lamps() -> (Arc<Transport>, Vec<bool>) {
    let mut stream = Stream::new(1, 2, 6);
    let mut random = |low: f32, high: f32| low + (high - low) * stream.uniform();
    let lamps: Vec<(bool, Vec<Vec3>)> = (0..200)
        .map(|_| {
            let turn = Quat::from_euler(EulerRot::XYZ, random(0.0, 6.0), random(0.0, 6.0), random(0.0, 6.0));
            let center = Vec3::new(random(-3.0, 3.0), random(0.05, 3.0), random(-3.0, 3.0));
            let corners = ceiling(0.01, 0.0).map(|corner| center + turn * corner);
            (random(0.0, 1.0) < 0.1, corners.to_vec())
        })
        .collect();
    let named = |bright: bool| if bright { "bright" } else { "lamp" };
    let emitters: Vec<(&str, &[Vec3])> = lamps.iter().map(|(bright, corners)| (named(*bright), &corners[..])).collect();
    (over_a_floor(&emitters), lamps.iter().map(|(bright, _)| *bright).collect())
}

/// Every lamp that shines on a place is chosen, and however weak it is often enough: no sample outweighs the rest by far.
#[test]
fn of_many_emitters_those_are_chosen_that_give_most() {
    let (transport, is_bright) = many_lamps();
    let (mut stream, mut met_count, mut worst) = (Stream::new(1, 2, 7), 0, 0.0_f64);
    for _ in 0..50 {
        let place = floor_at(&transport, 1.8 * stream.uniform() - 0.9, 1.8 * stream.uniform() - 0.9);
        let of_lamp = |lamp: usize| {
            let corners = corners_of(&transport, 1 + lamp);
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            let is_before = (place.point.as_dvec3() - corners[0]).dot(normal) > 0.0;
            let radiance = if is_bright[lamp] { 1000.0 } else { 1.0 };
            if is_before { radiance * PI * form_factor(place.point.as_dvec3(), DVec3::Y, &corners).abs() } else { 0.0 }
        };
        let expected: f64 = (0..is_bright.len()).map(of_lamp).sum();
        let (mut found, mut largest) = (Moments::default(), 0.0_f64);
        for _ in 0..20_000 {
            let sample = transport.emitters().sample(&place, stream.uniform(), stream.uniform2());
            let value = sample.map_or(0.0, |sample| f64::from(sample.radiance.x * sample.direction.y.max(0.0)));
            found.add(value);
            largest = largest.max(value);
            let Some(sample) = sample else { continue };
            let Some(met) = transport.meet(&transport.leave(&place, sample.direction)) else { continue };
            // Where no other hides it. Points are rounded to 1e-6 m, of distances of 0.05 m at least: by that the cosine may change.
            if met.point.abs_diff_eq(sample.point.point, 1e-5) && -met.facing.dot(sample.direction) > 0.05 {
                let pdf = transport.emitters().pdf(&place, &met, sample.direction);
                assert!((pdf / sample.pdf - 1.0).abs() < 1e-3, "{sample:?} {met:?} {pdf}");
                met_count += 1;
            }
        }
        worst = worst.max(largest / expected);
        // 50 means: beyond 4.5 standard errors once in some 3,000.
        assert!((found.mean() - expected).abs() < 4.5 * found.standard_error(), "{found:?}, {expected} expected");
    }
    println!("{met_count} met, a sample of {worst} times the mean");
    assert!(met_count > 500_000, "{met_count}");
    // By flux alone, one sample is 350 times the mean.
    assert!(worst < 40.0, "{worst}");
}

/// Lamps of one flux: a sample counts for no more than eight times what it would by flux alone, however wrong the expectation is.
#[test]
fn an_emitter_far_away_or_very_near_keeps_no_other_from_being_chosen() {
    let mut lamps: Vec<[Vec3; 4]> = Vec::new();
    for i in 0..16 {
        let center = Vec3::new(2.5 * (i % 4) as f32 - 3.75, 3.0, 2.5 * (i / 4) as f32 - 3.75);
        lamps.push(ceiling(0.1, 0.0).map(|corner| corner + center));
    }
    // One of them beyond all others, in a row with some of them.
    lamps.push(ceiling(0.1, 0.0).map(|corner| corner + Vec3::new(1000.0, 3.0, 2.5)));
    let candles: Vec<[Vec3; 4]> = (0..9)
        .map(|i| {
            let at = 0.9 * (2.0 * sobol2(i, 0, 8) - Vec2::ONE);
            ceiling(0.005, 0.0).map(|corner| corner + Vec3::new(at.x, 0.02, at.y))
        })
        .collect();
    for (name, lamps) in [("far", lamps), ("near", candles)] {
        let emitters: Vec<(&str, &[Vec3])> = lamps.iter().map(|corners| ("lamp", &corners[..])).collect();
        let transport = over_a_floor(&emitters);
        let (mut stream, mut worst) = (Stream::new(1, 2, 9), 0.0_f64);
        for _ in 0..200 {
            let place = floor_at(&transport, 1.9 * stream.uniform() - 0.95, 1.9 * stream.uniform() - 0.95);
            let mut found = Moments::default();
            let values: Vec<f64> = (0..1000)
                .map(|_| {
                    let sample = transport.emitters().sample(&place, stream.uniform(), stream.uniform2());
                    sample.map_or(0.0, |sample| f64::from(sample.radiance.x * sample.direction.y.max(0.0)))
                })
                .collect();
            values.iter().for_each(|&value| found.add(value));
            worst = worst.max(values.iter().fold(0.0_f64, |a, &b| a.max(b)) / found.mean());
        }
        println!("{name}: a sample of {worst} times the mean");
        // By flux one lamp of n that gives all light has samples of n times the mean.
        assert!(worst <= 8.0 * lamps.len() as f64, "{name}: {worst}");
    }
}
