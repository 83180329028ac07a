//! Budgets: an error that is wanted, a time that is allowed, or both; and how what came of them is told.

use super::quality::{QualityReport, TargetMet, TargetsMet, error_json};
use super::refuse;
use super::run_options::RunOptions;
use crate::accuracy::Error;
use crate::study::{Budget, Prediction, Recipe};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// What is asked of a command.
#[derive(Clone, Copy, Debug)]
pub struct CommandBudget {
    /// As a share of the mean light.
    pub error: Option<f64>,
    /// From the start of the program.
    time: Option<Duration>,
    start: Instant,
}

impl CommandBudget {
    /// Of a command; `None` where there is none, or `way`, an option, says how light is computed, and time limits it. An error is
    /// in percent. Ends the program, as any other wrong command line does, where options say how light is computed although that
    /// is to be chosen.
    pub fn of(run: &RunOptions, error: Option<f64>, way: Option<&str>) -> Option<Self> {
        let time = run.time();
        if let (Some(way), Some(_)) = (way, error) {
            refuse(&format!("{way} cannot be combined with --error, which chooses how light is computed"));
        }
        let is_chosen = way.is_none() && (error.is_some() || time.is_some());
        if is_chosen && !run.is_plain() {
            Self::refuse_choices();
        }
        is_chosen.then(|| Self { error: error.map(|percent| percent / 100.0), time, start: Instant::now() })
    }

    /// Ends the program because of options that say how light is computed.
    pub fn refuse_choices() -> ! {
        refuse(
            "--error, and --time without more, choose how light is computed: options that say how cannot be combined with them",
        )
    }

    /// When a search must be over that leaves so much time for what comes after it; `None` where there is no limit, or none that
    /// a clock could tell.
    pub fn end(&self, for_the_rest: Duration) -> Option<Instant> {
        self.time.and_then(|time| self.start.checked_add(time)?.checked_sub(for_the_rest))
    }

    /// What is asked of the search.
    pub fn of_search(&self, for_the_rest: Duration) -> Budget {
        Budget { error: self.error, end: self.end(for_the_rest) }
    }
}

/// What a budget has led to.
#[derive(Clone)]
pub struct BudgetOutcome {
    pub budget: CommandBudget,
    /// How the light was computed.
    pub recipe: Recipe,
    /// The options of the same command that do it again.
    pub options: String,
    pub error: Error,
    /// Of the solver, and of the picture if there is one.
    pub solver_seconds: f64,
    pub prediction: Prediction,
}

impl BudgetOutcome {
    /// From the start of the program until now.
    fn seconds(&self) -> f64 {
        self.budget.start.elapsed().as_secs_f64()
    }

    /// Whether the error and the time are as they were wanted, after so many seconds.
    fn targets(&self, seconds: f64) -> TargetsMet {
        TargetsMet {
            error: self.budget.error.map(|wanted| TargetMet::of_error(wanted, &self.error)),
            time: self.budget.time.map(|allowed| TargetMet::of_time(allowed, seconds)),
        }
    }

    /// Errors are shares of the mean light. Where only one of error and time was asked for, the other is what was expected when
    /// the method was chosen, if that was anything.
    pub fn add_to(&self, report: &mut Value) {
        let seconds = self.seconds();
        let wanted_seconds = self.budget.time.map(|time| time.as_secs_f64());
        report["promised"] = json!({
            "error": self.budget.error.or(self.prediction.error),
            "seconds": wanted_seconds.or(self.prediction.seconds),
        });
        report["achieved"] = json!({
            "seconds": if wanted_seconds.is_some() { seconds } else { self.solver_seconds },
            "solver_seconds": self.solver_seconds,
        });
        for (name, value) in error_json(&self.error) {
            report["achieved"][name] = value;
        }
        let mut chosen = json!({ "method": self.recipe.way, "options": self.options });
        for (knob, setting) in self.recipe.knobs() {
            chosen["settings"][knob.option().trim_start_matches("--")] = json!(setting);
        }
        report["chosen"] = chosen;
        report["kept"] = self.targets(seconds).json();
    }

    /// What was wanted, what came of it, and whether that is as it should be, line by line.
    pub fn text(&self) -> String {
        let seconds = self.seconds();
        let quality = self.quality();
        let kept = self.targets(seconds).in_words();
        let (promised, achieved) = (quality.promised(), quality.achieved());
        let chosen = &self.options;
        format!("  promised: {promised}\n  achieved: {achieved}, {seconds:.2} s in all: {kept}\n  chosen: {chosen}\n")
    }

    /// The same for a picture, as it stands before that is written.
    pub fn quality(&self) -> QualityReport {
        QualityReport {
            error_wanted: self.budget.error,
            error_foreseen: self.prediction.error,
            time_allowed: self.budget.time,
            error: self.error,
            seconds: self.solver_seconds,
            targets: Some(self.targets(self.seconds())),
            options: Some(self.options.clone()),
        }
    }
}
