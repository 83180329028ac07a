//! From a budget to a picture: candidates race at some of its pixels, whose light is known, and the winner makes the whole picture.

mod candidates;
mod exposure;
mod forecast;
mod pilot;
mod race;
mod studio;

use super::budget::{Budget, LONGEST, Prediction};
use super::lit::Light;
use super::not_found::NotFound;
use super::progress::SearchProgress;
use super::recipe::{Recipe, Way};
use super::worlds::Worlds;
use crate::accuracy::{Error, PixelTruth};
use crate::camera::Camera;
use crate::cancel::Cancel;
use crate::math::rgb::Rgb;
use crate::methods::Settings;
use crate::solution::CameraImage;
use exposure::{Exposure, Stopped};
use forecast::{Attitude, Merit, SAFE, Targets};
use race::{Race, Runner};
use std::time::{Duration, Instant};
use studio::{JUDGING, Studio};

/// The truth is to be known to this share of what is wanted before an error counts as reached: over some hundred pixels that
/// leaves it uncertain by less than a tenth.
const FLOOR: f64 = 0.9;
/// Share of the time of the picture that making the truth as well known may take, and this many seconds in any case.
const LOOKING: f64 = 0.15;
const LEAST_LOOKING: f64 = 0.25;
/// A picture with so many times the samples that were expected to do is good enough where nothing speaks against it, however
/// badly the truth is known: the judges say what came of it.
const AMPLE: f64 = 1.5;
/// Share of the time allowed that is kept for saying how far off the picture is.
const TELLING: f64 = 0.04;
/// Pixels that say how far off a picture is that no time limits, how uncertain that may be, as a share of the error, and the
/// share of the time of the picture that it may take; but this much in any case.
const JUDGES: usize = 1024;
const SURE: f64 = 0.1;
const JUDGE_SHARE: f64 = 1.0 / 3.0;
const LEAST_JUDGING: Duration = Duration::from_millis(500);
/// How often a picture that turned out to be less accurate than its pilots showed is gone on with.
const MORE: u32 = 4;

/// What is wanted of a picture.
#[derive(Clone, Copy, Debug)]
pub struct PictureRequest {
    pub camera: Camera,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// The way to make it, if that is not to be chosen, too.
    pub way: Option<Way>,
    /// Its error as a share of the mean radiance of the surfaces that are seen.
    pub budget: Budget,
}

/// A picture that was made for a request.
pub struct PictureResult {
    pub recipe: Recipe,
    /// What it was read off; `None` where rays from the camera found all light themselves.
    pub light: Option<Light>,
    pub image: CameraImage,
    pub error: Error,
    pub prediction: Prediction,
    /// Of the light and of the picture.
    pub seconds: f64,
}

/// Makes the cheapest picture that is as accurate as is wanted, or the most accurate in the time allowed; where the accuracy
/// cannot be had in the time, too. `tell` hears how far it is.
///
/// # Errors
/// If nothing but background is seen, or no light, or no way came to an end.
pub fn picture(
    worlds: &mut Worlds,
    settings: &Settings,
    request: &PictureRequest,
    cancel: &Cancel,
    tell: &mut dyn FnMut(&SearchProgress),
) -> Result<PictureResult, NotFound> {
    let mut studio = Studio::new(worlds, request, cancel, tell);
    if studio.is_dark() {
        return Err(NotFound::Unseen);
    }
    let Budget { error, end } = request.budget;
    let mut until = request.budget.end_from(studio.start).saturating_duration_since(studio.start);
    if end.is_some() {
        until = until.mul_f64(1.0 - TELLING);
    }
    let targets = Targets { error, end: until.as_secs_f64(), is_timed: end.is_some() };
    let candidates = candidates::of(studio.worlds.first(), settings, request.way);
    let ranked = Race::new(&mut studio, targets, candidates).run();
    let end = studio.start + until;
    Darkroom { studio, targets, end }.develop(ranked)
}

/// Where the whole picture is made.
struct Darkroom<'a> {
    studio: Studio<'a>,
    targets: Targets,
    /// When it must be done.
    end: Instant,
}

impl Darkroom<'_> {
    /// The picture of the best candidate; where that turns out to be worse than is wanted, and is not path tracing, which gets
    /// there in the end, that of path tracing, if there is time.
    fn develop(mut self, ranked: Vec<Runner>) -> Result<PictureResult, NotFound> {
        let Some(best) = ranked.first() else { return Err(NotFound::after(self.studio.refusal)) };
        let Some(result) = self.expose(best)? else { return Err(NotFound::NoTime) };
        let is_missed = self.targets.error.is_some_and(|wanted| result.error.rms > wanted);
        let traced = ranked[1..].iter().find(|runner| runner.recipe.way == Way::Reference);
        let Some(traced) = traced.filter(|_| is_missed && !self.targets.is_timed) else { return Ok(result) };
        let now = self.studio.start.elapsed().as_secs_f64();
        match traced.forecast.own_merit(&self.targets, now, Attitude::Careful) {
            Merit::Reaches(_) => {
                let other = self.expose(traced)?.filter(|other| other.error.rms < result.error.rms);
                Ok(other.unwrap_or(result))
            }
            Merit::Leaves(_) => Ok(result),
        }
    }

    /// `None` if stopped before there was a picture.
    fn expose(&mut self, runner: &Runner) -> Result<Option<PictureResult>, NotFound> {
        let now = self.studio.start.elapsed().as_secs_f64();
        let expected = runner.forecast.picture_seconds(&self.targets, now);
        let samples = expected / runner.forecast.sample_seconds;
        // What cannot be had in the time allowed is not looked for, which would take a part of the time.
        let mut wanted = self.targets.error.map(|error| SAFE * error);
        let (foreseen, end) = match runner.forecast.own_merit(&self.targets, now, Attitude::Careful) {
            Merit::Reaches(_) => (self.targets.error, self.end),
            Merit::Leaves(error) if self.targets.is_timed => {
                wanted = None;
                (Some(error), self.end)
            }
            // More samples would not make it better.
            Merit::Leaves(error) => (Some(error), self.end.min(Instant::now() + Duration::from_secs_f64(expected))),
        };
        let prediction = Prediction { error: foreseen, seconds: Some(runner.light_seconds + expected) };
        let pilot = &self.studio.pilots[runner.pilot];
        let Some(mut exposure) = Exposure::new(pilot, self.studio.request, (samples / 4.0) as u32) else {
            return Ok(None);
        };
        let mut judge = Judge::new(&self.studio);
        let mut error = None;
        for _ in 0..MORE {
            let stopped = self.advance(&mut exposure, wanted, end, &runner.recipe, samples);
            let Some(image) = exposure.image().filter(|_| stopped != Stopped::Cancelled) else { return Ok(None) };
            let seconds = runner.light_seconds + exposure.seconds();
            let found = judge.error_of(&mut self.studio, &image, seconds).ok_or(NotFound::Unseen)?;
            error = Some(found);
            match (&mut wanted, self.targets.error) {
                // The pilots have shown less of what is hard about the picture than the judges.
                (Some(aim), Some(error)) if stopped == Stopped::Enough && found.rms > error => {
                    *aim *= SAFE * error / found.rms;
                }
                _ => break,
            }
        }
        let (Some(error), Some(image)) = (error, exposure.image()) else { return Ok(None) };
        let mut recipe = runner.recipe;
        recipe.settings.image.samples = image.samples;
        let light = self.studio.pilots[runner.pilot].lit.light.clone();
        let seconds = runner.light_seconds + exposure.seconds();
        Ok(Some(PictureResult { recipe, light, image, error, prediction, seconds }))
    }

    /// Goes on with a picture until its pixels show the error that is wanted, if one is, or until `end`.
    fn advance(
        &mut self,
        exposure: &mut Exposure,
        wanted: Option<f64>,
        end: Instant,
        recipe: &Recipe,
        expected: f64,
    ) -> Stopped {
        let (cancel, mut looking) = (self.studio.cancel, 0.0);
        exposure.advance(end, cancel, &mut |exposure, radiance| {
            let samples = exposure.samples();
            let doing = format!("rendering {}: {samples} samples of about {expected:.0}", recipe.way_in_words());
            let Some(wanted) = wanted else {
                (self.studio.tell)(&SearchProgress::of(doing));
                return false;
            };
            let width = self.studio.request.size[0];
            let allowed = (LEAST_LOOKING + LOOKING * exposure.seconds() - looking).min(left(end));
            let start = Instant::now();
            self.studio.refine_until(FLOOR * wanted, allowed);
            looking += start.elapsed().as_secs_f64();
            let error = self.studio.truth.error(&self.studio.truth.of_places(radiance, width));
            let best = error.map(|error| error.in_words());
            (self.studio.tell)(&SearchProgress { doing, best });
            // Where there is no judge the time allowed is better used.
            let is_ample = !self.targets.is_timed && f64::from(samples) >= AMPLE * expected;
            error.is_some_and(|error| error.rms + error.uncertainty <= wanted || is_ample && error.rms <= wanted)
        })
    }
}

fn left(end: Instant) -> f64 {
    end.saturating_duration_since(Instant::now()).as_secs_f64()
}

/// Says how far off a picture is: where time does not limit it, at other pixels than it was chosen by.
struct Judge {
    truth: Option<PixelTruth>,
}

impl Judge {
    fn new(studio: &Studio<'_>) -> Self {
        let of = studio.request;
        let is_timed = of.budget.end.is_some();
        let truth = || PixelTruth::new(studio.worlds.first(), of.camera, of.size, JUDGES, JUDGING);
        Self { truth: (!is_timed).then(truth) }
    }

    /// The error of a picture that has taken so many seconds.
    fn error_of(&mut self, studio: &mut Studio<'_>, image: &CameraImage, seconds: f64) -> Option<Error> {
        let (radiance, width): (&[Rgb], u32) = (&image.radiance, image.size[0]);
        (studio.tell)(&SearchProgress::of("measuring the error of the picture"));
        let allowed = Duration::from_secs_f64(JUDGE_SHARE * seconds).max(LEAST_JUDGING);
        let Some(truth) = &mut self.truth else {
            let rms = studio.truth.error_of_picture(radiance, width).map_or(0.0, |error| error.rms);
            let end = studio.request.budget.end.unwrap_or(studio.start + LONGEST);
            studio.refine_until(rms / 2.0, left(end).min(allowed.as_secs_f64()));
            return studio.truth.error_of_picture(radiance, width);
        };
        let start = Instant::now();
        let wanted = studio.request.budget.error.unwrap_or_default();
        loop {
            let error = truth.error(&truth.of_places(radiance, width));
            let is_sure = error.is_some_and(|error| error.uncertainty <= SURE * error.rms.max(wanted));
            if is_sure || start.elapsed() > allowed || !truth.refine(studio.cancel) {
                return truth.error_of_picture(radiance, width);
            }
        }
    }
}
