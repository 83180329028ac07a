//! Races on curves of cost and error, with a clock that goes on by what they cost and by nothing else.

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
    /// Samples, in each estimate.
    reference: f64,
    /// What the reference and the pilots took, s.
    reference_seconds: f64,
    pilot_seconds: f64,
    pilots: Vec<(Recipe, u32)>,
    told: usize,
}

impl Curves {
    fn new(slowness: f64, light: f64) -> Self {
        let first_size = candidates()[3].recipe().settings.mesh.element_size.expect("a size");
        Self {
            slowness,
            light,
            scale: 100.0,
            first_size,
            clock: 0.0,
            reference: 0.0,
            reference_seconds: 0.0,
            pilot_seconds: 0.0,
            pilots: Vec::new(),
            told: 0,
        }
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

    fn refine_reference(&mut self, samples: u32, seconds: f64) {
        let sample_seconds = 0.01 * self.slowness * REPLICATES / self.scale;
        let fresh = (f64::from(samples) - self.reference).max((seconds / sample_seconds).ceil());
        self.clock += sample_seconds * fresh;
        self.reference_seconds += sample_seconds * fresh;
        self.reference += fresh;
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
        let seconds = sample_seconds * REPLICATES * f64::from(samples - taken) / self.scale;
        self.clock += seconds;
        self.pilot_seconds += seconds;
        let variance = (noise / f64::from(samples) + TRACED / self.reference) / REPLICATES;
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

/// All pilots are held against it, so that its noise counts for each of them. What the last round of pilots took is still to come
/// when the race ends, which is half of all.
#[test]
fn the_reference_gets_as_much_time_as_all_pilots_together() {
    let mut lab = Curves::new(1.0, 1.0);
    race(&mut lab, within(None, 60.0));
    assert!(lab.reference_seconds > 0.45 * lab.pilot_seconds, "{} {}", lab.reference_seconds, lab.pilot_seconds);
}

/// Where little time is left, and light of the mesh would take all of it, paths are traced at once.
#[test]
fn near_the_end_the_picture_is_not_eaten_by_the_search() {
    let mut lab = Curves::new(1.0, 1000.0);
    let (winner, now) = race(&mut lab, within(Some(0.05), 0.5));
    assert_eq!(winner.recipe.way, Way::Reference);
    assert!(now <= 0.25 * 0.5 + lab.first_round(), "{now}");
}
