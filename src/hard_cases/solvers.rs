//! Long runs, and methods of form factors at the end of their assumptions.

use super::row::{about, exactly};
use super::stage::{GLOW, cube, level, lit_cube, patch_of, plates, single, solve, steps, world};
use super::{Case, Rows};
use crate::cancel::Cancelled;
use crate::choice::Choice;
use crate::math::polygon::parallel_rectangles;
use crate::math::rgb::{Rgb64, total};
use crate::math::sparse::Sparse;
use crate::mesh::MeshSettings;
use crate::methods::radiosity::form_factor::centroid::{Facet, centroid, disc};
use crate::methods::radiosity::form_factor::hemicube::{Hemicube, Item};
use crate::methods::radiosity::{Relaxation, System, pick};
use crate::methods::{FormFactorMethod, Settings, Solver};
use glam::{DVec3, Vec3A};
use std::f64::consts::PI;

pub const CASES: &[Case] = &[
    Case {
        name: "long-run",
        about: "100,000 shots, each of which rounds the books a little",
        measure: long_run,
        scene: || lit_cube(0.999).show("long-run"),
    },
    Case {
        name: "rough-form-factors",
        about: "form factors from centre to centre, which are far above 1 where patches are near",
        measure: rough_form_factors,
        scene: || plates(0.1).show("rough-form-factors"),
    },
    Case {
        name: "hemicube",
        about: "a hemicube near a patch as large as itself, and over patches smaller than its cells",
        measure: hemicube,
        scene: || plates(1.0).show("hemicube"),
    },
    Case {
        name: "furnace",
        about: "a glowing room, in which every method must keep all of the light",
        measure: furnace,
        scene: || cube(0.5, GLOW).show("furnace"),
    },
];

fn long_run(rows: &mut Rows) -> Result<(), Cancelled> {
    let world = world(lit_cube(0.999).open("room"), single(0.51), rows.cancel)?;
    let settings = Settings { solver: Solver::Southwell, unshot_limit: 0.0, ..Settings::default() };
    let solution = steps(&world, &settings, 100_000, rows.cancel)?;
    let guard = "energy in double precision, and what is unshot and absorbed counted anew from the patches";
    rows.check("shots", solution.steps as f64, exactly(1e5), guard);
    // 100,000 roundings of half a unit in the last place, all in one direction: 1e5 · 1.1e-16.
    let drift = total(solution.energy.defect()) / total(solution.energy.emitted);
    rows.check("defect of the ledger, share of the flux", drift, about(0.0, 1.1e-11), guard);
    // Six patches with the exact form factors of a cube, one of which emits 1 W.
    let (facing, mut form_factors) = (parallel_rectangles(1.0, 1.0, 1.0), Sparse::with_capacity(6, 30));
    for i in 0..6_u32 {
        for j in (0..6).filter(|&j| j != i) {
            form_factors.push(j, if i / 2 == j / 2 { facing } else { 0.25 * (1.0 - facing) });
        }
        form_factors.end_row();
    }
    let mut exitance = [Rgb64::ZERO; 6];
    exitance[0] = Rgb64::ONE;
    let reflectance = [Rgb64::splat(0.99); 6];
    let system = System {
        form_factors: &form_factors,
        closing: &[1.0; 6],
        area: &[1.0; 6],
        reflectance: &reflectance,
        exitance: &exitance,
    };
    let mut relaxation = Relaxation::new(&system);
    for _ in 0..100_000 {
        relaxation.southwell(&system);
    }
    let ceiling = relaxation.radiosity(&system)[0].x;
    rows.check("B of the ceiling of a cube, ρ = 0.99, W/m²", ceiling, about(17.362_270_472_596, 1e-9), guard);
    Ok(())
}

fn rough_form_factors(rows: &mut Rows) -> Result<(), Cancelled> {
    let facet = |height: f64, normal: DVec3| Facet { center: height * DVec3::Y, normal, area: 1.0 };
    let (below, above) = (facet(0.0, DVec3::Y), facet(0.1, DVec3::NEG_Y));
    let reason = "from centre to centre, a patch counts as small and far: at a tenth of its size it is neither";
    rows.limit("centroid F, gap 0.1 (0.827 would be right)", centroid(&below, &above), about(100.0 / PI, 1e-9), reason);
    let reason = "a disc in place of the patch keeps F below 1, but has no edges";
    rows.limit(
        "disc F, gap 0.1 (0.827 would be right)",
        disc(&below, &above),
        about(1.0 / (0.01 * PI + 1.0), 1e-12),
        reason,
    );
    let world = world(plates(0.1).open("plates"), single(1.001), rows.cancel)?;
    let settings = Settings { form_factor: FormFactorMethod::Centroid, ..Settings::default() };
    let seen = pick(&world, &settings, patch_of(&world, "floor"), rows.cancel).ok_or(Cancelled)?;
    let guard = "form factors above 1 are cut down to 1 before a solver gets them, and counted";
    rows.check(
        "centroid F, gap 0.1, as solvers get it",
        seen.form_factors[patch_of(&world, "plate") as usize],
        exactly(1.0),
        guard,
    );
    let clamped = solve(&world, &settings, rows.cancel)?.counters.clamped;
    rows.check("form factors cut down and counted", clamped as f64, exactly(1.0), guard);
    Ok(())
}

/// F of a level square with its front down, from the point below its middle, by a hemicube.
fn by_hemicube(resolution: u32, half: f64, middle: [f64; 2], height: f64) -> f64 {
    let [x, z] = middle.map(|at| [at - half, at + half]);
    let [a, b, c, d] = level(x, height, z).map(|corner| corner.as_vec3());
    let mut hemicube = Hemicube::new(resolution);
    hemicube.draw(Vec3A::ZERO, Vec3A::Y, &[Item::new(&[d, c, b, a], 0)]);
    let mut sums = [0.0];
    hemicube.add_form_factors(&mut sums);
    sums[0]
}

fn hemicube(rows: &mut Rows) -> Result<(), Cancelled> {
    // Edges of the square are edges of cells; the deltas are right to 0.542 / 256².
    let reason = "proximity: a hemicube sees a near patch as its middle does, whatever its resolution";
    rows.limit(
        "hemicube F, gap 1 (0.199825 would be right)",
        by_hemicube(256, 0.5, [0.0; 2], 1.0),
        about(0.239_456_470_460_774, 1e-5),
        reason,
    );
    // Cells of a 64² hemicube are 1/32 wide; this square is 1/100, in the middle of a cell and on a corner.
    // The cell's middle is 1/64 off the axis in both directions; all deltas are divided by their sum.
    let (square, sum) = (1.0 + 2.0 / 64_f64.powi(2), 1.0 + 0.542 / 64_f64.powi(2));
    let cell = 1.0 / (32.0 * 32.0 * PI * square * square * sum);
    let reason = "aliasing: what is smaller than a cell is seen as large as the cell, or not at all";
    let (hit, missed) = (by_hemicube(64, 0.005, [1.0 / 64.0; 2], 1.0), by_hemicube(64, 0.005, [0.0; 2], 1.0));
    rows.limit("hemicube F of a small square in a cell (3.2e-5 would be right)", hit, about(cell, 1e-5 * cell), reason);
    rows.limit("the same between cells (3.2e-5 would be right)", missed, exactly(0.0), reason);
    let mesh = MeshSettings { element_size: Some(1.001 / 16.0), elements_per_patch_edge: 16 };
    let world = world(plates(1.0).open("plates"), mesh, rows.cancel)?;
    let settings = Settings { form_factor: FormFactorMethod::Hemicube, ..Settings::default() };
    let seen = pick(&world, &settings, patch_of(&world, "floor"), rows.cancel).ok_or(Cancelled)?;
    let guard = "pairs nearer than five radii are computed in closed form";
    let exact = parallel_rectangles(1.0, 1.0, 1.0);
    rows.check(
        "F of unit squares, gap 1, hemicube method",
        seen.form_factors[patch_of(&world, "plate") as usize],
        about(exact, 2.4e-4),
        guard,
    );
    Ok(())
}

fn furnace(rows: &mut Rows) -> Result<(), Cancelled> {
    let world = world(cube(0.5, GLOW).open("furnace"), single(0.26), rows.cancel)?;
    for &form_factor in FormFactorMethod::ALL {
        let settings = Settings {
            form_factor,
            solver: Solver::GaussSeidel,
            unshot_limit: 1e-8,
            light_rays: 200_000,
            hemicube_resolution: 64,
            ..Settings::default()
        };
        let solution = steps(&world, &settings, 1000, rows.cancel)?;
        let deviation = solution.light.radiosity.iter().map(|radiosity| f64::from((radiosity.x / 2.0 - 1.0).abs()));
        let guard = "the matrix is scaled until every row closes, and stays symmetric";
        rows.check(
            format!("largest deviation from B = 2, {}", form_factor.name()),
            deviation.fold(0.0, f64::max),
            about(0.0, 1e-6),
            guard,
        );
    }
    let settings = Settings { form_factor: FormFactorMethod::Rays, light_rays: 100_000, ..Settings::default() };
    // Sums of a hundred shares of the same number of rays.
    let mut worst = 0.0_f64;
    for patch in 0..world.mesh.patches.len() as u32 {
        let seen = pick(&world, &settings, patch, rows.cancel).ok_or(Cancelled)?;
        worst = worst.max((seen.form_factors.iter().sum::<f64>() + seen.escaping - 1.0).abs());
    }
    rows.check(
        "largest error of a row of F by rays",
        worst,
        about(0.0, 1e-14),
        "every ray lands on one element or escapes",
    );
    Ok(())
}
