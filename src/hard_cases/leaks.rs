//! Surfaces in the same place: where light leaks through, and shadow creeps out.

use super::oracle::mean_form_factor;
use super::row::{about, exactly};
use super::stage::{Stage, elements_of, level, patch_of, single, solve, world};
use super::{Case, Rows};
use crate::cancel::Cancelled;
use crate::math::rgb::total;
use crate::methods::Settings;
use crate::methods::radiosity::pick;
use crate::world::World;
use glam::{DMat3, DVec3};

pub const CASES: &[Case] = &[
    Case {
        name: "duplicate-faces",
        about: "a floor that the file states three times, with its corners in another order",
        measure: duplicate_faces,
        scene: || lit_room().line(DUPLICATES).show("duplicate-faces"),
    },
    Case {
        name: "coplanar-faces",
        about: "squares of one plane in general position, which see nothing of each other",
        measure: coplanar_faces,
        scene: || tilted_plane().show("coplanar-faces"),
    },
    Case {
        name: "rug-in-the-floor",
        about: "a rug that lies exactly in the floor, so that both claim the same light",
        measure: rug_in_the_floor,
        scene: || rug().show("rug-in-the-floor"),
    },
    Case {
        name: "lamp-in-the-ceiling",
        about: "a lamp that lies exactly in the plane of the ceiling",
        measure: lamp_in_the_ceiling,
        scene: || sunk_lamp().show("lamp-in-the-ceiling"),
    },
    Case {
        name: "block-on-the-floor",
        about: "a block that stands on a floor of one polygon: what it covers must neither shine nor darken the rest",
        measure: block_on_the_floor,
        scene: || furnace_with_block(0.0).show("block-on-the-floor"),
    },
    Case {
        name: "block-through-the-floor",
        about: "a block that is pushed through the floor: half of its sides are outside",
        measure: block_through_the_floor,
        scene: || furnace_with_block(-0.1).show("block-through-the-floor"),
    },
    Case {
        name: "wall-on-the-floor",
        about: "a wall between two rooms that stands on one floor polygon: no light may pass under it",
        measure: wall_on_the_floor,
        scene: || two_chambers(0.5).show("wall-on-the-floor"),
    },
];

const DUPLICATES: &str = "f 1 2 3 4\nf 3 4 1 2\nf 4 3 2 1";

/// A closed room of a cubic metre; its floor comes first.
fn room(reflectance: f64, radiance: f64) -> Stage {
    Stage::new().object("room", reflectance, radiance).room(DVec3::ZERO, DVec3::ONE)
}

fn lit_room() -> Stage {
    room(0.5, 0.0).object("lamp", 0.5, 1.0).level_down([0.3, 0.7], 0.9, [0.3, 0.7])
}

/// Two squares side by side and one farther off in the plane with the normal (1, 2, 3).
fn tilted_plane() -> Stage {
    let turn = DMat3::from_cols(
        DVec3::new(3.0, 0.0, -1.0).normalize(),
        DVec3::new(1.0, 2.0, 3.0).normalize(),
        DVec3::new(3.0, 0.0, -1.0).cross(DVec3::new(1.0, 2.0, 3.0)).normalize(),
    );
    let square = |x: f64| level([x, x + 1.0], 0.0, [0.0, 1.0]).map(|corner| turn * corner + DVec3::new(0.1, 0.7, 0.3));
    Stage::new()
        .object("lamp", 0.5, 1.0)
        .face(&square(0.0))
        .object("neighbours", 0.5, 0.0)
        .face(&square(1.0))
        .face(&square(2.5))
}

fn rug() -> Stage {
    room(0.5, 0.0)
        .object("rug", 0.2, 0.0)
        .level_up([0.25, 0.75], 0.0, [0.25, 0.75])
        .object("lamp", 0.5, 1.0)
        .level_down([0.25, 0.75], 0.5, [0.25, 0.75])
}

const LAMP: [f64; 2] = [0.25, 0.75];

fn sunk_lamp() -> Stage {
    room(0.5, 0.0).object("lamp", 0.5, 1.0).level_down(LAMP, 1.0, LAMP)
}

/// A furnace with a block in it whose foot is at this height; all glows and reflects alike.
fn furnace_with_block(foot: f64) -> Stage {
    let block = [DVec3::new(0.33, foot, 0.28), DVec3::new(0.71, 0.4, 0.63)];
    room(0.5, GLOW).object("block", 0.5, GLOW).block(block[0], block[1])
}

/// Radiance of what has M_e = 1 W/m².
const GLOW: f64 = std::f64::consts::FRAC_1_PI;

/// A room of two cubic metres with a thin wall across, and a lamp in its first part.
fn two_chambers(wall: f64) -> Stage {
    let across = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(y, z)| DVec3::new(wall, y, z));
    Stage::new()
        .object("room", 0.5, 0.0)
        .room(DVec3::ZERO, DVec3::ONE)
        .object("wall", 0.5, 0.0)
        .face(&across)
        .object("lamp", 0.5, 1.0)
        .level_down([0.125, 0.375], 0.75, [0.25, 0.75])
}

fn duplicate_faces(rows: &mut Rows) -> Result<(), Cancelled> {
    let guard = "faces with the same corners in any order are left out";
    let (once, thrice) = (lit_room().open("once"), lit_room().line(DUPLICATES).open("thrice"));
    rows.check("faces", thrice.polygons.len() as f64, exactly(7.0), guard);
    let light = |scene| {
        let world = world(scene, single(0.2), rows.cancel)?;
        Ok(solve(&world, &Settings::default(), rows.cancel)?.light.irradiance)
    };
    let (once, thrice) = (light(once)?, light(thrice)?);
    let differ = once.len().abs_diff(thrice.len()) + once.iter().zip(&thrice).filter(|(a, b)| a != b).count();
    rows.check("elements with other light", differ as f64, exactly(0.0), guard);
    Ok(())
}

fn coplanar_faces(rows: &mut Rows) -> Result<(), Cancelled> {
    let world = world(tilted_plane().open("plane"), single(0.25), rows.cancel)?;
    let mut largest: f64 = 0.0;
    for patch in 0..world.mesh.patches.len() as u32 {
        largest = pick(&world, &Settings::default(), patch).form_factors.into_iter().fold(largest, f64::max);
    }
    let guard = "planes nearer than twice the offset of rays are one plane";
    rows.check("largest F between patches", largest, exactly(0.0), guard);
    Ok(())
}

fn rug_in_the_floor(rows: &mut Rows) -> Result<(), Cancelled> {
    let world = world(rug().open("rug"), single(0.25), rows.cancel)?;
    let row = (0..16).map(|i| pick(&world, &Settings::default(), patch_of(&world, "lamp") + i % 4).form_factors.iter().sum::<f64>());
    println!("rug row {}", row.sum::<f64>() / 16.0);
    rows.limit("surface that light can reach, m²", world.mesh.area() - 0.5, about(6.25, 1e-5), "floor and rug are in the same place, and nothing says which is on top");
    Ok(())
}

fn lamp_in_the_ceiling(rows: &mut Rows) -> Result<(), Cancelled> {
    let world = world(sunk_lamp().open("lamp"), single(0.25), rows.cancel)?;
    let guard = "emitters in the plane of a wall are moved off it, and the wall behind them is taken for covered";
    // Areas are sums of some hundred numbers in double precision, of corners in single precision.
    rows.check("surface that light can reach, m²", world.mesh.area(), about(6.0, 1e-6), guard);
    let lamp = patch_of(&world, "lamp");
    let floor: Vec<usize> = elements_of(&world, "room").filter(|&i| world.mesh.elements[i].center.y < 1e-3).collect();
    let mut flux = 0.0;
    for patch in lamp..lamp + 4 {
        let seen = pick(&world, &Settings::default(), patch);
        flux += floor.iter().map(|&i| seen.form_factors[world.mesh.elements[i].patch as usize]).sum::<f64>() / 4.0;
    }
    let [a, b, c, d] = level(LAMP, 1.0, LAMP);
    let exact = mean_form_factor([d, c, b, a], &level([0.0, 1.0], 0.0, [0.0, 1.0]));
    rows.check("F from the lamp to the floor", flux, about(exact, 1e-3), guard);
    Ok(())
}

/// The largest share by which an element of a furnace with M_e = 1 and ρ = ½ differs from B = 2.
fn unevenness(world: &World, light: &crate::solution::Solution) -> f64 {
    let exposed = (0..world.mesh.elements.len()).filter(|&i| world.mesh.elements[i].exposed > 0.0);
    exposed.map(|i| f64::from((light.light.radiosity[i] / 2.0 - 1.0).abs().max_element())).fold(0.0, f64::max)
}

fn block_on_the_floor(rows: &mut Rows) -> Result<(), Cancelled> {
    block_at(rows, 0.0)
}

fn block_through_the_floor(rows: &mut Rows) -> Result<(), Cancelled> {
    block_at(rows, -0.1)
}

fn block_at(rows: &mut Rows, foot: f64) -> Result<(), Cancelled> {
    let guard = "what stands on an element covers that part of it";
    let world = world(furnace_with_block(foot).open("block"), single(0.1), rows.cancel)?;
    // The room, less what the block covers, and the block's five sides above the floor.
    let (foot_area, edge) = (0.38 * 0.35, 2.0 * (0.38 + 0.35));
    let exact = 6.0 + 0.4 * edge;
    rows.check("surface that light can reach, m²", world.mesh.area(), about(exact, edge * 0.1 / 8.0), guard);
    let solution = solve(&world, &Settings { unshot_limit: 1e-4, ..Settings::default() }, rows.cancel)?;
    println!("{foot_area} {:?}", solution.closure);
    rows.check("largest deviation from B = 2", unevenness(&world, &solution), about(0.0, 2e-2), guard);
    rows.check("escaping share of the flux", total(solution.energy.escaped) / total(solution.energy.emitted), exactly(0.0), guard);
    Ok(())
}

fn wall_on_the_floor(rows: &mut Rows) -> Result<(), Cancelled> {
    for wall in [0.5, 0.5625] {
        let world = world(two_chambers(wall).open("wall"), single(0.125), rows.cancel)?;
        let solution = solve(&world, &Settings::default(), rows.cancel)?;
        let dark = (0..world.mesh.elements.len()).filter(|&i| f64::from(world.mesh.elements[i].center.x) > wall + 1e-3);
        let flux: f64 = dark.map(|i| world.mesh.elements[i].area * total(solution.light.irradiance[i].as_dvec3())).sum();
        let share = flux / total(solution.energy.emitted);
        rows.check(format!("flux in the dark room, wall at {wall}"), share, exactly(0.0), "surfaces of a closed room");
    }
    Ok(())
}
