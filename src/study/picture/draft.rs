//! A way to make a picture, tried at some of its pixels.

use super::PictureGoal;
use crate::accuracy::{Error, PixelTruth};
use crate::cancel::Cancel;
use crate::methods::ImageSettings;
use crate::methods::image::Pixels;
use crate::study::bench::Bench;
use crate::study::lit::{Lit, light_of};
use crate::study::recipe::{Recipe, Way};
use std::fmt;
use std::time::Instant;

/// Light, and what the pixels have shown so far.
pub struct Draft {
    pub recipe: Recipe,
    pub lit: Lit,
    /// From the cutting of the mesh on.
    pub light_seconds: f64,
    pixels: Pixels,
    /// For all samples of the pixels so far.
    pixel_seconds: f64,
    /// So many pixels of the picture stand behind each of these.
    scale: f64,
    /// Samples and the error after them; each time twice as many.
    errors: Vec<(u32, Error)>,
}

impl Draft {
    /// Finds the light of the recipe, before the first sample; `None` if there is not enough time or memory.
    pub fn begin(
        bench: &mut Bench,
        recipe: &Recipe,
        goal: &PictureGoal,
        truth: &PixelTruth,
        end: Instant,
        cancel: &Cancel,
    ) -> Option<Self> {
        let start = Instant::now();
        let view = recipe.way.picture();
        let opened = if view.needs_radiosity() {
            bench.remeshed(&recipe.settings.mesh, cancel)
        } else {
            Ok(bench.world().clone())
        };
        let lit = opened.map_err(|reason| log::info!("{}: {reason}", recipe.options())).ok()?;
        let lit = light_of(&lit, view, &recipe.settings, end, cancel);
        let lit = lit.map_err(|reason| log::info!("{}: {reason}", recipe.options())).ok()??;
        let places = truth.places().clone();
        let scale = goal.size.map(f64::from).iter().product::<f64>() / places.len().max(1) as f64;
        let pixels = Pixels::new(&lit.sources, view, goal.camera, goal.size, places, &recipe.settings)?;
        Some(Self {
            recipe: *recipe,
            lit,
            light_seconds: start.elapsed().as_secs_f64(),
            pixels,
            pixel_seconds: 0.0,
            scale,
            errors: Vec::new(),
        })
    }

    /// Takes so many samples, or as many as that much time allows, but two at least.
    pub fn look(&mut self, truth: &PixelTruth, samples: u32, seconds: f64, cancel: &Cancel) {
        while self.samples() < samples && (self.samples() < 2 || self.pixel_seconds < seconds) && self.step(cancel) {
            if self.samples().is_power_of_two() {
                self.measure(truth);
            }
        }
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

    /// The squares of the bias and of the noise of one sample: what the last error and an earlier one, of a quarter of the
    /// samples, come from. Path tracing has no bias.
    fn parts(&self) -> (f64, f64) {
        let Some((samples, Error { rms: last, .. })) = self.errors.last() else { return (f64::MAX, 0.0) };
        let all_noise = (0.0, last * last * f64::from(*samples));
        if self.recipe.way == Way::Reference {
            return all_noise;
        }
        let earlier = self.errors.iter().rev().find(|(before, _)| 4 * before <= *samples).or(self.errors.first());
        let Some((before, Error { rms: first, .. })) = earlier.filter(|(before, _)| before < samples) else {
            return all_noise;
        };
        let [samples, before] = [*samples, *before].map(f64::from);
        let noise = (first * first - last * last) / (1.0 / before - 1.0 / samples);
        let noise = noise.clamp(0.0, last * last * samples);
        (last * last - noise / samples, noise)
    }

    /// The error that more samples would not take away.
    pub fn bias(&self) -> f64 {
        self.parts().0.sqrt()
    }

    /// The error of a picture that may take so long.
    pub fn error_in(&self, seconds: f64) -> f64 {
        let samples = (seconds / self.seconds_a_sample()).max(1.0);
        let (bias, noise) = self.parts();
        (bias + noise / samples).sqrt()
    }

    /// The same with light whose bias is another share of its own.
    pub fn error_with(&self, share: f64, seconds: f64) -> f64 {
        let samples = (seconds / self.seconds_a_sample()).max(1.0);
        let (bias, noise) = self.parts();
        (share * share * bias + noise / samples).sqrt()
    }

    /// How long a picture of this error takes; `None` where its bias alone is larger.
    pub fn seconds_to(&self, error: f64) -> Option<f64> {
        let (bias, noise) = self.parts();
        let noise_left = error * error - bias;
        (noise_left > 0.0).then(|| self.seconds_a_sample() * (noise / noise_left).ceil().max(1.0))
    }
}

impl fmt::Display for Draft {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (bias, noise) = self.parts();
        write!(
            f,
            "light in {:.2} s, {:.4} s a sample, bias {:.4}, noise {:.4}: {}",
            self.light_seconds,
            self.seconds_a_sample(),
            bias.sqrt(),
            noise.sqrt(),
            self.recipe.options(),
        )
    }
}
