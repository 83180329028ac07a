//! A mirror, glass and its caustic: every way to the same picture, and what each leaves out.

use super::agreement::{Part, check, mean_of, settings};
use super::{builtin, finished, home, sources, with_photons};
use lightwell::cancel::Cancel;
use lightwell::math::rgb::Rgb;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::photon_map::PhotonMapping;
use lightwell::methods::{ImageSettings, PhotonSettings, Settings, Step};
use lightwell::solution::{CameraImage, CameraView};

const BACK_WALL: Part = ("back wall", [26.0, 38.0], [16.0, 22.0]);
const MIRROR: Part = ("mirror ball", [17.0, 26.0], [42.0, 51.0]);
const GLASS: Part = ("glass ball", [39.0, 47.0], [43.0, 50.0]);
const CAUSTIC: Part = ("caustic", [42.0, 48.0], [57.0, 60.0]);
const CEILING: Part = ("ceiling", [20.0, 44.0], [1.0, 3.0]);

const SIZE: [u32; 2] = [128, 128];

#[test]
fn final_gather_sees_mirror_glass_and_caustic_as_brute_force_does() {
    let world = builtin("cornell-spheres");
    let settings = settings();
    let sources = with_photons(sources(&world), &settings);
    let image = finished(&sources, CameraView::FinalGather, home(&world), SIZE, &settings);
    // As in the room without spheres; behind glass there are fewer rays.
    check(&sources, &home(&world), &image, &[BACK_WALL, MIRROR, GLASS], 0.025);
    // The caustic has thousands of photons, spread by the radius of the estimate, which takes some light across its edge.
    check(&sources, &home(&world), &image, &[CAUSTIC], 0.05);
}

#[test]
fn rays_alone_leave_the_caustic_and_the_ceiling_dark() {
    let world = builtin("cornell-spheres");
    let settings = settings();
    let sources = with_photons(sources(&world), &settings);
    let see = |view| finished(&sources, view, home(&world), SIZE, &settings);
    let (traced, gathered, caustics) =
        (see(CameraView::RayTraced), see(CameraView::FinalGather), see(CameraView::Caustics));
    assert_eq!(mean_of(&traced, CEILING), Rgb::ZERO);
    let brightness = |image: &CameraImage, part| mean_of(image, part).element_sum();
    // Most of the spot under the glass is caustic, and none of it is seen by rays to the lamp, which glass stops.
    assert!(brightness(&traced, CAUSTIC) < 0.3 * brightness(&gathered, CAUSTIC));
    assert!(brightness(&caustics, CAUSTIC) > 0.4 * brightness(&gathered, CAUSTIC));
    // Nothing else is: away from the spheres there is some light over two mirrors, but little.
    assert!(brightness(&caustics, BACK_WALL) < 0.1 * brightness(&gathered, BACK_WALL));
}

#[test]
fn progressive_photons_come_to_the_same_picture() {
    let world = builtin("cornell-spheres");
    const PASSES: u32 = 24;
    let settings = Settings {
        photons: PhotonSettings {
            count: 100_000,
            caustic_count: 100_000,
            is_progressive: true,
            passes: PASSES,
            ..PhotonSettings::default()
        },
        image: ImageSettings { samples: PASSES, ..ImageSettings::default() },
        ..Settings::default()
    };
    let plain = sources(&world);
    let mut photons = PhotonMapping::new(plain.transport.clone(), &settings);
    let mut pass = || {
        while photons.step(&Cancel::default()) == Step::Advanced && !photons.is_pass_complete() {}
        Sources { photons: Some(photons.maps()), ..plain.clone() }
    };
    let mut run = ImageRun::new(&pass(), CameraView::PhotonRadiance, home(&world), SIZE, &settings).expect("photons");
    while run.step(&Cancel::default()) == Step::Advanced {
        if run.is_between_passes() && run.samples() < PASSES {
            assert!(run.go_on_with(&pass()));
        }
    }
    let image = run.image().expect("a picture");
    // 2.4 million photons in all. Of the smallest part, a few thousand times the passes: noise is below 1 %; the radius,
    // down to 0.6 of the first, still blurs edges of the caustic and of what mirrors show.
    check(&plain, &home(&world), &image, &[BACK_WALL, MIRROR, GLASS], 0.03);
    check(&plain, &home(&world), &image, &[CAUSTIC], 0.06);
}
