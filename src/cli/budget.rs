//! Light for a budget: an error that is wanted, a time that is allowed, or both.

use super::run_options::RunOptions;
use super::{CliError, refuse};
use crate::accuracy::{Cache, Error};
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::methods::Settings;
use crate::study::{Bench, Goal, Light, Recipe, Sought, seek};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// What is kept of the time allowed for telling what was found.
const FOR_TELLING: Duration = Duration::from_millis(50);
/// Times are kept where they are within this share of what was allowed.
const TIME_TOLERANCE: f64 = 0.1;

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// As a share of the mean irradiance.
    error: Option<f64>,
    /// From the start of the program.
    time: Option<Duration>,
    start: Instant,
}

/// What a budget has led to.
pub struct Found {
    pub light: Light,
    pub settings: Settings,
    budget: Budget,
    recipe: Recipe,
    error: Error,
    solver_seconds: f64,
    expected: [Option<f64>; 2],
    /// From the start of the program.
    seconds: f64,
}

impl Budget {
    /// Of a command whose method is chosen; `None` where there is no budget, or one method is asked for and time limits it.
    /// Ends the program, as any other wrong command line does, where options say how light is computed although that is to be
    /// chosen.
    pub fn of(run: &RunOptions, error: Option<f64>, method: Option<&str>) -> Option<Self> {
        let time = run.time();
        if let (Some(method), Some(_)) = (method, error) {
            refuse(&format!("--error chooses the method: --method {method} has no place with it"));
        }
        let is_chosen = method.is_none() && (error.is_some() || time.is_some());
        if is_chosen && !run.is_plain() {
            refuse(
                "--error, and --time without --method, choose how light is computed: options that say how have no place with \
                 them",
            );
        }
        is_chosen.then(|| Self { error, time, start: Instant::now() })
    }

    /// Looks for light that keeps to the budget, by what is known of the scene and what it finds out, which is kept.
    pub fn seek(&self, run: &RunOptions) -> Result<Found, CliError> {
        let world = run.open()?;
        let settings = Settings { unshot_limit: Settings::default().unshot_limit, ..run.settings() };
        let mut bench = Bench::open(world, settings.mesh, Cache::of_user());
        let end = self.time.and_then(|time| (self.start + time).checked_sub(FOR_TELLING));
        let sought = seek(&mut bench, &settings, &Goal { error: self.error, end }, &Cancel::default());
        if let Err(error) = bench.keep() {
            eprintln!("warning: {}", with_causes(&error));
        }
        let Sought { outcome, error, promise } = sought.ok_or(CliError::NothingFound)?;
        Ok(Found {
            light: outcome.light.ok_or(CliError::NothingFound)?,
            settings: outcome.recipe.settings,
            budget: *self,
            recipe: outcome.recipe,
            error,
            solver_seconds: outcome.price.seconds,
            expected: [promise.error, promise.seconds],
            seconds: self.start.elapsed().as_secs_f64(),
        })
    }
}

impl Found {
    /// Whether the error and the time are as they were wanted.
    fn is_kept(&self) -> bool {
        let is_near = |time: Duration| (self.seconds / time.as_secs_f64() - 1.0).abs() <= TIME_TOLERANCE;
        let is_in_time =
            |time: Duration| is_near(time) || self.budget.error.is_some() && self.seconds <= time.as_secs_f64();
        self.budget.error.is_none_or(|wanted| self.error.rms <= wanted) && self.budget.time.is_none_or(is_in_time)
    }

    /// Errors are shares of the mean irradiance. Where only one of error and time was asked for, the other is what was
    /// expected when the method was chosen, if that was anything.
    pub fn add_to(&self, report: &mut Value) {
        let [error, seconds] = self.expected;
        let wanted_seconds = self.budget.time.map(|time| time.as_secs_f64());
        report["promised"] = json!({ "error": self.budget.error.or(error), "seconds": wanted_seconds.or(seconds) });
        report["achieved"] = json!({
            "error": self.error.rms,
            "error_uncertainty": self.error.uncertainty,
            "seconds": if wanted_seconds.is_some() { self.seconds } else { self.solver_seconds },
            "solver_seconds": self.solver_seconds,
        });
        let mut chosen = json!({ "method": self.recipe.way, "options": self.recipe.options() });
        for (knob, setting) in self.recipe.knobs() {
            chosen["settings"][knob.option().trim_start_matches("--")] = json!(setting);
        }
        report["chosen"] = chosen;
        report["kept"] = json!(self.is_kept());
    }

    /// What was wanted, what came of it, and whether that is as it should be.
    pub fn text(&self) -> String {
        let percent = |share: f64| format!("{:.2} %", 100.0 * share);
        let wanted = [
            self.budget.error.map(|error| format!("an error of {}", percent(error))),
            self.budget.time.map(|time| format!("{:.2} s in all", time.as_secs_f64())),
        ];
        let wanted: Vec<String> = wanted.into_iter().flatten().collect();
        let kept = if self.is_kept() { "the promise was kept" } else { "THE PROMISE WAS NOT KEPT" };
        format!(
            "  promised: {}\n  achieved: an error of {} ± {} in {:.3} s of the solver, {:.2} s in all: {kept}\n  chosen: {}\n",
            wanted.join(", "),
            percent(self.error.rms),
            percent(self.error.uncertainty),
            self.solver_seconds,
            self.seconds,
            self.recipe.options(),
        )
    }
}
