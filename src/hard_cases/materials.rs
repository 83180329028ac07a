//! Rooms that reflect nearly all light, or claim to reflect more; lamps of any brightness.

use super::row::{about, exactly};
use super::stage::{GLOW, Stage, cube, single, steps, world};
use super::{Case, Rows};
use crate::cancel::Cancelled;
use crate::methods::{Settings, Solver};
use crate::scene::{FindingKind, Material, Scene};

pub const CASES: &[Case] = &[
    Case {
        name: "bright-room",
        about: "a closed room that reflects 99 % or 99.9 % of its light, which takes thousands of bounces",
        measure: bright_room,
        scene: || furnace(0.999).show("bright-room"),
    },
    Case {
        name: "white-room",
        about: "a closed room whose file says that it reflects all light, or more than all",
        measure: white_room,
        scene: || furnace(1.5).show("white-room"),
    },
    Case {
        name: "emission",
        about: "a lamp from a billionth of a watt to a billion watts",
        measure: emission,
        scene: || lamp(1e9).show("emission"),
    },
];

/// A closed cube with M_e = 1 W/m².
fn furnace(reflectance: f64) -> Stage {
    cube(reflectance, GLOW)
}

fn lamp(radiance: f64) -> Stage {
    cube(0.5, 0.0).object("lamp", 0.0, radiance).level_down([0.3, 0.7], 0.9, [0.2, 0.6])
}

/// More steps than any solver should need here: one that diverges ends, too.
const MOST_STEPS: u64 = 60_000;

/// Mean B of a scene with one patch a polygon, W/m², when what is left is a millionth of it.
fn mean_radiosity(scene: Scene, solver: Solver, rows: &Rows) -> Result<f64, Cancelled> {
    let world = world(scene, single(1.001), rows.cancel)?;
    // Unshot flux brings 1 / (1 − ρ) of itself, and the result is larger by the same factor than what is emitted.
    let settings = Settings { solver, unshot_limit: 1e-6, ..Settings::default() };
    let solution = steps(&world, &settings, MOST_STEPS, rows.cancel)?;
    let sum: f64 = solution.light.radiosity.iter().map(|radiosity| f64::from(radiosity.x)).sum();
    Ok(sum / solution.light.radiosity.len() as f64)
}

fn bright_room(rows: &mut Rows) -> Result<(), Cancelled> {
    let guard = "the matrix is scaled until every row closes, and stays symmetric";
    for (reflectance, solver, name) in [
        (0.99_f32, Solver::Jacobi, "Jacobi"),
        (0.999, Solver::GaussSeidel, "Gauss-Seidel"),
        (0.999, Solver::Southwell, "Southwell"),
    ] {
        // M_e and ρ in the single precision of materials.
        let expected = 1.0 / (1.0 - f64::from(reflectance));
        let got = mean_radiosity(furnace(f64::from(reflectance)).open("furnace"), solver, rows)?;
        // The stop rule leaves a millionth; single precision of what is handed out adds a tenth of that.
        rows.check(format!("B at ρ = {reflectance}, {name}, W/m²"), got, about(expected, 1.1e-6 * expected), guard);
    }
    Ok(())
}

fn white_room(rows: &mut Rows) -> Result<(), Cancelled> {
    let guard = "ρ is cut down to 0.999 as it is read, with a warning, so that light dies out";
    let expected = 1.0 / (1.0 - f64::from(Material::MAX_REFLECTANCE));
    for stated in [1.0, 1.5] {
        let scene = furnace(stated).open("furnace");
        let warnings = scene.findings.iter().filter(|f| f.kind == FindingKind::ReflectanceClamped).count();
        let got = mean_radiosity(scene, Solver::GaussSeidel, rows)?;
        rows.check(
            format!("B, W/m², where the file says ρ = {stated}"),
            got,
            about(expected, 1.1e-6 * expected),
            guard,
        );
        rows.check(format!("warnings, where the file says ρ = {stated}"), warnings as f64, exactly(1.0), guard);
    }
    Ok(())
}

fn emission(rows: &mut Rows) -> Result<(), Cancelled> {
    let light = |radiance: f64| {
        let world = world(lamp(radiance).open("lamp"), single(0.26), rows.cancel)?;
        Ok(steps(&world, &Settings::default(), 200, rows.cancel)?.light.irradiance)
    };
    let reference = light(1.0)?;
    for radiance in [1e-9, 1e-3, 1e3, 1e9] {
        let got = light(radiance)?;
        let apart =
            reference.iter().zip(&got).map(|(one, got)| (f64::from(got.x) / radiance / f64::from(one.x) - 1.0).abs());
        let guard = "light is counted in shares of what is emitted: no limit is in watts";
        // The radiance and both irradiances are rounded to single precision.
        rows.check(
            format!("relative difference of light, radiance {radiance:.0e}"),
            apart.fold(0.0, f64::max),
            about(0.0, 3e-7),
            guard,
        );
    }
    Ok(())
}
