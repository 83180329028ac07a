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
/// Share of what is left of the search that the first light of a candidate may take.
const FIRST_LIGHT: f64 = 0.5;
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
    /// The reference gets so many samples in each of its estimates.
    fn refine_reference(&mut self, samples: u32);
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
}

impl<'a, L: Laboratory> Race<'a, L> {
    pub fn new(lab: &'a mut L, targets: Targets, candidates: Vec<Candidate>) -> Self {
        Self { lab, targets, candidates, runners: Vec::new(), samples: 1 }
    }

    /// All pilots, the best first.
    pub fn run(mut self) -> Vec<Runner> {
        self.lab.refine_reference(self.samples);
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
            self.lab.refine_reference(self.samples);
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
        let only = ONLY_LIGHT * (self.targets.end - self.lab.now());
        let seconds = if self.runners.is_empty() { only } else { FIRST_LIGHT * self.seconds_left() };
        self.advance(candidate, seconds)
    }

    /// The next light of a candidate, and its pilot. The seconds of the light.
    fn advance(&mut self, candidate: usize, seconds: f64) -> f64 {
        let recipe = self.candidates[candidate].recipe();
        let best = self.best().map(|best| (best.recipe, self.merit(best, Attitude::Careful)));
        self.lab.tell(&recipe, best.as_ref().map(|(recipe, merit)| (recipe, *merit)));
        let prepared = self.lab.prepare(&recipe, seconds);
        let sampled = prepared.and_then(|(pilot, _)| self.lab.sample(pilot, self.samples));
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
        if let Some(forecast) = self.lab.sample(pilot, self.samples) {
            self.runners[runner].forecast = forecast;
        }
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
            && !self.lab.is_stopped()
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
mod tests {
    use super::*;
    use crate::accuracy::ErrorParts;
    use crate::cancel::Cancel;
    use crate::mesh::MeshSettings;
    use crate::methods::{Settings, Solver};
    use crate::scene::Scene;
    use crate::study::picture::candidates;
    use crate::study::recipe::Way;
    use crate::world::World;

    /// Replicates and pixels of pilots, and the variance of a sample of path tracing.
    const REPLICATES: f64 = 16.0;
    const PIXELS: f64 = 256.0;
    const TRACED: f64 = 0.64;

    /// Curves of cost and error like those of a small diffuse room, all times `slowness` times as long, and a clock that goes
    /// on by what they cost and by nothing else.
    struct Curves {
        slowness: f64,
        /// By how much light takes longer than that.
        light: f64,
        /// Pixels of the picture for each of the pilots.
        scale: f64,
        first_size: f32,
        clock: f64,
        reference: u32,
        pilots: Vec<(Recipe, u32)>,
        told: usize,
    }

    impl Curves {
        fn new(slowness: f64, light: f64) -> Self {
            let first_size = candidates()[1].recipe().settings.mesh.element_size.expect("a size");
            Self { slowness, light, scale: 100.0, first_size, clock: 0.0, reference: 0, pilots: Vec::new(), told: 0 }
        }

        /// Seconds of light and of a sample, bias and variance of a sample.
        fn of(&self, recipe: &Recipe) -> [f64; 4] {
            let turns = recipe.settings.mesh.element_size.map_or(1.0, |size| f64::from(self.first_size / size));
            let photons = f64::from(recipe.settings.photons.count) / 1e5;
            let [light, sample, bias, noise] = match recipe.way {
                Way::Reference => [0.0, 0.01, 0.0, TRACED],
                Way::RadiosityDirect if recipe.settings.solver == Solver::Southwell => {
                    [0.03 * turns.powf(2.2), 0.006, 0.09 / turns, 0.005]
                }
                Way::RadiosityDirect => [0.1 * turns.powf(2.2), 0.006, 0.09 / turns, 0.005],
                Way::FinalGather => [0.1 * photons, 0.05, 0.01 / photons.sqrt(), 0.2],
                _ => [0.0, 0.01, 0.3, 0.005],
            };
            [light * self.light * self.slowness, sample * self.slowness, bias, noise]
        }

        fn first_round(&self) -> f64 {
            let samples = candidates().iter().map(|candidate| self.of(&candidate.recipe())[1]).sum::<f64>();
            (samples + 0.01 * self.slowness) * REPLICATES / self.scale
        }
    }

    impl Laboratory for Curves {
        fn now(&self) -> f64 {
            self.clock
        }

        fn is_stopped(&self) -> bool {
            false
        }

        fn refine_reference(&mut self, samples: u32) {
            let fresh = f64::from(samples - self.reference);
            self.clock += 0.01 * self.slowness * REPLICATES * fresh / self.scale;
            self.reference = samples;
        }

        fn prepare(&mut self, recipe: &Recipe, seconds: f64) -> Option<(usize, f64)> {
            let [light, ..] = self.of(recipe);
            self.clock += light.min(seconds.max(0.0));
            (light <= seconds).then(|| {
                self.pilots.push((*recipe, 0));
                (self.pilots.len() - 1, light)
            })
        }

        /// The bias is known as well as differences of pairs tell, whose variance is that of both.
        fn sample(&mut self, pilot: usize, samples: u32) -> Option<Forecast> {
            let (recipe, taken) = self.pilots[pilot];
            let [_, sample_seconds, bias, noise] = self.of(&recipe);
            self.pilots[pilot].1 = samples;
            if recipe.way == Way::Reference {
                let parts = ErrorParts { noise, ..ErrorParts::default() };
                return Some(Forecast { parts, sample_seconds });
            }
            self.clock += sample_seconds * REPLICATES * f64::from(samples - taken) / self.scale;
            let variance = (noise + TRACED) / f64::from(samples) / REPLICATES;
            let bias_deviation = (2.0 * variance * variance + 4.0 * bias * bias * variance).sqrt() / PIXELS.sqrt();
            let parts = ErrorParts { bias: bias * bias, bias_deviation, noise };
            Some(Forecast { parts, sample_seconds })
        }

        fn tell(&mut self, _: &Recipe, _: Option<(&Recipe, Merit)>) {
            self.told += 1;
        }
    }

    fn candidates() -> Vec<Candidate> {
        let scene = Scene::open("empty-box").expect("a built-in scene");
        let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
        candidates::of(&world, &Settings::default(), None)
    }

    /// The winner, and when the race was over.
    fn race(lab: &mut Curves, targets: Targets) -> (Runner, f64) {
        let ranked = Race::new(lab, targets, candidates()).run();
        (ranked[0].clone(), lab.clock)
    }

    fn within(error: Option<f64>, end: f64) -> Targets {
        Targets { error, end, is_timed: true }
    }

    fn until(error: f64) -> Targets {
        Targets { error: Some(error), end: 300.0, is_timed: false }
    }

    /// Of the whole that it led to, or of what path tracing would have taken, which is all that is known before something better
    /// is found.
    #[test]
    fn searching_takes_a_third_of_the_whole_at_most_whatever_is_asked() {
        let timed = [1.0, 3.0, 10.0, 60.0].map(|end| [None, Some(0.05), Some(0.001)].map(|error| within(error, end)));
        let errors = [0.5, 0.1, 0.05, 0.02, 0.005].map(until);
        for slowness in [0.1, 1.0, 10.0] {
            for targets in timed.as_flattened().iter().chain(&errors) {
                let mut lab = Curves::new(slowness, 1.0);
                let (winner, now) = race(&mut lab, *targets);
                let whole = now + winner.forecast.picture_seconds(targets, now);
                let parts = ErrorParts { noise: TRACED, ..ErrorParts::default() };
                let traced = Forecast { parts, sample_seconds: 0.01 * slowness }.picture_seconds(targets, 0.0);
                let search = now - winner.light_seconds;
                // However little is wanted, each candidate is looked at once, and the least search is allowed.
                let least = LEAST + lab.first_round();
                let limit = whole.max(traced) / 3.0 + least;
                assert!(search <= limit, "{slowness} {targets:?}: {search} of {whole} s");
                assert!(lab.told >= lab.pilots.len(), "what is tried is told");
            }
        }
    }

    /// Both an error and a time: the least error in the time, and no less of it because the error cannot be had.
    #[test]
    fn an_error_that_cannot_be_had_in_the_time_costs_nothing() {
        for slowness in [0.1, 1.0, 10.0] {
            for end in [1.0, 3.0, 10.0, 60.0] {
                let [both, alone] = [Some(1e-4), None].map(|error| {
                    let targets = within(error, end);
                    let (winner, now) = race(&mut Curves::new(slowness, 1.0), targets);
                    let Merit::Leaves(left) = winner.forecast.own_merit(&targets, now, Attitude::Careful) else {
                        panic!("{slowness} {end}: nothing has an error of a hundredth of a percent")
                    };
                    left
                });
                assert_eq!(both, alone, "{slowness} {end}");
            }
        }
    }

    /// What is good enough soonest, as a look at the curves shows. Elements of a quarter of the first size have a bias of
    /// 2.25 % after 6.4 s, and a sample of 0.06 s reaches 5 %, for which path tracing takes 32 s. For 0.2 % it takes 1,975 s, and
    /// radiosity more.
    #[test]
    fn the_cheapest_that_is_good_enough_wins() {
        let way = |error| race(&mut Curves::new(1.0, 1.0), until(error)).0.recipe.way;
        assert_eq!([way(0.2), way(0.1)], [Way::RadiosityDirect; 2]);
        let (winner, _) = race(&mut Curves::new(10.0, 1.0), until(0.05));
        assert_eq!(winner.recipe.way, Way::RadiosityDirect);
        assert!(winner.forecast.parts.bias < 0.0081 * 0.3, "finer light than the first: {winner:?}");
        assert_eq!(way(0.002), Way::Reference);
    }

    /// Where little time is left, and light of the mesh would take all of it, paths are traced at once.
    #[test]
    fn near_the_end_the_picture_is_not_eaten_by_the_search() {
        let mut lab = Curves::new(1.0, 1000.0);
        let (winner, now) = race(&mut lab, within(Some(0.05), 0.5));
        assert_eq!(winner.recipe.way, Way::Reference);
        assert!(now <= 0.25 * 0.5 + lab.first_round(), "{now}");
    }
}
