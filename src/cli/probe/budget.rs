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
use crate::math::rgb::Rgb;
use crate::methods::path_trace::Sensors;
use crate::study::{Promise, Recipe, Way};
use crate::world::World;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What is kept of the time allowed for telling what was found about a million points.
const FOR_TELLING: Duration = Duration::from_secs(2);
/// When paths towards an error are given up.
const LONGEST: Duration = Duration::from_secs(300);

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
    let mut promise = Promise { error: None, seconds: None };
    loop {
        let before = start.elapsed();
        meters.step(1, &Cancel::default());
        let Some(error) = error_of(&meters) else { return Err(CliError::NothingFound) };
        let elapsed = start.elapsed();
        if promise.error.is_none() {
            promise =
                foresee(budget, &error, elapsed.as_secs_f64(), end.saturating_duration_since(start).as_secs_f64());
        }
        let is_met = budget.error.is_some_and(|wanted| error.rms + error.uncertainty <= wanted);
        let last = elapsed.saturating_sub(before);
        if is_met || Instant::now() + last > end {
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

/// The standard error of all points and channels, as a share of their mean; `None` without light.
fn error_of(meters: &Sensors) -> Option<Error> {
    let estimates = meters.irradiance();
    let nothing = vec![Rgb::ZERO; estimates.len()];
    let floor = Error::of(&nothing, &estimates)?.floor;
    // Of a standard deviation by so many independent estimates of each point.
    let uncertainty = floor / (2.0 * (Sensors::REPLICATES - 1) as f64 * estimates.len() as f64).sqrt();
    Some(Error { rms: floor, uncertainty, floor, noise: Some(floor) })
}

/// What the first paths let one expect: errors fall with the root of the time.
fn foresee(budget: &Budget, first: &Error, seconds: f64, allowed: f64) -> Promise {
    match budget.error {
        Some(wanted) => Promise { error: Some(wanted), seconds: Some(seconds * (first.rms / wanted).powi(2).max(1.0)) },
        None => Promise { error: Some(first.rms * (seconds / allowed).sqrt()), seconds: Some(allowed) },
    }
}
