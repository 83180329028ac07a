//! Progressive radiosity: the ledger after every shot, the order of the shots, repeatability.

use super::{check_ledger, finish, furnace, world, world_of};
use lightwell::cancel::Cancel;
use lightwell::math::rgb::{Rgb, total};
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{Method, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::Solution;
use lightwell::world::World;
use std::sync::Arc;

fn solve(world: &Arc<World>, settings: Settings) -> Solution {
    let mut method = Progressive::new(world.clone(), settings);
    finish(&mut method);
    method.solution()
}

#[test]
fn the_ledger_closes_after_every_shot() {
    for name in ["cornell-box", "furnace", "two-rooms", "empty-box", "gallery"] {
        let world = world(name, None);
        let mut method = Progressive::new(world, Settings { shadow_rays: 8, ..Settings::default() });
        let mut unshot = f64::INFINITY;
        for _ in 0..60 {
            if method.step(&Cancel::default()) != Step::Advanced {
                break;
            }
            let energy = method.solution().energy;
            check_ledger(&energy);
            assert!([energy.absorbed, energy.unshot, energy.escaped].iter().all(|part| part.min_element() >= 0.0));
            assert!(total(energy.unshot) < unshot, "{name}: no shot makes light");
            unshot = total(energy.unshot);
        }
    }
}

#[test]
fn a_shot_in_a_closed_room_of_one_reflectance_takes_its_absorbed_share() {
    // Whatever the form factors are, a shot of flux Φ leaves ρ Φ to be shot (facts of a closed room of one ρ).
    let reflectance = 0.5;
    let world = world_of(furnace(reflectance), &MeshSettings { element_size: Some(0.1), ..MeshSettings::default() });
    let mut method = Progressive::new(world.clone(), Settings::default());
    for _ in 0..200 {
        let before = method.solution();
        assert_eq!(method.step(&Cancel::default()), Step::Advanced);
        let after = method.solution();
        let shooter = &world.mesh.patches[after.shooter.expect("a patch shot") as usize];
        let flux = before.light.unshot[shooter.elements.start as usize].as_dvec3() * shooter.area;
        let taken = total(before.energy.unshot) - total(after.energy.unshot);
        // Unshot radiosities are handed out in single precision.
        let expected = (1.0 - f64::from(reflectance)) * total(flux);
        assert!((taken / expected - 1.0).abs() < 1e-5, "{taken} for {expected}");
    }
}

#[test]
fn the_patch_with_the_most_unshot_flux_shoots() {
    let world = world("cornell-box", None);
    let mut method = Progressive::new(world.clone(), Settings::default());
    for _ in 0..50 {
        let before = method.solution();
        method.step(&Cancel::default());
        let flux = |patch: &lightwell::mesh::Patch| {
            total(before.light.unshot[patch.elements.start as usize].as_dvec3()) * patch.area
        };
        let most = world.mesh.patches.iter().map(flux).fold(0.0, f64::max);
        let shot = flux(&world.mesh.patches[method.solution().shooter.expect("a patch shot") as usize]);
        assert!(shot >= most * (1.0 - 1e-6), "{shot} of {most}");
    }
}

#[test]
fn one_thread_and_two_give_the_same_bits() {
    let on_threads = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let world = world("cornell-box", Some(0.04));
            let mut method = Progressive::new(world, Settings { seed: 7, ..Settings::default() });
            for _ in 0..200 {
                method.step(&Cancel::default());
            }
            method.solution()
        })
    };
    let (one, two) = (on_threads(1), on_threads(2));
    assert_eq!(one.light.irradiance, two.light.irradiance);
    assert_eq!(one.energy, two.energy);
    assert_eq!((one.closure, one.counters), (two.closure, two.counters));
}

#[test]
fn another_seed_gives_other_noise_and_the_same_light() {
    let world = world("cornell-box", Some(0.03));
    let mean = |seed: u64| {
        let solution = solve(&world, Settings { seed, unshot_limit: 1e-2, ..Settings::default() });
        let light = world.mesh.elements.iter().zip(&solution.light.irradiance);
        let flux: f64 = light.map(|(element, irradiance)| element.area * f64::from(irradiance.element_sum())).sum();
        (flux, solution.light.irradiance)
    };
    let (first, second) = (mean(1), mean(2));
    assert_ne!(first.1, second.1);
    // Both stop with 1 % unshot; the noise of the sum over all elements is far below that.
    assert!((first.0 / second.0 - 1.0).abs() < 1e-2, "{} {}", first.0, second.0);
}

#[test]
fn a_cancelled_shot_changes_nothing() {
    let world = world("cornell-box", Some(0.04));
    let mut interrupted = Progressive::new(world.clone(), Settings::default());
    let mut straight = Progressive::new(world, Settings::default());
    let stop = Cancel::default();
    stop.request();
    for _ in 0..20 {
        assert_eq!(interrupted.step(&stop), Step::Cancelled);
        assert_eq!(interrupted.step(&Cancel::default()), Step::Advanced);
        straight.step(&Cancel::default());
    }
    assert_eq!(interrupted.solution().light.irradiance, straight.solution().light.irradiance);
}

#[test]
fn a_scene_without_light_has_converged_before_the_first_shot() {
    let mut scene = Scene::open("empty-box").expect("a built-in scene");
    for material in &mut scene.materials {
        material.emission = Rgb::ZERO;
    }
    let mut method = Progressive::new(world_of(scene, &MeshSettings::default()), Settings::default());
    assert_eq!(method.step(&Cancel::default()), Step::Converged);
    let solution = method.solution();
    assert!(solution.converged && solution.light.radiosity.iter().all(|radiosity| *radiosity == Rgb::ZERO));
    check_ledger(&solution.energy);
}

#[test]
fn overshooting_gets_to_the_same_light_in_fewer_shots() {
    let world = world("cornell-box", Some(0.04));
    let settings = Settings { unshot_limit: 1e-3, ..Settings::default() };
    let plain = solve(&world, settings);
    let mut method = Progressive::new(world.clone(), Settings { overshoot: true, ..settings });
    while method.step(&Cancel::default()) == Step::Advanced {
        check_ledger(&method.solution().energy);
    }
    let over = method.solution();
    assert!(over.converged && over.steps * 3 < plain.steps * 2, "{} shots for {}", over.steps, plain.steps);
    // Each run is known to what it left unshot; the noise of its shadow rays is less in a sum over all elements.
    let [one, other] = [&plain, &over].map(|solution| total(solution.energy.absorbed));
    assert!((one / other - 1.0).abs() < 3e-3, "{one} {other}");
}
