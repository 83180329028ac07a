//! From a wish to a recipe: the cheapest light that is as accurate as is wanted, or the most accurate in the time allowed.
//!
//! What was measured on this scene before is tried first. Else each family of recipes is tried where it is cheap; how its errors
//! and times change from one member to the next says which is to be tried next, and how finely.

use super::attempt::{CannotTry, Outcome, Price, Verdict, attempt};
use super::bench::Bench;
use super::memory::{Known, Memory};
use super::not_found::NotFound;
use super::recipe::{Recipe, Way};
use crate::accuracy::{Error, Truth};
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::mesh::MeshSettings;
use crate::methods::{PhotonSettings, Settings, Solver};
use std::time::{Duration, Instant};

/// An error counts as reached when what was measured is below this share of it: light is measured at a thousand points, and
/// meant everywhere.
const SAFE: f64 = 0.9;
/// Of the time that is left, what the next attempt may be expected to take: expectations are off by a third.
const CAREFUL: f64 = 0.7;
/// Share of the time allowed in which the truth is looked for before anything else.
const FIRST_TRUTH: f64 = 0.1;
/// An attempt is at most so many turns of its knob beyond what was tried before.
const MOST_TURNS: f64 = 2.0;
/// Fewer turns of a knob are not worth an attempt.
const LEAST_TURNS: f64 = 0.25;
/// A family whose errors fall by less than this from one turn to the next has come to its bias.
const LEVEL: f64 = 0.97;
/// Longest edge of an element to begin with, in those of the automatic mesh.
const COARSE: f32 = 4.0;
/// The same of an attempt before there is anything to fall back on, and what an attempt may take that nothing is known of.
const SMALL_PART: f64 = 0.2;
/// What an attempt aims at, in what is safe.
const AIM: f64 = 0.95;
/// When a search without a limit is given up.
const LONGEST: Duration = Duration::from_secs(300);
/// Photons of a pass.
const PHOTONS: u32 = 100_000;

/// What is wanted. One of the two, at least, or both.
#[derive(Clone, Copy, Debug)]
pub struct Goal {
    /// As a share of the mean irradiance.
    pub error: Option<f64>,
    /// When it must be over.
    pub end: Option<Instant>,
}

/// What was expected of a recipe when it was chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Promise {
    /// As a share of the mean irradiance; `None` where nothing was known.
    pub error: Option<f64>,
    /// Of the solver.
    pub seconds: Option<f64>,
}

/// What was found.
pub struct Sought {
    pub outcome: Outcome,
    pub error: Error,
    pub promise: Promise,
}

/// Looks for light that meets the goal; the best there is where the goal cannot be met.
///
/// # Errors
/// If there is no light, or no way to compute it came to an end.
pub fn seek(bench: &mut Bench, settings: &Settings, goal: &Goal, cancel: &Cancel) -> Result<Sought, NotFound> {
    let start = Instant::now();
    let end = goal.end.unwrap_or(start + LONGEST);
    let mut search = Search { settings, goal, end, cancel, best: None, refusal: None };
    search.look_at_truth(bench, start);
    if bench.reference.truth().is_dark() {
        return Err(NotFound::Dark);
    }
    if let Some(known) = search.known(&bench.memory) {
        let promise = Promise { error: Some(known.error), seconds: Some(known.seconds) };
        search.follow(bench, &known.recipe, promise, end);
    }
    let mut families = families(bench, settings);
    for family in &mut families {
        family.remember(&bench.memory);
    }
    while !search.is_over(bench) {
        let Some((family, turns)) = search.choose(&families) else { break };
        let promise = families[family].promise(turns);
        let recipe = families[family].recipe(turns);
        let end = search.end_of_attempt(families[family].tried.is_empty());
        let tried = search.follow(bench, &recipe, promise, end);
        families[family].note(turns, tried);
    }
    if goal.error.is_none() {
        bench.refine_until(end, cancel);
    }
    search.sought(bench)
}

/// The state of a search.
struct Search<'a> {
    settings: &'a Settings,
    goal: &'a Goal,
    /// When it must be over.
    end: Instant,
    cancel: &'a Cancel,
    /// With its error, as it was measured then.
    best: Option<(Outcome, Promise, f64)>,
    /// Why the last recipe that could not be followed could not.
    refusal: Option<CannotTry>,
}

impl Search<'_> {
    /// Seconds that the next attempt may be expected to take: where all is to be had from the time, a small part as long as
    /// there is nothing to fall back on.
    fn affordable(&self) -> f64 {
        let part = if self.goal.error.is_none() && self.best.is_none() { SMALL_PART } else { CAREFUL };
        part * self.end.saturating_duration_since(Instant::now()).as_secs_f64()
    }

    /// A truth that is twice as good as what is wanted of the light, or as good as a part of the time allows.
    fn look_at_truth(&self, bench: &mut Bench, start: Instant) {
        let allowed = start + self.end.saturating_duration_since(start).mul_f64(FIRST_TRUTH);
        let floor = self.goal.error.map_or(0.0, |error| error / 2.0);
        let is_enough = |truth: &Truth| truth.floor <= floor || truth.is_dark();
        let is_known = |truth: &Truth| truth.floor.is_finite() || truth.is_dark();
        let has_time = |truth: &Truth| Instant::now() < allowed || !is_known(truth);
        while !is_enough(bench.reference.truth()) && has_time(bench.reference.truth()) {
            if !bench.reference.refine(self.cancel) {
                return;
            }
        }
    }

    /// What was measured before and is safe to begin with: the cheapest that meets the goal, or the best that takes a small
    /// part of the time.
    fn known(&self, memory: &Memory) -> Option<Known> {
        let Settings { seed, effects, .. } = *self.settings;
        let runs = memory.runs().filter(|known| {
            let is_same = Settings { seed, effects, ..known.recipe.settings } == known.recipe.settings;
            known.recipe.way.is_everywhere() && is_same
        });
        let known = match self.goal.error {
            Some(wanted) => {
                let good = runs.filter(|known| known.error <= SAFE * wanted && known.all_seconds <= self.affordable());
                good.min_by(|a, b| a.all_seconds.total_cmp(&b.all_seconds))
            }
            None => {
                let quick = runs.filter(|known| known.all_seconds <= self.affordable());
                quick.min_by(|a, b| a.error.total_cmp(&b.error))
            }
        };
        known.copied()
    }

    /// Whether the goal is met, or time is up.
    fn is_over(&self, bench: &Bench) -> bool {
        let is_met = self.goal.error.is_some_and(|wanted| {
            let best = self.best.as_ref().and_then(|(best, ..)| bench.reference.truth().error(&best.found));
            best.is_some_and(|best| meets(&best, wanted))
        });
        is_met || Instant::now() >= self.end || self.cancel.is_requested()
    }

    /// The family that is expected to come to the goal at the least price, and how many turns of its knob are to be taken.
    fn choose(&self, families: &[Family]) -> Option<(usize, f64)> {
        let is_open = |family: &Family| !family.is_given_up;
        if let Some(fresh) = families.iter().position(|family| family.tried.is_empty() && is_open(family)) {
            return Some((fresh, 0.0));
        }
        let open = families.iter().enumerate().filter(|(_, family)| is_open(family));
        let ranked = open.filter_map(|(index, family)| {
            let (turns, rank) = self.prospect(family)?;
            Some((index, turns, rank))
        });
        ranked.min_by(|a, b| a.2.total_cmp(&b.2)).map(|(index, turns, _)| (index, turns))
    }

    /// How many turns a family is to take, and what counts in the end: the price of the error that is wanted, or the error
    /// that the time allows. `None` where it has nothing more to offer.
    fn prospect(&self, family: &Family) -> Option<(f64, f64)> {
        let last = family.tried.last()?;
        let affordable = (self.affordable() / last.all_seconds).ln() / family.growth().ln();
        let wanted = match self.goal.error {
            Some(error) => (AIM * SAFE * error / last.error).ln() / family.decay().min(LEVEL).ln(),
            None => affordable,
        };
        let turns = family.rounded(wanted, affordable)?;
        let rank = match self.goal.error {
            Some(_) => last.all_seconds * family.growth().powf(wanted),
            None => last.error * family.decay().powf(turns),
        };
        let best = self.best.as_ref().map(|(_, _, error)| *error);
        let gains = self.goal.error.is_some() || best.is_none_or(|best| rank < LEVEL * best);
        gains.then_some((turns, rank))
    }

    /// When an attempt is given up: one that nothing is known of must leave most of the time allowed to others.
    fn end_of_attempt(&self, is_first: bool) -> Instant {
        if is_first && self.goal.error.is_none() {
            let now = Instant::now();
            return now + self.end.saturating_duration_since(now).mul_f64(SMALL_PART);
        }
        self.end
    }

    /// Follows a recipe until its end or until the goal is met; what came of it at last, if anything did.
    fn follow(&mut self, bench: &mut Bench, recipe: &Recipe, promise: Promise, end: Instant) -> Option<Tried> {
        let start = Instant::now();
        let truth = bench.reference.truth().clone();
        let wanted = self.goal.error;
        let mut last: Option<(Outcome, Error)> = None;
        let followed = attempt(bench, recipe, end, self.cancel, &mut |outcome| {
            let Some(error) = truth.error(&outcome.found) else { return Verdict::Continue(()) };
            let is_met = wanted.is_some_and(|wanted| meets(&error, wanted));
            last = Some((outcome, error));
            if is_met { Verdict::Break(()) } else { Verdict::Continue(()) }
        });
        if let Err(reason) = followed {
            log::info!("{}: {}", recipe.options(), with_causes(&reason));
            self.refusal = Some(reason);
        }
        let Some((outcome, error)) = last else {
            log::info!("nothing in {:.2} s, expected {promise:?}: {}", start.elapsed().as_secs_f64(), recipe.options());
            return None;
        };
        bench.memory.note(outcome.recipe, &outcome.price, error.rms);
        let Price { seconds, all_seconds, .. } = outcome.price;
        log::info!("{:.4} in {all_seconds:.2} s, expected {promise:?}: {}", error.rms, outcome.recipe.options());
        let tried = Tried { seconds, all_seconds, error: error.rms, is_finished: outcome.is_finished };
        let is_better = self.best.as_ref().is_none_or(|(.., best)| error.rms < *best);
        if is_better {
            self.best = Some((outcome, promise, error.rms));
        }
        Some(tried)
    }

    fn sought(self, bench: &Bench) -> Result<Sought, NotFound> {
        let Some((outcome, promise, _)) = self.best else { return Err(NotFound::after(self.refusal)) };
        let error = bench.reference.truth().error(&outcome.found).ok_or(NotFound::Dark)?;
        Ok(Sought { outcome, error, promise })
    }
}

/// Whether an error is surely small enough.
fn meets(error: &Error, wanted: f64) -> bool {
    error.rms + error.uncertainty <= SAFE * wanted
}

/// Recipes that differ in one knob: each turn of it costs more and leaves less of the error.
struct Family {
    first: Recipe,
    /// What a turn does before it was tried: to the time, and to the error.
    expected: [f64; 2],
    /// Turns of the last attempt from the first, and what came of attempts.
    turns: f64,
    tried: Vec<Tried>,
    /// Whether the last of them was tried now, and not before.
    is_tried_now: bool,
    is_given_up: bool,
}

/// What came of an attempt.
#[derive(Clone, Copy, Debug)]
struct Tried {
    /// Of the solver.
    seconds: f64,
    /// From the cutting of the mesh to the measuring of the error.
    all_seconds: f64,
    error: f64,
    is_finished: bool,
}

/// Light that is everywhere: radiosity by shooting, and with all form factors kept, on finer and finer meshes; and photons, pass
/// by pass.
fn families(bench: &Bench, settings: &Settings) -> Vec<Family> {
    let size = Some(COARSE * bench.world().element_size);
    let coarse = Settings { mesh: MeshSettings { element_size: size, ..settings.mesh }, ..*settings };
    let passes =
        PhotonSettings { count: PHOTONS, caustic_count: PHOTONS, is_progressive: true, passes: 1, ..settings.photons };
    let family = |way, settings, expected| Family {
        first: Recipe { way, settings },
        expected,
        turns: 0.0,
        tried: Vec::new(),
        is_tried_now: false,
        is_given_up: false,
    };
    vec![
        family(Way::Radiosity, coarse, [4.5, 0.5]),
        family(Way::Radiosity, Settings { solver: Solver::Southwell, ..coarse }, [4.5, 0.5]),
        family(Way::PhotonMap, Settings { photons: passes, ..*settings }, [2.0, 0.75]),
    ]
}

impl Family {
    /// The member so many turns beyond the last that was tried.
    fn recipe(&self, turns: f64) -> Recipe {
        let Recipe { way, settings } = self.first;
        let all = self.turns + turns;
        let settings = match way {
            Way::Radiosity => {
                let size = settings.mesh.element_size.map(|size| size * 0.5_f32.powf(all as f32));
                Settings { mesh: MeshSettings { element_size: size, ..settings.mesh }, ..settings }
            }
            _ => {
                let passes = all.exp2().round() as u32;
                Settings { photons: PhotonSettings { passes, ..settings.photons }, ..settings }
            }
        };
        Recipe { way, settings }
    }

    /// Turns to be taken, of so many that are wanted and can be afforded: for photons whole ones. `None` where that is next to
    /// nothing, and known already.
    fn rounded(&self, wanted: f64, affordable: f64) -> Option<f64> {
        let is_continuous = self.first.way == Way::Radiosity;
        // What one turn brings is not known before there were two attempts.
        let most = if self.tried.len() < 2 { 1.0 } else { MOST_TURNS };
        let turns = if is_continuous { wanted.min(affordable) } else { wanted.ceil().min(affordable.floor()) };
        let turns = turns.min(most).max(-self.turns);
        let least = if is_continuous { LEAST_TURNS } else { 1.0 };
        (turns.abs() >= least || !self.is_tried_now).then_some(turns)
    }

    /// Takes over what is known of its members from before, the cheapest first.
    fn remember(&mut self, memory: &Memory) {
        let mut members: Vec<(f64, Tried)> = memory.runs().filter_map(|known| self.member(known)).collect();
        members.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (turns, tried) in members {
            if turns >= self.turns {
                self.note(turns - self.turns, Some(tried));
            }
        }
        // A bias that was come to may be all there is to be had.
        (self.is_given_up, self.is_tried_now) = (false, false);
    }

    /// How many turns from the first one a known recipe is, if it belongs to the family.
    fn member(&self, known: &Known) -> Option<(f64, Tried)> {
        let (of_family, settings) = (self.first.settings, known.recipe.settings);
        let (turns, same) = match self.first.way {
            Way::Radiosity => {
                let turns = f64::from(of_family.mesh.element_size? / settings.mesh.element_size?).log2();
                (turns, Settings { mesh: of_family.mesh, ..settings })
            }
            _ => (
                f64::from(settings.photons.passes).log2(),
                Settings { photons: PhotonSettings { passes: 1, ..settings.photons }, ..settings },
            ),
        };
        let tried =
            Tried { seconds: known.seconds, all_seconds: known.all_seconds, error: known.error, is_finished: true };
        let is_member = known.recipe.way == self.first.way && same == of_family && turns >= 0.0;
        is_member.then_some((turns, tried))
    }

    /// What so many turns are expected to come to.
    fn promise(&self, turns: f64) -> Promise {
        let Some(last) = self.tried.last() else { return Promise { error: None, seconds: None } };
        Promise {
            error: Some(last.error * self.decay().powf(turns)),
            seconds: Some(last.seconds * self.growth().powf(turns)),
        }
    }

    /// By how much a turn lengthens the time.
    fn growth(&self) -> f64 {
        // What it costs to begin hides how fast pairs of smaller elements grow in number: in the end sixteenfold.
        let least = match self.first.way {
            Way::Radiosity if self.first.settings.solver.needs_matrix() => 10.0,
            Way::Radiosity => 7.0,
            _ => 1.5,
        };
        self.expected[0].clamp(least, 16.0)
    }

    /// What share of the error a turn leaves.
    fn decay(&self) -> f64 {
        self.expected[1].clamp(0.2, 1.0)
    }

    /// Takes note of what came of so many turns, and expects the same of the next.
    fn note(&mut self, turns: f64, tried: Option<Tried>) {
        let Some(tried) = tried.filter(|tried| tried.is_finished) else {
            self.is_given_up = true;
            return;
        };
        if let Some(last) = self.tried.last().filter(|_| turns.abs() >= LEAST_TURNS) {
            let a_turn = |ratio: f64| ratio.powf(1.0 / turns);
            self.expected = [a_turn(tried.all_seconds / last.all_seconds), a_turn(tried.error / last.error)];
            // Nothing is left to be gained by more of the same.
            self.is_given_up = self.expected[1] > LEVEL;
        }
        self.turns += turns;
        self.is_tried_now = true;
        self.tried.push(tried);
    }
}
