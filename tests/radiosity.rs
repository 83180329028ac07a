//! Progressive radiosity against closed forms: the furnace, the ledger after every shot, repeatability.

use lightwell::cancel::Cancel;
use lightwell::math::rgb::{Rgb, total};
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{Method, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::{Energy, Solution};
use lightwell::world::World;
use std::sync::Arc;

fn world_of(scene: Scene, element_size: Option<f32>) -> Arc<World> {
    Arc::new(
        World::build(scene, &MeshSettings { element_size, ..MeshSettings::default() }, &Cancel::default())
            .expect("a world"),
    )
}

fn world(name: &str, element_size: Option<f32>) -> Arc<World> {
    world_of(Scene::open(name).expect("a built-in scene"), element_size)
}

/// The furnace with another reflectance.
fn furnace(reflectance: f32, element_size: f32) -> Arc<World> {
    let mut scene = Scene::open("furnace").expect("a built-in scene");
    for material in &mut scene.materials {
        material.diffuse = Rgb::splat(reflectance);
    }
    world_of(scene, Some(element_size))
}

fn solve(world: &Arc<World>, settings: Settings) -> Solution {
    let mut method = Progressive::new(world.clone(), settings);
    while method.step(&Cancel::default()) == Step::Advanced {}
    method.solution()
}

/// The ledger closes to rounding, and no part of it is negative.
fn check(energy: &Energy) {
    assert!(total(energy.defect()).abs() <= 1e-12 * total(energy.emitted), "{energy:?}");
    for part in [energy.absorbed, energy.unshot, energy.escaped] {
        assert!(part.min_element() >= 0.0 && part.is_finite(), "{energy:?}");
    }
}

#[test]
fn a_furnace_glows_evenly_on_every_element() {
    for reflectance in [0.3, 0.5, 0.9] {
        let world = furnace(reflectance, 0.05);
        // What is unshot is missing from the result: a tenth of the tolerance may be.
        let solution =
            solve(&world, Settings { unshot_limit: 5e-4 * f64::from(1.0 - reflectance), ..Settings::default() });
        let exitance = world.scene.materials[0].exitance().x;
        let expected = exitance / (1.0 - reflectance);
        for (index, radiosity) in solution.light.radiosity.iter().enumerate() {
            let error = (*radiosity / expected - 1.0).abs().max_element();
            assert!(error < 5e-3, "ρ = {reflectance}, element {index}: {radiosity} for {expected}");
        }
        check(&solution.energy);
        assert_eq!(total(solution.energy.escaped), 0.0);
    }
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
            check(&energy);
            assert!(total(energy.unshot) < unshot, "{name}: no shot makes light");
            unshot = total(energy.unshot);
        }
    }
}

#[test]
fn a_shot_in_a_closed_room_of_one_reflectance_takes_its_absorbed_share() {
    // Whatever the form factors are, a shot of flux Φ leaves ρ Φ to be shot (facts of a closed room of one ρ).
    let reflectance = 0.5;
    let world = furnace(reflectance, 0.1);
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
    let mut method = Progressive::new(world_of(scene, None), Settings::default());
    assert_eq!(method.step(&Cancel::default()), Step::Converged);
    let solution = method.solution();
    assert!(solution.converged && solution.light.radiosity.iter().all(|radiosity| *radiosity == Rgb::ZERO));
    check(&solution.energy);
}
