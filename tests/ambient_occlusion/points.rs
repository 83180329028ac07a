//! At single points.

use super::shapes;
use super::{FAR, ROUNDED, UNDER_A_CEILING, at, plane, quad, settings, transport, wall};
use glam::Vec3;
use lightwell::methods::{Falloff, Range};

const RAYS: u32 = 1 << 14;
const ANY_HIT: (Range, Falloff) = (Range::Unlimited, Falloff::None);

/// Three standard errors of a mean over independent rays, each of which brings something in [0, 1]: at most √(v (1 − v) / n)
/// each. Stratified ones are better.
fn tolerance(share: f64) -> f64 {
    3.0 * (share * (1.0 - share) / f64::from(RAYS)).sqrt() + ROUNDED
}

fn assert_share(found: f32, expected: f64, what: &str) {
    let found = f64::from(found);
    assert!((found - expected).abs() <= tolerance(expected), "{what}: {found}, not {expected}");
}

fn share_on_floor(obj: &str, x: f32, z: f32, (range, falloff): (Range, Falloff)) -> f32 {
    at(&transport(obj), Vec3::new(x, 0.5, z), Vec3::NEG_Y, &settings(RAYS, range, falloff), 1).share
}

#[test]
fn a_wall_hides_what_its_height_says() {
    for (height, distance) in [(1.0, 1.0), (2.0, 0.5), (0.3, 2.0)] {
        let obj = plane(0.0, FAR) + &wall(height);
        let hidden = 0.5 * (1.0 - f64::from(distance / f32::hypot(distance, height)));
        assert_share(share_on_floor(&obj, 0.0, distance, ANY_HIT), 1.0 - hidden, "a wall");
    }
}

#[test]
fn half_is_seen_at_the_foot_of_a_wall_and_a_quarter_in_a_corner() {
    // As high as it is long, and a hair away: what is missing of the half is 1e-2 / FAR.
    let obj = plane(0.0, FAR) + &wall(FAR);
    assert_share(share_on_floor(&obj, 0.0, 1e-2, ANY_HIT), 0.5, "a foot");
    let corner = |y: f32, z: f32| Vec3::new(0.0, y, z);
    let other = quad([corner(0.0, -FAR), corner(FAR, -FAR), corner(FAR, FAR), corner(0.0, FAR)]);
    assert_share(share_on_floor(&(obj + &other), 1e-2, 1e-2, ANY_HIT), 0.25, "a corner");
}

#[test]
fn a_disc_hides_what_its_radius_says() {
    for (radius, height) in [(1.0_f32, 1.0_f32), (0.5, 1.0), (3.0, 0.7)] {
        // A polygon of 3 m corners has the area of a circle within 1 − sin(2π/n)/(2π/n) = 6e-4 at n = 100; this much of the
        // share, at most, is missing.
        let n = 100;
        let mut obj = plane(0.0, FAR) + &format!("v 0 {height} 0\n");
        for i in 0..n {
            let angle = std::f32::consts::TAU * i as f32 / n as f32;
            obj += &format!("v {} {height} {}\n", radius * angle.cos(), radius * angle.sin());
        }
        for i in 0..n {
            obj += &format!("f 5 {} {}\n", 6 + i, 6 + (i + 1) % n);
        }
        let hidden = f64::from(radius * radius / (radius * radius + height * height));
        let eye = Vec3::new(1e-3, 0.1, 1e-3);
        let found = at(&transport(&obj), eye, Vec3::NEG_Y, &settings(RAYS, ANY_HIT.0, ANY_HIT.1), 1).share;
        let found = f64::from(found);
        assert!((found - (1.0 - hidden)).abs() <= tolerance(hidden) + 6e-4, "{found}, not {}", 1.0 - hidden);
    }
}

#[test]
fn every_falloff_has_its_closed_form_under_a_ceiling() {
    let obj = plane(0.0, FAR) + &plane(1.0, FAR);
    for (falloff, range, hidden) in UNDER_A_CEILING {
        let found = share_on_floor(&obj, 0.0, 0.0, (Range::Metres(range), falloff));
        assert_share(found, 1.0 - hidden, falloff_name(falloff));
    }
}

fn falloff_name(falloff: Falloff) -> &'static str {
    use lightwell::choice::Choice;
    falloff.name()
}

#[test]
fn an_unlimited_distance_is_dark_under_any_ceiling_whatever_the_falloff() {
    let obj = plane(0.0, FAR) + &plane(1.0, FAR);
    for falloff in [Falloff::None, Falloff::Linear, Falloff::Quadratic, Falloff::Exponential] {
        assert_share(share_on_floor(&obj, 0.0, 0.0, (Range::Unlimited, falloff)), 0.0, falloff_name(falloff));
    }
}

#[test]
fn nothing_hides_itself_at_any_scale() {
    for scale in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        // A ball is convex: nothing of it is in the way of anything else of it. A room is closed: nothing gets out.
        for (shape, expected, eye) in [(shapes::sphere(3), 1.0, 3.0), (shapes::cube(4), 0.0, 0.0)] {
            let mut obj = String::new();
            for triangle in shapes::placed(&shape, scale, Vec3::new(0.3, 0.2, 0.1)) {
                for corner in triangle {
                    obj += &format!("v {} {} {}\n", corner.x, corner.y, corner.z);
                }
                obj += "f -3 -2 -1\n";
            }
            let transport = transport(&obj);
            let bounds = transport.world.bounds;
            for i in 0..64 {
                let angle = i as f32 * 0.7;
                let out = Vec3::new(angle.cos(), (3.1 * angle).sin(), angle.sin()).normalize();
                let from = bounds.center() + eye * bounds.radius() * out;
                let towards = if eye > 0.0 { -out } else { out };
                let found = at(&transport, from, towards, &settings(256, ANY_HIT.0, ANY_HIT.1), i);
                assert_eq!(found.share, expected, "scale {scale}, direction {out}");
            }
        }
    }
}

#[test]
fn the_bent_normal_leans_away_from_a_wall() {
    let transport = transport(&(plane(0.0, FAR) + &wall(FAR)));
    let found = at(&transport, Vec3::new(0.0, 0.5, 0.01), Vec3::NEG_Y, &settings(RAYS, ANY_HIT.0, ANY_HIT.1), 1);
    let bent = found.bent_normal.normalize();
    // The mean of (sin θ cos φ, cos θ) over the free half, with the density cos θ / π: (4 / 3π, 2/3), hence 32.5° from the
    // normal. Its standard error is 0.5 / √RAYS by axis.
    let [along, up] = [4.0 / (3.0 * std::f32::consts::PI), 2.0 / 3.0];
    let expected = Vec3::new(0.0, up, along).normalize();
    assert!(Vec3::from(bent).abs_diff_eq(expected, 3.0 * 0.5 / (RAYS as f32).sqrt() / f32::hypot(along, up)), "{bent}");
}

#[test]
fn noise_falls_at_least_as_with_independent_rays() {
    let transport = transport(&(plane(0.0, FAR) + &wall(1.0)));
    let deviation = |rays: u32| {
        let shares: Vec<f64> = (0..256)
            .map(|seed| {
                let settings = settings(rays, Range::Metres(2.0), Falloff::Linear);
                f64::from(at(&transport, Vec3::new(0.0, 0.5, 0.5), Vec3::NEG_Y, &settings, seed).share)
            })
            .collect();
        let mean = shares.iter().sum::<f64>() / shares.len() as f64;
        (shares.iter().map(|share| (share - mean).powi(2)).sum::<f64>() / shares.len() as f64).sqrt()
    };
    // Each deviation is known to 1 part in √(2 · 256): 4.4 %; their quotient to √2 times this, of which three are allowed.
    let quotient = deviation(64) / deviation(16);
    assert!(quotient <= 0.5 * (1.0 + 3.0 * 0.0625), "{quotient}");
}
