//! Passes, tiles and cancelling.

use super::{builtin, finished, home, sources, with_photons, with_samples};
use lightwell::cancel::Cancel;
use lightwell::methods::image::ImageRun;
use lightwell::methods::{PhotonSettings, Settings, Step};
use lightwell::solution::CameraView;

const SIZE: [u32; 2] = [100, 75];

#[test]
fn pictures_are_coarse_first_and_end_with_all_samples() {
    let world = builtin("cornell-box");
    let settings = with_samples(2);
    let mut run = ImageRun::new(&sources(&world), CameraView::RayTraced, home(&world), SIZE, &settings)
        .expect("no photons needed");
    assert!(run.image().is_none(), "there is nothing to show before the first step");
    let mut resolutions = Vec::new();
    while run.step(&Cancel::default()) == Step::Advanced {
        let image = run.image().expect("a picture after the first step, which is all of the coarse pass here");
        assert_eq!(image.radiance.len(), (image.resolution[0] * image.resolution[1]) as usize);
        assert_eq!(image.coverage.len(), image.radiance.len());
        resolutions.push(image.resolution);
    }
    resolutions.dedup();
    assert_eq!(resolutions, [[7, 5], [13, 10], [25, 19], [50, 38], SIZE]);
    let image = run.image().expect("a picture");
    assert!(image.is_complete && image.samples == 2 && image.rays > u64::from(2 * SIZE[0] * SIZE[1]));
}

#[test]
fn a_stopped_step_changes_nothing() {
    let world = builtin("cornell-box");
    let (sources, settings) = (sources(&world), with_samples(1));
    let whole = finished(&sources, CameraView::RayTraced, home(&world), SIZE, &settings);
    let mut run =
        ImageRun::new(&sources, CameraView::RayTraced, home(&world), SIZE, &settings).expect("no photons needed");
    let stopped = Cancel::default();
    stopped.request();
    loop {
        assert_eq!(run.step(&stopped), if run.samples() == 1 { Step::Converged } else { Step::Cancelled });
        if run.step(&Cancel::default()) == Step::Converged {
            break;
        }
    }
    assert_eq!(run.image().expect("a picture").radiance, whole.radiance);
}

#[test]
fn pictures_are_the_same_on_any_number_of_threads() {
    let world = builtin("cornell-box");
    let (sources, settings) = (sources(&world), with_samples(1));
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| finished(&sources, CameraView::RayTraced, home(&world), SIZE, &settings).radiance)
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn the_background_is_not_covered() {
    let world = builtin("cornell-box");
    let mut camera = home(&world);
    camera.zoom(3.0);
    let image = finished(&sources(&world), CameraView::RayTraced, camera, SIZE, &with_samples(1));
    assert_eq!((image.coverage[0], image.coverage[(SIZE[1] / 2 * SIZE[0] + SIZE[0] / 2) as usize]), (0.0, 1.0));
}

#[test]
fn a_picture_that_goes_on_with_other_photons_is_the_mean_over_both() {
    let world = builtin("cornell-box");
    let view = CameraView::PhotonRadiance;
    let with_seed = |seed, samples| Settings {
        photons: PhotonSettings { count: 5_000, ..PhotonSettings::default() },
        ..Settings { seed, ..with_samples(samples) }
    };
    let plain = sources(&world);
    let [first, second] = [1, 2].map(|seed| with_photons(plain.clone(), &with_seed(seed, 1)));
    // Places in pixels come from the same seed, so that samples can be told apart.
    let radiance = |sources, samples| finished(sources, view, home(&world), SIZE, &with_seed(0, samples)).radiance;
    let mut run = ImageRun::new(&first, view, home(&world), SIZE, &with_seed(0, 2)).expect("photons");
    while run.samples() < 1 {
        assert_eq!(run.step(&Cancel::default()), Step::Advanced);
    }
    assert!(run.is_between_passes() && run.go_on_with(&second));
    while run.step(&Cancel::default()) == Step::Advanced {}
    let mixed = run.image().expect("a picture").radiance;
    let (of_first, of_second, both_of_second) = (radiance(&first, 1), radiance(&second, 1), radiance(&second, 2));
    let pixels = mixed.iter().zip(of_first).zip(of_second.iter().zip(both_of_second));
    for ((mixed, first), (second, both)) in pixels {
        let expected = 0.5 * (first + (2.0 * both - *second));
        assert!(mixed.abs_diff_eq(expected, 1e-5 * (1.0 + expected.max_element())), "{mixed} instead of {expected}");
    }
}
