//! A search for settings, or a study, on a thread of its own.

use super::bench::Bench;
use super::memory::Memory;
use super::recipe::Recipe;
use super::seek::{Goal, Promise, Sought, seek};
use super::sweep::{Progress, Study, study};
use crate::accuracy::{Cache, CacheError, Error, Reference};
use crate::cancel::Cancel;
use crate::errors::with_causes;
use crate::methods::Settings;
use crate::worker::in_background;
use crate::world::World;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
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

/// What is known of the answer.
#[derive(Clone, Debug)]
pub struct Answer {
    pub question: Question,
    /// What is being done, in words; `None` when all is done.
    pub doing: Option<String>,
    /// What was found, at last.
    pub found: Option<Choice>,
    pub study: Option<Arc<Study>>,
    /// Whether all was done and there is no light.
    pub is_dark: bool,
}

/// A recipe that was chosen, and how far off its light was when it was tried.
#[derive(Clone, Copy, Debug)]
pub struct Choice {
    pub recipe: Recipe,
    pub error: Error,
    /// Of the solver.
    pub seconds: f64,
    pub promise: Promise,
}

/// An answer in the making. Dropping it cancels what is left of the work, without waiting.
pub struct Inquiry {
    cancel: Cancel,
    latest: Arc<Mutex<Arc<Answer>>>,
}

impl Inquiry {
    /// Starts to look for an answer about a world. `wake` is called from the thread whenever more is known of it.
    pub fn spawn(
        question: Question,
        world: Arc<World>,
        settings: Settings,
        cache: Option<Cache>,
        wake: impl Fn() + Send + 'static,
    ) -> Self {
        let doing = Some("opening the scene".to_owned());
        let answer = Answer { question, doing, found: None, study: None, is_dark: false };
        let latest = Arc::new(Mutex::new(Arc::new(answer.clone())));
        let cancel = Cancel::default();
        let work = Work { cancel: cancel.clone(), latest: latest.clone(), answer, cache, wake };
        let thread = std::thread::Builder::new().name("inquiry".to_owned());
        thread.spawn(move || in_background(|| work.answer(world, &settings))).expect("the system can start a thread");
        Self { cancel, latest }
    }

    /// What is known now. Never waits.
    pub fn latest(&self) -> Arc<Answer> {
        lock(&self.latest).clone()
    }
}

impl Drop for Inquiry {
    fn drop(&mut self) {
        self.cancel.request();
    }
}

fn lock(latest: &Mutex<Arc<Answer>>) -> MutexGuard<'_, Arc<Answer>> {
    latest.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What the thread owns.
struct Work<W> {
    cancel: Cancel,
    latest: Arc<Mutex<Arc<Answer>>>,
    answer: Answer,
    cache: Option<Cache>,
    wake: W,
}

impl<W: Fn()> Work<W> {
    fn answer(mut self, world: Arc<World>, settings: &Settings) {
        let start = Instant::now();
        let reference = match &self.cache {
            Some(cache) => Reference::from_cache(world.clone(), cache),
            None => Reference::new(world.clone()),
        };
        let key = *reference.key();
        let mut memory = self.cache.as_ref().map(|cache| Memory::load(cache, &key)).unwrap_or_default();
        let mut bench = Bench::new(world, settings.mesh, reference);
        self.tell("trying");
        match self.answer.question {
            Question::Error(error) => {
                self.seek(&mut bench, settings, &Goal { error: Some(error), end: None }, &mut memory);
            }
            Question::Time(time) => {
                self.seek(&mut bench, settings, &Goal { error: None, end: Some(start + time) }, &mut memory);
            }
            Question::Study(budget) => self.study(&mut bench, settings, [start, start + budget], &mut memory),
        }
        if let Some(cache) = &self.cache {
            let kept: Result<(), CacheError> = bench.reference.keep(cache).and_then(|()| memory.store(cache, &key));
            if let Err(error) = kept {
                log::warn!("{}", with_causes(&error));
            }
        }
        self.answer.doing = None;
        self.publish();
    }

    fn seek(&mut self, bench: &mut Bench, settings: &Settings, goal: &Goal, memory: &mut Memory) {
        match seek(bench, settings, goal, memory, &self.cancel) {
            Some(Sought { outcome, error, promise }) => {
                let seconds = outcome.seconds;
                self.answer.found = Some(Choice { recipe: outcome.recipe, error, seconds, promise });
            }
            None => self.answer.is_dark = true,
        }
    }

    fn study(&mut self, bench: &mut Bench, settings: &Settings, span: [Instant; 2], memory: &mut Memory) {
        let cancel = self.cancel.clone();
        let study = study(bench, settings, span, &cancel, &mut |Progress { done, of, recipe }| {
            let what = recipe.map_or("the reference".to_owned(), Recipe::label);
            self.tell(&format!("{done} of {of}: {what}"));
        });
        memory.note_all(&study.measured);
        self.answer.is_dark = study.measured.is_empty();
        self.answer.study = Some(Arc::new(study));
    }

    fn tell(&mut self, doing: &str) {
        self.answer.doing = Some(doing.to_owned());
        self.publish();
    }

    fn publish(&self) {
        *lock(&self.latest) = Arc::new(self.answer.clone());
        (self.wake)();
    }
}
