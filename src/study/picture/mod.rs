//! From a wish to a picture: ways to make it are tried at some of its pixels, whose light is known, and what these show of
//! error and price says which way the whole picture is made in.

mod draft;
mod lines;

use super::bench::Bench;
use super::lit::Light;
use super::recipe::{Recipe, Way};
use super::seek::Promise;
use crate::accuracy::{Error, PixelTruth};
use crate::camera::Camera;
use crate::cancel::Cancel;
use crate::methods::image::ImageRun;
use crate::methods::{ImageSettings, Settings, Step};
use crate::solution::CameraImage;
use draft::Draft;
use lines::Line;
use std::time::{Duration, Instant};

/// An error counts as reached when it is below this share of what is wanted: it is measured in a thousand pixels, and meant in
/// all.
const SAFE: f64 = 0.9;
/// Pixels that tell an error that is wanted; and where time is short, so that more is known of each.
const PIXELS: usize = 1024;
const FEW_PIXELS: usize = 256;
/// Share of the time allowed in which the truth is looked for before anything else.
const FIRST_TRUTH: f64 = 0.12;
/// The truth may be off by this share of what is wanted: over a thousand pixels that comes to a few percent of an error.
const FLOOR: f64 = 0.7;
/// Share of an error by which it may be uncertain when it is told at last.
const SURE: f64 = 0.05;
/// Share of the time left that finding a way's light may take, and the first of it, of which nothing is known.
const LIGHT: f64 = 0.45;
const FIRST_LIGHT: f64 = 0.12;
/// Share of the time left that trying a way on pixels may take.
const TRIAL: f64 = 0.02;
/// Samples of a pixel after which the errors of a way can be foreseen.
const SAMPLES: u32 = 16;
/// What is to be gained by a finer light, at least, as a share of the error.
const LEVEL: f64 = 0.97;
/// Light may turn out to be worth it that is finer by so many turns.
const MOST_TURNS: usize = 3;
/// A way that takes so many times as long as foreseen is given up.
const PATIENCE: f64 = 3.0;
/// When a search without a limit is given up.
const LONGEST: Duration = Duration::from_secs(300);
/// The longest that the truth is made better known for an error that is told at last.
const LAST_TRUTH: Duration = Duration::from_secs(20);

/// What is wanted of a picture. One of error and end, at least, or both.
#[derive(Clone, Copy, Debug)]
pub struct PictureGoal {
    pub camera: Camera,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// The way to make it, if that is not to be chosen, too.
    pub way: Option<Way>,
    /// As a share of the mean radiance of the surfaces that are seen.
    pub error: Option<f64>,
    /// When it must be over.
    pub end: Option<Instant>,
}

/// A picture that was made for a goal.
pub struct Pictured {
    pub recipe: Recipe,
    /// What it was read off; `None` where rays from the camera found all light themselves.
    pub light: Option<Light>,
    pub image: CameraImage,
    pub error: Error,
    pub promise: Promise,
    /// Of the light and of the picture.
    pub seconds: f64,
}

/// Makes the cheapest picture that is as accurate as is wanted, or the most accurate in the time allowed. `None` where nothing
/// but emitters is seen, or no light.
pub fn picture(bench: &mut Bench, settings: &Settings, goal: &PictureGoal, cancel: &Cancel) -> Option<Pictured> {
    let start = Instant::now();
    let end = goal.end.unwrap_or(start + LONGEST);
    let pixels = if goal.error.is_some() { PIXELS } else { FEW_PIXELS };
    let truth = PixelTruth::new(bench.world(), goal.camera, goal.size, pixels);
    let mut search = Search { goal, truth, end, cancel, drafts: Vec::new() };
    search.look_at_truth(start);
    if search.truth.is_dark() {
        return None;
    }
    search.try_ways(bench, settings);
    match goal.error {
        Some(wanted) => search.picture_of_error(wanted),
        None => search.picture_of_time(),
    }
}

/// The draft that came nearest to an error.
struct Best {
    draft: Draft,
    samples: u32,
    promise: Promise,
    error: f64,
}

/// The state of a search.
struct Search<'a> {
    goal: &'a PictureGoal,
    truth: PixelTruth,
    /// When it must be over.
    end: Instant,
    cancel: &'a Cancel,
    drafts: Vec<Draft>,
}

impl Search<'_> {
    fn seconds_left(&self) -> f64 {
        self.end.saturating_duration_since(Instant::now()).as_secs_f64()
    }

    /// A truth that is good enough to tell whether a picture is, or as good as a part of the time allows.
    fn look_at_truth(&mut self, start: Instant) {
        let allowed = start + self.end.saturating_duration_since(start).mul_f64(FIRST_TRUTH);
        let floor = self.goal.error.map_or(0.0, |error| FLOOR * error);
        while self.truth.floor() > floor
            && !self.truth.is_dark()
            && (Instant::now() < allowed || self.truth.floor().is_infinite())
            && self.truth.refine(self.cancel)
        {}
    }

    /// Tries all ways that may be worth it, each with finer and finer light.
    fn try_ways(&mut self, bench: &mut Bench, settings: &Settings) {
        let mut lines = lines::of(bench, settings, self.goal.way);
        while let Some(line) = self.next(&lines) {
            let recipe = lines[line].recipe();
            let light_end = Instant::now() + Duration::from_secs_f64(self.light_seconds(&lines[line]));
            match Draft::begin(bench, &recipe, self.goal, &self.truth, light_end, self.cancel) {
                Some(mut draft) => {
                    draft.look(&self.truth, SAMPLES, TRIAL * self.seconds_left(), self.cancel);
                    log::info!("{draft}");
                    lines[line].note(draft.light_seconds, draft.bias(), self.drafts.len());
                    self.drafts.push(draft);
                    lines::keep_the_faster(&mut lines);
                }
                None => lines[line].end(),
            }
            if self.cancel.is_requested() || Instant::now() >= self.end {
                return;
            }
        }
    }

    /// What the next light of a line may take.
    fn light_seconds(&self, line: &Line) -> f64 {
        let left = self.seconds_left();
        match self.goal.error {
            // Light may take as long as what is known to be good enough.
            Some(wanted) => self.least_seconds(wanted).min(left),
            None if line.draft.is_none() => FIRST_LIGHT * left,
            None => LIGHT * left,
        }
    }

    /// How long the cheapest picture of an error takes that is known by now.
    fn least_seconds(&self, wanted: f64) -> f64 {
        self.drafts.iter().filter_map(|draft| draft.seconds_to(SAFE * wanted)).fold(f64::MAX, f64::min)
    }

    /// The way to be tried next, if any is worth it.
    fn next(&self, lines: &[Line]) -> Option<usize> {
        let fresh = lines.iter().position(|line| !line.has_ended && line.draft.is_none());
        fresh.or_else(|| lines.iter().position(|line| !line.has_ended && self.is_worth_refining(line)))
    }

    /// Whether a finer light may pay.
    fn is_worth_refining(&self, line: &Line) -> bool {
        let Some(draft) = line.draft.map(|draft| &self.drafts[draft]) else { return false };
        match self.goal.error {
            // It is not good enough, and a better one takes less time than what is good enough.
            Some(wanted) => {
                let best =
                    self.drafts.iter().filter_map(|draft| draft.seconds_to(SAFE * wanted)).fold(f64::MAX, f64::min);
                draft.seconds_to(SAFE * wanted).is_none_or(|seconds| seconds > best) && line.light_seconds(1) < best
            }
            None => {
                let left = self.seconds_left();
                let best = self.drafts.iter().map(|draft| draft.error_in(left)).fold(f64::MAX, f64::min);
                let is_affordable = |turns: &i32| line.light_seconds(*turns) <= LIGHT * left;
                let error = |turns| line.error(draft, turns, left - line.light_seconds(turns));
                (1..).take_while(is_affordable).take(MOST_TURNS).map(error).any(|error| error < LEVEL * best)
            }
        }
    }

    /// The best that there is time for.
    fn picture_of_time(&mut self) -> Option<Pictured> {
        let left = self.seconds_left();
        let error = |draft: &Draft| draft.error_in(left);
        let best = (0..self.drafts.len()).min_by(|&a, &b| error(&self.drafts[a]).total_cmp(&error(&self.drafts[b])))?;
        let draft = self.drafts.swap_remove(best);
        let promise = Promise { error: Some(error(&draft)), seconds: Some(draft.light_seconds + left) };
        self.expose(draft, ImageSettings::MAX_SAMPLES, promise)
    }

    /// The cheapest that is good enough, as its pixels show before the others are made; where none is, the best.
    fn picture_of_error(&mut self, wanted: f64) -> Option<Pictured> {
        let mut best: Option<Best> = None;
        while !self.drafts.is_empty() {
            let price = |draft: &Draft| draft.seconds_to(SAFE * wanted).unwrap_or(f64::MAX);
            let order = |&a: &usize, &b: &usize| price(&self.drafts[a]).total_cmp(&price(&self.drafts[b]));
            let cheapest = (0..self.drafts.len()).min_by(order)?;
            let mut draft = self.drafts.swap_remove(cheapest);
            let foreseen = draft.seconds_to(SAFE * wanted);
            let promise =
                Promise { error: Some(wanted), seconds: foreseen.map(|seconds| draft.light_seconds + seconds) };
            // What is known to have no bias gets there in the end.
            let patience = if draft.recipe.way == Way::Reference { f64::MAX } else { PATIENCE };
            let limit = foreseen.map_or(0.0, |seconds| patience * seconds);
            let samples = draft.expose_until(&mut self.truth, SAFE * wanted, limit, self.end, self.cancel);
            let error = draft.last_error();
            if samples.is_some() || best.as_ref().is_none_or(|best| error < best.error) {
                best = Some(Best { samples: samples.unwrap_or(draft.samples()), draft, promise, error });
            }
            if samples.is_some() || self.cancel.is_requested() || Instant::now() >= self.end {
                break;
            }
        }
        let Best { draft, samples, promise, .. } = best?;
        self.expose(draft, samples, promise)
    }

    /// The whole picture.
    fn expose(&mut self, draft: Draft, samples: u32, promise: Promise) -> Option<Pictured> {
        let start = Instant::now();
        let Draft { mut recipe, lit, light_seconds, .. } = draft;
        recipe.settings.image.samples = samples;
        let PictureGoal { camera, size, .. } = *self.goal;
        let mut run = ImageRun::new(&lit.sources, recipe.way.picture(), camera, size, &recipe.settings)?;
        let has_time = |run: &ImageRun| self.goal.end.is_none_or(|end| Instant::now() < end) || run.samples() == 0;
        while has_time(&run) && run.step(self.cancel) == Step::Advanced {}
        let elapsed = start.elapsed();
        let image = CameraImage { elapsed, is_complete: true, ..run.image()? };
        recipe.settings.image.samples = image.samples;
        let error = self.error_of(&image)?;
        let seconds = light_seconds + elapsed.as_secs_f64();
        Some(Pictured { recipe, light: lit.light, image, error, promise, seconds })
    }

    /// How far off a picture is; where there is time, against a truth that is good enough to tell.
    fn error_of(&mut self, image: &CameraImage) -> Option<Error> {
        let end = Instant::now() + LAST_TRUTH;
        loop {
            let error = self.truth.error_of_picture(&image.radiance, image.size[0])?;
            let is_enough = error.uncertainty <= SURE * error.rms || self.goal.end.is_some();
            if is_enough || Instant::now() >= end || !self.truth.refine(self.cancel) {
                return Some(error);
            }
        }
    }
}
