//! Surfaces in the same place: where light leaks through, and shadow creeps out.

use super::oracle::mean_form_factor;
use super::row::{about, exactly};
use super::stage::{GLOW, Stage, cube, elements_of, level, lit_cube, patch_of, room_faces, single, solve, world};
use super::{Case, Rows};
use crate::cancel::Cancelled;
use crate::effects::{Effect, Effects, Switches};
use crate::math::rgb::total;
use crate::mesh::MeshSettings;
use crate::methods::photon_map::PhotonMapping;
use crate::methods::radiosity::pick;
use crate::methods::transport::Transport;
use crate::methods::{PhotonSettings, Settings, Solver, Step};
use crate::scene::Material;
use crate::solution::{Solution, Zero};
use crate::world::World;
use glam::{DMat3, DVec3};
use std::sync::Arc;

pub const CASES: &[Case] = &[
    Case {
        name: "duplicate-faces",
        about: "a floor that the file states four times, with its corners in other orders and front and back",
        measure: duplicate_faces,
        scene: || lit_cube(0.5).line(DUPLICATES).show("duplicate-faces"),
    },
    Case {
        name: "coplanar-faces",
        about: "squares of one plane in general position, which see nothing of each other",
        measure: coplanar_faces,
        scene: || tilted_plane().show("coplanar-faces"),
    },
    Case {
        name: "glass-on-the-floor",
        about: "a block of glass on the floor of a closed room, down to no gap at all: no photon may slip out between them",
        measure: glass_on_the_floor,
        scene: || glass_over_the_floor(0.0).show("glass-on-the-floor"),
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
        scene: || furnace_with(aligned_block(0.0)).show("block-on-the-floor"),
    },
    Case {
        name: "block-through-the-floor",
        about: "a block that is pushed through the floor: half of its sides are outside",
        measure: block_through_the_floor,
        scene: || furnace_with(aligned_block(-0.125)).show("block-through-the-floor"),
    },
    Case {
        name: "wall-on-the-floor",
        about: "a wall between two rooms that stands on one floor polygon: no light may pass under it",
        measure: wall_on_the_floor,
        scene: || two_chambers(0.5).show("wall-on-the-floor"),
    },
];

const SEEN: &str = "every pair of points is asked whether they see each other";

const DUPLICATES: &str = "usemtl room\nf 1 2 3 4\nf 3 4 1 2\nf 4 3 2 1";

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

fn glass_over_the_floor(gap: f64) -> Stage {
    let glass = "newmtl glass\nKd 0 0 0\nNi 1.5\nillum 7\n";
    cube(0.5, 0.0)
        .object("lamp", 0.5, 1.0)
        .level_down([0.4, 0.6], 0.9, [0.4, 0.6])
        .material(glass)
        .line("o glass\nusemtl glass")
        .block(DVec3::new(0.25, gap, 0.25), DVec3::new(0.75, 0.3, 0.75))
}

fn rug() -> Stage {
    cube(0.5, 0.0)
        .object("rug", 0.2, 0.0)
        .level_up([0.25, 0.75], 0.0, [0.25, 0.75])
        .object("lamp", 0.5, 1.0)
        .level_down([0.25, 0.75], 0.5, [0.25, 0.75])
}

const LAMP: [f64; 2] = [0.25, 0.75];

fn sunk_lamp() -> Stage {
    cube(0.5, 0.0).object("lamp", 0.5, 1.0).level_down(LAMP, 1.0, LAMP)
}

/// A furnace with M_e = 1 and ρ = ½, and a block in it. The floor and the block are white instead of glowing, which in a
/// furnace looks alike.
fn furnace_with(block: [DVec3; 2]) -> Stage {
    let [floor, rest @ ..] = room_faces(DVec3::ZERO, DVec3::ONE);
    let stage = rest.iter().fold(Stage::new().object("walls", 0.5, GLOW), |stage, face| stage.face(face));
    stage.object("white", f64::from(Material::MAX_REFLECTANCE), 0.0).face(&floor).block(block[0], block[1])
}

/// A block whose edges are edges of elements of an eighth of a metre, with its foot at this height.
fn aligned_block(foot: f64) -> [DVec3; 2] {
    [DVec3::new(0.25, foot, 0.375), DVec3::new(0.75, 0.375, 0.625)]
}

/// Half way round the foot of that block, m.
const FOOT_EDGE: f64 = 2.0 * (0.5 + 0.25);

const CHAMBER_LAMP: [[f64; 2]; 2] = [[0.125, 0.375], [0.25, 0.75]];

/// A black room with a grey floor, a thin wall across, and a lamp on one side of it.
fn two_chambers(wall: f64) -> Stage {
    let across = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(y, z)| DVec3::new(wall, y, z));
    let [floor, rest @ ..] = room_faces(DVec3::ZERO, DVec3::ONE);
    let stage = Stage::new().object("floor", 0.5, 0.0).face(&floor).object("room", 0.0, 0.0).face(&across);
    let [x, z] = CHAMBER_LAMP;
    rest.iter().fold(stage, |stage, face| stage.face(face)).object("lamp", 0.0, 1.0).level_down(x, 0.75, z)
}

fn duplicate_faces(rows: &mut Rows) -> Result<(), Cancelled> {
    let guard = "faces of one material with the same corners, seen from either side, are kept once";
    let (once, thrice) = (lit_cube(0.5).open("once"), lit_cube(0.5).line(DUPLICATES).open("thrice"));
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
    let settings = Settings { solver: Solver::Jacobi, ..Settings::default() };
    let matrix = solve(&world, &settings, rows.cancel)?.matrix;
    let share = |why| matrix.as_ref().map_or(f64::NAN, |matrix| matrix.share(Some(why)));
    let (coplanar, behind) = (share(Zero::SamePlane), share(Zero::FacesAway));
    let guard = "planes nearer than twice the offset of rays are one plane";
    // The lamp lights nothing, so both sides of the plane count: half of the pairs are of a side with one behind it.
    rows.check("share of pairs that see nothing for being in one plane", coplanar, exactly(0.5), guard);
    rows.check("share of pairs that see nothing for facing away", behind, exactly(0.5), guard);
    Ok(())
}

fn glass_on_the_floor(rows: &mut Rows) -> Result<(), Cancelled> {
    let guard = "rays start on the surface that they leave; what touches it is found in double precision";
    for gap in [0.0, 1e-7, 1e-6, -1e-7] {
        let world = world(glass_over_the_floor(gap).open("glass"), single(0.5), rows.cancel)?;
        let photons = PhotonSettings { count: 20_000, caustic_count: 0, ..PhotonSettings::default() };
        let settings = Settings { photons, ..Settings::default() };
        let mut mapping = PhotonMapping::new(Arc::new(Transport::new(world, settings.effects)), &settings);
        loop {
            match mapping.step(rows.cancel) {
                Step::Advanced | Step::Prepared => {}
                Step::Converged => break,
                Step::Cancelled => return Err(Cancelled),
            }
        }
        let energy = mapping.solution().energy;
        let share = energy.escaped.element_sum() / energy.emitted.element_sum();
        rows.check(format!("share of the photons that escapes, gap {gap:.0e}"), share, exactly(0.0), guard);
    }
    Ok(())
}

fn rug_in_the_floor(rows: &mut Rows) -> Result<(), Cancelled> {
    let world = world(rug().open("rug"), single(0.25), rows.cancel)?;
    let area = |i: usize| world.mesh.elements[i].area;
    let both = floor_of(&world).chain(elements_of(&world, "rug")).map(area).sum::<f64>();
    let guard = "of polygons in the same place the one that comes later lies on top, and covers the other";
    // Areas are sums in double precision, of corners in single precision.
    rows.check("floor and rug that light can reach, m²", both, about(1.0, 1e-6), guard);
    Ok(())
}

/// Elements of the room's floor.
fn floor_of(world: &World) -> impl Iterator<Item = usize> + '_ {
    elements_of(world, "room").filter(|&i| world.mesh.elements[i].center.y < 1e-3)
}

fn lamp_in_the_ceiling(rows: &mut Rows) -> Result<(), Cancelled> {
    let mesh = MeshSettings { element_size: Some(1.001 / 32.0), elements_per_patch_edge: 16 };
    let world = world(sunk_lamp().open("lamp"), mesh, rows.cancel)?;
    let guard = "emitters in the plane of a wall are moved off it, and the wall behind them counts as covered";
    // Areas are sums of some thousand numbers in double precision, of corners in single precision.
    rows.check("surface that light can reach, m²", world.mesh.area(), about(6.0, 1e-6), guard);
    let lamp = patch_of(&world, "lamp");
    let seen = pick(&world, &Settings::default(), lamp, rows.cancel).ok_or(Cancelled)?;
    let mut patches: Vec<u32> = floor_of(&world).map(|i| world.mesh.elements[i].patch).collect();
    patches.dedup();
    let got: f64 = patches.iter().map(|&patch| seen.form_factors[patch as usize]).sum();
    let [a, b, c, d] = level(LAMP, 1.0, LAMP);
    let exact = mean_form_factor([d, c, b, a], &level([0.0, 1.0], 0.0, [0.0, 1.0]));
    // The midpoint rule on 32 × 32 elements, a lamp's height away: (1/32)² / 24 times second derivatives of some 10 F.
    rows.check("F from the lamp to the floor", got, about(exact, 2e-4), "the closed form to the whole polygon");
    Ok(())
}

/// The largest share by which an element of a furnace with M_e = 1 and ρ = ½ differs from B = 2.
fn unevenness(world: &World, solution: &Solution) -> f64 {
    let deviation = |i: usize| f64::from((solution.light.radiosity[i] / 2.0 - 1.0).abs().max_element());
    elements(world).map(deviation).fold(0.0, f64::max)
}

/// Elements that light can reach.
fn elements(world: &World) -> impl Iterator<Item = usize> + '_ {
    (0..world.mesh.elements.len()).filter(|&i| world.mesh.elements[i].exposed > 0.0)
}

/// Four elements of an eighth of a metre along the edge of a patch.
const EIGHTHS: MeshSettings = MeshSettings { element_size: Some(0.1251), elements_per_patch_edge: 4 };

fn block_on_the_floor(rows: &mut Rows) -> Result<(), Cancelled> {
    let guard = "the part of an element on which something stands counts as covered";
    let settings = Settings { unshot_limit: 1e-4, shadow_rays: 256, ..Settings::default() };
    let light = |block: [DVec3; 2]| {
        let world = world(furnace_with(block).open("block"), EIGHTHS, rows.cancel)?;
        let solution = solve(&world, &settings, rows.cancel)?;
        Ok((world, solution))
    };
    let (world, solution) = light(aligned_block(0.0))?;
    // The room, and of the block its four sides; its top is as large as what it covers.
    rows.check("surface that light can reach, m²", world.mesh.area(), about(6.0 + 0.375 * FOOT_EDGE, 1e-6), guard);
    // A fifth of an element's light comes from patches that it sees in part, of which 256 rays tell how much: a standard
    // deviation of 1/2 √(1/5 / 256) = 1.4 %, of which 3.5 are allowed for some 500 elements.
    rows.check("largest deviation from B = 2", unevenness(&world, &solution), about(0.0, 0.05), guard);
    let defect = total(solution.energy.defect()) / total(solution.energy.emitted);
    let closing = "rows of form factors close: what leaves a patch arrives or escapes";
    // A few thousand shots, each of which rounds a sum by 1e-16.
    rows.check("defect of the ledger, share of the flux", defect, about(0.0, 1e-12), closing);
    let (moved, crossed) = light(aligned_block(0.0).map(|corner| corner + DVec3::new(0.0625, 0.0, 0.0625)))?;
    // Points on an 8 × 8 grid tell which part of an element is covered: half a cell along the edge of the foot.
    let tolerance = FOOT_EDGE * 0.125 / 16.0;
    let area = moved.mesh.area();
    rows.check("the same, its foot across elements", area, about(6.0 + 0.375 * FOOT_EDGE, tolerance), guard);
    let reason = "an element that is half covered is taken as a whole: points under the block do not see its side";
    // From the foot, F to the side is nearly 1/2, and half of the points miss it.
    let deviation = unevenness(&moved, &crossed);
    rows.limit("largest deviation from B = 2 (0 would be right)", deviation, about(0.25, 0.04), reason);
    Ok(())
}

fn block_through_the_floor(rows: &mut Rows) -> Result<(), Cancelled> {
    let guard = SEEN;
    let on_the_floor = |foot: f64| {
        let [low, high] = aligned_block(foot);
        let world =
            world(lit_cube(0.5).object("block", 0.5, 0.0).block(low, high).open("block"), single(0.1251), rows.cancel)?;
        let solution = solve(&world, &Settings { unshot_limit: 1e-2, ..Settings::default() }, rows.cancel)?;
        let flux = |i: usize| world.mesh.elements[i].area * f64::from(solution.light.irradiance[i].x);
        Ok((floor_of(&world).map(flux).sum::<f64>(), solution.energy))
    };
    let ((standing, _), (pushed, energy)) = (on_the_floor(0.0)?, on_the_floor(-0.125)?);
    rows.check("flux on the floor over that of a block that stands on it", pushed / standing, about(1.0, 5e-3), guard);
    rows.check("share of the flux that escapes", total(energy.escaped) / total(energy.emitted), exactly(0.0), guard);
    let world = world(furnace_with(aligned_block(-0.125)).open("block"), EIGHTHS, rows.cancel)?;
    // The room is closed, so that nobody would look for a way out unless told to.
    let effects = Switches { forced: Effects::of(&[Effect::Escape]), ..Switches::default() };
    let energy = solve(&world, &Settings { unshot_limit: 1e-4, effects, ..Settings::default() }, rows.cancel)?.energy;
    // Patches half a metre high, three quarters of them in the furnace: their mean B is 3/4 of 2 at most. A quarter of
    // them is outside. The rest of the furnace dims by that, but not to half.
    let most = 1.5 * FOOT_EDGE * 0.125 / energy.emitted.x;
    let reason =
        "a patch has one radiosity, and shines with it outside of the room, too, where it goes through the floor";
    let escaping = energy.escaped.x / energy.emitted.x;
    rows.limit(
        "the same where patches go through the floor, and a way out is looked for (0 would be right)",
        escaping,
        about(0.75 * most, 0.25 * most),
        reason,
    );
    Ok(())
}

fn wall_on_the_floor(rows: &mut Rows) -> Result<(), Cancelled> {
    let dark_share = |wall: f64, stage: Stage| {
        let world = world(stage.open("wall"), single(0.125), rows.cancel)?;
        let solution = solve(&world, &Settings { shadow_rays: 256, ..Settings::default() }, rows.cancel)?;
        let flux = |i: usize| world.mesh.elements[i].area * total(solution.light.irradiance[i].as_dvec3());
        // A little off its surface, so that each side of the wall is on its own side.
        let is_dark = |&i: &usize| {
            let element = &world.mesh.elements[i];
            let normal = world.mesh.patches[element.patch as usize].normal;
            f64::from((element.center + 1e-2 * normal).x) > wall + 5e-3
        };
        Ok(elements(&world).filter(is_dark).map(flux).sum::<f64>() / total(solution.energy.emitted))
    };
    // A glimmer in the other room, so that its walls count as surfaces that light can reach.
    let glimmer = two_chambers(0.5625).object("glimmer", 0.0, 1e-9).level_down([0.7, 0.8], 0.9, [0.4, 0.6]);
    let (beside, across) = (dark_share(0.5, two_chambers(0.5))?, dark_share(0.5625, glimmer)?);
    let guard = SEEN;
    rows.check("share of the flux that gets into the dark room", beside, exactly(0.0), guard);
    // A row of floor elements gets half of the light that it would without the wall, reflects half of that, and half of
    // it on the dark side.
    let [a, b, c, d] = level(CHAMBER_LAMP[0], 0.75, CHAMBER_LAMP[1]);
    let without_wall = mean_form_factor([d, c, b, a], &level([0.5, 0.625], 0.0, [0.0, 1.0]));
    let expected = 0.125 * without_wall;
    let reason = "an element has one irradiance; where a wall crosses it, light comes out on the other side";
    // Some 40 % of it falls on the foot of the wall, where four points see a strip that is half as wide as their element
    // wrong by up to a half of itself.
    let quantity = "the same, wall across the middle of elements (0 would be right)";
    rows.limit(quantity, across, about(expected, 0.2 * expected), reason);
    Ok(())
}
