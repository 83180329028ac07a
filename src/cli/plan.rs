//! `lightwell plan`: which effects of light a scene calls for, and how it is best computed.

use super::{CliError, warn_of};
use crate::cancel::Cancel;
use crate::choice::Choice;
use crate::effects::{Plan, Verdict, plan};
use crate::mesh::MeshSettings;
use crate::scene::Scene;
use crate::world::{World, with_ceiling_light};
use serde_json::{Value, json};
use std::io::Write;

#[derive(clap::Args, Debug)]
pub struct Options {
    /// The path of an OBJ file, or the name of a built-in scene
    scene: String,
    /// Add a ceiling light where the scene has no emitter of its own
    #[arg(long)]
    ceiling_light: bool,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

pub fn run(options: &Options) -> Result<(), CliError> {
    let mut scene = Scene::open(&options.scene)?;
    if options.ceiling_light && !scene.has_emitter() {
        scene = with_ceiling_light(&scene);
    }
    let world = World::build(scene, &MeshSettings::default(), &Cancel::default())?;
    warn_of(&world.scene.findings);
    let plan = plan(&world);
    let mut out = std::io::stdout().lock();
    if options.json {
        writeln!(out, "{}", report(&world, &plan))?;
    } else {
        write!(out, "{}", text(&world, &plan))?;
    }
    Ok(())
}

/// What `inspect` also says of the effects.
pub fn effects(plan: &Plan) -> Value {
    plan.verdicts.iter().map(verdict).collect()
}

fn verdict(verdict: &Verdict) -> Value {
    json!({
        "effect": verdict.effect.name(),
        "needed": verdict.is_needed,
        "reason": verdict.reason,
        "saves": verdict.saves,
    })
}

fn with_loss(verdict: &Verdict) -> Value {
    let mut value = self::verdict(verdict);
    value["if_missed"] = verdict.if_missed.into();
    value
}

fn report(world: &World, plan: &Plan) -> Value {
    json!({
        "scene": world.scene.name,
        "effects": plan.verdicts.iter().map(with_loss).collect::<Vec<_>>(),
        "parts": plan.parts,
        "method": plan.advice.approach,
        "method_reason": plan.advice.reason,
    })
}

fn text(world: &World, plan: &Plan) -> String {
    let mut text = format!("{}: {}\n{}\n", world.scene.name, plan.advice.approach.label(), plan.advice.reason);
    for verdict in &plan.verdicts {
        let (sign, tail) = if verdict.is_needed {
            ("needed", format!("If it were skipped: {}", verdict.if_missed))
        } else {
            ("not needed", format!("Skipping it saves: {}", verdict.saves))
        };
        text += &format!("{sign:10}  {:19}  {} {tail}\n", verdict.effect.name(), verdict.reason);
    }
    plan.parts.iter().fold(text, |text, part| text + part + "\n")
}
