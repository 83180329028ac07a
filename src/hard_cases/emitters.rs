//! Lamps that are tiny, turned away, alone, or not there.

use super::row::{about, exactly};
use super::stage::{Stage, cube, elements_of, level, single, solve, steps, world};
use super::{Case, Rows};
use crate::cancel::Cancelled;
use crate::math::polygon::form_factor;
use crate::math::rgb::total;
use crate::methods::Settings;
use crate::scene::FindingKind;
use crate::solution::Solution;
use crate::world::World;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

pub const CASES: &[Case] = &[
    Case {
        name: "tiny-lamp",
        about: "a lamp whose edge is a ten-thousandth of the room's, and its area a hundred-millionth",
        measure: tiny_lamp,
        scene: || cube(0.5, 0.0).object("lamp", 0.0, 1e8).level_down(TINY, 0.875, TINY).show("tiny-lamp"),
    },
    Case {
        name: "no-lamp",
        about: "a scene in which nothing emits",
        measure: no_lamp,
        scene: || cube(0.5, 0.0).show("no-lamp"),
    },
    Case {
        name: "turned-lamp",
        about: "a lamp under the ceiling whose front faces the ceiling",
        measure: turned_lamp,
        scene: || turned().show("turned-lamp"),
    },
    Case {
        name: "single-triangle",
        about: "a scene of one triangle, which emits: all its light is lost",
        measure: single_triangle,
        scene: || triangle().show("single-triangle"),
    },
];

/// Numbers that single precision has, an eight-thousandth apart.
const TINY: [f64; 2] = [0.5 - 1.0 / 16384.0, 0.5 + 1.0 / 16384.0];
const WIDE: [f64; 2] = [0.3, 0.7];

fn turned() -> Stage {
    cube(0.5, 0.0).object("lamp", 0.5, 1.0).level_up(WIDE, 0.99, WIDE)
}

fn triangle() -> Stage {
    Stage::new().object("triangle", 0.5, 1.0).face(&[DVec3::ZERO, DVec3::Z, DVec3::X])
}

fn tiny_lamp(rows: &mut Rows) -> Result<(), Cancelled> {
    let scene = cube(0.5, 0.0).object("lamp", 0.0, 1e8).level_down(TINY, 0.875, TINY).open("lamp");
    let world = world(scene, single(0.0626), rows.cancel)?;
    // The first shot is the lamp's.
    let solution = steps(&world, &Settings::default(), 1, rows.cancel)?;
    let corners: Vec<DVec3> = level(TINY, 0.875, TINY).into_iter().rev().collect();
    let exitance = PI * 1e8;
    let deviation = |i: usize| {
        let center = world.mesh.elements[i].center.as_dvec3();
        let expected = exitance * form_factor(center, DVec3::Y, &corners);
        (f64::from(solution.light.irradiance[i].x) / expected - 1.0).abs()
    };
    let floor = elements_of(&world, "room").filter(|&i| world.mesh.elements[i].center.y < 1e-3);
    let guard = "shadow rays are aimed at the lamp, and form factors need no ray to find it";
    // The row is scaled to close, by less than what its closure says; centres agree to rounding.
    let tolerance = solution.closure.worst + 1e-4;
    rows.check(
        "largest deviation of light on the floor",
        floor.map(deviation).fold(f64::NAN, f64::max),
        about(0.0, tolerance),
        guard,
    );
    // M_e is in single precision.
    let flux = exitance * (TINY[1] - TINY[0]).powi(2);
    rows.check(
        "flux emitted, W",
        solution.energy.emitted.x,
        about(flux, 1e-6),
        "no face is dropped for being small: what has no area is told by its own length",
    );
    Ok(())
}

fn no_lamp(rows: &mut Rows) -> Result<(), Cancelled> {
    let scene = cube(0.5, 0.0).open("dark");
    let warnings = scene.findings.iter().filter(|finding| finding.kind == FindingKind::NoEmitter).count();
    let world = world(scene, single(0.26), rows.cancel)?;
    let solution = steps(&world, &Settings::default(), 100, rows.cancel)?;
    let guard = "a run in which nothing is unshot has converged before its first shot";
    rows.check("shots", solution.steps as f64, exactly(0.0), guard);
    rows.check("warnings", warnings as f64, exactly(1.0), "a scene without light says so");
    Ok(())
}

fn turned_lamp(rows: &mut Rows) -> Result<(), Cancelled> {
    let light = |stage: Stage| -> Result<(Arc<World>, Solution), Cancelled> {
        let world = world(stage.open("lamp"), single(0.26), rows.cancel)?;
        let solution = solve(&world, &Settings::default(), rows.cancel)?;
        Ok((world, solution))
    };
    let (right_world, right) = light(cube(0.5, 0.0).object("lamp", 0.5, 1.0).level_down(WIDE, 0.99, WIDE))?;
    let (world, turned) = light(turned())?;
    let guard = "an emitter that sees only what stands right before it, and has the room behind it, is turned";
    let warnings = world.scene.findings.iter().filter(|finding| finding.kind == FindingKind::EmitterTurned).count();
    rows.check("lamps turned and reported", warnings as f64, exactly(1.0), guard);
    let floor = |world: &World, solution: &Solution| {
        let floor = elements_of(world, "room").filter(|&i| world.mesh.elements[i].center.y < 1e-3);
        floor.map(|i| world.mesh.elements[i].area * f64::from(solution.light.irradiance[i].x)).sum::<f64>()
    };
    rows.check(
        "flux on the floor over that of a lamp hung right",
        floor(&world, &turned) / floor(&right_world, &right),
        about(1.0, 5e-3),
        guard,
    );
    Ok(())
}

fn single_triangle(rows: &mut Rows) -> Result<(), Cancelled> {
    let world = world(triangle().open("triangle"), single(2.0), rows.cancel)?;
    let solution = solve(&world, &Settings::default(), rows.cancel)?;
    let energy = solution.energy;
    let guard = "flux that no surface receives is booked as escaped";
    // Half a square metre with M_e = π, rounded to single precision.
    rows.check("flux that escapes, W", energy.escaped.x, about(0.5 * PI, 1e-6), guard);
    rows.check("defect of the ledger, W", total(energy.defect()), exactly(0.0), guard);
    Ok(())
}
