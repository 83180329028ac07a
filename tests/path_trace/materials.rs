//! Every material in a furnace: where all surfaces send the same light, it cannot be seen.

use crate::{assert_all_near, irradiance, scene, shapes, unit_box};
use glam::{Vec3, Vec3A};
use lightwell::math::random::{PaddedPoint, Stream};
use lightwell::math::rgb::Rgb;
use lightwell::math::stats::Moments;
use lightwell::methods::Cost;
use lightwell::methods::path_trace::PathTracer;
use lightwell::methods::transport::{Media, Transport, fresnel_reflectance};
use lightwell::solution::PathMatcher;
use lightwell::tracer::Ray;
use std::sync::Arc;

/// Walls that send a radiance of 2, and what a ball sends besides what it reflects or lets through of that.
const MTL: &str = "\
newmtl wall\nKd 0.5 0.5 0.5\nKe 1 1 1\nnewmtl even\nKd 0 0 0\nKe 2 2 2
newmtl diffuse\nKd 0.25 0.5 0.75\nKe 1.5 1 0.5\nnewmtl mirror\nKd 0 0 0\nKs 1 1 1\nillum 3
newmtl half-mirror\nKd 0.5 0.5 0.5\nKs 0.25 0.25 0.25\nKe 0.5 0.5 0.5\nillum 3
newmtl glass\nKd 0 0 0\nNi 1.5\nillum 7\nnewmtl pane\nKd 0 0 0\nd 0\nillum 1
newmtl gloss\nKd 0.25 0.25 0.25\nKs 0.5 0.25 0.5\nNs 20\nnewmtl dull\nKd 0 0 0\nKs 0.5 0.5 0.5\nNs 1\n";

/// A ball of facets in the middle of the box, flat ones or with the normals of a sphere.
fn box_with_ball(walls: &str, material: &str, depth: u32, is_smooth: bool) -> Arc<Transport> {
    let mut text = unit_box([walls; 6]) + &format!("usemtl {material}\n");
    for triangle in shapes::sphere(depth) {
        for normal in triangle {
            let at = Vec3::splat(0.5) + 0.3 * normal;
            text += &format!("v {} {} {}\nvn {} {} {}\n", at.x, at.y, at.z, normal.x, normal.y, normal.z);
        }
        text += if is_smooth { "f -3//-3 -2//-2 -1//-1\n" } else { "f -3 -2 -1\n" };
    }
    scene(&text, MTL)
}

/// Mean radiance along rays, by channel, of one path each.
fn radiance(transport: &Arc<Transport>, count: u64, ray: impl Fn(&mut Stream) -> Ray) -> [Moments; 3] {
    let tracer = PathTracer::new(transport.clone(), PathMatcher::default());
    let mut channels = [Moments::default(); 3];
    for index in 0..count {
        let ray = ray(&mut Stream::new(5, 6, index));
        let found = tracer.radiance(&ray, Media::default(), &PaddedPoint::new(7, index), &mut Cost::default());
        for (channel, value) in channels.iter_mut().zip(found.expect("a closed room").to_array()) {
            channel.add(value.into());
        }
    }
    channels
}

#[test]
fn no_material_can_be_seen_in_a_furnace() {
    // Normals of a sphere lean from those of an octahedron by up to 55°: a lobe round them must not lose what is below.
    let smooth = ("diffuse", 0, true);
    let flat = ["diffuse", "mirror", "half-mirror", "glass", "pane"].map(|material| (material, 2, false));
    for (material, depth, is_smooth) in flat.into_iter().chain([smooth]) {
        let transport = box_with_ball("wall", material, depth, is_smooth);
        let from_a_corner = |stream: &mut Stream| {
            let target = Vec3A::splat(0.5) + 0.6 * (Vec3A::from((stream.uniform2(), stream.uniform())) - 0.5);
            let origin = Vec3A::splat(0.05);
            Ray::new(origin, (target - origin).normalize())
        };
        let found = radiance(&transport, 200_000, from_a_corner);
        println!("{material}: {found:?}");
        assert_all_near(&found, Rgb::splat(2.0));
        let error = found[0].standard_error();
        assert!(error < 0.02, "{material}: too noisy to tell: {error}");
    }
}

/// A Phong lobe along the normal reflects all of its share, and what falls on it there is the same from everywhere. Light
/// that grazes it is cut at the horizon: of n = 1, its lobe keeps 1/π.
#[test]
fn gloss_reflects_what_its_lobe_keeps_of_an_even_light() {
    for (material, direction, expected) in [
        ("gloss", Vec3A::NEG_Y, Rgb::new(1.5, 1.0, 1.5)),
        ("dull", Vec3A::NEG_Y, Rgb::splat(1.0)),
        ("dull", Vec3A::new(1.0, -1e-3, 0.0).normalize(), Rgb::splat(1.0 / std::f32::consts::PI)),
    ] {
        let transport = scene(&unit_box(["even", "even", material, "even", "even", "even"]), MTL);
        let origin = Vec3A::new(0.5, 0.0, 0.5) - direction * 0.3;
        let found = radiance(&transport, 40_000, |_| Ray::new(origin, direction));
        // The grazing ray comes in at 1e-3 above the horizon, which changes the lobe by about as much.
        for (channel, expected) in found.iter().zip(expected.as_dvec3().to_array()) {
            let miss = (channel.mean() - expected).abs();
            assert!(miss < 5.0 * channel.standard_error() + 2e-3 * expected, "{material}: {channel:?}, {expected}");
            assert!(channel.standard_error() < 0.01, "{material}: {channel:?}");
        }
    }
}

/// E on the floor below a level lamp of radiance 1 and a pane of clear glass between them, W/m²: over directions, what a pane lets
/// through of which each boundary reflects R, with all reflections inside, (1 − R)/(1 + R), along the way that Snell says.
fn irradiance_below_a_pane(half: f64, height: f64, thickness: f64, index: f64) -> f64 {
    const STEPS: u32 = 1000;
    let step = 2.0 / f64::from(STEPS);
    let place = |i: u32| (f64::from(i) + 0.5) * step - 1.0;
    let mut sum = 0.0;
    for (i, j) in (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (i, j))) {
        // Points of the unit disc weigh directions by their cosine. Those to the lamp are within half of it.
        let (x, z) = (0.5 * place(i), 0.5 * place(j));
        let sine = x.hypot(z);
        let inside = (sine / index).asin();
        let across = (height - thickness) * sine.asin().tan() + thickness * inside.tan();
        let [x, z] = [x, z].map(|part| part / sine * across);
        if x.abs().max(z.abs()) < half {
            let reflected = f64::from(fresnel_reflectance(sine.asin().cos() as f32, index as f32));
            sum += (1.0 - reflected) / (1.0 + reflected) * (0.5 * step).powi(2);
        }
    }
    sum
}

/// A body and a sheet of one glass let the same through: `Tf` once.
#[test]
fn the_filter_of_a_pane_and_of_a_sheet_counts_once() {
    const MTL: &str = "\
newmtl black\nKd 0 0 0\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\nnewmtl glass\nKd 0 0 0\nNi 1.5\nTf 0.6 0.36 1\nillum 7\n";
    let level = |half: f32, y: f32, face: &str| {
        format!("v -{half} {y} -{half}\nv -{half} {y} {half}\nv {half} {y} {half}\nv {half} {y} -{half}\nf {face}\n")
    };
    let room = format!("usemtl black\n{}usemtl lamp\n{}", level(4.0, 0.0, "1 2 3 4"), level(0.5, 2.0, "8 7 6 5"));
    // So wide that no light which its edges reflect comes back to the middle.
    let pane = level(30.0, 1.0, "12 11 10 9")
        + &level(30.0, 1.2, "13 14 15 16")
        + "f 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n";
    let sheet = level(30.0, 1.0, "9 10 11 12");
    let filter = Rgb::new(0.6, 0.36, 1.0);
    for (glass, thickness, index) in [(pane, 0.2, 1.5), (sheet, 0.0, 1.0)] {
        let transport = scene(&format!("{room}usemtl glass\n{glass}"), MTL);
        let found = irradiance(&transport, &[(Vec3A::ZERO, Vec3A::Y)], 1 << 13, 1);
        let expected = irradiance_below_a_pane(0.5, 2.0, thickness, index) as f32;
        println!("{found:?}, {expected}");
        assert_all_near(&found[0], filter * expected);
        assert!(found[0][2].standard_error() < 0.01 * f64::from(expected), "too noisy to tell");
    }
}

/// Mirrors and glass that lose nothing before walls that all send the same: every single path brings just that, however long
/// it is under way, since roulette takes part in nothing that loses nothing.
#[test]
fn lossless_mirrors_and_glass_add_no_noise_however_often_they_are_met() {
    let mirrors = scene(&unit_box(["even", "mirror", "mirror", "mirror", "mirror", "mirror"]), MTL);
    for (name, transport) in [("mirrors", mirrors), ("glass", box_with_ball("even", "glass", 2, false))] {
        let found = radiance(&transport, 20_000, |stream| {
            // Steep enough to come to the left wall before event 512, by whichever mirrors.
            let target = Vec3A::new(0.4, 1.0, 1.0) * Vec3A::from((stream.uniform2(), stream.uniform()));
            let origin = Vec3A::new(0.9, 0.05, 0.05);
            Ray::new(origin, (target - origin).normalize())
        });
        // Light goes round in the ball by total reflection for long, but one of 20,000 at most past event 512.
        println!("{name}: {found:?}");
        assert!((found[0].mean() - 2.0).abs() < 1e-3 && found[0].standard_error() < 1e-3, "{name}: {found:?}");
    }
}
