//! A search for settings, or a study, on a thread of its own.

use super::bench::Bench;
use super::budget::{Budget, Prediction};
use super::not_found::NotFound;
use super::progress::SearchProgress;
use super::recipe::Recipe;
use super::seek::{SearchResult, seek};
use super::sweep::{Progress, Study, study};
use crate::accuracy::{Cache, Error};
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::mesh::MeshSettings;
use crate::methods::Settings;
use crate::worker::{Background, Desk};
use crate::world::World;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Question {
    /// The cheapest light whose error is at most this share of the mean irradiance.
    Error(f64),
    /// The most accurate light within this time.
    Time(Duration),
    /// What accuracy costs, in so much time.
    Study(Duration),
}

impl Question {
    /// The error that is wanted, as a share of the mean irradiance.
    pub fn error(self) -> Option<f64> {
        if let Self::Error(error) = self { Some(error) } else { None }
    }

    /// The time that light may take.
    pub fn time(self) -> Option<Duration> {
        if let Self::Time(time) = self { Some(time) } else { None }
    }
}

/// What is known of the answer.
#[derive(Clone, Debug)]
pub struct Answer {
    pub question: Question,
    pub state: State,
}

#[derive(Clone, Debug)]
pub enum State {
    /// What is being done, in words.
    Doing(String),
    Found(Arc<Choice>),
    Studied(Arc<Study>),
    /// There is no light.
    Dark,
    /// It stopped, for this reason.
    Failed(String),
}

/// A recipe that was chosen, and how far off its light was when it was tried.
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    pub recipe: Recipe,
    pub error: Error,
    /// Of the solver.
    pub seconds: f64,
    pub prediction: Prediction,
}

impl Answer {
    /// Whether more of it is on its way.
    pub fn is_awaited(&self) -> bool {
        matches!(self.state, State::Doing(_))
    }
}

/// An answer in the making. Dropping it cancels what is left of the work, without waiting.
pub struct Inquiry(Background<Answer>);

impl Inquiry {
    /// Starts to look for an answer about the scene of a world, whatever its mesh, with these seed and effects and defaults else.
    /// `wake` is called from the thread whenever more is known of it.
    pub fn spawn(
        question: Question,
        world: Arc<World>,
        settings: &Settings,
        cache: Option<Cache>,
        wake: impl Fn() + Send + 'static,
    ) -> Self {
        let settings = Settings { seed: settings.seed, effects: settings.effects, ..Settings::default() };
        let first = Answer { question, state: State::Doing("opening the scene".to_owned()) };
        Self(Background::spawn("inquiry", first, wake, move |desk| {
            let work = || answer(question, &world, &settings, cache, desk);
            let state = catch_unwind(AssertUnwindSafe(work));
            let state = state.unwrap_or_else(|_| State::Failed("a fault of the program".to_owned()));
            desk.publish(Answer { question, state });
        }))
    }

    /// What is known now. Never waits.
    pub fn latest(&self) -> Arc<Answer> {
        self.0.latest()
    }
}

fn answer(question: Question, world: &World, settings: &Settings, cache: Option<Cache>, desk: &Desk<Answer>) -> State {
    let start = Instant::now();
    let mesh = MeshSettings::default();
    let opened = match world.remeshed(&mesh, &desk.cancel) {
        Ok(world) => Arc::new(world),
        Err(reason) => return State::Failed(with_causes(&reason)),
    };
    let mut bench = Bench::open(opened, mesh, cache);
    let mut told = String::new();
    // Every word wakes the window: the same one only once.
    let mut tell = |doing: String| {
        if doing != told {
            desk.publish(Answer { question, state: State::Doing(doing.clone()) });
            told = doing;
        }
    };
    let state = match question {
        Question::Error(error) => {
            let budget = Budget { error: Some(error), end: None };
            found(&mut bench, settings, &budget, &desk.cancel, &mut |progress| tell(progress.to_string()))
        }
        Question::Time(time) => {
            let budget = Budget { error: None, end: Some(start + time) };
            found(&mut bench, settings, &budget, &desk.cancel, &mut |progress| tell(progress.to_string()))
        }
        Question::Study(budget) => {
            let span = [start, start + budget];
            let study = study(&mut bench, settings, span, &desk.cancel, &mut |Progress { done, of, recipe }| {
                let what = recipe.map_or("the reference".to_owned(), Recipe::label);
                tell(format!("{done} of {of}: {what}"));
            });
            let is_dark = !bench.world().census.light_may_arrive || bench.reference.truth().is_dark();
            if !study.measured.is_empty() {
                State::Studied(Arc::new(study))
            } else if is_dark {
                State::Dark
            } else {
                State::Failed(NotFound::NoTime.to_string())
            }
        }
    };
    // Whoever asks for something else has no more need of it, and may be writing already.
    if !desk.cancel.is_requested()
        && let Err(error) = bench.keep()
    {
        log::warn!("{}", with_causes(&error));
    }
    state
}

fn found(
    bench: &mut Bench,
    settings: &Settings,
    budget: &Budget,
    cancel: &Cancel,
    tell: &mut dyn FnMut(&SearchProgress),
) -> State {
    match seek(bench, settings, budget, cancel, tell) {
        Ok(SearchResult { outcome, error, prediction }) => {
            let seconds = outcome.price.seconds;
            State::Found(Arc::new(Choice { recipe: outcome.recipe, error, seconds, prediction }))
        }
        Err(NotFound::Dark | NotFound::Unlit | NotFound::DarkPoints) => State::Dark,
        Err(reason) => State::Failed(with_causes(&reason)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::Solver;
    use crate::scene::Scene;

    /// The end of an inquiry about a scene that is cut as someone has set it.
    fn end(scene: &str, question: Question) -> State {
        let scene = Scene::open(scene).expect("a built-in scene");
        let coarse = MeshSettings { element_size: Some(0.5), ..MeshSettings::default() };
        let world = Arc::new(World::build(scene, &coarse, &Cancel::default()).expect("a world"));
        let settings = Settings { mesh: coarse, solver: Solver::Jacobi, ..Settings::default() };
        let inquiry = Inquiry::spawn(question, world, &settings, None, || ());
        let start = Instant::now();
        loop {
            let answer = inquiry.latest();
            if !answer.is_awaited() {
                return answer.state.clone();
            }
            assert!(start.elapsed() < Duration::from_secs(300), "{answer:?}");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    #[test]
    fn an_error_is_reached_whatever_the_settings_are() {
        let State::Found(choice) = end("empty-box", Question::Error(0.15)) else { panic!("nothing was found") };
        assert!(choice.error.rms <= 0.15 && choice.seconds > 0.0, "{choice:?}");
        assert_ne!(choice.recipe.settings.solver, Solver::Jacobi);
        let applied = choice.recipe.applied_to(&Settings { seed: 0, ..Settings::default() });
        assert_eq!(applied.image, Settings::default().image);
    }

    #[test]
    fn without_light_that_is_the_answer() {
        assert!(matches!(end("ao-study", Question::Error(0.1)), State::Dark));
        assert!(matches!(end("ao-study", Question::Study(Duration::from_secs(5))), State::Dark));
    }
}
