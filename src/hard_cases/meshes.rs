//! Faces that are no good: slivers, faces without area, corners that are no numbers.

use super::row::{about, exactly};
use super::stage::{GLOW, Stage, elements_of, lit_cube, room_faces, single, solve, world};
use super::{Case, Rows};
use crate::cancel::Cancelled;
use crate::math::random::Stream;
use crate::methods::Settings;
use crate::tracer::Ray;
use glam::{DVec3, Vec3A};

pub const CASES: &[Case] = &[
    Case {
        name: "sliver",
        about: "a strip of floor a million times as long as wide, without which light would leak out",
        measure: sliver,
        scene: || furnace_with_sliver().show("sliver"),
    },
    Case {
        name: "bad-faces",
        about: "faces without area, with corners that are no finite numbers, or that do not exist",
        measure: bad_faces,
        scene: || bad_room().show("bad-faces"),
    },
];

const WIDTH: f64 = 1e-6;

/// A furnace with M_e = 1 and ρ = ½ whose floor is two parts with a sliver between them.
fn furnace_with_sliver() -> Stage {
    let stage = Stage::new().object("room", 0.5, GLOW);
    let faces = room_faces(DVec3::ZERO, DVec3::ONE);
    let stage = faces[1..].iter().fold(stage, |stage, face| stage.face(face));
    stage
        .level_up([0.0, 0.4], 0.0, [0.0, 1.0])
        .level_up([0.4 + WIDTH, 1.0], 0.0, [0.0, 1.0])
        .object("sliver", 0.5, GLOW)
        .level_up([0.4, 0.4 + WIDTH], 0.0, [0.0, 1.0])
}

fn bad_room() -> Stage {
    lit_cube(0.5).line("v nan 0 0\nv 0 inf 0\nv 1e39 0 0\nv 0.5 0.5 0.5\nf 1 2 -4\nf 1 2 -3\nf 1 2 -2\nf -1 -1 -1\nf 1 2 1 2\nf 1 2 99\nf 1 x 2")
}

fn sliver(rows: &mut Rows) -> Result<(), Cancelled> {
    let world = world(furnace_with_sliver().open("sliver"), single(0.26), rows.cancel)?;
    let mut stream = Stream::new(1, 0, 0);
    let lost = (0..50_000).filter(|_| {
        let eye = Vec3A::new(stream.uniform(), 0.1 + 0.8 * stream.uniform(), stream.uniform());
        let target = Vec3A::new((0.4 + 0.5 * WIDTH) as f32, 0.0, stream.uniform());
        world.tracer.closest(&Ray::new(eye, (target - eye).normalize())).is_none()
    });
    let guard = "a triangle is missed only if its area as the ray sees it is exactly 0";
    rows.check("rays at the sliver that fall through", lost.count() as f64, exactly(0.0), guard);
    let solution = solve(&world, &Settings { unshot_limit: 1e-4, ..Settings::default() }, rows.cancel)?;
    let worst =
        elements_of(&world, "sliver").map(|i| f64::from((solution.light.radiosity[i] / 2.0 - 1.0).abs().max_element()));
    // As everywhere in a furnace of such elements: four points an element see each wall.
    let guard = "no face is dropped for being small: what has no area is told by its own length";
    rows.check("largest deviation of the sliver from B = 2", worst.fold(f64::NAN, f64::max), about(0.0, 2e-2), guard);
    Ok(())
}

fn bad_faces(rows: &mut Rows) -> Result<(), Cancelled> {
    let guard = "every line of the file is checked, and what cannot be used is left out by name and line";
    let (good, bad) = (lit_cube(0.5).open("good"), bad_room().open("bad"));
    rows.check("faces that are left", bad.polygons.len() as f64, exactly(7.0), guard);
    // Three vertices that cannot be used, the three faces that use them, two corners that do not exist, two faces without
    // area.
    rows.check("things that are reported", bad.findings.len() as f64, exactly(10.0), guard);
    let light = |scene| {
        let world = world(scene, single(0.2), rows.cancel)?;
        Ok(solve(&world, &Settings::default(), rows.cancel)?.light.irradiance)
    };
    let (good, bad) = (light(good)?, light(bad)?);
    let differ = good.len().abs_diff(bad.len()) + good.iter().zip(&bad).filter(|(a, b)| a != b).count();
    rows.check("elements with other light", differ as f64, exactly(0.0), guard);
    Ok(())
}
