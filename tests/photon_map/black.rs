//! Light on surfaces that send none of it on: irradiance does not depend on what a surface reflects.

use super::{at, run_to_end, settings, transport};
use glam::{DVec3, Vec3, Vec3A};
use lightwell::effects::{Effect, plan};
use lightwell::methods::PhotonSettings;
use lightwell::methods::photon_map::{Estimate, PhotonMaps, Scratch, Which, trail};
use lightwell::methods::transport::{Surface, Transport};
use lightwell::scene::Scene;
use lightwell::solution::Photon;
use std::f64::consts::PI;
use std::sync::Arc;

const MTL: &str = "\
newmtl grey\nKd 0.7 0.7 0.7\nillum 1\nnewmtl black\nKd 0 0 0\nillum 1\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\nillum 1
newmtl mirror\nKd 0 0 0\nKs 0.8 0.8 0.8\nillum 3\nnewmtl glass\nKd 0 0 0\nNi 1.5\nillum 7\n";

/// A level rectangle, x and z from and to, with its front up or down.
fn level(material: &str, [x0, x1]: [f32; 2], [z0, z1]: [f32; 2], y: f32, is_up: bool) -> String {
    let face = if is_up { "f -4 -3 -2 -1" } else { "f -1 -2 -3 -4" };
    format!("usemtl {material}\nv {x0} {y} {z0}\nv {x0} {y} {z1}\nv {x1} {y} {z1}\nv {x1} {y} {z0}\n{face}\n")
}

fn scene(parts: &[String]) -> Arc<Transport> {
    transport(Scene::from_text("test", &format!("mtllib m.mtl\n{}", parts.concat()), MTL).expect("a scene"))
}

fn photons(count: u32) -> PhotonSettings {
    PhotonSettings { count, caustic_count: count, nearest: 400, ..PhotonSettings::default() }
}

fn estimate(maps: &PhotonMaps, surface: &Surface) -> Estimate {
    maps.irradiance(surface, Which::All, &mut Scratch::default())
}

/// E on a level place, W/m², of a level rectangle of radiance 10 above it (Lambert; facts of form factors: point to polygon).
fn irradiance_below(place: DVec3, corners: [DVec3; 4]) -> f64 {
    let ways = corners.map(|corner| (corner - place).normalize());
    let edge = |i: usize| {
        let (a, b) = (ways[i], ways[(i + 1) % 4]);
        let normal = a.cross(b);
        normal.length().atan2(a.dot(b)) * normal.normalize().y
    };
    10.0 * PI * ((0..4).map(edge).sum::<f64>() / (2.0 * PI)).abs()
}

/// A lamp of 0.5 m over a floor of 2 m, which is of one material to the left and of another to the right.
fn floor(left: &str, right: &str) -> Arc<Transport> {
    let half = 0.25;
    scene(&[
        level(left, [-1.0, 0.0], [-1.0, 1.0], 0.0, true),
        level(right, [0.0, 1.0], [-1.0, 1.0], 0.0, true),
        level("lamp", [-half, half], [-half, half], 2.0, false),
    ])
}

fn lamp(half: f64, y: f64) -> [DVec3; 4] {
    [(-half, -half), (-half, half), (half, half), (half, -half)].map(|(x, z)| DVec3::new(x, y, z))
}

#[test]
fn a_black_floor_gets_as_much_light_as_a_grey_one_and_no_seam_between_them() {
    let settings = photons(400_000);
    let floors = [("grey", "grey"), ("black", "black"), ("grey", "black")].map(|(left, right)| floor(left, right));
    let maps = floors.each_ref().map(|floor| run_to_end(floor, settings).maps());
    for x in [-0.5_f32, -0.02, 0.02, 0.4] {
        let [grey, black, both] = [0, 1, 2].map(|i| {
            let surface = at(&floors[i], Vec3A::new(x, 0.0, 0.1), Vec3A::Y);
            estimate(&maps[i], &surface)
        });
        // The lamp reflects nothing, so that the very same photons land on both floors.
        assert_eq!(grey, black, "{x}");
        // Only the order of sums is another.
        let difference = (grey.irradiance.x / both.irradiance.x - 1.0).abs();
        assert!(difference < 1e-5 && grey.photons == both.photons, "{x}: {grey:?} {both:?}");
        let expected = irradiance_below(DVec3::new(x.into(), 0.0, 0.1), lamp(0.25, 2.0));
        let error = f64::from(grey.relative_error);
        // Over a disc of some 3 cm the light is as good as even. Of four estimates one is beyond 4 errors once in 4,000.
        let got = f64::from(grey.irradiance.x);
        assert!((got / expected - 1.0).abs() < 4.0 * error && error < 0.06, "{x}: {got} ± {error}, not {expected}");
    }
    // What is handed out to be looked at is on diffuse surfaces.
    assert!(maps[1].photons().is_empty() && maps[1].kept() > 0);
    assert!(maps[0].photons().iter().all(|photon| photon.position.y == 0.0));
    assert!(maps[2].photons().iter().all(|photon| photon.position.x <= 0.0));
}

#[test]
fn light_that_comes_over_a_mirror_alone_lands_on_black_and_on_the_mirror() {
    // The lamp looks up into a mirror at 3 m, and stands in the way of nothing that comes to the left of it.
    let parts = [
        level("black", [-2.0, 2.0], [-2.0, 2.0], 0.0, true),
        level("lamp", [-0.25, 0.25], [-0.25, 0.25], 2.0, true),
        level("mirror", [-4.0, 4.0], [-4.0, 4.0], 3.0, false),
    ];
    let transport = scene(&parts);
    assert!(plan(&transport.world).needed().contains(Effect::Caustics));
    let maps = run_to_end(&transport, photons(400_000)).maps();
    let place = Vec3A::new(-1.5, 0.0, 0.3);
    // The mirrored lamp is as far above the mirror as the lamp is below it, and reflected to 0.8.
    let mirrored = 0.8 * irradiance_below(place.as_dvec3(), lamp(0.25, 4.0));
    let on_mirror = Vec3A::new(0.3, 3.0, -0.2);
    let below = irradiance_below(on_mirror.as_dvec3(), lamp(0.25, 2.0));
    for (place, normal, expected) in [(place, Vec3A::Y, mirrored), (on_mirror, Vec3A::NEG_Y, below)] {
        let found = estimate(&maps, &at(&transport, place, normal));
        let (got, error) = (f64::from(found.irradiance.x), f64::from(found.relative_error));
        assert!((got / expected - 1.0).abs() < 4.0 * error && error < 0.06, "{place}: {got} ± {error}, not {expected}");
    }
}

#[test]
fn where_no_photon_lands_the_error_is_that_of_one() {
    // Behind the lamp, where nothing shines.
    let transport = floor("grey", "grey");
    let maps = run_to_end(&transport, photons(10_000)).maps();
    let found = estimate(&maps, &at(&transport, Vec3A::new(0.0, 2.0, 0.0), Vec3A::Y));
    assert_eq!((found.irradiance.x, found.photons), (0.0, 0));
    let flux = 10.0 * std::f32::consts::PI * 0.25 / 10_000.0;
    let one = flux / (std::f32::consts::PI * found.radius * found.radius * found.inside);
    assert!((found.variance.x.sqrt() / one - 1.0).abs() < 1e-5, "{found:?}, {one}");
}

/// A ball of few facets with the normals of a sphere. Half of what lands on it is absorbed, whichever way the normals lean:
/// none of what is reflected goes into the polygon.
#[test]
fn smooth_normals_absorb_no_more_than_the_surface_does() {
    let mut text = level("lamp", [-0.5, 0.5], [-0.5, 0.5], 2.0, false) + "usemtl half\n";
    let equator = [Vec3::X, Vec3::NEG_Z, Vec3::NEG_X, Vec3::Z];
    for quarter in 0..4 {
        let [from, to] = [equator[quarter], equator[(quarter + 1) % 4]];
        for corners in [[from, to, Vec3::Y], [to, from, Vec3::NEG_Y]] {
            for normal in corners {
                let at = 0.5 * normal;
                text += &format!("v {} {} {}\nvn {} {} {}\n", at.x, at.y, at.z, normal.x, normal.y, normal.z);
            }
            text += "f -3//-3 -2//-2 -1//-1\n";
        }
    }
    let mtl = format!("{MTL}newmtl half\nKd 0.5 0.5 0.5\nillum 1\n");
    let ball = transport(Scene::from_text("ball", &format!("mtllib m.mtl\n{text}"), &mtl).expect("a scene"));
    let photons = PhotonSettings { count: 600_000, ..PhotonSettings::default() };
    let solution = run_to_end(&ball, photons).solution();
    // The ball is convex, and the lamp black: what lands on the ball lands once.
    let is_absorbed = |photon: &&Photon| {
        let trail = trail(&ball, &settings(photons), 0, photon.emission, false);
        trail.places[1].scattering.is_none()
    };
    let landed = solution.photons.len() as f64;
    let absorbed = solution.photons.iter().filter(is_absorbed).count() as f64 / landed;
    // A coin for each landing.
    assert!(landed > 10_000.0 && (absorbed - 0.5).abs() < 4.0 * 0.5 / landed.sqrt(), "{absorbed} of {landed}");
}
