//! Methods and solvers against each other, on scenes with blocks and doorways.

use super::{run_to_end, world};
use lightwell::choice::Choice;
use lightwell::math::rgb::Rgb;
use lightwell::methods::{FormFactorMethod, Settings, Solver};
use lightwell::solution::Solution;
use lightwell::world::World;

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
