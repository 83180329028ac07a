//! The three ways to solve the equations, on the closed unit cube with six patches, whose form factors are known exactly.

use lightwell::math::polygon::parallel_rectangles;
use lightwell::math::rgb::{Rgb64, total};
use lightwell::math::sparse::Sparse;
use lightwell::methods::radiosity::{Relaxation, System};

/// Ceiling, floor, four walls; M_e = 1 W/m² on the ceiling, in one channel.
struct Cube {
    form_factors: Sparse,
    reflectance: [Rgb64; 6],
    exitance: [Rgb64; 6],
}

const CEILING: usize = 0;
const FLOOR: usize = 1;
const WALL: usize = 2;

impl Cube {
    fn new(reflectance: f64) -> Self {
        let facing = parallel_rectangles(1.0, 1.0, 1.0);
        let beside = (1.0 - facing) / 4.0;
        let mut form_factors = Sparse::with_capacity(6, 30);
        for i in 0..6 {
            for j in (0..6).filter(|&j| j != i) {
                // Opposite faces are neighbours in the list: 0 and 1, 2 and 3, 4 and 5.
                form_factors.push(j as u32, if i / 2 == j / 2 { facing } else { beside });
            }
            form_factors.end_row();
        }
        let mut exitance = [Rgb64::ZERO; 6];
        exitance[CEILING] = Rgb64::X;
        Self { form_factors, reflectance: [Rgb64::X * reflectance; 6], exitance }
    }

    fn system(&self) -> System<'_> {
        System {
            form_factors: &self.form_factors,
            closing: &[1.0; 6],
            area: &[1.0; 6],
            reflectance: &self.reflectance,
            exitance: &self.exitance,
        }
    }

    /// Steps from the start until `iterate` is nowhere farther from the solution than 1e-6 of its largest value.
    fn count(&self, step: fn(&mut Relaxation, &System), iterate: fn(&Relaxation, &System) -> Vec<Rgb64>) -> u32 {
        let system = self.system();
        let exact = self.solution();
        let limit = 1e-6 * exact.iter().fold(0.0, |most, b| b.x.max(most));
        let mut relaxation = Relaxation::new(&system);
        let mut steps = 0;
        let is_far = |relaxation: &Relaxation| {
            iterate(relaxation, &system).iter().zip(&exact).any(|(b, exact)| (b.x - exact.x).abs() >= limit)
        };
        while is_far(&relaxation) {
            step(&mut relaxation, &system);
            steps += 1;
        }
        steps
    }

    /// B to rounding: after enough sweeps nothing moves any more.
    fn solution(&self) -> Vec<Rgb64> {
        let system = self.system();
        let mut relaxation = Relaxation::new(&system);
        for _ in 0..4000 {
            relaxation.gauss_seidel(&system);
        }
        relaxation.radiosity(&system)
    }
}

/// ρ; B of ceiling, floor and wall; Jacobi sweeps, Gauss-Seidel sweeps, Southwell shots to 1e-6.
const TABLE: [(f64, [f64; 3], [u32; 3]); 4] = [
    (0.2, [1.009615385978, 0.048044544595, 0.048085017357], [7, 5, 22]),
    (0.5, [1.090909098108, 0.181745826108, 0.181836268946], [18, 10, 55]),
    (0.8, [1.551724153645, 0.689551070738, 0.689681193904], [59, 31, 178]),
    (0.99, [17.362270472596, 16.527425127720, 16.527576099919], [1370, 687, 4113]),
];

#[test]
fn the_unit_cube_has_its_radiosities() {
    for (reflectance, expected, _) in TABLE {
        let solution = Cube::new(reflectance).solution();
        for (patch, expected) in [CEILING, FLOOR, WALL].into_iter().zip(expected) {
            assert!((solution[patch].x - expected).abs() < 1e-9, "ρ = {reflectance}: {solution:?}");
        }
        // What is emitted is absorbed: (1 − ρ) Σ A B = Σ A M_e in every closed room of one reflectance.
        let sum: f64 = solution.iter().map(|b| b.x).sum();
        assert!(((1.0 - reflectance) * sum - 1.0).abs() < 1e-12, "ρ = {reflectance}: {sum}");
    }
}

#[test]
fn every_solver_takes_as_many_steps_as_it_should() {
    let radiosity = |relaxation: &Relaxation, system: &System| relaxation.radiosity(system);
    let sent = |relaxation: &Relaxation, _: &System| relaxation.sent().to_vec();
    let southwell = |relaxation: &mut Relaxation, system: &System| {
        relaxation.southwell(system);
    };
    for (reflectance, _, [jacobi, gauss_seidel, shots]) in TABLE {
        let cube = Cube::new(reflectance);
        assert_eq!(cube.count(Relaxation::jacobi, radiosity), jacobi, "ρ = {reflectance}");
        assert_eq!(cube.count(Relaxation::gauss_seidel, sent), gauss_seidel, "ρ = {reflectance}");
        // Equal walls tie, and rounding decides which of them shoots first.
        let got = f64::from(cube.count(southwell, radiosity));
        assert!((got / f64::from(shots) - 1.0).abs() <= 0.02, "ρ = {reflectance}: {got} for {shots}");
    }
}

#[test]
fn unshot_flux_falls_shot_by_shot_as_it_should() {
    let cube = Cube::new(0.5);
    let system = cube.system();
    let mut relaxation = Relaxation::new(&system);
    for expected in [1.0, 0.5, 0.449989, 0.394976, 0.334466, 0.267904, 0.194733, 0.164207, 0.135630, 0.109697] {
        let unshot: f64 = relaxation.unshot().iter().map(|unshot| total(*unshot)).sum();
        assert!((unshot - expected).abs() < 1e-6, "{unshot} for {expected}");
        relaxation.southwell(&system);
    }
}

#[test]
fn a_jacobi_sweep_is_a_bounce() {
    // In a furnace, B after k bounces is M (1 − ρ^(k+1)) / (1 − ρ).
    let reflectance = 0.8;
    let cube = Cube { exitance: [Rgb64::X; 6], ..Cube::new(reflectance) };
    let system = cube.system();
    let mut relaxation = Relaxation::new(&system);
    for bounces in 0..40 {
        let expected = (1.0 - reflectance.powi(bounces + 1)) / (1.0 - reflectance);
        let radiosity = relaxation.radiosity(&system);
        assert!(radiosity.iter().all(|b| (b.x / expected - 1.0).abs() < 1e-14), "{bounces}: {radiosity:?}");
        relaxation.jacobi(&system);
    }
}

#[test]
fn light_is_conserved_after_every_step_of_every_solver() {
    let steps: [fn(&mut Relaxation, &System); 3] =
        [Relaxation::jacobi, Relaxation::gauss_seidel, |relaxation, system| {
            relaxation.southwell(system);
        }];
    for step in steps {
        let cube = Cube::new(0.99);
        let system = cube.system();
        let mut relaxation = Relaxation::new(&system);
        for _ in 0..200 {
            step(&mut relaxation, &system);
            let absorbed: f64 = relaxation.irradiance().iter().map(|e| 0.01 * e.x).sum();
            let unshot: f64 = relaxation.unshot().iter().map(|unshot| unshot.x).sum();
            assert!((absorbed + unshot - 1.0).abs() < 1e-13, "{absorbed} + {unshot}");
        }
    }
}
