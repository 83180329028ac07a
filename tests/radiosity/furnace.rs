//! A closed room that glows and reflects alike everywhere has the same radiosity M / (1 − ρ) everywhere, whatever its shape:
//! every method, every solver, up to ρ = 0.99.

use super::{bent_furnace, check_ledger, furnace, mean_and_worst, run_to_end, world_of};
use lightwell::choice::Choice;
use lightwell::math::rgb::total;
use lightwell::mesh::MeshSettings;
use lightwell::methods::{FormFactorMethod, Settings, Solver};
use lightwell::scene::Scene;
use lightwell::world::World;
use std::sync::Arc;

fn mesh(element_size: f32, elements_per_patch_edge: u32) -> MeshSettings {
    MeshSettings { element_size: Some(element_size), elements_per_patch_edge }
}

fn rooms(reflectance: f32) -> [(&'static str, Scene); 2] {
    [("cube", furnace(reflectance)), ("bent room", bent_furnace(reflectance))]
}

/// How far an element may be from the truth in a run that shoots patch by patch. Rows of shooters close, so the mean is right
/// with any form factors; what single elements receive is only as good as the method is at its edges and corners.
fn allowed(method: FormFactorMethod, world: &World, settings: &Settings, reflectance: f64) -> f64 {
    match method {
        // Centre to centre is wrong by a fraction of 1 where patches touch: it is shown, not hidden.
        FormFactorMethod::Centroid | FormFactorMethod::Disc => 0.6,
        // A pair that is partly hidden is known to its shadow rays, at least 4: off by up to 1/8, of a few pairs that each
        // are up to a fifth of what is seen.
        FormFactorMethod::Polygon => 0.05,
        // An element's light comes from as many rays as its share of all flux; five standard deviations of their number.
        FormFactorMethod::Rays => {
            let least = world.mesh.elements.iter().map(|element| element.area).fold(f64::INFINITY, f64::min);
            let landed = f64::from(settings.light_rays) / (1.0 - reflectance) * least / world.mesh.area();
            5.0 / landed.sqrt()
        }
        // Proximity: at five radii, where the hemicube takes over, a point is off by 1/3 · (1/5)² · 2.
        FormFactorMethod::Hemicube => 0.05,
    }
}

#[test]
fn every_method_and_solver_fills_a_furnace_evenly() {
    // Few patches where light goes to and fro for long.
    for (reflectance, element_size, elements_per_patch_edge) in [(0.5, 0.125, 2), (0.99, 0.25, 4)] {
        for (name, scene) in rooms(reflectance) {
            let world = world_of(scene, &mesh(element_size, elements_per_patch_edge));
            let exitance = f64::from(world.scene.materials[0].exitance().element_sum());
            let expected = exitance / (1.0 - f64::from(reflectance));
            for &form_factor in FormFactorMethod::ALL {
                for &solver in Solver::ALL {
                    check(name, &world, form_factor, solver, f64::from(reflectance), expected);
                }
            }
        }
    }
}

fn check(
    name: &str,
    world: &Arc<World>,
    form_factor: FormFactorMethod,
    solver: Solver,
    reflectance: f64,
    expected: f64,
) {
    // Light that goes to and fro a hundred times is not followed to its end.
    let unshot_limit = if reflectance > 0.9 { 1e-2 } else { 1e-4 };
    let settings = Settings {
        form_factor,
        solver,
        unshot_limit,
        // All flux takes 1 / (1 − ρ) times as many.
        light_rays: (2e6 * (1.0 - reflectance)) as u32,
        hemicube_resolution: 64,
        ..Settings::default()
    };
    let solution = run_to_end(world, &settings);
    let (mean, worst) = mean_and_worst(world, &solution, expected);
    let what =
        format!("{name}, ρ = {reflectance}, {form_factor:?}, {solver:?}: mean {mean} for {expected}, worst {worst}");
    println!("{what}, {} steps", solution.steps);
    check_ledger(&solution.energy);
    assert!(solution.converged, "{what}");
    assert!(total(solution.energy.escaped).abs() <= 1e-12 * total(solution.energy.emitted), "{what}");
    // Unshot flux Φ_u is missing with all its reflections: ρ Φ_u / (1 − ρ) of Φ / (1 − ρ), so the limit itself.
    assert!((mean / expected - 1.0).abs() < 1.01 * unshot_limit + 1e-6, "{what}");
    assert!(worst < allowed(form_factor, world, &settings, reflectance) + unshot_limit, "{what}");
}

#[test]
fn on_the_matrix_even_a_rough_estimate_leaves_no_patch_out() {
    // Pairs agree and rows close there, so every patch receives what it sends, with any form factors.
    for (name, scene) in rooms(0.9) {
        let world = world_of(scene, &mesh(0.125, 2));
        let expected = f64::from(world.scene.materials[0].exitance().element_sum()) / 0.1;
        for &form_factor in FormFactorMethod::ALL {
            let settings =
                Settings { form_factor, solver: Solver::GaussSeidel, unshot_limit: 1e-7, ..Settings::default() };
            let solution = run_to_end(&world, &settings);
            let irradiance: Vec<_> = solution.light.irradiance.iter().map(|irradiance| irradiance.as_dvec3()).collect();
            let exitance = world.scene.materials[0].exitance().as_dvec3();
            for mean in world.mesh.patch_means(&irradiance) {
                // What elements receive is kept in single precision.
                let radiosity = total(exitance + f64::from(0.9_f32) * mean);
                assert!((radiosity / expected - 1.0).abs() < 1e-5, "{name}, {form_factor:?}: {radiosity} {expected}");
            }
        }
    }
}
