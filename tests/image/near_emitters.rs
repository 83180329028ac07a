//! Direct light near large emitters, by every view that samples it, against closed forms.

use super::{camera, finished, scene, sources, with_photons};
use glam::{DVec3, Vec2, Vec3, Vec3A};
use lightwell::cancel::Cancel;
use lightwell::math::polygon::form_factor;
use lightwell::math::random::sobol2;
use lightwell::math::stats::Moments;
use lightwell::methods::image::{Meters, Reading, Sources};
use lightwell::methods::path_trace::{Sensor, Sensors};
use lightwell::methods::radiosity;
use lightwell::methods::transport::Surface;
use lightwell::methods::{ImageSettings, PhotonSettings, Settings, Step};
use lightwell::solution::{CameraView, PathFilter};
use lightwell::tracer::Ray;
use lightwell::world::World;
use std::fmt::Write;
use std::sync::Arc;

/// Of M_e = 1 and ρ = 0.5: in a closed room B = M_e/(1 − ρ) = 2 everywhere, which is also E; and of that 1 comes straight.
const GLOW: &str = "newmtl glow\nKd .5 .5 .5\nKe .318309886184 .318309886184 .318309886184\n";
const DIRECT: f64 = 1.0;
const ALL: f64 = 2.0;

/// A floor of 10 m, and on it two roof slopes that meet it at an acute edge and each other above its middle.
fn attic(slope: f64) -> Arc<World> {
    let mut obj = "mtllib m.mtl\nusemtl glow\n".to_owned();
    for (x, y) in [(0.0, 0.0), (10.0, 0.0), (5.0, 5.0 * slope)] {
        let _ = writeln!(obj, "v {x} {y} 0\nv {x} {y} 10");
    }
    // Floor, slopes and gables.
    scene(&(obj + "f 1 2 4 3\nf 1 5 6 2\nf 3 4 6 5\nf 1 3 5\nf 2 6 4\n"), GLOW)
}

/// A glowing panel of 1 m, 1 cm before the middle of a wall of 2 m. Its back does not emit.
const PANEL: &str = "\
mtllib m.mtl
usemtl wall
v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4
usemtl glow
v -0.5 -0.5 0.01\nv -0.5 0.5 0.01\nv 0.5 0.5 0.01\nv 0.5 -0.5 0.01\nf 5 6 7 8
";
const PANEL_MTL: &str =
    "newmtl wall\nKd .5 .5 .5\nnewmtl glow\nKd .5 .5 .5\nKe .318309886184 .318309886184 .318309886184
";

/// A floor of 4 m, 3 m over it a lamp of 1 m that faces down, and beside its middle a lamp of 1 % of that flux, 10 cm wide.
const TWO_LAMPS: &str = "\
mtllib m.mtl
usemtl wall
v -2 0 2\nv 2 0 2\nv 2 0 -2\nv -2 0 -2\nf 1 2 3 4
usemtl glow
v -0.5 3 -0.5\nv 0.5 3 -0.5\nv 0.5 3 0.5\nv -0.5 3 0.5\nf 5 6 7 8
v 0 0.1 -0.05\nv 0.1 0.1 -0.05\nv 0.1 0.1 0.05\nv 0 0.1 0.05\nf 9 10 11 12
";

fn two_lamps_irradiance(point: Vec3A) -> f64 {
    let lamp = |low: DVec3, edge: f64| {
        let corners = [(0.0, 0.0), (edge, 0.0), (edge, edge), (0.0, edge)].map(|(x, z)| low + DVec3::new(x, 0.0, z));
        form_factor(point.as_dvec3(), DVec3::Y, &corners)
    };
    lamp(DVec3::new(-0.5, 3.0, -0.5), 1.0) + lamp(DVec3::new(0.0, 0.1, -0.05), 0.1)
}

/// Points of the floor round the weak lamp, to 0.3 m from it; none under the shadow of it.
fn beside_the_weak_lamp() -> Vec<(Vec3A, Vec3A)> {
    let place = |i: u32| {
        let at = sobol2(i, 0, 5);
        (Vec3A::new(0.15 + 0.2 * at.x, 0.0, 0.4 * at.y - 0.2), Vec3A::Y)
    };
    (0..100).map(place).collect()
}

fn panel_irradiance(point: Vec3A) -> f64 {
    let corners = [(-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5)].map(|(x, y)| DVec3::new(x, y, 0.01));
    form_factor(point.as_dvec3(), DVec3::Z, &corners)
}

/// Points of the floor of an attic of this slope: the first ten have the roof 5 mm above them, the next ones are anywhere.
fn on_the_floor(slope: f32) -> Vec<(Vec3A, Vec3A)> {
    let from_edge = 0.005 / slope;
    let place = |i: u32| {
        let at = sobol2(i, 0, 3) * 10.0;
        let at = if i < 10 {
            Vec2::new(from_edge, at.y.clamp(1.0, 9.0))
        } else {
            at.clamp(Vec2::splat(0.3), Vec2::splat(9.7))
        };
        (Vec3A::new(at.x, 0.0, at.y), Vec3A::Y)
    };
    (0..100).map(place).collect()
}

/// Points of the wall, most of them under the panel.
fn on_the_wall() -> Vec<(Vec3A, Vec3A)> {
    (0..100).map(|i| ((sobol2(i, 0, 4) * 1.4 - 0.7).extend(0.0).into(), Vec3A::Z)).collect()
}

/// As a ray meets it that comes from 1 mm above.
fn surfaces(sources: &Sources, points: &[(Vec3A, Vec3A)]) -> Vec<Surface> {
    let surface = |&(point, normal): &(Vec3A, Vec3A)| {
        let ray = Ray::new(point + 1e-3 * normal, -normal);
        let surface = sources.transport.meet(&ray).expect("a surface");
        assert!(surface.point.abs_diff_eq(point, 1e-5) && surface.is_front, "{surface:?}");
        surface
    };
    points.iter().map(surface).collect()
}

/// Red E at a point, W/m².
#[derive(Debug)]
struct Found {
    irradiance: f64,
    standard_error: f64,
}

/// By so many samples of a view.
fn metered(sources: &Sources, view: CameraView, surfaces: &[Surface], settings: &Settings) -> Vec<Found> {
    let mut meters = Meters::new(sources, view, surfaces.to_vec(), settings).expect("all it needs");
    (0..settings.image.samples).for_each(|_| assert!(meters.step(&Cancel::default())));
    let red =
        |reading: &Reading| Found { irradiance: reading.irradiance[0], standard_error: reading.standard_error[0] };
    meters.readings().iter().map(red).collect()
}

/// Every value within 3 of its standard errors, as often as chance allows: of 100 values 0.3 are beyond, and more than 4
/// once in 10,000. Low-discrepancy samples are nearer. `rounding` is a share, of what is no matter of chance.
fn assert_within_errors(name: &str, found: &[Found], expected: &[f64], rounding: f64) {
    let away = |(found, expected): (&Found, &f64)| {
        ((found.irradiance - expected).abs() - rounding * expected).max(0.0) / found.standard_error.max(1e-9)
    };
    let outside: Vec<_> = found.iter().zip(expected).enumerate().filter(|(_, pair)| away(*pair) > 3.0).collect();
    let error = found.iter().map(|value| value.standard_error / value.irradiance).fold(0.0, f64::max);
    println!("{name}: {} of {} outside, largest standard error {error:.4}", outside.len(), found.len());
    assert!(outside.len() <= 4, "{name}: {outside:?}");
    // A sample is never farther off than some times its mean: its error does not hide a part of the light.
    assert!(error < 0.15, "{name}: {error}");
}

fn settings(samples: u32, filter: &str) -> Settings {
    let filter: PathFilter = filter.parse().expect("a pattern");
    Settings {
        photons: PhotonSettings { count: 200_000, ..PhotonSettings::default() },
        image: ImageSettings { samples, gather_rays: 16, light_rays: 4, filter },
        ..Settings::default()
    }
}

/// Direct light by points of emitters against cosine-distributed rays: a few of their own, or those that gather.
#[test]
fn direct_light_near_emitters_is_its_closed_form_in_every_view() {
    let panel: Vec<f64> = on_the_wall().iter().map(|&(point, _)| panel_irradiance(point)).collect();
    let scenes = [
        ("slope 1/10", attic(0.1), on_the_floor(0.1), vec![DIRECT; 100]),
        ("slope 1/100", attic(0.01), on_the_floor(0.01), vec![DIRECT; 100]),
        ("panel", scene(PANEL, PANEL_MTL), on_the_wall(), panel),
    ];
    for (name, world, points, expected) in scenes {
        let settings = settings(128, "LDE");
        let sources = with_photons(sources(&world), &settings);
        let surfaces = surfaces(&sources, &points);
        for view in [CameraView::RayTraced, CameraView::FinalGather] {
            let found = metered(&sources, view, &surfaces, &settings);
            // Rays start off the floor by 4e-5 m, less than 1/100 of what is 5 mm away; up to such a share of the light that
            // comes from beyond changes its place.
            assert_within_errors(&format!("{name}, {view:?}"), &found, &expected, 2e-3);
        }
    }
}

#[test]
fn radiosity_with_direct_rays_and_the_reference_are_right_near_emitters() {
    for slope in [0.1, 0.01] {
        let world = attic(slope.into());
        let settings = Settings { unshot_limit: 1e-5, ..settings(128, "") };
        let mut method = radiosity::start(world.clone(), &settings);
        while matches!(method.step(&Cancel::default()), Step::Advanced | Step::Prepared) {}
        let sources = Sources { radiosity: Some(Arc::new(method.solution())), ..sources(&world) };
        let points = on_the_floor(slope);
        let found = metered(&sources, CameraView::RadiosityDirect, &surfaces(&sources, &points), &settings);
        assert_within_errors(&format!("radiosity-direct, {slope}"), &found, &[ALL; 100], 2e-3);
        let sensors = points.iter().map(|&(point, normal)| Sensor::new(&sources.transport, point, normal)).collect();
        let mut sensors = Sensors::new(sources.transport.clone(), sensors, 1);
        assert!(sensors.step(32, &Cancel::default()));
        let red = |[red, ..]: &[Moments; 3]| Found { irradiance: red.mean(), standard_error: red.standard_error() };
        let found: Vec<Found> = sensors.irradiance().iter().map(red).collect();
        assert_within_errors(&format!("reference, {slope}"), &found, &[ALL; 100], 2e-3);
    }
}

/// Twenty seeds at places near emitters: the truth is within what each of them states. An error that is stated too small is one
/// that few samples know of, so that most seeds miss it.
#[test]
fn standard_errors_near_emitters_are_honest() {
    let points = on_the_wall();
    let panel: Vec<f64> = points.iter().map(|&(point, _)| panel_irradiance(point)).collect();
    let beside = beside_the_weak_lamp();
    let lamps: Vec<f64> = beside.iter().map(|&(point, _)| two_lamps_irradiance(point)).collect();
    let scenes = [
        ("attic", attic(0.1), on_the_floor(0.1), vec![DIRECT; 20]),
        ("panel", scene(PANEL, PANEL_MTL), points, panel),
        ("weak lamp", scene(TWO_LAMPS, PANEL_MTL), beside, lamps),
    ];
    for (name, world, points, expected) in scenes {
        let sources = with_photons(sources(&world), &settings(16, "LDE"));
        let surfaces = surfaces(&sources, &points[..20]);
        for view in [CameraView::RayTraced, CameraView::FinalGather] {
            let mut outside = 0;
            for seed in 0..20 {
                let found = metered(&sources, view, &surfaces, &Settings { seed, ..settings(16, "LDE") });
                for (found, expected) in found.iter().zip(&expected) {
                    let miss = (found.irradiance - expected).abs() - 2e-3 * expected;
                    outside += usize::from(miss > 3.0 * found.standard_error);
                }
            }
            println!("{name}, {view:?}: {outside} of 400 outside");
            // Student's distribution with 15 degrees of freedom is beyond 3 for 0.9 %: 3.6 of 400, and 12 once in 3,000.
            assert!(outside <= 12, "{name}, {view:?}: {outside}");
        }
    }
}

/// A lamp over a glossy plane: what a lobe reflects of it is the same by every view, but not found by chance.
#[test]
fn highlights_of_lamps_on_gloss_are_those_of_the_reference_and_not_found_by_chance() {
    let obj = "\
mtllib m.mtl
usemtl gloss
v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4
usemtl lamp
v -0.05 1 -0.05\nv 0.05 1 -0.05\nv 0.05 1 0.05\nv -0.05 1 0.05\nf 5 6 7 8
";
    let mtl = "newmtl gloss\nKd 0.2 0.2 0.2\nKs 0.5 0.5 0.5\nNs 60\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n";
    let world = scene(obj, mtl);
    let sources = sources(&world);
    let camera = camera(&world, Vec3::new(0.0, 0.6, 1.5), Vec3::new(0.0, 0.4, 0.0), Vec3::Y, 60.0);
    let picture = |view, filter: &str, samples, seed| {
        let settings = Settings { seed, ..settings(samples, filter) };
        finished(&sources, view, camera, [32, 32], &settings).radiance
    };
    for filter in ["", "LSE", "LDE", "LE"] {
        let truth = picture(CameraView::Reference, filter, 256, 0);
        let mean = |pixels: &[Vec3]| pixels.iter().map(|pixel| f64::from(pixel.x)).sum::<f64>() / pixels.len() as f64;
        // Independent pictures, whose spread tells the error of their mean.
        let (mut means, mut squares) = (Moments::default(), Moments::default());
        for seed in 1..=16 {
            let found = picture(CameraView::RayTraced, filter, 4, seed);
            means.add(mean(&found));
            squares.add(truth.iter().zip(&found).map(|(a, b)| f64::from((a.x - b.x).powi(2))).sum::<f64>() / 1024.0);
        }
        let square = truth.iter().map(|pixel| f64::from(pixel.x.powi(2))).sum::<f64>() / 1024.0;
        let rms = (squares.mean() / square).sqrt();
        println!("{filter:?}: {:.5} {:.5} ± {:.5}, RMS {rms:.3}", mean(&truth), means.mean(), means.standard_error());
        // The truth has 4 times the samples of all; Student's distribution with 15 degrees of freedom: beyond 5 once in 6,000.
        let error = means.standard_error() * 1.25_f64.sqrt();
        assert!((means.mean() - mean(&truth)).abs() < 5.0 * error + 1e-6 * mean(&truth), "{filter:?}: {means:?}");
        if filter == "LSE" {
            // A lobe of (n + 1)/2π = 10/sr meets the lamp of 0.01 sr by chance once in ten times at best: an error of √(9/4) for
            // four samples. Points of the lamp differ by the change of the lobe over it alone: less than half of that.
            assert!(rms < 0.75, "{rms}");
        }
    }
}
