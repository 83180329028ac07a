//! The boundary of glass: Snell and Fresnel, and what the lobes make of them.

use crate::{plane, slanted};
use glam::{Vec3, Vec3A};
use lightwell::math::random::Stream;
use lightwell::methods::transport::{Bsdf, fresnel_reflectance, reflect, refract};
use lightwell::scene::Lobes;
use std::f64::consts::FRAC_PI_2;

/// What the closed forms are met by.
const TOLERANCE: f64 = 1e-6;

const INDICES: [f64; 6] = [1.0 / 2.5, 1.0 / 1.5, 1.0 / 1.33, 1.33, 1.5, 2.5];

fn reflectance(cosine: f64, index: f64) -> f64 {
    fresnel_reflectance(cosine as f32, index as f32).into()
}

/// Angles from 1° to 89.9°.
fn angles() -> impl Iterator<Item = f64> {
    (10..900).map(|tenths| (0.1 * f64::from(tenths)).to_radians())
}

fn assert_close(got: f64, expected: f64, what: &str) {
    assert!((got - expected).abs() < TOLERANCE, "{what}: {got}, not {expected}");
}

#[test]
fn light_along_the_normal_is_reflected_by_the_square_of_the_indices_contrast() {
    for index in [1.0, 1.33, 1.5, 2.5, 10.0, 1.0 / 1.5] {
        assert_close(reflectance(1.0, index), ((index - 1.0) / (index + 1.0)).powi(2), &format!("n = {index}"));
    }
}

#[test]
fn at_brewsters_angle_only_one_polarisation_is_left() {
    for index in INDICES {
        let cosine = (1.0 + index * index).sqrt().recip();
        let expected = 0.5 * ((1.0 - index * index) / (1.0 + index * index)).powi(2);
        assert_close(reflectance(cosine, index), expected, &format!("n = {index}"));
    }
}

/// The other form of the equations, by sines and tangents of the two angles.
#[test]
fn all_angles_follow_fresnel() {
    for index in INDICES {
        // Closer to total reflection, the cosine's rounding to single precision counts.
        for angle in angles().filter(|angle| angle.sin() < 0.99 * index) {
            let angle = f64::from(angle.cos() as f32).acos();
            let behind = (angle.sin() / index).asin();
            let (sum, difference) = (angle + behind, angle - behind);
            let expected = 0.5 * ((difference.sin() / sum.sin()).powi(2) + (difference.tan() / sum.tan()).powi(2));
            assert_close(reflectance(angle.cos(), index), expected, &format!("n = {index}, {angle}"));
            if angle < 1.0 {
                assert_close(reflectance(behind.cos(), 1.0 / index), expected, &format!("back, n = {index}, {angle}"));
            }
        }
        assert!(reflectance(1e-6, index) > 0.999, "all is reflected at a grazing angle");
    }
    assert_eq!(reflectance(0.5, 1.0), 0.0);
}

#[test]
fn beyond_the_critical_angle_all_is_reflected() {
    for index in INDICES.into_iter().filter(|index| *index < 1.0) {
        let at = |sine: f64| slanted(sine.asin() as f32);
        let below = at(0.999 * index);
        let above = at(1.001 * index);
        assert!(refract(below, Vec3A::Z, index as f32).is_some());
        assert!(fresnel_reflectance(below.z, index as f32) < 0.95);
        assert_eq!(refract(above, Vec3A::Z, index as f32), None);
        assert_eq!(fresnel_reflectance(above.z, index as f32), 1.0);
    }
}

#[test]
fn directions_follow_snell_in_the_plane_of_the_normal() {
    let mut stream = Stream::new(3, 0, 0);
    for index in INDICES {
        for _ in 0..1000 {
            let mut unit = || (Vec3A::from((stream.uniform2() - 0.5).extend(stream.uniform() - 0.5))).normalize();
            let (normal, towards) = (unit(), unit());
            let towards = if towards.dot(normal) < 0.0 { -towards } else { towards };
            let Some(behind) = refract(towards, normal, index as f32) else { continue };
            let [normal, towards, behind] = [normal, towards, behind].map(|vector| vector.as_dvec3());
            assert_close(behind.length(), 1.0, "length");
            assert!(behind.dot(normal) < 0.0);
            // n1 sin θ1 = n2 sin θ2 as vectors: the tangential parts are opposite.
            let tangential = |v: glam::DVec3| v - v.dot(normal) * normal;
            let miss = index * tangential(behind) + tangential(towards);
            assert!(miss.length() < TOLERANCE * index.max(1.0), "n = {index}: {miss}");
            // And back, where the way back is not at the edge of total reflection, which magnifies rounding.
            if towards.dot(normal) > 0.1 {
                let back = refract(behind.as_vec3a(), -normal.as_vec3a(), (1.0 / index) as f32).expect("the way back");
                assert!(back.as_dvec3().distance(towards) < 1e-5, "{back} for {towards}");
            }
        }
    }
    assert!(reflect(slanted(0.4), Vec3A::Z).distance(slanted(-0.4)) < 1e-6);
}

/// A solid angle dω at θ in one medium fills dω' in the other, and n² cos θ dω stays: so radiance goes with n².
#[test]
fn radiance_changes_by_what_refraction_does_to_solid_angles() {
    let step = 1e-2_f32;
    for (index, angle) in [(1.5, 0.3), (1.5, 1.2), (1.0 / 1.5, 0.4), (2.5, 0.8)] {
        let bundle = [(0.0, 0.0), (step, 0.0), (0.0, step)]
            .map(|(up, side)| Vec3A::new((angle + up).sin(), side * f32::sin(angle), (angle + up).cos()).normalize());
        let through = bundle.map(|towards| refract(towards, Vec3A::Z, index).expect("it goes through"));
        let projected = |[a, b, c]: [Vec3A; 3]| (b - a).cross(c - a).dot(a).abs() * a.z.abs();
        let share = projected(through) / projected(bundle);
        let narrowing = crossing(index, slanted(angle)).narrowing;
        // The bundle is a hundredth wide, so this is good to about that.
        assert!((share / narrowing - 1.0).abs() < 0.03, "n = {index}: {share} and {narrowing}");
    }
}

/// A sample that goes through clear glass.
fn crossing(index: f32, towards: Vec3A) -> lightwell::methods::transport::Sample {
    let bsdf = Bsdf::new(&glass(1.0), &plane(), towards, index);
    let mut stream = Stream::new(4, 0, 0);
    let mut samples = (0..1000).filter_map(|_| bsdf.sample(Vec3::ONE, &mut stream));
    samples.find(|sample| sample.crosses).expect("some of it goes through")
}

fn glass(filter: f32) -> Lobes {
    Lobes { glass: 1.0, filter: Vec3::splat(filter), ..Lobes::default() }
}

#[test]
fn what_refraction_does_to_radiance_on_the_way_in_it_undoes_on_the_way_out() {
    for index in [1.33_f32, 1.5, 2.5] {
        let into = crossing(index, slanted(0.7));
        let out = crossing(1.0 / index, slanted((0.7_f32.sin() / index).asin()));
        assert!((into.narrowing - 1.0 / (index * index)).abs() < 1e-6);
        assert!((into.narrowing * out.narrowing - 1.0).abs() < 1e-6);
        assert!(into.is_sharp && into.weight.distance(Vec3::ONE) < 1e-6);
        // It comes out as it went in.
        let out_direction = out.direction;
        assert!(out_direction.distance(-slanted(0.7)) < 1e-5 || out_direction.distance(-slanted(-0.7)) < 1e-5);
    }
}

#[test]
fn clear_glass_neither_gains_nor_loses() {
    let count = 20_000;
    for index in INDICES {
        for angle in (0..90).step_by(6).map(|degrees| (degrees as f32).to_radians()) {
            let towards = slanted(angle);
            let bsdf = Bsdf::new(&glass(1.0), &plane(), towards, index as f32);
            // A cosine of an angle is rounded once, the two parts of the light twice.
            assert!((bsdf.albedo() - Vec3::ONE).abs().max_element() < 1e-6);
            let expected = reflectance(towards.z.into(), index);
            let mut stream = Stream::new(5, 0, 0);
            let mut reflected = 0;
            for _ in 0..count {
                let sample = bsdf.sample(Vec3::ONE, &mut stream).expect("nothing is absorbed");
                assert!(sample.weight.distance(Vec3::ONE) < 1e-5, "{}", sample.weight);
                assert_eq!(sample.crosses, sample.direction.z < 0.0);
                reflected += u32::from(!sample.crosses);
            }
            // Five standard deviations of a share.
            let deviation = (expected * (1.0 - expected) / f64::from(count)).sqrt();
            let share = f64::from(reflected) / f64::from(count);
            assert!((share - expected).abs() <= 5.0 * deviation + 1e-9, "n = {index}, {angle}: {share}, {expected}");
            if (angle as f64).min(FRAC_PI_2).sin() > index {
                assert_eq!(reflected, count as u32, "total reflection");
            }
        }
    }
}

#[test]
fn a_filter_takes_its_share_of_what_goes_through_alone() {
    let towards = slanted(1.0);
    let bsdf = Bsdf::new(&glass(0.25), &plane(), towards, 1.5);
    let reflected = reflectance(towards.z.into(), 1.5);
    let expected = reflected + 0.25 * (1.0 - reflected);
    assert_close(bsdf.albedo().x.into(), expected, "albedo");
}
