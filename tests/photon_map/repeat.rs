//! The same settings give the same bits.

use super::{at, meet, open, run_to_end, settings};
use glam::Vec3A;
use lightwell::methods::photon_map::{Scratch, Which};
use lightwell::methods::{Kernel, PhotonSettings, Settings};
use lightwell::solution::{Path, PathFilter, Scattering};
use rayon::ThreadPoolBuilder;
use std::sync::Arc;

#[test]
fn photons_and_estimates_do_not_depend_on_the_number_of_threads() {
    let transport = open("cornell-box");
    let run = |threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mapping = run_to_end(&transport, PhotonSettings { count: 50_000, ..PhotonSettings::default() });
            let maps = mapping.maps();
            let estimate = |i: u16| {
                let way = Vec3A::new(0.1 * f32::from(i % 7) - 0.3, 0.1 * f32::from(i / 7) - 0.3, 1.0);
                let surface = meet(&transport, Vec3A::new(0.278, 0.273, -0.8), way);
                maps.irradiance(&surface, Which::All, &mut Scratch::default())
            };
            (mapping.solution(), (0..49).map(estimate).collect::<Vec<_>>())
        })
    };
    let (one, estimates) = run(1);
    for threads in [2, 3] {
        let (several, others) = run(threads);
        assert_eq!(one.photons, several.photons);
        assert_eq!((one.energy, &one.counters, &one.splits), (several.energy, &several.counters, &several.splits));
        assert_eq!(estimates, others);
    }
}

#[test]
fn what_needs_no_new_photons_keeps_them() {
    let transport = open("cornell-box");
    let photons = PhotonSettings { count: 20_000, ..PhotonSettings::default() };
    let mut mapping = run_to_end(&transport, photons);
    let before = mapping.solution().photons;
    let floor = at(&transport, Vec3A::new(0.4, 0.0, 0.1), Vec3A::Y);
    let plain = mapping.maps().irradiance(&floor, Which::All, &mut Scratch::default());
    let keeps = PhotonSettings { nearest: 50, max_radius: Some(0.02), kernel: Kernel::Cone, ..photons };
    assert!(mapping.configure(&settings(keeps)));
    assert!(Arc::ptr_eq(&before, &mapping.solution().photons));
    let changed = mapping.maps().irradiance(&floor, Which::All, &mut Scratch::default());
    assert!(changed.photons < plain.photons && changed.radius <= 0.02, "{plain:?} {changed:?}");
    for other in [
        settings(PhotonSettings { count: 20_001, ..photons }),
        settings(PhotonSettings { caustic_count: 1, ..photons }),
        settings(PhotonSettings { is_progressive: true, ..photons }),
        Settings { seed: 1, ..settings(photons) },
    ] {
        assert!(!mapping.configure(&other));
        assert!(Arc::ptr_eq(&before, &mapping.solution().photons));
    }
}

#[test]
fn light_is_the_sum_of_its_kinds() {
    let transport = open("cornell-box");
    let photons =
        PhotonSettings { count: 100_000, nearest: 100_000, max_radius: Some(0.05), ..PhotonSettings::default() };
    let maps = run_to_end(&transport, photons).maps();
    let mut scratch = Scratch::default();
    let filter = |pattern: &str| {
        let matcher = pattern.parse::<PathFilter>().unwrap().matcher();
        maps.filter(|path| matcher.passes(path, Some(Scattering::Diffuse), Path::LIGHT))
    };
    let (direct, second, all) = (filter("LDE"), filter("LDDE"), filter(""));
    for place in [Vec3A::new(0.4, 0.0, 0.1), Vec3A::new(0.53, 0.0, 0.3)] {
        let floor = at(&transport, place, Vec3A::Y);
        let mut ask = |which| maps.irradiance(&floor, which, &mut scratch);
        let whole = ask(Which::All);
        assert_eq!(whole, ask(Which::Filtered(&all)));
        assert_eq!(ask(Which::Direct), ask(Which::Filtered(&direct)));
        let parts = ask(Which::Direct).irradiance + ask(Which::Indirect).irradiance + ask(Which::Caustics).irradiance;
        assert!(parts.abs_diff_eq(whole.irradiance, 1e-4 * whole.irradiance.x), "{parts} {whole:?}");
        assert!(ask(Which::Caustics).photons == 0);
        let second = ask(Which::Filtered(&second));
        assert!(second.photons > 0 && second.photons < ask(Which::Indirect).photons);
    }
}
