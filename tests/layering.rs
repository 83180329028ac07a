//! The modules form layers, and a name may be used only from a higher one; an outside crate only where the table says.
//! Every path in `src/` is held against the table, in `use` trees and in expressions, in the program and in its tests.

#[path = "layering/source.rs"]
mod source;

use source::{Reference, Target, references};
use std::collections::HashSet;
use std::fs;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

/// The top modules of each layer; `lib` and `main` are the two crate roots.
const LAYERS: [&[&str]; 8] = [
    &["math", "cancel", "choice", "clock", "errors"],
    &["scene", "mesh", "tracer", "world"],
    &["camera", "effects", "solution"],
    &["methods"],
    &["accuracy", "hard_cases"],
    &["worker", "study"],
    &["viewport"],
    &["cli", "app", "main", "lib"],
];

/// A layer names itself and those below it, with one exception: the picture is drawn from what a method hands out, so it
/// never names a method or anything that drives one.
const PICTURE: usize = 6;
const HIDDEN_FROM_THE_PICTURE: RangeInclusive<usize> = 3..=5;

/// The order inside a layer, where there is one: the first never names the second.
const NEVER: [(&str, &str); 6] = [
    ("scene", "mesh"),
    ("scene", "tracer"),
    ("scene", "world"),
    ("mesh", "world"),
    ("camera", "solution"),
    ("worker", "study"),
];

const ANYWHERE: &[&str] = &[""];

/// The modules (with all below them) that may name an outside crate.
const CRATES: &[(&str, &[&str])] = &[
    // Numbers and light.
    ("glam", ANYWHERE),
    ("sobol_burley", &["math"]),
    ("tobj", &["scene::obj", "scene::mtl"]),
    ("earcut", &["scene"]),
    ("obvhs", &["tracer"]),
    ("rayon", &["mesh", "tracer", "world", "methods", "accuracy", "worker", "study"]),
    ("thread_priority", &["worker"]),
    ("sysinfo", &["worker"]),
    ("dirs", &["accuracy"]),
    ("regex", &["solution"]),
    // The picture.
    ("wgpu", &["viewport", "app"]),
    ("bytemuck", &["viewport", "solution"]),
    ("pollster", &["viewport"]),
    // The two faces.
    ("clap", &["cli", "main"]),
    ("exr", &["cli", "main"]),
    ("png", &["cli", "main"]),
    ("plotters", &["cli", "main"]),
    ("serde_json", &["study", "cli", "main", "app"]),
    ("env_logger", &["cli", "main"]),
    ("egui", &["app"]),
    ("eframe", &["app"]),
    ("egui_plot", &["app"]),
    ("rfd", &["app"]),
    // Everywhere: what a thing is called outside, and what is said about it.
    ("serde", ANYWHERE),
    ("thiserror", ANYWHERE),
    ("log", ANYWHERE),
    // Tests alone can name these.
    ("proptest", ANYWHERE),
    ("tempfile", ANYWHERE),
    ("naga", &["viewport"]),
    ("egui_kittest", &["app"]),
];

#[test]
fn every_file_keeps_to_its_layer() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let dependencies = dependencies(&fs::read_to_string(root.join("Cargo.toml")).unwrap());
    let mut broken = Vec::new();
    for file in rust_files(&root.join("src")) {
        let name = file.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/");
        broken.extend(check(&name, &fs::read_to_string(&file).unwrap(), &dependencies));
    }
    assert!(broken.is_empty(), "the layers are broken (the table is in tests/layering.rs):\n{}", broken.join("\n"));
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    let expand = |path: PathBuf| if path.is_dir() { rust_files(&path) } else { vec![path] };
    entries.into_iter().flat_map(expand).filter(|path| path.extension().is_some_and(|end| end == "rs")).collect()
}

/// The crates that Cargo.toml's dependency sections list, as Rust code spells them.
fn dependencies(manifest: &str) -> HashSet<String> {
    let mut names = HashSet::new();
    let mut listed = false;
    for line in manifest.lines().map(str::trim) {
        if let Some(section) = line.strip_prefix('[') {
            let section = section.trim_end_matches(']');
            listed = section.ends_with("dependencies");
            names.extend(section.split_once("dependencies.").map(|(_, name)| name.replace('-', "_")));
        } else if listed && !line.is_empty() && !line.starts_with('#') {
            let name = line.split(['=', '.', ' ']).next().unwrap_or_default();
            names.insert(name.replace('-', "_"));
        }
    }
    names
}

/// One line for every rule that the file breaks. `file` is its path from the repository's root.
fn check(file: &str, source: &str, dependencies: &HashSet<String>) -> Vec<String> {
    let path = file.trim_start_matches("src/").trim_end_matches(".rs").trim_end_matches("/mod");
    let module: Vec<&str> = path.split('/').collect();
    let top = module[0];
    if layer(top).is_none() {
        return vec![format!("{file}:1: {}", no_layer(top))];
    }
    let is_root = matches!(top, "lib" | "main");
    let mut broken = Vec::new();
    for Reference { from, target, line } in references(source, if is_root { vec![] } else { module }) {
        let from = if is_root { top } else { &from };
        let complaint = match target {
            Target::Module(name) => module_rule(top, name),
            Target::Crate(name) | Target::Name(name) if dependencies.contains(name) => crate_rule(from, name),
            Target::Crate(_) | Target::Name(_) => None,
        };
        broken.extend(complaint.map(|complaint| format!("{file}:{line}: {complaint}")));
    }
    broken
}

fn layer(module: &str) -> Option<usize> {
    LAYERS.iter().position(|modules| modules.contains(&module))
}

fn no_layer(module: &str) -> String {
    format!("the top module `{module}` has no layer: put it in the table")
}

fn module_rule(from: &str, to: &str) -> Option<String> {
    if from == to {
        return None;
    }
    if to == "*" {
        return Some("names the whole crate at once: name the modules".to_owned());
    }
    let (own, Some(other)) = (layer(from)?, layer(to)) else { return Some(no_layer(to)) };
    let hidden = own == PICTURE && HIDDEN_FROM_THE_PICTURE.contains(&other);
    let refused = other > own || hidden || NEVER.contains(&(from, to));
    refused.then(|| format!("`{from}` (layer {own}) may not name `{to}` (layer {other})"))
}

fn crate_rule(from: &str, name: &str) -> Option<String> {
    let Some((_, places)) = CRATES.iter().find(|(listed, _)| *listed == name) else {
        return Some(format!("the crate `{name}` has no place: put it in the table"));
    };
    let within = |place: &str| from.strip_prefix(place).is_some_and(|rest| rest.is_empty() || rest.starts_with("::"));
    let allowed = places.iter().any(|place| place.is_empty() || within(place));
    (!allowed).then(|| format!("`{from}` may not name the crate `{name}`: its place is {}", places.join(", ")))
}

/// What the checker says of a file with one line of code, without the file's name.
fn said(file: &str, source: &str) -> Vec<String> {
    let dependencies = ["glam", "tobj", "exr", "wgpu", "newcomer"].map(str::to_owned).into();
    let cut = |line: String| line.strip_prefix(file).unwrap().to_owned();
    check(file, source, &dependencies).into_iter().map(cut).collect()
}

#[test]
fn the_checker_refuses_a_higher_layer_however_it_is_named() {
    let refused = ":1: `mesh` (layer 1) may not name `world` (layer 1)";
    for source in [
        "use crate::world;",
        "use crate::world::World;",
        "use crate::{math::rgb, world::{self, World}};",
        "use crate::{self as all, world as w};",
        "use super::world::World;",
        "fn f(world: &crate::world::World) {}",
        "fn f() -> Vec<super::world::World> { vec![] }",
        "#[cfg(test)] mod tests { use super::super::world::World; }",
        "mod a { mod b {} fn f() { super::super::world::build() } }",
        "macro_rules! m { () => { $crate::world::build() } }",
        "fn f<'a>(quote: char, x: &'a str) { if quote == '\"' { crate::world::build() } }",
    ] {
        assert!(said("src/mesh/mod.rs", source).contains(&refused.to_owned()), "{source}");
    }
    assert_eq!(said("src/mesh/mod.rs", "\n\nuse crate::{\n    math,\n    app,\n};").len(), 1);
    assert!(said("src/mesh/mod.rs", "\n\nuse crate::{\n    math,\n    app,\n};")[0].starts_with(":5: "));
}

#[test]
fn the_checker_knows_every_kind_of_rule() {
    for (file, source, expected) in [
        ("src/math/mod.rs", "use crate::scene::Scene;", "`math` (layer 0) may not name `scene` (layer 1)"),
        ("src/viewport/mod.rs", "use crate::worker::Slot;", "`viewport` (layer 6) may not name `worker` (layer 5)"),
        ("src/camera.rs", "use crate::methods;", "`camera` (layer 2) may not name `methods` (layer 3)"),
        ("src/scene/obj.rs", "use crate::tracer;", "`scene` (layer 1) may not name `tracer` (layer 1)"),
        ("src/world.rs", "use crate::novel::X;", "the top module `novel` has no layer: put it in the table"),
        ("src/novel/mod.rs", "", "the top module `novel` has no layer: put it in the table"),
        ("src/main.rs", "use lightwell::novel;", "the top module `novel` has no layer: put it in the table"),
        ("src/world.rs", "use super::*;", "names the whole crate at once: name the modules"),
        ("src/world.rs", "use crate::{self as all};", "names the whole crate at once: name the modules"),
        (
            "src/world.rs",
            "use tobj::Mesh;",
            "`world` may not name the crate `tobj`: its place is scene::obj, scene::mtl",
        ),
        (
            "src/cli/mod.rs",
            "fn f(x: wgpu::Texture) {}",
            "`cli` may not name the crate `wgpu`: its place is viewport, app",
        ),
        ("src/math/rgb.rs", "extern crate exr;", "`math::rgb` may not name the crate `exr`: its place is cli, main"),
        ("src/app/mod.rs", "use crate::cli::exr; use ::exr::io;", "`app` may not name the crate `exr`"),
        ("src/math/rgb.rs", "use newcomer::X;", "the crate `newcomer` has no place: put it in the table"),
    ] {
        let said = said(file, source);
        assert!(said.len() == 1 && said[0].starts_with(&format!(":1: {expected}")), "{file}: {source}: {said:?}");
    }
}

#[test]
fn the_checker_lets_pass_what_the_table_allows() {
    for (file, source) in [
        (
            "src/mesh/mod.rs",
            "pub mod smooth; use smooth::x; use crate::{math::rgb::Rgb, scene, tracer}; use std::sync::Arc;",
        ),
        (
            "src/scene/obj.rs",
            "use super::{doctor::Finding, *}; use tobj::Mesh; fn f(v: ::glam::Vec3) -> ::glam::Vec3 { v }",
        ),
        ("src/scene/obj/lines.rs", "mod tests { use super::super::super::Scene; use tobj::Mesh; }"),
        ("src/viewport/mod.rs", "use crate::solution::Solution; pub(crate) fn f(s: &self::targets::Targets) {}"),
        ("src/main.rs", "use lightwell::{app, cli}; fn main() { exr::f(); lightwell::worker::run::<u8>() }"),
        ("src/lib.rs", "pub mod app; pub use scene::Scene; use self::app::x;"),
        ("src/app/mod.rs", "use crate::cli::exr; fn f() { exr::write(); Vec::<u8>::exr(); x.exr::<u8>() }"),
        (
            "src/math/rgb.rs",
            "// crate::app\n/* /* tobj::x */ crate::app */ /// [`crate::app`]\nconst A: &str = \"crate::app\";",
        ),
        ("src/math/rgb.rs", "const A: &str = \"\\\" crate::app \\\\\"; const B: char = '\"'; use crate::math;"),
        ("src/math/rgb.rs", "const A: &str = r#\"\" crate::app\"#; const B: char = '\\''; const C: &[u8] = br\"\\\";"),
    ] {
        assert_eq!(said(file, source), [""; 0], "{file}: {source}");
    }
}

#[test]
fn dependencies_are_read_from_every_section() {
    let manifest = "[package]\nname = \"x\"\n[dependencies]\n# a = 1\nglam = \"1\"\nsome-crate.workspace = true # why\n\
                    [dev-dependencies]\nnaga = { version = \"1\" }\n[target.'cfg(unix)'.dependencies.long-one]\nversion = \"1\"\n\
                    [profile.release]\ndebug = true";
    let expected = ["glam", "some_crate", "naga", "long_one"].map(str::to_owned).into();
    assert_eq!(dependencies(manifest), expected);
}
