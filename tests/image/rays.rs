//! Direct light, mirrors, and the paths of light, against closed forms.

use super::{builtin, camera, finished, home, mean, scene, sources, with_samples};
use glam::Vec3;
use lightwell::math::rgb::Rgb;
use lightwell::methods::radiosity;
use lightwell::methods::{ImageSettings, Settings, Step};
use lightwell::solution::{CameraView, SurfaceProbe};
use lightwell::tracer::Ray;
use std::f32::consts::PI;
use std::sync::Arc;

/// A lamp of 2 × 2 two metres above a wide floor.
const LAMP_OVER_FLOOR: &str = "\
mtllib m.mtl
v -9 0 -9\nv -9 0 9\nv 9 0 9\nv 9 0 -9
usemtl floor
f 1 2 3 4
v -1 2 -1\nv 1 2 -1\nv 1 2 1\nv -1 2 1
usemtl lamp
f 5 6 7 8
";
const LAMP_MTL: &str = "newmtl floor\nKd 0.6 0.3 0.9\nnewmtl lamp\nKd 0 0 0\nKe 5 5 5\n";

#[test]
fn direct_light_below_a_lamp_is_its_form_factor() {
    let world = scene(LAMP_OVER_FLOOR, LAMP_MTL);
    // Below the lamp, between it and the floor, looking down on a spot of 2 mm.
    let down = camera(&world, Vec3::new(0.0, 0.1, 0.0), Vec3::ZERO, Vec3::NEG_Z, 1.0);
    let settings = Settings {
        image: ImageSettings { samples: 64, light_rays: 16, ..ImageSettings::default() },
        ..Settings::default()
    };
    let image = finished(&sources(&world), CameraView::RayTraced, down, [8, 8], &settings);
    // From a point in the middle under a square: facts on form factors, unit squares at gap 1.
    let form_factor = 0.239_456_47;
    let expected = Rgb::new(0.6, 0.3, 0.9) * 5.0 * form_factor;
    let got = mean(&image, [0.0, 1.0], [0.0, 1.0]);
    // 65,536 stratified points of an integrand that varies by a factor of 3: the error of independent ones would be 0.1 %.
    assert!((got / expected - Rgb::ONE).abs().max_element() < 1e-3, "{got} instead of {expected}");
}

/// A mirror in the plane z = 0, and a lamp 2 m before it that shines on it.
const MIRRORED_LAMP: &str = "\
mtllib m.mtl
v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0
usemtl mirror
f 1 2 3 4
v -0.1 -0.1 2\nv -0.1 0.1 2\nv 0.1 0.1 2\nv 0.1 -0.1 2
usemtl lamp
f 5 6 7 8
";

#[test]
fn a_mirror_shows_the_lamp_in_its_own_radiance() {
    let mtl = "newmtl mirror\nKd 0 0 0\nKs 0.8 0.5 0.25\nillum 3\nnewmtl lamp\nKd 0 0 0\nKe 7 7 7\n";
    let world = scene(MIRRORED_LAMP, mtl);
    // The mirrored lamp is at z = -2; seen from beside it past its edge.
    let eye = Vec3::new(0.0, 0.5, 2.0);
    let to_image = camera(&world, eye, Vec3::new(0.0, 0.0, -2.0), Vec3::Y, 1.0);
    let image = finished(&sources(&world), CameraView::RayTraced, to_image, [4, 4], &with_samples(4));
    let got = mean(&image, [0.0, 1.0], [0.0, 1.0]);
    assert!((got - 7.0 * Rgb::new(0.8, 0.5, 0.25)).abs().max_element() < 1e-5, "{got}");
    // Half a degree beside it there is only the dark.
    let beside = camera(&world, eye, Vec3::new(0.2, 0.0, -2.0), Vec3::Y, 1.0);
    let image = finished(&sources(&world), CameraView::RayTraced, beside, [4, 4], &with_samples(4));
    assert_eq!(mean(&image, [0.0, 1.0], [0.0, 1.0]), Rgb::ZERO);
}

#[test]
fn a_faint_mirror_image_is_right_on_average() {
    let mtl = "newmtl mirror\nKd 0 0 0\nKs 0.1 0.1 0.1\nillum 3\nnewmtl lamp\nKd 0 0 0\nKe 7 7 7\n";
    let world = scene(MIRRORED_LAMP, mtl);
    let to_image = camera(&world, Vec3::new(0.0, 0.5, 2.0), Vec3::new(0.0, 0.0, -2.0), Vec3::Y, 1.0);
    let image = finished(&sources(&world), CameraView::RayTraced, to_image, [8, 8], &with_samples(256));
    let got = mean(&image, [0.0, 1.0], [0.0, 1.0]).x;
    // Two of five rays survive roulette: of 16,384 the mean is off by √(0.6 / 0.4 / 16384) = 1 %; 4 of these are allowed.
    assert!((got / 0.7 - 1.0).abs() < 0.04, "{got}");
}

#[test]
fn a_lamp_in_glass_is_dimmed_by_the_solid_angle_that_widens_outside() {
    let obj = "\
mtllib m.mtl
v -1 0 -1\nv 1 0 -1\nv 1 2 -1\nv -1 2 -1\nv -1 0 1\nv 1 0 1\nv 1 2 1\nv -1 2 1
usemtl glass
f 5 6 7 8\nf 2 1 4 3\nf 6 2 3 7\nf 1 5 8 4\nf 8 7 3 4\nf 1 2 6 5
v -0.5 1 -0.5\nv -0.5 1 0.5\nv 0.5 1 0.5\nv 0.5 1 -0.5
usemtl lamp
f 9 10 11 12
";
    let mtl = "newmtl glass\nKd 0 0 0\nNi 1.5\nillum 7\nnewmtl lamp\nKd 0 0 0\nKe 3 3 3\n";
    let world = scene(obj, mtl);
    let down = camera(&world, Vec3::new(0.0, 4.0, 0.0), Vec3::ZERO, Vec3::NEG_Z, 1.0);
    let image = finished(&sources(&world), CameraView::RayTraced, down, [4, 4], &with_samples(4));
    // Along the normal 4 % are reflected, and L / n² is the same on both sides. Half a degree beside it, cosines differ by
    // 4e-5.
    let expected = 3.0 * 0.96 / (1.5 * 1.5);
    let got = mean(&image, [0.0, 1.0], [0.0, 1.0]).x;
    assert!((got / expected - 1.0).abs() < 1e-3, "{got} instead of {expected}");
    // From within, nothing is lost.
    let inside = camera(&world, Vec3::new(0.0, 1.5, 0.0), Vec3::ZERO, Vec3::NEG_Z, 1.0);
    let image = finished(&sources(&world), CameraView::RayTraced, inside, [4, 4], &with_samples(4));
    assert_eq!(mean(&image, [0.0, 1.0], [0.0, 1.0]).x, 3.0);
}

#[test]
fn patterns_of_paths_split_the_picture_without_rest() {
    let world = builtin("cornell-box");
    let picture = |pattern: &str| {
        let filter = pattern.parse().expect("a pattern");
        let image = ImageSettings { samples: 1, filter, ..ImageSettings::default() };
        let settings = Settings { image, ..Settings::default() };
        finished(&sources(&world), CameraView::RayTraced, home(&world), [64, 64], &settings).radiance
    };
    let (all, emitted, direct) = (picture(""), picture("LE"), picture("LDE"));
    assert!(emitted.iter().any(|pixel| *pixel != Rgb::ZERO) && direct.iter().any(|pixel| *pixel != Rgb::ZERO));
    for ((all, emitted), direct) in all.iter().zip(&emitted).zip(&direct) {
        assert!((*all - *emitted - *direct).abs().max_element() <= 1e-6 * all.max_element());
    }
    assert!(picture("LDDE").iter().all(|pixel| *pixel == Rgb::ZERO), "no light between diffuse surfaces");
}

#[test]
fn radiosity_is_seen_as_it_was_solved() {
    let world = builtin("cornell-box");
    let settings = with_samples(1);
    let mut method = radiosity::start(world.clone(), &settings);
    for _ in 0..50 {
        assert_eq!(method.step(&lightwell::cancel::Cancel::default()), Step::Advanced);
    }
    let solution = Arc::new(method.solution());
    let mut sources = sources(&world);
    sources.radiosity = Some(solution.clone());
    let spot = camera(&world, Vec3::new(0.43, 0.3, 0.1), Vec3::new(0.4, 0.0, 0.1), Vec3::Z, 1.0);
    let image = finished(&sources, CameraView::RadiositySpecular, spot, [2, 2], &settings);
    let ray: Ray = spot.ray([1.0, 1.0], [2, 2]);
    let hit = world.tracer.closest(&ray).expect("the floor");
    let point = ray.origin + hit.distance * ray.direction;
    let irradiance = SurfaceProbe::new(&world, &solution).irradiance(point, glam::Vec3A::Y).expect("on the floor");
    let expected = Rgb::new(0.725, 0.71, 0.68) * irradiance / PI;
    let got = mean(&image, [0.0, 1.0], [0.0, 1.0]);
    // Over a spot of 5 mm, light on a mesh of 15 mm varies by less than a percent.
    assert!((got / expected - Rgb::ONE).abs().max_element() < 0.01, "{got} instead of {expected}");
}
