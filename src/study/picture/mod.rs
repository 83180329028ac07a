//! From a wish to a picture: ways to make it are tried at some of its pixels, whose light is known, and what these show of
//! error and price says which way the whole picture is made in.

mod draft;
mod lines;

use super::attempt::CannotTry;
use super::lit::Light;
use super::not_found::NotFound;
use super::recipe::{Recipe, Way};
use super::seek::Promise;
use super::worlds::Worlds;
use crate::accuracy::{Error, PixelTruth};
use crate::camera::Camera;
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::methods::image::ImageRun;
use crate::methods::{ImageSettings, Settings, Step};
use crate::solution::CameraImage;
use crate::world::World;
use draft::Draft;
use lines::Line;
use std::sync::Arc;
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
/// Sets of pixels: those that say which way is taken, and how far, and those that say at last how far off the picture is.
const CHOOSING: u32 = 0;
const JUDGING: u32 = 1;
/// Share of an error by which it may be uncertain, for noise of the truth, when it is told at last.
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

/// Makes the cheapest picture that is as accurate as is wanted, or the most accurate in the time allowed.
///
/// # Errors
/// If nothing but background is seen, or no light, or no way came to an end.
pub fn picture(
    worlds: &mut Worlds,
    settings: &Settings,
    goal: &PictureGoal,
    cancel: &Cancel,
) -> Result<Pictured, NotFound> {
    let start = Instant::now();
    let end = goal.end.unwrap_or(start + LONGEST);
    let pixels = if goal.error.is_some() { PIXELS } else { FEW_PIXELS };
    let truth = PixelTruth::new(worlds.first(), goal.camera, goal.size, pixels, CHOOSING);
    let mut search = Search { goal, truth, end, cancel, drafts: Vec::new(), refusal: None };
    search.look_at_truth(start);
    if search.truth.is_dark() {
        return Err(NotFound::Dark);
    }
    search.try_ways(worlds, settings);
    let chosen = goal.error.and_then(|wanted| search.chosen_for_error(wanted)).or_else(|| search.chosen_for_time());
    let Some(chosen) = chosen else { return Err(NotFound::after(search.refusal)) };
    search.expose(worlds.first(), chosen)
}

/// A draft that is to become a picture, with so many samples if there is time for them.
struct Chosen {
    draft: Draft,
    samples: u32,
    promise: Promise,
}

/// The state of a search.
struct Search<'a> {
    goal: &'a PictureGoal,
    truth: PixelTruth,
    /// When it must be over.
    end: Instant,
    cancel: &'a Cancel,
    drafts: Vec<Draft>,
    /// Why the last way that could not be gone could not.
    refusal: Option<CannotTry>,
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
    fn try_ways(&mut self, worlds: &mut Worlds, settings: &Settings) {
        let mut lines = lines::of(worlds.first(), settings, self.goal.way);
        while let Some(line) = self.next(&lines) {
            let recipe = lines[line].recipe();
            let light_end = Instant::now() + Duration::from_secs_f64(self.light_seconds(&lines[line]));
            match Draft::begin(worlds, &recipe, self.goal, &self.truth, light_end, self.cancel) {
                Ok(Some(mut draft)) => {
                    draft.look(&self.truth, SAMPLES, TRIAL * self.seconds_left(), self.cancel);
                    log::info!("{draft}");
                    lines[line].note(draft.light_seconds, draft.bias(), self.drafts.len());
                    self.drafts.push(draft);
                    lines::keep_the_faster(&mut lines);
                }
                Ok(None) => lines[line].end(),
                Err(reason) => {
                    log::info!("{}: {}", recipe.options(), with_causes(&reason));
                    self.refusal = Some(reason);
                    lines[line].end();
                }
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
        self.drafts.iter().filter_map(|draft| draft.seconds_to(SAFE * wanted, 1.0)).fold(f64::MAX, f64::min)
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
            // With it, a picture that is good enough takes less time, or there is none yet.
            Some(wanted) => {
                let best = self.least_seconds(wanted);
                let is_affordable = |turns: &i32| line.light_seconds(*turns) < best;
                let seconds = |turns| {
                    let exposure = draft.seconds_to(SAFE * wanted, line.bias_left(turns));
                    exposure.map_or(f64::MAX, |exposure| line.light_seconds(turns) + exposure)
                };
                best == f64::MAX || (1..).take_while(is_affordable).take(MOST_TURNS).map(seconds).any(|one| one < best)
            }
            None => {
                let left = self.seconds_left();
                let best = self.drafts.iter().map(|draft| draft.error_in(left, 1.0)).fold(f64::MAX, f64::min);
                let is_affordable = |turns: &i32| line.light_seconds(*turns) <= LIGHT * left;
                let error = |turns| draft.error_in(left - line.light_seconds(turns), line.bias_left(turns));
                (1..).take_while(is_affordable).take(MOST_TURNS).map(error).any(|error| error < LEVEL * best)
            }
        }
    }

    /// The best that there is time for.
    fn chosen_for_time(&mut self) -> Option<Chosen> {
        // Where there is as much time as one likes, no more samples than were looked at without coming to what was wanted.
        let left = self.goal.end.map(|_| self.seconds_left());
        let error = |draft: &Draft| left.map_or(draft.last_error(), |left| draft.error_in(left, 1.0));
        let order = |&a: &usize, &b: &usize| error(&self.drafts[a]).total_cmp(&error(&self.drafts[b]));
        let best = (0..self.drafts.len()).min_by(order)?;
        let draft = self.drafts.swap_remove(best);
        let promise = Promise { error: Some(error(&draft)), seconds: left.map(|left| draft.light_seconds + left) };
        let samples = if left.is_some() { ImageSettings::MAX_SAMPLES } else { draft.samples() };
        Some(Chosen { draft, samples, promise })
    }

    /// The cheapest that is good enough, as its pixels show before the others are made; `None` where none is.
    fn chosen_for_error(&mut self, wanted: f64) -> Option<Chosen> {
        let price = |draft: &Draft| draft.seconds_to(SAFE * wanted, 1.0).unwrap_or(f64::MAX);
        self.drafts.sort_by(|a, b| price(a).total_cmp(&price(b)));
        for index in 0..self.drafts.len() {
            if self.cancel.is_requested() || Instant::now() >= self.end {
                break;
            }
            let left = self.seconds_left();
            let draft = &mut self.drafts[index];
            let foreseen = draft.seconds_to(SAFE * wanted, 1.0);
            // What is known to have no bias gets there in the end.
            let patience = if draft.recipe.way == Way::Reference { f64::MAX } else { PATIENCE };
            // The rest of the picture is to be made in the time left, too.
            let limit = foreseen.map_or(0.0, |seconds| (patience * seconds).min(left));
            let samples = draft.expose_until(&mut self.truth, SAFE * wanted, limit, self.end, self.cancel);
            if let Some(samples) = samples {
                let draft = self.drafts.swap_remove(index);
                let seconds = foreseen.map(|seconds| draft.light_seconds + seconds);
                return Some(Chosen { draft, samples, promise: Promise { error: Some(wanted), seconds } });
            }
        }
        None
    }

    /// The whole picture, in whole passes: so it can be made again.
    fn expose(&mut self, world: &Arc<World>, chosen: Chosen) -> Result<Pictured, NotFound> {
        let start = Instant::now();
        let Chosen { draft: Draft { mut recipe, lit, light_seconds, .. }, samples, promise } = chosen;
        recipe.settings.image.samples = samples;
        let PictureGoal { camera, size, .. } = *self.goal;
        let run = ImageRun::new(&lit.sources, recipe.way.picture(), camera, size, &recipe.settings);
        let image = run.and_then(|mut run| {
            let mut pass = Instant::now();
            while run.step(self.cancel) == Step::Advanced {
                if run.is_between_passes() {
                    let last = pass.elapsed();
                    pass = Instant::now();
                    if self.goal.end.is_some_and(|end| pass + last > end) {
                        break;
                    }
                }
            }
            run.image().filter(|image| image.samples > 0 && !self.cancel.is_requested())
        });
        let Some(image) = image else { return Err(NotFound::NoTime) };
        let elapsed = start.elapsed();
        recipe.settings.image.samples = image.samples;
        let error = self.error_of(world, &image).ok_or(NotFound::Dark)?;
        let image = CameraImage { elapsed, is_complete: true, ..image };
        let seconds = light_seconds + elapsed.as_secs_f64();
        Ok(Pictured { recipe, light: lit.light, image, error, promise, seconds })
    }

    /// How far off a picture is: where there is time, at other pixels than it was chosen by, against a truth that is good
    /// enough to tell.
    fn error_of(&mut self, world: &Arc<World>, image: &CameraImage) -> Option<Error> {
        let (radiance, width) = (&image.radiance, image.size[0]);
        if self.goal.end.is_some() {
            return self.truth.error_of_picture(radiance, width);
        }
        let mut truth = PixelTruth::new(world, self.goal.camera, image.size, PIXELS, JUDGING);
        let end = Instant::now() + LAST_TRUTH;
        let wanted = self.goal.error.unwrap_or(0.0);
        while Instant::now() < end && truth.refine(self.cancel) {
            let is_enough = |error: &Error| error.uncertainty <= SURE * error.rms.max(wanted);
            if truth.error(&truth.of_places(radiance, width)).as_ref().is_some_and(is_enough) {
                break;
            }
        }
        truth.error_of_picture(radiance, width)
    }
}
