//! `lightwell solve`: where the light went.

use super::CliError;
use super::run_options::{RunOptions, Solved};
use crate::choice::Choice;
use crate::math::rgb::total;
use serde_json::{Value, json};
use std::io::Write;

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    run: RunOptions,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

pub fn run(options: &Options) -> Result<(), CliError> {
    let solved = options.run.solve()?;
    let mut out = std::io::stdout().lock();
    if options.json {
        writeln!(out, "{}", report(&solved))?;
    } else {
        write!(out, "{}", text(&solved))?;
    }
    Ok(())
}

/// Energies are in W, summed over red, green and blue.
pub fn report(solved: &Solved) -> Value {
    let Solved { world, settings, solution } = solved;
    let energy = &solution.energy;
    json!({
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
    })
}

fn text(solved: &Solved) -> String {
    let Solved { world, settings, solution } = solved;
    let energy = &solution.energy;
    let emitted = total(energy.emitted);
    let row = |name: &str, watts: f64| {
        let share = if emitted > 0.0 { 100.0 * watts / emitted } else { 0.0 };
        let watts =
            if (1e-3..1e7).contains(&watts) || watts == 0.0 { format!("{watts:.6}") } else { format!("{watts:.6e}") };
        format!("  {name:<10} {watts:>14} W {share:>9.4} %\n")
    };
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
    text += &row("emitted", emitted);
    text += &row("absorbed", total(energy.absorbed));
    text += &row("unshot", total(energy.unshot));
    text += &row("escaped", total(energy.escaped));
    text += &format!("  {:<10} {:>14.1e} W\n", "defect", total(energy.defect()));
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
