//! A way to make a picture, tried at some of its pixels.

use super::PictureRequest;
use super::forecast::Forecast;
use crate::accuracy::PixelTruth;
use crate::cancel::Cancel;
use crate::methods::image::Pixels;
use crate::study::attempt::CannotTry;
use crate::study::lit::{Lit, light_of};
use crate::study::recipe::Recipe;
use crate::study::worlds::Worlds;
use crate::world::WorldError;
use std::time::Instant;

/// Light, and what the pixels have shown so far: as often as the truth has estimates, by the same random numbers.
pub struct PilotRender {
    pub recipe: Recipe,
    pub lit: Lit,
    /// Of the solver.
    pub light_seconds: f64,
    replicates: Vec<Pixels>,
    /// For all samples so far.
    sampling_seconds: f64,
}

impl PilotRender {
    /// Finds the light of the recipe, before the first sample; `None` if there is not enough time.
    ///
    /// # Errors
    /// If the scene cannot be cut so finely, or there is not enough memory.
    pub fn begin(
        worlds: &mut Worlds,
        recipe: &Recipe,
        request: &PictureRequest,
        truth: &PixelTruth,
        end: Instant,
        cancel: &Cancel,
    ) -> Result<Option<Self>, CannotTry> {
        let cancel = cancel.with_deadline(end);
        let (view, start) = (recipe.way.picture(), Instant::now());
        let world = if view.needs_radiosity() {
            match worlds.remeshed(&recipe.settings.mesh, &cancel) {
                Ok(world) => world,
                Err(WorldError::Cancelled) => return Ok(None),
                Err(reason) => return Err(reason.into()),
            }
        } else {
            worlds.first().clone()
        };
        let Some(lit) = light_of(&world, view, &recipe.settings, end, &cancel)? else { return Ok(None) };
        let (places, settings) = (truth.places().clone(), &recipe.settings);
        let pixels = Pixels::new(&lit.sources, view, request.camera, request.size, places, settings);
        let light_seconds = start.elapsed().as_secs_f64();
        Ok(pixels.map(|pixels| Self {
            recipe: *recipe,
            lit,
            light_seconds,
            replicates: truth.seeds().map(|seed| pixels.reseeded(seed)).collect(),
            sampling_seconds: 0.0,
        }))
    }

    /// Takes samples until there are so many of each pixel in each replicate, and holds them against the truth, which has at
    /// least as many. `scale` pixels of the picture stand behind each of these. `None` if stopped, or where there is no light.
    pub fn sample(&mut self, truth: &PixelTruth, samples: u32, scale: f64, cancel: &Cancel) -> Option<Forecast> {
        let start = Instant::now();
        for replicate in &mut self.replicates {
            while replicate.samples() < samples {
                if !replicate.step(cancel) {
                    return None;
                }
            }
        }
        self.sampling_seconds += start.elapsed().as_secs_f64();
        let taken: u32 = self.replicates.iter().map(Pixels::samples).sum();
        let parts = truth.parts(&self.replicates)?;
        Some(Forecast { parts, sample_seconds: scale * self.sampling_seconds / f64::from(taken) })
    }
}
