//! From a wish to a recipe: the cheapest light that is as accurate as is wanted, or the most accurate in the time allowed.
//!
//! What was measured on this scene before is tried first. Else each family of recipes is tried where it is cheap; how its errors
//! and times change from one member to the next says which is to be tried next, and how finely.

use super::attempt::{CannotTry, Outcome, Price, Verdict, attempt};
use super::bench::Bench;
use super::budget::{Budget, Prediction};
use super::family::{Family, LEVEL, Tried, families};
use super::memory::{Known, Memory};
use super::not_found::NotFound;
use super::progress::SearchProgress;
use super::recipe::Recipe;
use crate::accuracy::{Error, Truth};
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::methods::Settings;
use std::time::{Duration, Instant};

/// An error counts as reached when what was measured is below this share of it: light is measured at a thousand points, and
/// meant everywhere.
const SAFE: f64 = 0.9;
/// Of the time that is left, what the next attempt may be expected to take: expectations are off by a third.
const CAREFUL: f64 = 0.7;
/// The truth is to be known to this share of the error that is wanted: at a thousand points that leaves the error uncertain by
/// 5 %.
const FLOOR: f64 = 1.2;
/// Share of the time allowed, or of the time that an attempt is expected to take, in which the truth is looked for; and in any
/// case, where nothing limits the time.
const TRUTH: f64 = 0.1;
const LEAST_TRUTH: Duration = Duration::from_millis(300);
/// The same of an attempt before there is anything to fall back on, and what an attempt may take that nothing is known of.
const SMALL_PART: f64 = 0.2;
/// What an attempt aims at, in what is safe.
const AIM: f64 = 0.95;

/// What was found.
pub struct SearchResult {
    pub outcome: Outcome,
    pub error: Error,
    pub prediction: Prediction,
}

/// Looks for light that meets the budget; the best there is where it cannot be met. `tell` hears how far it is.
///
/// # Errors
/// If there is no light, or no way to compute it came to an end.
pub fn seek(
    bench: &mut Bench,
    settings: &Settings,
    budget: &Budget,
    cancel: &Cancel,
    tell: &mut dyn FnMut(&SearchProgress),
) -> Result<SearchResult, NotFound> {
    if !bench.world().census.light_may_arrive {
        return Err(NotFound::without_light(bench.world()));
    }
    let start = Instant::now();
    let end = budget.end_from(start);
    let mut search = Search { settings, budget, start, end, cancel, tell, best: None, refusal: None };
    search.look_at_truth(bench, 0.0);
    if bench.reference.truth().is_dark() {
        return Err(NotFound::without_light(bench.world()));
    }
    if let Some(known) = search.known(&bench.memory) {
        let prediction = Prediction { error: Some(known.error), seconds: Some(known.seconds) };
        search.follow(bench, &known.recipe, prediction, end);
    }
    let mut families = families(bench, settings);
    for family in &mut families {
        family.remember(&bench.memory);
    }
    while !search.is_over(bench) {
        let Some((family, turns)) = search.choose(&families) else { break };
        let family = &mut families[family];
        let (recipe, prediction) = (family.recipe(turns, budget.error.is_some()), family.prediction(turns));
        search.look_at_truth(bench, prediction.seconds.unwrap_or_default());
        if search.is_over(bench) {
            break;
        }
        let end = search.end_of_attempt(family.tried.is_empty());
        match search.follow(bench, &recipe, prediction, end) {
            Some((recipe, tried)) => family.note(family.turns_to(&recipe), Some(tried)),
            None => family.note(turns, None),
        }
    }
    if budget.error.is_none() {
        search.tell("measuring the error");
        bench.refine_until(end, cancel);
    }
    search.result(bench)
}

/// The state of a search.
struct Search<'a> {
    settings: &'a Settings,
    budget: &'a Budget,
    start: Instant,
    /// When it must be over.
    end: Instant,
    cancel: &'a Cancel,
    tell: &'a mut dyn FnMut(&SearchProgress),
    /// With its error, as it was measured then.
    best: Option<(Outcome, Prediction, f64)>,
    /// Why the last recipe that could not be followed could not.
    refusal: Option<CannotTry>,
}

impl Search<'_> {
    /// Seconds that the next attempt may be expected to take: where all is to be had from the time, a small part as long as
    /// there is nothing to fall back on.
    fn affordable(&self) -> f64 {
        let part = if self.budget.error.is_none() && self.best.is_none() { SMALL_PART } else { CAREFUL };
        part * self.end.saturating_duration_since(Instant::now()).as_secs_f64()
    }

    /// A truth that is good enough to tell whether light is, or as good as a part of the time allows; where only the error that
    /// is wanted ends the search, of the time that the next attempt is expected to take.
    fn look_at_truth(&mut self, bench: &mut Bench, expected: f64) {
        let allowed = if self.budget.end.is_some() {
            self.start + (self.end - self.start).mul_f64(TRUTH)
        } else {
            Instant::now() + Duration::from_secs_f64(TRUTH * expected.min(3600.0)).max(LEAST_TRUTH)
        };
        let floor = self.budget.error.map_or(0.0, |error| FLOOR * error);
        let is_enough = |truth: &Truth| truth.floor <= floor || truth.is_dark();
        let is_known = |truth: &Truth| truth.floor.is_finite() || truth.is_dark();
        let has_time = |truth: &Truth| Instant::now() < allowed || !is_known(truth);
        while !is_enough(bench.reference.truth()) && has_time(bench.reference.truth()) {
            self.tell("tracing the reference");
            if !bench.reference.refine(self.cancel) {
                return;
            }
        }
    }

    fn tell(&mut self, doing: &str) {
        let best = self.best_in_words();
        (self.tell)(&SearchProgress { doing: doing.to_owned(), best });
    }

    fn best_in_words(&self) -> Option<String> {
        let (outcome, _, error) = self.best.as_ref()?;
        Some(format!("{}, an error of {:.2} %", outcome.recipe.way_in_words(), 100.0 * error))
    }

    /// What was measured before and is safe to begin with: the cheapest that meets it, or the best that takes a small
    /// part of the time.
    fn known(&self, memory: &Memory) -> Option<Known> {
        let Settings { seed, effects, .. } = *self.settings;
        let runs = memory.runs().filter(|known| {
            let is_same = Settings { seed, effects, ..known.recipe.settings } == known.recipe.settings;
            known.recipe.way.is_everywhere() && is_same
        });
        let known = match self.budget.error {
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

    /// Whether the error that is wanted is met, or time is up.
    fn is_over(&self, bench: &Bench) -> bool {
        let is_met = self.budget.error.is_some_and(|wanted| {
            let best = self.best.as_ref().and_then(|(best, ..)| bench.reference.truth().error(&best.found));
            best.is_some_and(|best| meets(&best, wanted))
        });
        is_met || Instant::now() >= self.end || self.cancel.is_requested()
    }

    /// The family that is expected to come to what is wanted at the least price, and how many turns of its knob are to be taken.
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
        let wanted = match self.budget.error {
            Some(error) => (AIM * SAFE * error / last.error).ln() / family.decay().min(LEVEL).ln(),
            None => affordable,
        };
        let turns = family.rounded(wanted, affordable)?;
        let rank = match self.budget.error {
            Some(_) => last.all_seconds * family.growth().powf(wanted),
            None => last.error * family.decay().powf(turns),
        };
        let best = self.best.as_ref().map(|(_, _, error)| *error);
        let gains = self.budget.error.is_some() || best.is_none_or(|best| rank < LEVEL * best);
        gains.then_some((turns, rank))
    }

    /// When an attempt is given up: one that nothing is known of must leave most of the time allowed to others.
    fn end_of_attempt(&self, is_first: bool) -> Instant {
        if is_first && self.budget.error.is_none() {
            let now = Instant::now();
            return now + self.end.saturating_duration_since(now).mul_f64(SMALL_PART);
        }
        self.end
    }

    /// Follows a recipe until its end or until the error that is wanted is met; what came of it at last, if anything did, with
    /// the recipe as it came out.
    fn follow(
        &mut self,
        bench: &mut Bench,
        recipe: &Recipe,
        prediction: Prediction,
        end: Instant,
    ) -> Option<(Recipe, Tried)> {
        let start = Instant::now();
        let truth = bench.reference.truth().clone();
        let wanted = self.budget.error;
        let best = self.best_in_words();
        let tell = &mut self.tell;
        let doing = format!("trying {}", recipe.label());
        tell(&SearchProgress { doing: doing.clone(), best: best.clone() });
        let mut last: Option<(Outcome, Error)> = None;
        let followed = attempt(bench, recipe, end, self.cancel, &mut |outcome| {
            let Some(error) = truth.error(&outcome.found) else { return Verdict::Continue(()) };
            let is_met = wanted.is_some_and(|wanted| meets(&error, wanted));
            let doing = format!("{doing}: {} so far", error.in_words());
            tell(&SearchProgress { doing, best: best.clone() });
            last = Some((outcome, error));
            if is_met { Verdict::Break(()) } else { Verdict::Continue(()) }
        });
        if let Err(reason) = followed {
            log::info!("{}: {}", recipe.options(), with_causes(&reason));
            self.refusal = Some(reason);
        }
        let Some((outcome, error)) = last else {
            log::info!(
                "nothing in {:.2} s, expected {prediction:?}: {}",
                start.elapsed().as_secs_f64(),
                recipe.options()
            );
            return None;
        };
        bench.memory.note(outcome.recipe, &outcome.price, error.rms);
        let Price { seconds, all_seconds, .. } = outcome.price;
        log::info!("{:.4} in {all_seconds:.2} s, expected {prediction:?}: {}", error.rms, outcome.recipe.options());
        let tried = Tried { seconds, all_seconds, error: error.rms, is_finished: outcome.is_finished };
        let is_better = self.best.as_ref().is_none_or(|(.., best)| error.rms < *best);
        let recipe = outcome.recipe;
        if is_better {
            self.best = Some((outcome, prediction, error.rms));
        }
        Some((recipe, tried))
    }

    fn result(self, bench: &Bench) -> Result<SearchResult, NotFound> {
        let Some((outcome, prediction, _)) = self.best else { return Err(NotFound::after(self.refusal)) };
        let error = bench.reference.truth().error(&outcome.found);
        let error = error.ok_or_else(|| NotFound::without_light(bench.world()))?;
        Ok(SearchResult { outcome, error, prediction })
    }
}

/// Whether an error is surely small enough.
fn meets(error: &Error, wanted: f64) -> bool {
    error.rms + error.uncertainty <= SAFE * wanted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshSettings;
    use crate::scene::Scene;
    use crate::world::World;
    use std::sync::Arc;

    #[test]
    fn a_search_says_what_it_tries_and_the_best_so_far() {
        let scene = Scene::open("empty-box").expect("a built-in scene");
        let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
        let mut bench = Bench::open(Arc::new(world), MeshSettings::default(), None);
        let mut told: Vec<SearchProgress> = Vec::new();
        // Nothing has so small an error at the first attempt, so each family is tried.
        let budget = Budget { error: Some(0.04), end: None };
        let found = seek(&mut bench, &Settings::default(), &budget, &Cancel::default(), &mut |news| {
            told.push(news.clone());
        });
        assert!(found.expect("light").error.rms <= 0.04);
        for doing in ["tracing the reference", "trying Radiosity", "trying Photon map"] {
            assert!(told.iter().any(|news| news.doing.starts_with(doing)), "{doing}: {told:?}");
        }
        assert!(told[0].best.is_none() && told.iter().any(|news| news.best.is_some()), "{told:?}");
    }
}
