//! The books of photons.

use super::rooms::{add, add_material, furnace, mirror, square};
use super::{open, run_to_end, settings, transport};
use glam::{Quat, Vec3};
use lightwell::cancel::Cancel;
use lightwell::math::rgb::total;
use lightwell::methods::photon_map::{PhotonMapping, trail};
use lightwell::methods::transport::Transport;
use lightwell::methods::{PhotonSettings, Step};
use lightwell::scene::BUILTINS;
use lightwell::solution::{Path, PhotonSolution};
use std::sync::Arc;

fn check_books(name: &str, solution: &PhotonSolution) {
    let PhotonSolution { energy, counters, .. } = solution;
    assert!(total(energy.defect()).abs() <= 1e-12 * total(energy.emitted), "{name}: {energy:?}");
    assert_eq!(counters.emitted, counters.absorbed + counters.escaped + counters.truncated, "{name}: {counters:?}");
    let landings: u64 = counters.by_bounce.iter().sum();
    assert_eq!(landings, counters.by_path.iter().map(|(_, count)| count).sum::<u64>(), "{name}: {counters:?}");
    assert!(landings >= counters.stored, "{name}: {counters:?}");
    assert!(counters.rays >= counters.emitted + counters.caustic_emitted, "{name}: {counters:?}");
}

#[test]
fn the_ledger_closes_after_every_step_in_every_built_in_scene() {
    for builtin in BUILTINS {
        let transport = open(builtin.name);
        if transport.emitters().is_empty() {
            check_darkness(builtin.name, &transport);
            continue;
        }
        let photons = PhotonSettings { count: 40_000, caustic_count: 10_000, ..PhotonSettings::default() };
        let mut mapping = PhotonMapping::new(transport.clone(), &settings(photons));
        check_books(builtin.name, &mapping.solution());
        assert!(mapping.solution().photons.is_empty() && mapping.maps().photons().is_empty());
        let mut steps = 0;
        while mapping.step(&Cancel::default()) == Step::Advanced {
            steps += 1;
            let solution = mapping.solution();
            check_books(builtin.name, &solution);
            assert_eq!(solution.batches, steps);
        }
        let solution = mapping.solution();
        println!("{}: {:?}", builtin.name, solution.counters);
        assert!(solution.is_complete && solution.passes == 1 && solution.counters.emitted == 40_000);
        assert_eq!(solution.photons.len() as u64, solution.counters.stored + solution.counters.caustic_stored);
        // Each photon carries its share in single precision.
        let flux = transport.emitters().flux();
        assert!((total(solution.energy.emitted) / total(flux) - 1.0).abs() < 1e-6, "{}", builtin.name);
        let lobes = |material: &lightwell::scene::Material| material.lobes().is_specular();
        if !transport.world.scene.materials.iter().any(lobes) {
            assert_eq!((solution.counters.caustic_emitted, solution.counters.caustic_stored), (0, 0));
            assert!(solution.photons.iter().all(|photon| !photon.path.to_string().contains('S')));
        }
    }
}

/// Without an emitter there is nothing to do, and the books hold nothing.
fn check_darkness(name: &str, transport: &Arc<Transport>) {
    let mut mapping = PhotonMapping::new(transport.clone(), &settings(PhotonSettings::default()));
    assert_eq!(mapping.step(&Cancel::default()), Step::Converged, "{name}");
    let solution = mapping.solution();
    check_books(name, &solution);
    let PhotonSolution { energy, counters, .. } = &solution;
    assert_eq!([energy.emitted, energy.absorbed, energy.escaped, energy.defect()].map(total), [0.0; 4], "{name}");
    assert_eq!((counters.emitted, counters.caustic_emitted, counters.rays), (0, 0, 0), "{name}: {counters:?}");
    assert!(solution.photons.is_empty() && mapping.maps().photons().is_empty(), "{name}");
}

#[test]
fn a_step_that_is_cancelled_changes_nothing() {
    let transport = open("cornell-box");
    let mut mapping = PhotonMapping::new(transport, &settings(PhotonSettings::default()));
    assert_eq!(mapping.step(&Cancel::default()), Step::Advanced);
    let before = mapping.solution();
    let cancel = Cancel::default();
    cancel.request();
    assert_eq!(mapping.step(&cancel), Step::Cancelled);
    let after = mapping.solution();
    assert_eq!((before.batches, before.energy, before.counters), (after.batches, after.energy, after.counters));
    assert_eq!(before.photons, after.photons);
}

#[test]
fn caustics_are_either_in_their_own_map_or_in_the_global_one() {
    let mut scene = furnace(0.5);
    let material = add_material(&mut scene, mirror());
    add(&mut scene, material, &[square(0.5, Quat::from_rotation_x(0.4), Vec3::splat(0.5))]);
    let transport = transport(scene);
    let with = PhotonSettings { count: 20_000, caustic_count: 30_000, ..PhotonSettings::default() };
    let own = run_to_end(&transport, with).solution();
    let shared = run_to_end(&transport, PhotonSettings { caustic_count: 0, ..with }).solution();
    let caustics = |solution: &PhotonSolution| solution.photons.iter().filter(|p| p.path.is_caustic()).count() as u64;
    // The global photons are the same: those of caustics are counted, but not kept where they have a map of their own.
    assert_eq!(own.energy, shared.energy);
    assert_eq!(own.counters.by_path, shared.counters.by_path);
    assert_eq!(caustics(&own), own.counters.caustic_stored);
    assert_eq!(caustics(&shared), shared.counters.stored - own.counters.stored);
    // Both carry the same light, to the noise of so many landings.
    let flux = |solution: &PhotonSolution| {
        let caustics = solution.photons.iter().filter(|photon| photon.path.is_caustic());
        caustics.map(|photon| f64::from(photon.flux.x)).sum::<f64>()
    };
    let noise = (1.0 / caustics(&own) as f64 + 1.0 / caustics(&shared) as f64).sqrt();
    assert!((flux(&own) / flux(&shared) - 1.0).abs() < 4.0 * noise, "{} {}", flux(&own), flux(&shared));
    assert!(shared.counters.caustic_emitted == 0 && own.counters.caustic_emitted == 30_000);
}

#[test]
fn a_trail_leads_to_the_places_where_its_photon_landed() {
    let mut scene = furnace(0.8);
    let material = add_material(&mut scene, mirror());
    add(&mut scene, material, &[square(0.5, Quat::from_rotation_x(0.4), Vec3::splat(0.5))]);
    let transport = transport(scene);
    let photons = PhotonSettings { count: 2_000, caustic_count: 2_000, ..PhotonSettings::default() };
    let solution = run_to_end(&transport, photons).solution();
    let mut long = 0;
    // Of longer paths the beginning is not known.
    for photon in solution.photons.iter().filter(|photon| photon.path.len() < Path::MAX_EVENTS) {
        let trail = trail(&transport, &settings(photons), 0, photon.emission, photon.path.is_caustic());
        // The emitter, then the surfaces that it met before, then where it landed.
        let place = &trail.places[photon.path.len() + 1];
        assert_eq!((place.point, place.flux), (photon.position, photon.flux));
        let events: Vec<_> = trail.places[1..=photon.path.len()].iter().filter_map(|place| place.scattering).collect();
        assert_eq!(events, photon.path.events().collect::<Vec<_>>());
        assert!(trail.places.iter().all(|place| (0.0..=1.0).contains(&place.survival)));
        assert!(trail.escape.is_none() && trail.places.last().is_some_and(|place| place.scattering.is_none()));
        long += usize::from(photon.path.len() > 3);
    }
    assert!(long > 1000, "{long} photons came far");
}

/// A photon meets a thousand surfaces on average, and 0.999^16384 = 8e-8 of the flux meet more than are followed.
#[test]
fn a_room_that_reflects_nearly_all_keeps_its_flux() {
    let transport = transport(furnace(0.999));
    let photons = PhotonSettings { count: 2000, ..PhotonSettings::default() };
    let solution = run_to_end(&transport, photons).solution();
    let PhotonSolution { energy, .. } = &solution;
    assert!(total(energy.truncated) < 1e-3 * total(energy.emitted), "{energy:?}");
    assert_eq!(solution.warning(), None);
}
