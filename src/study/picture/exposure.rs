//! The whole picture, sample by sample, until it is good enough or time is up.

use super::PictureRequest;
use super::pilot::PilotRender;
use crate::cancel::Cancel;
use crate::math::rgb::Rgb;
use crate::methods::image::ImageRun;
use crate::methods::{ImageSettings, Settings, Step};
use crate::solution::CameraImage;
use std::time::{Duration, Instant};

/// By what factor samples grow from one look at the error to the next.
const PACE: f64 = 1.25;

/// A picture in the making: in whole passes, so that it can be made again.
pub struct Exposure {
    run: ImageRun,
    /// Spent on passes.
    elapsed: Duration,
    last_pass: Duration,
    next_look: u32,
}

/// Why an exposure stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// It is good enough.
    Enough,
    /// Another pass would not end in time, or there are as many samples as there may be.
    Over,
    Cancelled,
}

impl Exposure {
    /// Before the first pass; its error is looked at for the first time after `first_look` samples. `None` where the light
    /// that the view needs is missing.
    pub fn new(pilot: &PilotRender, request: &PictureRequest, first_look: u32) -> Option<Self> {
        let image = ImageSettings { samples: ImageSettings::MAX_SAMPLES, ..pilot.recipe.settings.image };
        let settings = Settings { image, ..pilot.recipe.settings };
        let view = pilot.recipe.way.picture();
        let run = ImageRun::new(&pilot.lit.sources, view, request.camera, request.size, &settings)?;
        Some(Self { run, elapsed: Duration::ZERO, last_pass: Duration::ZERO, next_look: first_look.max(1) })
    }

    pub fn samples(&self) -> u32 {
        self.run.samples()
    }

    pub fn seconds(&self) -> f64 {
        self.elapsed.as_secs_f64()
    }

    /// Goes on until `is_enough` says so of a picture, or until `end`; one pass is made in any case.
    pub fn advance(
        &mut self,
        end: Instant,
        cancel: &Cancel,
        is_enough: &mut dyn FnMut(&Self, &[Rgb]) -> bool,
    ) -> Stopped {
        loop {
            let is_first = self.samples() == 0;
            if !is_first && Instant::now() + self.last_pass > end {
                return Stopped::Over;
            }
            let start = Instant::now();
            loop {
                match self.run.step(cancel) {
                    Step::Advanced if !self.run.is_between_passes() => {}
                    Step::Advanced => break,
                    Step::Prepared | Step::Converged => return Stopped::Over,
                    Step::Cancelled => return Stopped::Cancelled,
                }
            }
            let pass = start.elapsed();
            self.elapsed += pass;
            // The first one includes the coarse passes before it, a third more.
            self.last_pass = if is_first { pass.mul_f64(0.75) } else { pass };
            if self.samples() >= self.next_look
                && let Some(image) = self.run.image()
            {
                self.next_look = (PACE * f64::from(self.samples())).ceil() as u32;
                if is_enough(self, &image.radiance) {
                    return Stopped::Enough;
                }
            }
        }
    }

    /// What there is so far; `None` before the first pass over all pixels was whole.
    pub fn image(&self) -> Option<CameraImage> {
        let image = self.run.image().filter(|image| image.samples > 0)?;
        Some(CameraImage { elapsed: self.elapsed, is_complete: true, ..image })
    }
}
