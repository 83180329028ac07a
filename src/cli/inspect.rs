//! `lightwell inspect`: what a scene holds, and what was wrong with it.

use super::plan::effects;
use super::{CliError, values};
use crate::cancel::Cancel;
use crate::effects::plan;
use crate::mesh::MeshSettings;
use crate::scene::{Scene, Severity};
use crate::world::World;
use serde_json::{Value, json};
use std::io::Write;

#[derive(clap::Args, Debug)]
pub struct Options {
    /// The path of an OBJ file, or the name of a built-in scene
    scene: String,
    /// Longest edge of an element, in the scene's units [default: about 8000 elements in all]
    #[arg(long, value_name = "SIZE", value_parser = values::positive)]
    element: Option<f64>,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

pub fn run(options: &Options) -> Result<(), CliError> {
    let scene = Scene::open(&options.scene)?;
    let settings = MeshSettings { element_size: options.element.map(|size| size as f32), ..MeshSettings::default() };
    let world = World::build(scene, &settings, &Cancel::default())?;
    let mut out = std::io::stdout().lock();
    if options.json {
        writeln!(out, "{}", report(&world))?;
    } else {
        write!(out, "{}", text(&world))?;
    }
    Ok(())
}

/// Polygons that emit.
fn emitters(world: &World) -> usize {
    let scene = &world.scene;
    scene.polygons.iter().filter(|polygon| scene.materials[polygon.material as usize].is_emitter()).count()
}

fn triangles(world: &World) -> usize {
    world.scene.polygons.iter().map(|polygon| polygon.corners().len() - 2).sum()
}

fn report(world: &World) -> Value {
    let (scene, view) = (&world.scene, &world.viewpoint);
    let in_file = |point| scene.file_from_scene(point).to_array();
    json!({
        "scene": scene.name,
        "polygons": scene.polygons.len(),
        "triangles": triangles(world),
        "patches": world.mesh.patches.len(),
        "elements": world.mesh.elements.len(),
        "element_size": world.element_size,
        "materials": scene.materials.len(),
        "emitters": emitters(world),
        "extent": { "min": in_file(world.bounds.min), "max": in_file(world.bounds.max) },
        "closed": world.is_closed(),
        "effects": effects(&plan(world)),
        "viewpoint": {
            "eye": in_file(view.eye),
            "target": in_file(view.target),
            "up": view.up.to_array(),
            "vertical_fov": view.vertical_fov,
        },
        "findings": scene.findings,
    })
}

fn text(world: &World) -> String {
    let scene = &world.scene;
    let mut text = format!(
        "{}: {} polygons ({} triangles), {} objects, {} materials, {} emitters\n",
        scene.name,
        scene.polygons.len(),
        triangles(world),
        scene.objects.len(),
        scene.materials.len(),
        emitters(world),
    );
    text += &format!(
        "mesh: {} patches, {} elements of at most {:.3e}\nextent: {} to {}, {}\n",
        world.mesh.patches.len(),
        world.mesh.elements.len(),
        world.element_size,
        scene.file_from_scene(world.bounds.min),
        scene.file_from_scene(world.bounds.max),
        if world.is_closed() { "closed" } else { "open: light escapes" },
    );
    for finding in &scene.findings {
        let severity = if finding.severity == Severity::Warning { "warning" } else { "note" };
        text += &format!("{severity}: {}: {}; {}\n", finding.subject, finding.problem, finding.remedy);
    }
    text
}
