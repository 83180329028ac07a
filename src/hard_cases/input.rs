//! Files that hold nothing, and numbers that are none.

use super::row::exactly;
use super::stage::{Stage, single, steps, world};
use super::{Case, Rows};
use crate::cancel::{Cancel, Cancelled};
use crate::mesh::MeshSettings;
use crate::methods::Settings;
use crate::scene::Scene;
use crate::world::World;

pub const CASES: &[Case] = &[
    Case {
        name: "empty-file",
        about: "files that hold no face that could be drawn",
        measure: empty_file,
        scene: || None,
    },
    Case {
        name: "not-a-number",
        about: "NaN and infinity in place of each number of a scene, one after the other",
        measure: not_a_number,
        scene: || lamp_over_floor().show("not-a-number"),
    },
    Case { name: "element-size", about: "element sizes that no mesh can have", measure: element_size, scene: || None },
];

fn lamp_over_floor() -> Stage {
    Stage::new().object("floor", 0.5, 0.0).level_up([0.0, 1.0], 0.0, [0.0, 1.0]).object("lamp", 0.5, 1.0).level_down(
        [0.3, 0.7],
        0.9,
        [0.3, 0.7],
    )
}

fn empty_file(rows: &mut Rows) -> Result<(), Cancelled> {
    let files = ["", "# a comment\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "v 0 0 0\nf 1 1 1\n", "f 1 2 3\n"];
    let opened = files.iter().filter(|text| Scene::from_text("empty", text, "").is_ok()).count();
    rows.check(
        "files without a face that open",
        opened as f64,
        exactly(0.0),
        "a scene without a face is refused, with the reason",
    );
    Ok(())
}

/// The text with each of its numbers, one after the other, replaced.
fn spoiled<'a>(text: &'a str, number: &'a str) -> impl Iterator<Item = String> + 'a {
    let words: Vec<&str> = text.split_inclusive(char::is_whitespace).collect();
    let is_number = |word: &&str| word.trim_end().parse::<f64>().is_ok();
    let numbers: Vec<usize> = (0..words.len()).filter(|&i| is_number(&words[i])).collect();
    numbers.into_iter().map(move |at| {
        let mut words = words.clone();
        let end = &words[at][words[at].trim_end().len()..];
        let number = format!("{number}{end}");
        words[at] = &number;
        words.concat()
    })
}

fn not_a_number(rows: &mut Rows) -> Result<(), Cancelled> {
    let stage = lamp_over_floor();
    let (obj, mtl) = stage.text();
    for number in ["nan", "inf", "-1e39"] {
        let objs = spoiled(obj, number).map(|obj| Scene::from_text("spoiled", &obj, mtl));
        let mtls = spoiled(mtl, number).map(|mtl| Scene::from_text("spoiled", obj, &mtl));
        let (mut tried, mut broken) = (0, 0);
        for scene in objs.chain(mtls) {
            tried += 1;
            let Ok(scene) = scene else { continue };
            let world = world(scene, single(0.51), rows.cancel)?;
            let light = steps(&world, &Settings { shadow_rays: 4, ..Settings::default() }, 4, rows.cancel)?.light;
            broken += light.radiosity.iter().filter(|radiosity| !radiosity.is_finite()).count();
        }
        let guard = "every number is checked where it is read, and what is none is mended or left out";
        rows.check(
            format!("elements that are no number, {tried} scenes with one {number}"),
            broken as f64,
            exactly(0.0),
            guard,
        );
    }
    Ok(())
}

fn element_size(rows: &mut Rows) -> Result<(), Cancelled> {
    let sizes = [f32::NAN, f32::INFINITY, 0.0, -1.0, 1e-30];
    let built = sizes.iter().filter(|&&size| {
        let settings = MeshSettings { element_size: Some(size), ..MeshSettings::default() };
        World::build(lamp_over_floor().open("room"), &settings, &Cancel::default()).is_ok()
    });
    rows.check(
        "element sizes out of range that are taken",
        built.count() as f64,
        exactly(0.0),
        "sizes are checked before anything is cut",
    );
    Ok(())
}
