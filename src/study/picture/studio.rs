//! Where pilots are rendered: the laboratory of a race for a picture.

use super::PictureRequest;
use super::forecast::{Forecast, Merit};
use super::pilot::PilotRender;
use super::race::Laboratory;
use crate::accuracy::PixelTruth;
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::methods::{ImageSettings, Settings};
use crate::study::attempt::CannotTry;
use crate::study::progress::SearchProgress;
use crate::study::recipe::{Recipe, Way};
use crate::study::worlds::Worlds;
use std::time::{Duration, Instant};

/// Pixels that pilots show.
const PIXELS: usize = 256;
/// Sets of pixels: those that pilots show, and those that say at last how far off the picture is.
const PILOTS: u32 = 0;
pub const JUDGING: u32 = 1;

/// Pilots, and the truth that they are held against.
pub struct Studio<'a> {
    pub worlds: &'a mut Worlds,
    pub request: &'a PictureRequest,
    pub truth: PixelTruth,
    /// Spent on the truth, which is the pilot of path tracing at the same time.
    truth_seconds: f64,
    pub start: Instant,
    pub cancel: &'a Cancel,
    pub pilots: Vec<PilotRender>,
    /// Why the last way that could not be gone could not.
    pub refusal: Option<CannotTry>,
    pub tell: &'a mut dyn FnMut(&SearchProgress),
}

impl<'a> Studio<'a> {
    pub fn new(
        worlds: &'a mut Worlds,
        request: &'a PictureRequest,
        cancel: &'a Cancel,
        tell: &'a mut dyn FnMut(&SearchProgress),
    ) -> Self {
        let start = Instant::now();
        let truth = PixelTruth::new(worlds.first(), request.camera, request.size, PIXELS, PILOTS);
        Self { worlds, request, truth, truth_seconds: 0.0, start, cancel, pilots: Vec::new(), refusal: None, tell }
    }

    /// Whether the camera sees no light, of which as many samples are taken as it takes to know.
    pub fn is_dark(&mut self) -> bool {
        while self.truth.floor().is_infinite() && !self.truth.is_dark() && self.refine() {}
        self.truth.is_dark()
    }

    /// One more sample in each estimate of the truth; false if stopped.
    fn refine(&mut self) -> bool {
        let start = Instant::now();
        let is_finer = self.truth.refine(self.cancel);
        self.truth_seconds += start.elapsed().as_secs_f64();
        is_finer
    }

    /// Makes the truth better known until its own error is `floor`, or for so many seconds.
    pub fn refine_until(&mut self, floor: f64, seconds: f64) {
        let start = Instant::now();
        while self.truth.floor() > floor && start.elapsed().as_secs_f64() < seconds && self.refine() {}
    }

    /// Pixels of the picture for each that is shown by pilots.
    fn scale(&self) -> f64 {
        let all: f64 = self.request.size.map(f64::from).iter().product();
        all / self.truth.places().len().max(1) as f64
    }

    fn begin(&mut self, recipe: &Recipe, seconds: f64) -> Result<Option<PilotRender>, CannotTry> {
        let seconds = Duration::try_from_secs_f64(seconds).unwrap_or_default();
        let end = Instant::now() + seconds;
        PilotRender::begin(self.worlds, recipe, self.request, &self.truth, end, self.cancel)
    }
}

impl Laboratory for Studio<'_> {
    fn now(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    fn is_stopped(&self) -> bool {
        self.cancel.is_requested()
    }

    fn refine_reference(&mut self, samples: u32, seconds: f64) {
        let start = Instant::now();
        while (self.truth.samples() < samples || start.elapsed().as_secs_f64() < seconds) && self.refine() {}
    }

    fn prepare(&mut self, recipe: &Recipe, seconds: f64) -> Option<(usize, f64)> {
        match self.begin(recipe, seconds) {
            Ok(Some(pilot)) => {
                let light_seconds = pilot.light_seconds;
                self.pilots.push(pilot);
                Some((self.pilots.len() - 1, light_seconds))
            }
            Ok(None) => {
                log::info!("no time for the light: {}", recipe.options());
                None
            }
            Err(reason) => {
                log::info!("{}: {}", recipe.options(), with_causes(&reason));
                self.refusal = Some(reason);
                None
            }
        }
    }

    fn sample(&mut self, pilot: usize, samples: u32) -> Option<Forecast> {
        let scale = self.scale();
        let pilot = &mut self.pilots[pilot];
        let is_truth = is_truth_itself(&pilot.recipe);
        let forecast = if is_truth {
            let taken = self.truth.seeds().count() as f64 * f64::from(self.truth.samples());
            let parts = self.truth.own_parts()?;
            Forecast { parts, sample_seconds: scale * self.truth_seconds / taken }
        } else {
            pilot.sample(&self.truth, samples, scale, self.cancel)?
        };
        log::info!(
            "{:.2} s: {} samples, light in {:.2} s, {:.4} s a pass, bias² {:.2e} ± {:.2e}, noise {:.3}: {}",
            self.start.elapsed().as_secs_f64(),
            if is_truth { self.truth.samples() } else { samples },
            pilot.light_seconds,
            forecast.sample_seconds,
            forecast.parts.bias,
            forecast.parts.bias_deviation,
            forecast.parts.noise.sqrt(),
            pilot.recipe.options(),
        );
        Some(forecast)
    }

    fn tell(&mut self, next: &Recipe, best: Option<(&Recipe, Merit)>) {
        let best = best.map(|(recipe, merit)| match merit {
            Merit::Reaches(seconds) => format!("{}, in {seconds:.1} s more", recipe.way_in_words()),
            Merit::Leaves(error) => format!("{}, {:.2} % foreseen", recipe.way_in_words(), 100.0 * error),
        });
        (self.tell)(&SearchProgress { doing: format!("trying {}", next.way_in_words()), best });
    }
}

/// Whether a pilot of the recipe would go the very ways of the truth: with all effects and all paths.
fn is_truth_itself(recipe: &Recipe) -> bool {
    let Settings { effects, image, .. } = recipe.settings;
    let default = Settings::default();
    recipe.way == Way::Reference
        && effects == default.effects
        && ImageSettings { filter: default.image.filter, ..image } == image
}
