//! Lobes and their mixtures: what is sampled is what is valued, and no more leaves than arrives.

use crate::{plane, slanted};
use glam::{DVec3, Vec3, Vec3A};
use lightwell::math::random::Stream;
use lightwell::methods::transport::Bsdf;
use lightwell::scene::Lobes;
use lightwell::solution::Scattering;
use std::f64::consts::TAU;

/// Samples of a mean.
const COUNT: u32 = 100_000;

/// Mean and standard error of a function of samples; where there is no sample it counts as 0.
fn mean(bsdf: &Bsdf, light: Vec3, seed: u64, function: impl Fn(Vec3, Vec3A) -> Vec3) -> (DVec3, DVec3) {
    let mut stream = Stream::new(seed, 0, 0);
    let (mut sum, mut squares) = (DVec3::ZERO, DVec3::ZERO);
    for _ in 0..COUNT {
        let value = bsdf.sample(light, &mut stream).map_or(Vec3::ZERO, |s| function(light * s.weight, s.direction));
        sum += value.as_dvec3();
        squares += value.as_dvec3() * value.as_dvec3();
    }
    let mean = sum / f64::from(COUNT);
    let variance = (squares / f64::from(COUNT) - mean * mean).max(DVec3::ZERO);
    (mean, (variance / f64::from(COUNT)).map(f64::sqrt))
}

/// ∫ f |cos| g dω over the half-space.
fn integral(bsdf: &Bsdf, function: impl Fn(Vec3A) -> f64) -> f64 {
    over_directions(|direction| {
        let [diffuse, glossy] = bsdf.value(direction);
        f64::from(diffuse.x + glossy.x) * function(direction)
    })
}

/// ∫ g dω over the half-space, by midpoints of a grid in height and azimuth.
fn over_directions(function: impl Fn(Vec3A) -> f64) -> f64 {
    let (heights, turns) = (600, 200);
    let cell = TAU / f64::from(heights * turns);
    let mut sum = 0.0;
    for i in 0..heights {
        let z = (f64::from(i) + 0.5) / f64::from(heights);
        for j in 0..turns {
            let azimuth = TAU * (f64::from(j) + 0.5) / f64::from(turns);
            let radius = (1.0 - z * z).sqrt();
            let direction = DVec3::new(radius * azimuth.cos(), radius * azimuth.sin(), z).as_vec3a();
            sum += function(direction);
        }
    }
    sum * cell
}

fn gloss(exponent: f32) -> Lobes {
    Lobes { glossy: Vec3::ONE, exponent, ..Lobes::default() }
}

#[test]
fn a_phong_lobe_is_sampled_as_it_is_valued_and_reflects_no_more_than_all() {
    for exponent in [0.0, 1.0, 10.0, 100.0] {
        for degrees in [0.0_f32, 30.0, 60.0, 80.0, 89.0] {
            let bsdf = Bsdf::new(&gloss(exponent), &plane(), slanted(degrees.to_radians()), 1.0);
            let albedo = integral(&bsdf, |_| 1.0);
            // The grid's step is 1/600 in height, an eighth of the narrowest lobe's half-width squared.
            let grid = 2e-3;
            assert!(albedo <= 1.0 + grid, "n = {exponent}, {degrees}°: {albedo}");
            if degrees == 0.0 {
                assert!((albedo - 1.0).abs() < grid, "n = {exponent}: {albedo}");
            }
            // Not only as much as it should be, but also where.
            let moments: [fn(Vec3A) -> f32; 4] = [|_| 1.0, |d| d.x, |d| d.z, |d| d.x * d.z];
            for (i, moment) in moments.into_iter().enumerate() {
                let (got, error) = mean(&bsdf, Vec3::ONE, i as u64, |weight, d| weight * moment(d));
                let expected = integral(&bsdf, |d| moment(d).into());
                let miss = (got.x - expected).abs();
                assert!(miss < 5.0 * error.x + grid, "n = {exponent}, {degrees}°, moment {i}: {} {expected}", got.x);
            }
        }
    }
}

/// (n + 2)/(2π) ∫ cosⁿα cos θ dω at a grazing angle, where half of the lobe is below the horizon: ∫∫ over the upper half,
/// z = sin α cos φ, is (n + 2)/(2π) · 2 · ∫ cosⁿα sin²α dα = (n + 2)/π · (√π/2) Γ((n+1)/2)/(2 Γ(n/2 + 2)).
#[test]
fn a_grazing_phong_lobe_keeps_what_is_above_the_horizon() {
    // n = 1: 3/π · ∫ cos α sin²α dα = 3/π · 1/3; n = 3: 5/π · (1/3 − 1/5).
    for (exponent, expected) in [(1.0, 1.0 / std::f64::consts::PI), (3.0, 2.0 / (3.0 * std::f64::consts::PI))] {
        let bsdf = Bsdf::new(&gloss(exponent), &plane(), Vec3A::X, 1.0);
        let (got, error) = mean(&bsdf, Vec3::ONE, 9, |weight, _| weight);
        assert!((got.x - expected).abs() < 5.0 * error.x, "n = {exponent}: {} not {expected}", got.x);
    }
}

#[test]
fn mixtures_keep_what_their_albedo_says() {
    let lobes = Lobes {
        diffuse: Vec3::new(0.3, 0.1, 0.0),
        mirror: Vec3::new(0.1, 0.1, 0.5),
        straight: Vec3::new(0.0, 0.2, 0.1),
        glass: 0.4,
        filter: Vec3::new(1.0, 0.5, 0.2),
        ..Lobes::default()
    };
    for light in [Vec3::ONE, Vec3::new(0.1, 2.0, 7.0), Vec3::X] {
        for index in [1.5, 1.0 / 1.5] {
            for degrees in [0.0_f32, 35.0, 70.0] {
                let bsdf = Bsdf::new(&lobes, &plane(), slanted(degrees.to_radians()), index);
                let expected = (light * bsdf.albedo()).as_dvec3();
                let (got, error) = mean(&bsdf, light, 11, |weight, _| weight);
                let is_met = (got - expected).abs().cmple(5.0 * error + DVec3::splat(1e-6));
                assert!(is_met.all(), "{light}, n = {index}, {degrees}°: {got} ± {error}, not {expected}");
            }
        }
    }
}

/// No sample weighs more than the light times the sum of what the lobes keep, so roulette ends every path.
#[test]
fn no_sample_brings_more_than_arrived() {
    let lobes = Lobes {
        diffuse: Vec3::new(0.3, 0.1, 0.2),
        mirror: Vec3::splat(0.2),
        straight: Vec3::new(0.1, 0.2, 0.0),
        glass: 0.4,
        filter: Vec3::new(1.0, 0.5, 0.2),
        ..Lobes::default()
    };
    let bsdf = Bsdf::new(&lobes, &plane(), slanted(0.6), 1.5);
    let mut stream = Stream::new(12, 0, 0);
    for _ in 0..10_000 {
        let light = Vec3::new(stream.uniform(), stream.uniform(), stream.uniform());
        let Some(sample) = bsdf.sample(light, &mut stream) else { continue };
        let most: f32 = (light * lobes.diffuse).max_element()
            + (light * lobes.mirror).max_element()
            + (light * lobes.straight).max_element()
            + light.max_element() * lobes.glass;
        assert!((light * sample.weight).max_element() <= most * (1.0 + 1e-5));
    }
}

#[test]
fn a_diffuse_lobe_is_sampled_as_it_is_valued() {
    let lobes = Lobes { diffuse: Vec3::splat(0.5), ..Lobes::default() };
    let bsdf = Bsdf::new(&lobes, &plane(), slanted(0.9), 1.0);
    assert!((integral(&bsdf, |_| 1.0) - 0.5).abs() < 1e-5);
    // ∫ ρ/π cos²θ dω = 2ρ/3.
    let (got, error) = mean(&bsdf, Vec3::ONE, 1, |weight, d| weight * d.z);
    assert!((got.x - 1.0 / 3.0).abs() < 5.0 * error.x);
}

#[test]
fn halves_of_a_mixture_are_its_diffuse_and_its_specular_lobes() {
    let lobes = Lobes { diffuse: Vec3::splat(0.3), glossy: Vec3::splat(0.4), exponent: 5.0, ..Lobes::default() };
    let whole = Bsdf::new(&lobes, &plane(), slanted(0.5), 1.0);
    for (half, kept) in [(Scattering::Diffuse, 0), (Scattering::Specular, 1)] {
        let part = whole.only(half);
        let direction = slanted(-0.3);
        assert_eq!(part.value(direction)[kept], whole.value(direction)[kept]);
        assert_eq!(part.value(direction)[1 - kept], Vec3::ZERO);
        let mut stream = Stream::new(2, 0, 0);
        assert!((0..1000).filter_map(|_| part.sample(Vec3::ONE, &mut stream)).all(|s| s.scattering == half));
    }
}

/// The density that is told of a direction is that with which it is chosen: over all directions it is the share of samples
/// that a lobe gets, and the same for who asks as for who samples.
#[test]
fn directions_have_the_density_that_is_told() {
    let lobes = Lobes {
        diffuse: Vec3::new(0.3, 0.1, 0.2),
        glossy: Vec3::new(0.1, 0.4, 0.3),
        exponent: 5.0,
        mirror: Vec3::splat(0.2),
        ..Lobes::default()
    };
    let bsdf = Bsdf::new(&lobes, &plane(), slanted(0.7), 1.0);
    let light = Vec3::new(1.0, 0.5, 0.25);
    let mut stream = Stream::new(9, 0, 0);
    let mut counts = [0; 2];
    for _ in 0..COUNT {
        let Some(sample) = bsdf.sample(light, &mut stream) else { continue };
        let lobe = usize::from(sample.scattering == Scattering::Specular);
        let expected =
            if sample.is_sharp { 0.0 } else { bsdf.densities(sample.direction, &bsdf.lobe_probabilities(light))[lobe] };
        assert!((sample.density - expected).abs() <= 1e-5 * expected, "{sample:?} {expected}");
        counts[lobe] += u32::from(!sample.is_sharp);
    }
    let densities = |lobe: usize| {
        over_directions(|direction| bsdf.densities(direction, &bsdf.lobe_probabilities(light))[lobe].into())
    };
    for (lobe, count) in counts.into_iter().enumerate() {
        let share = f64::from(count) / f64::from(COUNT);
        let error = (share * (1.0 - share) / f64::from(COUNT)).sqrt();
        assert!((share - densities(lobe)).abs() < 5.0 * error + 2e-3, "lobe {lobe}: {share} {}", densities(lobe));
    }
}

#[test]
fn nothing_is_kept_of_nothing() {
    let mut stream = Stream::new(1, 0, 0);
    let black = Bsdf::new(&Lobes::default(), &plane(), slanted(0.2), 1.0);
    assert!(black.sample(Vec3::ONE, &mut stream).is_none());
    let red = Bsdf::new(&Lobes { diffuse: Vec3::X, ..Lobes::default() }, &plane(), slanted(0.2), 1.0);
    assert!(red.sample(Vec3::Y, &mut stream).is_none());
}
