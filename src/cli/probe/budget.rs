//! Irradiance at points for a budget. Paths are the one method whose error can be told without the truth about the points; to know
//! that for another one takes longer than to trace the paths.

use super::measured::Measured;
use super::methods::{read, sensors};
use super::{MOST_POINTS, Options};
use crate::accuracy::{Error, ProbePoint};
use crate::cancel::Cancel;
use crate::choice::Choice;
use crate::cli::CliError;
use crate::cli::budget::{Account, Budget};
use crate::study::{NotFound, Promise, Recipe, Way};
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
    pub(super) fn budget(&self) -> Option<Budget> {
        let method = self.method.map(|method| format!("--method {}", method.name()));
        let budget = Budget::of(&self.run, self.error, method.as_deref())?;
        let says_how = self.samples.is_some()
            || self.gather_rays.is_some()
            || self.photons.given().is_some()
            || self.occlusion.given().is_some()
            || self.accuracy;
        if says_how {
            Budget::refuse_choices();
        }
        Some(budget)
    }
}

/// As many paths from each point as lead to the error, or as there is time for.
pub fn measure(
    budget: &Budget,
    options: &Options,
    world: Arc<World>,
    points: &[ProbePoint],
) -> Result<(Vec<Measured>, Account), CliError> {
    let start = Instant::now();
    let settings = options.run.settings();
    let mut meters = sensors(&settings, world, points);
    let for_telling = FOR_TELLING.mul_f64(points.len() as f64 / f64::from(MOST_POINTS));
    let end = budget.end(for_telling).unwrap_or(start + LONGEST);
    let mut promise = None;
    loop {
        let before = start.elapsed();
        meters.step(1, &Cancel::default());
        let elapsed = start.elapsed();
        let error = Error::of_noise(&meters.irradiance());
        if let (None, Some(error)) = (&promise, &error) {
            let allowed = end.saturating_duration_since(start).as_secs_f64();
            promise = Some(foresee(budget, error, elapsed.as_secs_f64(), allowed));
        }
        let is_enough = |wanted| error.is_some_and(|error| error.rms + error.uncertainty <= wanted);
        let is_met = meters.paths() >= LEAST_PATHS && budget.error.is_some_and(is_enough);
        let is_dark = error.is_none() && meters.paths() >= DARK;
        let last = elapsed.saturating_sub(before);
        if is_met || is_dark || Instant::now() + last > end {
            let (Some(error), Some(promise)) = (error, promise) else {
                return Err(if is_dark { NotFound::Dark } else { NotFound::NoTime }.into());
            };
            let mut recipe = Recipe { way: Way::Reference, settings };
            recipe.settings.image.samples = u32::try_from(meters.paths()).unwrap_or(u32::MAX);
            let account = Account {
                budget: *budget,
                recipe,
                options: recipe.options(),
                error,
                solver_seconds: elapsed.as_secs_f64(),
                promise,
            };
            return Ok((read(&meters, points), account));
        }
    }
}

/// What the first paths let one expect: errors fall with the root of the time.
fn foresee(budget: &Budget, first: &Error, seconds: f64, allowed: f64) -> Promise {
    match budget.error {
        Some(wanted) => Promise { error: Some(wanted), seconds: Some(seconds * (first.rms / wanted).powi(2).max(1.0)) },
        None => Promise { error: Some(first.rms * (seconds / allowed).sqrt()), seconds: Some(allowed) },
    }
}
