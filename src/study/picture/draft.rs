//! A way to make a picture, tried at some of its pixels.

use super::PictureGoal;
use crate::accuracy::{Error, Parts, PixelTruth};
use crate::cancel::Cancel;
use crate::math::random::hash;
use crate::methods::image::Pixels;
use crate::methods::{ImageSettings, Settings};
use crate::study::attempt::CannotTry;
use crate::study::lit::{Lit, light_of};
use crate::study::recipe::{Recipe, Way};
use crate::study::worlds::Worlds;
use std::fmt;
use std::time::Instant;

/// Light, and what the pixels have shown so far.
pub struct Draft {
    pub recipe: Recipe,
    pub lit: Lit,
    /// Of the solver.
    pub light_seconds: f64,
    /// As they are in the picture.
    pixels: Pixels,
    /// The same with other random numbers: what both are off by is bias.
    others: Pixels,
    /// For all samples of the pixels so far, without the others.
    pixel_seconds: f64,
    /// So many pixels of the picture stand behind each of these.
    scale: f64,
    /// Samples and the error after them; each time twice as many.
    errors: Vec<(u32, Error)>,
    /// The squares of the bias and of the noise of one sample.
    parts: Parts,
}

impl Draft {
    /// Finds the light of the recipe, before the first sample; `None` if there is not enough time.
    ///
    /// # Errors
    /// If the scene cannot be cut so finely, or there is not enough memory.
    pub fn begin(
        worlds: &mut Worlds,
        recipe: &Recipe,
        goal: &PictureGoal,
        truth: &PixelTruth,
        end: Instant,
        cancel: &Cancel,
    ) -> Result<Option<Self>, CannotTry> {
        let view = recipe.way.picture();
        let world = if view.needs_radiosity() {
            worlds.remeshed(&recipe.settings.mesh, cancel)?
        } else {
            worlds.first().clone()
        };
        let start = Instant::now();
        let Some(lit) = light_of(&world, view, &recipe.settings, end, cancel)? else { return Ok(None) };
        let light_seconds = start.elapsed().as_secs_f64();
        let places = truth.places();
        let scale = goal.size.map(f64::from).iter().product::<f64>() / places.len().max(1) as f64;
        let pixels = |seed| {
            let settings = Settings { seed, ..recipe.settings };
            Pixels::new(&lit.sources, view, goal.camera, goal.size, places.clone(), &settings)
        };
        let seed = recipe.settings.seed;
        let both = pixels(seed).zip(pixels(hash(seed, 1, 0)));
        Ok(both.map(|(pixels, others)| Self {
            recipe: *recipe,
            lit,
            light_seconds,
            pixels,
            others,
            pixel_seconds: 0.0,
            scale,
            errors: Vec::new(),
            parts: Parts::default(),
        }))
    }

    /// Takes so many samples, or as many as that much time allows, but two at least.
    pub fn look(&mut self, truth: &PixelTruth, samples: u32, seconds: f64, cancel: &Cancel) {
        let start = Instant::now();
        let has_time = |draft: &Self| draft.samples() < 2 || start.elapsed().as_secs_f64() < seconds;
        while self.samples() < samples && has_time(self) && self.step(cancel) && self.others.step(cancel) {
            if self.samples().is_power_of_two() {
                self.measure(truth);
            }
        }
        let count = f64::from(self.samples());
        let parts = truth.parts(&self.pixels.radiance(), &self.others.radiance()).unwrap_or_default();
        // Path tracing has no bias.
        let bias = if self.recipe.way == Way::Reference { 0.0 } else { parts.bias.max(0.0) };
        self.parts = Parts { bias, noise: count * parts.noise };
    }

    /// After how many samples the error is surely as small, taking them if they were not taken yet; `None` where that takes
    /// longer than is allowed for the whole picture.
    pub fn expose_until(
        &mut self,
        truth: &mut PixelTruth,
        wanted: f64,
        limit: f64,
        end: Instant,
        cancel: &Cancel,
    ) -> Option<u32> {
        let early = self.errors.iter().find(|(_, error)| error.rms + error.uncertainty <= wanted);
        if let Some((samples, _)) = early {
            return Some(*samples);
        }
        let mut next = self.samples();
        loop {
            if self.samples() >= next {
                let error = truth.error(&self.pixels.radiance())?;
                if error.rms + error.uncertainty <= wanted {
                    self.measure(truth);
                    return Some(self.samples());
                }
                // A sixteenth more each time.
                next = self.samples() + self.samples().div_ceil(16);
                // While that may be due to the truth alone.
                if error.uncertainty > wanted / 10.0 && !truth.refine(cancel) {
                    return None;
                }
            }
            let is_too_long = self.seconds_a_sample() * f64::from(self.samples()) > limit;
            let is_over = is_too_long || Instant::now() >= end || self.samples() >= ImageSettings::MAX_SAMPLES;
            if is_over || !self.step(cancel) {
                self.measure(truth);
                return None;
            }
        }
    }

    fn step(&mut self, cancel: &Cancel) -> bool {
        let start = Instant::now();
        let is_done = self.pixels.step(cancel);
        self.pixel_seconds += start.elapsed().as_secs_f64();
        is_done
    }

    fn measure(&mut self, truth: &PixelTruth) {
        if let Some(error) = truth.error(&self.pixels.radiance()) {
            self.errors.push((self.samples(), error));
        }
    }

    pub fn samples(&self) -> u32 {
        self.pixels.samples()
    }

    /// The error after all samples so far.
    pub fn last_error(&self) -> f64 {
        self.errors.last().map_or(f64::MAX, |(_, error)| error.rms)
    }

    /// For a sample of every pixel of the picture.
    fn seconds_a_sample(&self) -> f64 {
        self.scale * self.pixel_seconds / f64::from(self.samples().max(1))
    }

    /// The error that more samples would not take away.
    pub fn bias(&self) -> f64 {
        self.parts.bias.sqrt()
    }

    /// The error of a picture that may take so long, with light whose bias is `share` of its own. Noise of well-spread samples
    /// falls a little faster.
    pub fn error_in(&self, seconds: f64, share: f64) -> f64 {
        let samples = (seconds / self.seconds_a_sample()).floor().max(1.0);
        (share * share * self.parts.bias + self.parts.noise / samples).sqrt()
    }

    /// How long a picture of this error takes, with light whose bias is `share` of its own; `None` where that alone is larger.
    pub fn seconds_to(&self, error: f64, share: f64) -> Option<f64> {
        let noise_left = error * error - share * share * self.parts.bias;
        (noise_left > 0.0).then(|| self.seconds_a_sample() * (self.parts.noise / noise_left).ceil().max(1.0))
    }
}

impl fmt::Display for Draft {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "light in {:.2} s, {:.4} s a sample, bias {:.4}, noise {:.4}: {}",
            self.light_seconds,
            self.seconds_a_sample(),
            self.bias(),
            self.parts.noise.sqrt(),
            self.recipe.options(),
        )
    }
}
