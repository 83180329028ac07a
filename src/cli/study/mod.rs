//! `lightwell study`: what accuracy costs in time on one scene, as a table, a chart and a report.

mod chart;
mod report;
mod table;

use super::run_options::SceneOptions;
use super::{CliError, values};
use crate::accuracy::Cache;
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::mesh::MeshSettings;
use crate::methods::Settings;
use crate::study::{Bench, Progress, Study, study};
use serde_json::{Value, json};
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What is kept for writing the files.
const FOR_WRITING: Duration = Duration::from_millis(200);

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    scene: SceneOptions,
    /// The folder for cost.csv, cost.svg and report.md; it is made where it is missing
    #[arg(long, short, value_name = "FOLDER", value_parser = values::folder)]
    output: PathBuf,
    /// How long it may take in all, from the start of the program
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = values::positive)]
    budget: f64,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

pub fn run(options: &Options) -> Result<(), CliError> {
    let start = Instant::now();
    let budget = Duration::try_from_secs_f64(options.budget).unwrap_or(Duration::from_secs(u32::MAX.into()));
    let settings = Settings { seed: options.scene.seed, ..Settings::default() };
    let mesh = options.scene.mesh(MeshSettings::default().elements_per_patch_edge);
    let world = options.scene.open(mesh.elements_per_patch_edge)?;
    let name = world.scene.name.clone();
    let mut bench = Bench::open(world, mesh, Cache::of_user());
    let end = (start + budget).checked_sub(FOR_WRITING).unwrap_or(start);
    let study = study(&mut bench, &settings, [start, end], &Cancel::default(), &mut tell);
    if let Err(error) = bench.keep() {
        eprintln!("warning: {}", with_causes(&error));
    }
    write_files(&options.output, &name, options.budget, &study)?;
    let mut out = std::io::stdout().lock();
    if options.json {
        writeln!(out, "{}", json_of(&name, options.budget, &study))?;
    } else {
        write!(out, "{}", report::summary(&study))?;
    }
    Ok(())
}

/// How far it is, on a terminal alone.
fn tell(progress: &Progress<'_>) {
    if std::io::stderr().is_terminal() {
        let what = progress.recipe.map_or("the reference".to_owned(), |recipe| recipe.label());
        eprint!("\r\x1b[K{} of {}: {what}", progress.done, progress.of);
        if progress.recipe.is_none() {
            eprintln!();
        }
    }
}

fn write_files(folder: &Path, scene: &str, budget: f64, study: &Study) -> Result<(), CliError> {
    std::fs::create_dir_all(folder).map_err(|source| CliError::Folder { path: folder.to_owned(), source })?;
    let write = |name: &str, text: String| {
        let path = folder.join(name);
        std::fs::write(&path, text).map_err(|source| CliError::Write { path, source })
    };
    write("cost.csv", table::csv(study))?;
    let path = folder.join("cost.svg");
    let chart = chart::svg(scene, study).map_err(|source| CliError::Encode { path, source })?;
    write("cost.svg", chart)?;
    write("report.md", report::markdown(scene, budget, study))
}

/// Errors are shares of the mean irradiance.
fn json_of(scene: &str, budget: f64, study: &Study) -> Value {
    let runs: Vec<Value> = study
        .measured
        .iter()
        .enumerate()
        .map(|(index, measured)| {
            json!({
                "run": measured.run,
                "method": measured.recipe.way,
                "options": measured.recipe.options(),
                "finished": measured.is_finished,
                "seconds": measured.price.seconds,
                "rays": measured.price.rays,
                "bytes": measured.price.bytes,
                "error": measured.error.rms,
                "error_uncertainty": measured.error.uncertainty,
                "noise": measured.error.noise,
                "on_front": study.front.contains(&index),
                "levels_off": study.levels.contains(&index),
            })
        })
        .collect();
    let slopes: serde_json::Map<String, Value> =
        study.slopes.iter().map(|(way, slope)| (crate::choice::Choice::name(*way).to_owned(), json!(slope))).collect();
    json!({
        "scene": scene,
        "budget": budget,
        "seconds": study.elapsed.as_secs_f64(),
        "reference": { "points": study.truth.irradiance.len(), "paths": study.truth.paths, "error": study.truth.floor },
        "slopes": slopes,
        "runs": runs,
    })
}
