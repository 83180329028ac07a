//! How far light is off: what a method found, held against the truth.

use super::CliError;
use super::quality::{error_json, percent};
use super::run_options::Solved;
use super::tracing::Tracing;
use crate::accuracy::{Cache, Error, Found, ProbePoint, Reference, by_photons, by_radiosity};
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::methods::photon_map::{ProgressivePoints, Which};
use crate::solution::PhotonSolution;
use crate::world::World;
use serde_json::{Value, json};
use std::sync::Arc;

/// Paths from a point after which the truth has to do, however small the error.
const MOST_PATHS: u64 = 1 << 16;

/// The truth about a scene, as good as it must be.
pub struct Judge {
    reference: Reference,
    cache: Option<Cache>,
}

/// An error and what it was measured by.
pub struct Verdict {
    /// `None` without light.
    pub error: Option<Error>,
    points: usize,
    paths: u64,
}

impl Judge {
    pub fn new(world: Arc<World>) -> Self {
        let cache = Cache::of_user();
        Self { reference: Reference::open(world, cache.as_ref()), cache }
    }

    /// Where errors are measured.
    pub fn points(&self) -> &[ProbePoint] {
        self.reference.points()
    }

    pub fn found_by_radiosity(&self, solved: &Solved) -> Found {
        by_radiosity(&solved.world, &solved.solution, self.reference.points(), solved.settings.seed)
    }

    /// Traces the photons of all passes.
    pub fn found_by_photons(&self, tracing: &mut Tracing) -> Result<(PhotonSolution, Found), CliError> {
        let points = self.reference.points();
        if tracing.settings.photons.is_progressive {
            let mut means = ProgressivePoints::new(tracing.photons()?.method().surfaces(points));
            let solution = tracing.trace(|photons| means.add(&photons.method().maps(), Which::All))?;
            return Ok((solution, Found::of_samples(means.irradiance())));
        }
        let solution = tracing.trace(|_| ())?;
        Ok((solution, by_photons(&tracing.photons()?.method().maps(), points)))
    }

    /// Refines the truth until its own error is a quarter of what it is to measure, and keeps it for the next time.
    pub fn verdict(&mut self, found: &Found) -> Verdict {
        let before = self.reference.truth().paths;
        let error = loop {
            let truth = self.reference.truth();
            let error = truth.error(found);
            let is_enough = error.is_some_and(|error| truth.is_enough_for(&error));
            if is_enough || truth.is_dark() || truth.paths >= MOST_PATHS || !self.reference.refine(&Cancel::default()) {
                break error;
            }
        };
        let paths = self.reference.truth().paths;
        if let Some(cache) = self.cache.as_ref().filter(|_| paths > before)
            && let Err(error) = self.reference.keep(cache)
        {
            eprintln!("warning: {}", with_causes(&error));
        }
        Verdict { error, points: found.irradiance.len(), paths }
    }
}

impl Verdict {
    /// Errors are shares of the mean irradiance.
    pub fn json(&self) -> Value {
        let error = self.error.as_ref();
        let mut report = json!({
            "error": null,
            "error_uncertainty": null,
            "error_below_percent": null,
            "noise": error.and_then(|error| error.noise),
            "bias": error.and_then(Error::bias),
            "floor": error.map(|error| error.floor),
            "points": self.points,
            "paths": self.paths,
        });
        for (name, value) in error.map(error_json).into_iter().flatten() {
            report[name] = value;
        }
        report
    }

    pub fn text(&self) -> String {
        let Some(error) = &self.error else {
            return "  error: there is no light to compare\n".to_owned();
        };
        format!(
            "  error {} of the mean irradiance at {} points (reference: {} paths each, {})\n",
            error.in_words(),
            self.points,
            self.paths,
            percent(error.floor),
        )
    }
}
