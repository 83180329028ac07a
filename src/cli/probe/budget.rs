//! Irradiance at points for a budget. Paths are the one method whose error can be told without the truth about the points; to know
//! that for another one takes longer than to trace the paths.

use super::measured::Measured;
use super::methods::{read, sensors};
use super::{MOST_POINTS, Options};
use crate::accuracy::{Error, ProbePoint};
use crate::cancel::Cancel;
use crate::choice::Choice;
use crate::cli::CliError;
use crate::cli::budget::{BudgetOutcome, CommandBudget};
use crate::cli::progress_line::ProgressLine;
use crate::study::{NotFound, Prediction, Recipe, SearchProgress, Way};
use crate::world::World;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What is kept of the time allowed for telling what was found about a million points.
const FOR_TELLING: Duration = Duration::from_secs(2);
/// When paths towards an error are given up.
const LONGEST: Duration = Duration::from_secs(300);
/// Paths from each point before their scatter is believed: light that few of them meet may not have been met at all before.
const LEAST_PATHS: u64 = 256;
/// Paths from each point none of which has met light where there is none.
const DARK: u64 = 4096;

impl Options {
    /// What is asked for instead of a method, if anything is. Ends the program, as any other wrong command line does, where
    /// options say how light is computed all the same.
    pub(super) fn budget(&self) -> Option<CommandBudget> {
        let method = self.method.map(|method| format!("--method {}", method.name()));
        let budget = CommandBudget::of(&self.run, self.error, method.as_deref())?;
        let says_how = self.samples.is_some()
            || self.gather_rays.is_some()
            || self.photons.given().is_some()
            || self.occlusion.given().is_some()
            || self.accuracy;
        if says_how {
            CommandBudget::refuse_choices();
        }
        Some(budget)
    }
}

/// As many paths from each point as lead to the error, or as there is time for.
pub fn measure(
    budget: &CommandBudget,
    options: &Options,
    world: Arc<World>,
    points: &[ProbePoint],
) -> Result<(Vec<Measured>, BudgetOutcome), CliError> {
    let start = Instant::now();
    let settings = options.run.settings();
    let dark = NotFound::without_light(&world);
    let mut meters = sensors(&settings, world, points);
    let for_telling = FOR_TELLING.mul_f64(points.len() as f64 / f64::from(MOST_POINTS));
    let end = budget.end(for_telling).unwrap_or(start + LONGEST);
    let mut prediction = None;
    let mut progress = ProgressLine::new();
    loop {
        let before = start.elapsed();
        meters.step(1, &Cancel::default());
        let elapsed = start.elapsed();
        let error = Error::of_noise(&meters.irradiance());
        if let (None, Some(error)) = (&prediction, &error) {
            let allowed = end.saturating_duration_since(start).as_secs_f64();
            prediction = Some(foresee(budget, error, elapsed.as_secs_f64(), allowed));
        }
        let doing = format!("tracing {} paths from each point", meters.paths());
        progress.tell(&SearchProgress { doing, best: error.map(|error| error.in_words()) });
        let is_enough = |wanted| error.is_some_and(|error| error.rms + error.uncertainty <= wanted);
        let is_met = meters.paths() >= LEAST_PATHS && budget.error.is_some_and(is_enough);
        let is_dark = error.is_none() && meters.paths() >= DARK;
        let last = elapsed.saturating_sub(before);
        if is_met || is_dark || Instant::now() + last > end {
            let (Some(error), Some(prediction)) = (error, prediction) else {
                return Err(if is_dark { dark } else { NotFound::NoTime }.into());
            };
            let mut recipe = Recipe { way: Way::Reference, settings };
            recipe.settings.image.samples = u32::try_from(meters.paths()).unwrap_or(u32::MAX);
            let account = BudgetOutcome {
                budget: *budget,
                recipe,
                options: recipe.options(),
                error,
                solver_seconds: elapsed.as_secs_f64(),
                prediction,
            };
            return Ok((read(&meters, points), account));
        }
    }
}

/// What the first paths let one expect: errors fall with the root of the time.
fn foresee(budget: &CommandBudget, first: &Error, seconds: f64, allowed: f64) -> Prediction {
    match budget.error {
        Some(wanted) => {
            Prediction { error: Some(wanted), seconds: Some(seconds * (first.rms / wanted).powi(2).max(1.0)) }
        }
        None => Prediction { error: Some(first.rms * (seconds / allowed).sqrt()), seconds: Some(allowed) },
    }
}
