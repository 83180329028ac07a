//! `lightwell solve`: where the light went.

use super::budget::CommandBudget;
use super::judge::Judge;
use super::photon_options::{LightMethod, PhotonOptions};
use super::run_options::{RunOptions, Solved};
use super::seeking::light_for;
use super::tracing::{Tracing, photon_report};
use super::{CliError, effect_options, refuse, values};
use crate::choice::{Choice, parse};
use crate::math::rgb::total;
use crate::methods::Settings;
use crate::solution::{PhotonSolution, Solution};
use crate::study::{Light, NotFound};
use crate::worker::Subject;
use crate::world::World;
use serde_json::{Value, json};
use std::io::Write;

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    run: RunOptions,
    /// How light is computed: radiosity or photon-map [default: radiosity, or with --error, or --time, what suits it best]
    #[arg(long, value_name = "METHOD", value_parser = parse::<LightMethod>)]
    method: Option<LightMethod>,
    /// Choose the method and its settings: the cheapest whose error is at most this share of the mean irradiance. With --time
    /// instead, and no --method, the most accurate within this time in all; with both, the same, but no longer than the error
    /// takes
    #[arg(long, value_name = "PERCENT", conflicts_with_all = ["steps", "converge"], value_parser = values::percent)]
    error: Option<f64>,
    #[command(flatten)]
    photons: PhotonOptions,
    /// Measure how far the light is off at points spread over all surfaces, against a path-traced reference that is kept
    /// for the next time
    #[arg(long)]
    accuracy: bool,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

pub fn run(options: &Options) -> Result<(), CliError> {
    let way = options.method.map(|method| format!("--method {}", method.name()));
    let (report, text) = match CommandBudget::of(&options.run, options.error, way.as_deref()) {
        Some(budget) => {
            if let Some(option) = options.photons.given() {
                refuse(&format!("{option} says how light is computed: --method photon-map goes with it"));
            }
            match solve_within(&budget, &options.run) {
                Err(CliError::NotFound(reason @ (NotFound::Unlit | NotFound::DarkPoints))) => {
                    eprintln!("warning: {reason}; solved by radiosity, without an error");
                    solve_by(options)?
                }
                result => result?,
            }
        }
        None => solve_by(options)?,
    };
    let mut out = std::io::stdout().lock();
    if options.json {
        writeln!(out, "{report}")?;
    } else {
        write!(out, "{text}")?;
    }
    Ok(())
}

/// By the method and the settings that a budget leads to.
fn solve_within(budget: &CommandBudget, run: &RunOptions) -> Result<(Value, String), CliError> {
    let found = light_for(budget, run)?;
    let (mut told, mut words) = match &found.light {
        Light::Radiosity(world, solution) => {
            let solved = Solved { world: world.clone(), settings: found.settings, solution: Solution::clone(solution) };
            (report(&solved), text(&solved))
        }
        Light::Photons(world, photons) => (photon_report(world, &found.settings, photons), photon_text(world, photons)),
    };
    found.account.add_to(&mut told);
    words += &found.account.text();
    Ok((told, words))
}

/// By the method that is asked for.
fn solve_by(options: &Options) -> Result<(Value, String), CliError> {
    let method = options.method.unwrap_or_default();
    check_method(method, &options.run, &options.photons);
    let world = options.run.open()?;
    let mut judge = options.accuracy.then(|| Judge::new(world.clone()));
    let (mut report, mut text, found) = match method {
        LightMethod::Radiosity => {
            let solved = options.run.solve_in(world, options.run.settings())?;
            let found = judge.as_ref().map(|judge| judge.found_by_radiosity(&solved));
            (report(&solved), text(&solved), found)
        }
        LightMethod::PhotonMap => {
            let settings = Settings { photons: options.photons.settings(), ..options.run.settings() };
            let mut tracing = Tracing::new(world, settings, options.run.time());
            let (photons, found) = match &judge {
                Some(judge) => judge.found_by_photons(&mut tracing).map(|(photons, found)| (photons, Some(found)))?,
                None => (tracing.trace(|_| ())?, None),
            };
            (photon_report(&tracing.world, &settings, &photons), photon_text(&tracing.world, &photons), found)
        }
    };
    if let (Some(judge), Some(found)) = (&mut judge, &found) {
        let verdict = judge.verdict(found);
        report["accuracy"] = verdict.json();
        text += &verdict.text();
    }
    Ok((report, text))
}

/// Ends the program, as any other wrong command line does, where an option is about another method.
pub fn check_method(method: LightMethod, run: &RunOptions, photons: &PhotonOptions) {
    let stranger = match method {
        LightMethod::Radiosity => photons.given(),
        LightMethod::PhotonMap => run.stop_of_radiosity().or(run.light_rays.map(|_| "--light-rays")),
    };
    if let Some(option) = stranger {
        refuse(&format!("{option} is not for --method {}", method.name()));
    }
    let subject = match method {
        LightMethod::Radiosity => Subject::Radiosity,
        LightMethod::PhotonMap => Subject::Photons,
    };
    let name = format!("--method {}", method.name());
    let objection = run.effects.objection(subject, &run.settings(), &name);
    if let Some(objection) = run.objection_by_radiosity().or(objection) {
        refuse(&objection);
    }
}

/// Energies are in W, summed over red, green and blue.
pub fn report(solved: &Solved) -> Value {
    let Solved { world, settings, solution } = solved;
    let energy = &solution.energy;
    let mut report = json!({
        "scene": world.scene.name,
        "method": "radiosity",
        "solver": settings.solver,
        "form_factor": settings.form_factor,
        "steps": solution.steps,
        "seconds": solution.elapsed.as_secs_f64(),
        "patches": world.mesh.patches.len(),
        "elements": world.mesh.elements.len(),
        "converged": solution.converged,
        "energy": {
            "emitted": total(energy.emitted),
            "absorbed": total(energy.absorbed),
            "unshot": total(energy.unshot),
            "escaped": total(energy.escaped),
            "defect": total(energy.defect()),
        },
        "closure": solution.closure,
        "counters": solution.counters,
    });
    effect_options::report(&mut report, Subject::Radiosity, world, settings, &solution.counters.bill);
    report
}

/// A line of the ledger, with its share of what was emitted.
fn row(name: &str, watts: f64, emitted: f64) -> String {
    let share = if emitted > 0.0 { 100.0 * watts / emitted } else { 0.0 };
    let watts =
        if (1e-3..1e7).contains(&watts) || watts == 0.0 { format!("{watts:.6}") } else { format!("{watts:.6e}") };
    format!("  {name:<10} {watts:>14} W {share:>9.4} %\n")
}

fn defect_row(watts: f64) -> String {
    format!("  {:<10} {watts:>14.1e} W\n", "defect")
}

fn photon_text(world: &World, photons: &PhotonSolution) -> String {
    let PhotonSolution { energy, counters, .. } = photons;
    let emitted = total(energy.emitted);
    let mut text = format!(
        "{}: photon map, {} passes in {:.3} s, {}\n",
        world.scene.name,
        photons.passes,
        photons.elapsed.as_secs_f64(),
        if photons.is_complete { "complete" } else { "not complete" },
    );
    text += &row("emitted", emitted, emitted);
    text += &row("absorbed", total(energy.absorbed), emitted);
    text += &row("escaped", total(energy.escaped), emitted);
    text += &row("truncated", total(energy.truncated), emitted);
    text += &defect_row(total(energy.defect()));
    if let Some(warning) = photons.warning() {
        text += &format!("  warning: {warning}\n");
    }
    text += &format!("  photons of the last pass: {} emitted, {} landings stored", counters.emitted, counters.stored);
    if counters.caustic_emitted > 0 {
        let (emitted, stored) = (counters.caustic_emitted, counters.caustic_stored);
        text += &format!("; for caustics {emitted} emitted, {stored} stored");
    }
    text += &format!("; {} rays\n  landings by path:", counters.rays);
    for (path, count) in &counters.by_path {
        text += &format!(" {path} {count}");
    }
    text + "\n"
}

fn text(solved: &Solved) -> String {
    let Solved { world, settings, solution } = solved;
    let energy = &solution.energy;
    let emitted = total(energy.emitted);
    let mut text = format!(
        "{}: {} patches, {} elements\nradiosity, {}, form factors by {}: {} {}s in {:.3} s, {} rays, {}\n",
        world.scene.name,
        world.mesh.patches.len(),
        world.mesh.elements.len(),
        settings.solver.name(),
        settings.form_factor.name(),
        solution.steps,
        settings.solver.step_name(),
        solution.elapsed.as_secs_f64(),
        solution.counters.rays,
        if solution.converged { "converged" } else { "not converged" },
    );
    text += &row("emitted", emitted, emitted);
    text += &row("absorbed", total(energy.absorbed), emitted);
    text += &row("unshot", total(energy.unshot), emitted);
    text += &row("escaped", total(energy.escaped), emitted);
    text += &defect_row(total(energy.defect()));
    text += &format!(
        "  closure of form factors: mean {:.2e}, worst {:.2e}\n",
        solution.closure.mean, solution.closure.worst
    );
    if solution.counters.clamped > 0 {
        text += &format!("  form factors above 1, cut down: {}\n", solution.counters.clamped);
    }
    if solution.counters.near_field > 0 {
        text += &format!("  pairs too near for a hemicube: {}\n", solution.counters.near_field);
    }
    text
}
