//! Which way to make a picture is best: all of them begin with few samples, those that cannot win any more drop out, and the
//! others go on with twice as many (successive halving: Jamieson, Talwalkar 2016). The whole race may take a share of the time
//! of the picture that it is for; where that is over before anything is decided, what is known of the candidates decides, and
//! a bias that is not known counts against them.

use super::candidates::{Candidate, keep_the_faster};
use super::forecast::{Attitude, Forecast, Merit, Targets};
use crate::study::recipe::Recipe;

/// The search may take this share of the time of the picture that is best so far: a quarter of both together.
const SEARCH: f64 = 1.0 / 3.0;
/// What it may take in any case, s, but for this share of the time allowed.
const LEAST: f64 = 0.25;
const LEAST_SHARE: f64 = 0.2;
/// What the first light of a candidate may take: a share of what is left of the search, or of the best picture so far.
const FIRST_LIGHT: f64 = 0.5;
const LIGHT_OF_PICTURE: f64 = 0.1;
/// Share of the time of the best picture so far that finer light may be expected to take, and by how much longer it may turn
/// out to take. It is a part of the picture if it pays.
const FINER_LIGHT: f64 = 1.0 / 3.0;
const PATIENCE: f64 = 1.5;
/// Share of the time allowed for light where there is nothing else yet.
const ONLY_LIGHT: f64 = 0.45;
/// Light may turn out to be worth it that is finer by so many turns.
const MOST_TURNS: i32 = 3;
/// Samples of a pilot in each of its estimates after which nothing more is to be learnt from them.
const MOST_SAMPLES: u32 = 1024;

/// Where pilots are made; with a clock of its own.
pub trait Laboratory {
    /// Seconds since the search began.
    fn now(&self) -> f64;
    /// Whether the search was stopped.
    fn is_stopped(&self) -> bool;
    /// The reference gets at least so many samples in each of its estimates, and samples for at least so many seconds.
    fn refine_reference(&mut self, samples: u32, seconds: f64);
    /// Computes the light of a recipe in at most so many seconds; the number of its pilot, and the seconds that it took.
    fn prepare(&mut self, recipe: &Recipe, seconds: f64) -> Option<(usize, f64)>;
    /// Gives a pilot as many samples in each of its estimates, and tells what to expect of its picture.
    fn sample(&mut self, pilot: usize, samples: u32) -> Option<Forecast>;
    /// Hears of what is tried next, and of the best so far.
    fn tell(&mut self, next: &Recipe, best: Option<(&Recipe, Merit)>);
}

/// A pilot in the race.
#[derive(Clone, Debug)]
pub struct Runner {
    pub pilot: usize,
    pub recipe: Recipe,
    /// Of its light.
    pub light_seconds: f64,
    pub forecast: Forecast,
    is_racing: bool,
}

/// A race under way.
pub struct Race<'a, L> {
    lab: &'a mut L,
    targets: Targets,
    candidates: Vec<Candidate>,
    runners: Vec<Runner>,
    /// In each estimate of the pilots that are still racing.
    samples: u32,
    /// What samples of pilots took since the reference was refined, s.
    sampling_seconds: f64,
}

impl<'a, L: Laboratory> Race<'a, L> {
    pub fn new(lab: &'a mut L, targets: Targets, candidates: Vec<Candidate>) -> Self {
        Self { lab, targets, candidates, runners: Vec::new(), samples: 1, sampling_seconds: 0.0 }
    }

    /// All pilots, the best first.
    pub fn run(mut self) -> Vec<Runner> {
        self.lab.refine_reference(self.samples, 0.0);
        let mut start = self.lab.now();
        let mut light_seconds = 0.0;
        for candidate in 0..self.candidates.len() {
            if !self.is_over() {
                light_seconds += self.begin(candidate);
            }
        }
        let mut last_round = self.lab.now() - start - light_seconds;
        loop {
            self.refine_lights();
            self.drop_losers();
            let racing = self.runners.iter().filter(|runner| runner.is_racing).count();
            let is_affordable = 2.0 * last_round < self.seconds_left();
            if racing < 2 || !is_affordable || self.samples >= MOST_SAMPLES || self.lab.is_stopped() {
                return self.ranked();
            }
            self.samples *= 2;
            start = self.lab.now();
            // Its noise is in the bias of all of them: it gets as much time as they did together.
            self.lab.refine_reference(self.samples, std::mem::take(&mut self.sampling_seconds));
            for runner in 0..self.runners.len() {
                self.sample(runner);
            }
            last_round = self.lab.now() - start;
        }
    }

    /// Whether there is something to make a picture by and no time to look for anything else.
    fn is_over(&self) -> bool {
        self.lab.is_stopped() || !self.runners.is_empty() && self.seconds_left() <= 0.0
    }

    fn merit(&self, runner: &Runner, attitude: Attitude) -> Merit {
        runner.forecast.own_merit(&self.targets, self.lab.now(), attitude)
    }

    fn best(&self) -> Option<&Runner> {
        let order = |a: &&Runner, b: &&Runner| {
            let [a, b] = [a, b].map(|runner| self.merit(runner, Attitude::Careful));
            a.partial_cmp(&b).unwrap_or(std::cmp::Ordering::Equal)
        };
        self.runners.iter().min_by(order)
    }

    /// What is left of the time of the search. The light of the best candidate is a part of its picture.
    fn seconds_left(&self) -> f64 {
        let now = self.lab.now();
        let [light, picture] = self
            .best()
            .map_or([0.0; 2], |best| [best.light_seconds, best.forecast.picture_seconds(&self.targets, now)]);
        (SEARCH * (light + picture)).max(LEAST.min(LEAST_SHARE * self.targets.end)) - (now - light)
    }

    /// The first light of a candidate, and its pilot. The seconds of the light.
    fn begin(&mut self, candidate: usize) -> f64 {
        let now = self.lab.now();
        let picture = self.best().map(|best| best.forecast.picture_seconds(&self.targets, now));
        let seconds = picture.map_or(ONLY_LIGHT * (self.targets.end - now), |picture| {
            (FIRST_LIGHT * self.seconds_left()).max(LIGHT_OF_PICTURE * picture)
        });
        self.advance(candidate, seconds)
    }

    /// The next light of a candidate, and its pilot. The seconds of the light.
    fn advance(&mut self, candidate: usize, seconds: f64) -> f64 {
        let recipe = self.candidates[candidate].recipe();
        let best = self.best().map(|best| (best.recipe, self.merit(best, Attitude::Careful)));
        self.lab.tell(&recipe, best.as_ref().map(|(recipe, merit)| (recipe, *merit)));
        let prepared = self.lab.prepare(&recipe, seconds);
        let sampled = prepared.and_then(|(pilot, _)| self.samples_of(pilot));
        let (Some((pilot, light_seconds)), Some(forecast)) = (prepared, sampled) else {
            self.candidates[candidate].end();
            return 0.0;
        };
        let bias = forecast.parts.bias.max(0.0).sqrt();
        self.candidates[candidate].note(light_seconds, bias, self.runners.len());
        keep_the_faster(&mut self.candidates);
        self.runners.push(Runner { pilot, recipe, light_seconds, forecast, is_racing: true });
        light_seconds
    }

    fn sample(&mut self, runner: usize) {
        let Runner { pilot, recipe, is_racing, .. } = self.runners[runner];
        if !is_racing || self.lab.is_stopped() {
            return;
        }
        let best = self.best().map(|best| (best.recipe, self.merit(best, Attitude::Careful)));
        self.lab.tell(&recipe, best.as_ref().map(|(recipe, merit)| (recipe, *merit)));
        if let Some(forecast) = self.samples_of(pilot) {
            self.runners[runner].forecast = forecast;
        }
    }

    fn samples_of(&mut self, pilot: usize) -> Option<Forecast> {
        let start = self.lab.now();
        let forecast = self.lab.sample(pilot, self.samples);
        self.sampling_seconds += self.lab.now() - start;
        forecast
    }

    /// Those that cannot win any more, even if their bias is smaller than it looks.
    fn drop_losers(&mut self) {
        let Some(best) = self.best() else { return };
        let (pilot, merit) = (best.pilot, self.merit(best, Attitude::Careful));
        let may_win = |runner: &Runner| {
            runner.pilot == pilot || self.merit(runner, Attitude::Hopeful).is_clearly_better_than(merit)
        };
        let racing: Vec<bool> = self.runners.iter().map(|runner| runner.is_racing && may_win(runner)).collect();
        for (runner, is_racing) in self.runners.iter_mut().zip(racing) {
            runner.is_racing = is_racing;
        }
    }

    /// Finer light wherever that may pay.
    fn refine_lights(&mut self) {
        while let Some(candidate) = (0..self.candidates.len()).find(|&candidate| self.is_worth_refining(candidate))
            && !self.is_over()
        {
            let seconds = PATIENCE * self.candidates[candidate].light_seconds(1);
            self.advance(candidate, seconds);
        }
    }

    /// Whether finer light makes a better picture than the best so far: where the bias of its light is known to be there.
    fn is_worth_refining(&self, candidate: usize) -> bool {
        let candidate = &self.candidates[candidate];
        let (Some(best), Some(own)) = (self.best(), candidate.runner.map(|runner| &self.runners[runner])) else {
            return false;
        };
        let now = self.lab.now();
        let best_merit = self.merit(best, Attitude::Careful);
        let limit = FINER_LIGHT * (best.light_seconds + best.forecast.picture_seconds(&self.targets, now));
        let pays = |turns: i32| {
            let finer = [candidate.bias_left(turns), candidate.light_seconds(turns)];
            finer[1] <= limit
                && own.forecast.merit(&self.targets, now, Attitude::Careful, finer).is_clearly_better_than(best_merit)
        };
        !candidate.has_ended && own.forecast.is_biased() && (1..=MOST_TURNS).any(pays)
    }

    fn ranked(mut self) -> Vec<Runner> {
        let mut ranked = Vec::with_capacity(self.runners.len());
        while let Some(pilot) = self.best().map(|best| best.pilot) {
            let index = self.runners.iter().position(|runner| runner.pilot == pilot).unwrap_or_default();
            ranked.push(self.runners.swap_remove(index));
        }
        ranked
    }
}

#[cfg(test)]
mod tests;
