//! The same scene in other units, and far from the origin.

use super::row::about;
use super::stage::{Stage, solve, world};
use super::{Case, Rows};
use crate::cancel::Cancelled;
use crate::math::rgb::Rgb;
use crate::mesh::MeshSettings;
use crate::methods::Settings;
use crate::scene::Scene;
use glam::DVec3;

pub const CASES: &[Case] = &[
    Case {
        name: "scaled",
        about: "a room in units from a millionth to a million times as large",
        measure: scaled,
        scene: || room(1e6, DVec3::ZERO).show("scaled"),
    },
    Case {
        name: "moved",
        about: "a room a million times its own size away from the origin",
        measure: moved,
        scene: || room(1.0, FAR).show("moved"),
    },
];

const FAR: DVec3 = DVec3::new(1e6, -1e6, 1e6);

/// A closed room with a block and a lamp, scaled and then moved.
fn room(scale: f64, shift: DVec3) -> Stage {
    Stage::new()
        .placed(scale, shift)
        .object("room", 0.5, 0.0)
        .room(DVec3::ZERO, DVec3::new(1.0, 0.8, 0.9))
        .object("block", 0.7, 0.0)
        .block(DVec3::new(0.15, 0.0, 0.2), DVec3::new(0.45, 0.35, 0.55))
        .object("lamp", 0.5, 1.0)
        .level_down([0.35, 0.6], 0.78, [0.3, 0.55])
}

/// Irradiance of each element, W/m².
fn light(scene: Scene, scale: f64, rows: &Rows) -> Result<Vec<Rgb>, Cancelled> {
    // No edge is a whole number of elements long, so that rounding cannot change their number.
    let mesh = MeshSettings { element_size: Some((0.11 * scale) as f32), ..MeshSettings::default() };
    let world = world(scene, mesh, rows.cancel)?;
    let settings = Settings { unshot_limit: 1e-2, shadow_rays: 16, ..Settings::default() };
    Ok(solve(&world, &settings, rows.cancel)?.light.irradiance)
}

/// Mean difference of two pictures over their mean; 1 where they do not have the same elements.
fn difference(a: &[Rgb], b: &[Rgb]) -> f64 {
    let sum = |light: &[Rgb]| light.iter().map(|light| f64::from(light.element_sum())).sum::<f64>();
    let apart: Vec<Rgb> = a.iter().zip(b).map(|(a, b)| (*a - *b).abs()).collect();
    if a.len() == b.len() { sum(&apart) / sum(a) } else { 1.0 }
}

/// Corners are rounded to 6e-8 of the room's size, and a shadow ray that passes an edge by less may fall on its other side. Of
/// some hundred thousand rays between points of a room with a metre of edges hardly one does, and it moves the light of
/// one element by a quarter at most: 1e-4 of the mean over some thousand elements, for a few of them.
const SAME: f64 = 1e-4;

fn scaled(rows: &mut Rows) -> Result<(), Cancelled> {
    let reference = light(room(1.0, DVec3::ZERO).open("room"), 1.0, rows)?;
    for scale in [1e-6, 1e-3, 1e3, 1e6] {
        let got = light(room(scale, DVec3::ZERO).open("room"), scale, rows)?;
        let guard = "rays are traced in a frame of fixed size, and every other threshold is relative";
        rows.check(
            format!("mean difference of light, size {scale:.0e}"),
            difference(&reference, &got),
            about(0.0, SAME),
            guard,
        );
    }
    Ok(())
}

fn moved(rows: &mut Rows) -> Result<(), Cancelled> {
    for scale in [1.0, 1e-3] {
        let reference = light(room(scale, DVec3::ZERO).open("room"), scale, rows)?;
        let got = light(room(scale, FAR * scale).open("room"), scale, rows)?;
        let guard = "scenes far from the origin are moved there before numbers are rounded to single precision";
        rows.check(
            format!("mean difference of light, size {scale:.0e}"),
            difference(&reference, &got),
            about(0.0, SAME),
            guard,
        );
    }
    Ok(())
}
