//! Methods and solvers against each other, on scenes with blocks and doorways.

use super::{run_to_end, world, world_of};
use glam::{DVec3, Vec3};
use lightwell::choice::Choice;
use lightwell::math::polygon::form_factor;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::MeshSettings;
use lightwell::methods::{FormFactorMethod, Settings, Solver};
use lightwell::scene::{Polygon, Scene};
use lightwell::solution::Solution;
use lightwell::world::World;
use std::sync::Arc;

/// Area-weighted root of the mean square of the difference in E, over the mean of E; and the difference of the means.
fn difference(world: &World, one: &Solution, other: &Solution) -> (f64, f64) {
    let value = |irradiance: &Rgb| f64::from(irradiance.element_sum());
    let pairs = one.light.irradiance.iter().zip(&other.light.irradiance);
    let (mut squares, mut apart, mut sum) = (0.0, 0.0, 0.0);
    for (element, (a, b)) in world.mesh.elements.iter().zip(pairs) {
        squares += element.area * (value(a) - value(b)).powi(2);
        apart += element.area * (value(a) - value(b));
        sum += element.area * value(b);
    }
    ((squares / world.mesh.area()).sqrt() * world.mesh.area() / sum, apart / sum)
}

#[test]
fn solvers_on_one_matrix_agree_within_the_stop_rule() {
    for (name, size) in [("cornell-box", 0.04), ("two-rooms", 0.3)] {
        let world = world(name, Some(size));
        let unshot_limit = 1e-6;
        let solutions = [Solver::Jacobi, Solver::GaussSeidel, Solver::Southwell]
            .map(|solver| run_to_end(&world, &Settings { solver, unshot_limit, ..Settings::default() }));
        for other in &solutions[1..] {
            let (rms, mean) = difference(&world, &solutions[0], other);
            println!("{name}: RMS {rms:.2e}, mean {mean:.2e}");
            // What is unshot is missing with its reflections, 1/(1 − ρ̄) in a closed room: less than 10 times as much.
            assert!(rms < 10.0 * unshot_limit && mean.abs() < 10.0 * unshot_limit, "{name}: {rms} {mean}");
        }
    }
}

#[test]
fn shooting_without_a_matrix_agrees_with_the_matrix() {
    for (name, size) in [("cornell-box", 0.02), ("two-rooms", 0.15)] {
        let world = world(name, Some(size));
        let [progressive, matrix] = [Solver::Progressive, Solver::GaussSeidel]
            .map(|solver| run_to_end(&world, &Settings { solver, unshot_limit: 1e-3, ..Settings::default() }));
        let (rms, mean) = difference(&world, &progressive, &matrix);
        println!("{name}: RMS {rms:.4}, mean {mean:.4}");
        // Both stop with 0.1 % unshot, which may be 1 % of the light in a closed room; the rest is the noise of shadow
        // rays, of which the two have different ones.
        assert!(rms < 0.04 && mean.abs() < 0.01, "{name}: {rms} {mean}");
    }
}

/// A square floor of 2 m and a square lamp of 10 cm a metre above its middle: nearly all light escapes.
fn lamp_over_a_floor() -> Arc<World> {
    let mut scene = Scene::open("furnace").expect("a built-in scene");
    let square = |half: f32, height: f32| {
        [(-half, -half), (-half, half), (half, half), (half, -half)].map(|(x, z)| Vec3::new(x, height, z))
    };
    scene.positions = square(1.0, 0.0).into_iter().chain(square(0.05, 1.0)).collect();
    scene.polygons = vec![Polygon::new(&[0, 1, 2, 3], 1, 0, 0), Polygon::new(&[7, 6, 5, 4], 0, 0, 0)];
    let mut floor = scene.materials[0].clone();
    floor.emission = Rgb::ZERO;
    scene.materials.push(floor);
    scene.viewpoint = None;
    world_of(scene, &MeshSettings { element_size: Some(0.25), elements_per_patch_edge: 1 })
}

#[test]
fn every_solver_lights_an_open_floor_as_the_closed_form_does() {
    let world = lamp_over_a_floor();
    let lamp = world.mesh.patches.iter().find(|patch| patch.polygon == 1 && patch.is_front).expect("it shines down");
    let corners: Vec<DVec3> = lamp.corners().iter().map(|corner| corner.as_dvec3()).collect();
    let exitance = f64::from(world.scene.materials[0].exitance().element_sum());
    for &solver in Solver::ALL {
        let solution = run_to_end(&world, &Settings { solver, ..Settings::default() });
        for (element, irradiance) in world.mesh.elements.iter().zip(&solution.light.irradiance) {
            let patch = &world.mesh.patches[element.patch as usize];
            if patch.polygon == 0 && patch.is_front {
                let center = element.center.as_dvec3();
                let expected = exitance * form_factor(center, patch.normal.as_dvec3(), &corners);
                let error = f64::from(irradiance.element_sum()) / expected - 1.0;
                // The rays that count what escapes from the lamp are good to half a percent; the centre of an element of a
                // quarter of a metre stands for its mean to 1 %; what the lamp reflects back is a thousandth.
                assert!(error.abs() < 0.02, "{solver:?} at {center}: {error}");
            }
        }
    }
}

#[test]
fn methods_agree_within_their_own_error() {
    for (name, size) in [("cornell-box", 0.02), ("two-rooms", 0.15)] {
        let world = world(name, Some(size));
        let solve = |form_factor| {
            run_to_end(
                &world,
                &Settings { form_factor, solver: Solver::GaussSeidel, light_rays: 30_000_000, ..Settings::default() },
            )
        };
        let reference = solve(FormFactorMethod::Polygon);
        for &form_factor in FormFactorMethod::ALL {
            let (rms, mean) = difference(&world, &solve(form_factor), &reference);
            println!("{name}, {form_factor:?}: RMS {rms:.4}, mean {mean:.4}");
            let (allowed_rms, allowed_mean) = match form_factor {
                FormFactorMethod::Centroid | FormFactorMethod::Disc => (0.25, 0.05),
                FormFactorMethod::Polygon => (0.0, 0.0),
                FormFactorMethod::Rays | FormFactorMethod::Hemicube => (0.06, 0.01),
            };
            assert!(rms <= allowed_rms && mean.abs() <= allowed_mean, "{name}, {form_factor:?}: {rms} {mean}");
        }
    }
}
