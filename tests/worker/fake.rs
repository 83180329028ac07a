//! A method whose steps do what a test says.

use lightwell::cancel::Cancel;
use lightwell::math::rgb::Rgb;
use lightwell::methods::{Method, Settings, Step};
use lightwell::solution::{Closure, Counters, ElementLight, Energy, Solution};
use lightwell::worker::{StartMethod, Worker};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What a step does, given the number of steps before it.
type Work = dyn Fn(u64, &Cancel) -> Step + Send + Sync;

struct Fake {
    work: Arc<Work>,
    steps: u64,
    seed: u64,
    elements: usize,
}

impl Method for Fake {
    fn step(&mut self, cancel: &Cancel) -> Step {
        let step = (self.work)(self.steps, cancel);
        self.steps += u64::from(step == Step::Advanced);
        step
    }

    fn configure(&mut self, settings: &Settings) -> bool {
        settings.seed == self.seed
    }

    fn solution(&self) -> Solution {
        let light = vec![Rgb::ZERO; self.elements];
        Solution {
            steps: self.steps,
            elapsed: Duration::ZERO,
            converged: false,
            energy: Energy::default(),
            closure: Closure::default(),
            counters: Counters::default(),
            shooter: None,
            light: ElementLight { irradiance: light.clone(), radiosity: light.clone(), unshot: light },
            ..Solution::default()
        }
    }
}

/// A worker whose method does this work in every step.
pub fn worker(work: impl Fn(u64, &Cancel) -> Step + Send + Sync + 'static) -> Worker {
    Worker::spawn_with(method(work), || ())
}

/// The method itself, for a worker of one's own.
pub fn method(work: impl Fn(u64, &Cancel) -> Step + Send + Sync + 'static) -> Box<StartMethod> {
    let work: Arc<Work> = Arc::new(work);
    Box::new(move |world, settings| {
        let elements = world.mesh.elements.len();
        Ok(Box::new(Fake { work: work.clone(), steps: 0, seed: settings.seed, elements }))
    })
}

/// A step that takes a second, unless it is told to stop.
pub fn long_step(_: u64, cancel: &Cancel) -> Step {
    step_of(Duration::from_secs(1), cancel)
}

/// A step that is over at once.
pub fn short_step(_: u64, cancel: &Cancel) -> Step {
    step_of(Duration::from_micros(100), cancel)
}

fn step_of(duration: Duration, cancel: &Cancel) -> Step {
    let start = Instant::now();
    while start.elapsed() < duration {
        if cancel.is_requested() {
            return Step::Cancelled;
        }
        std::thread::sleep(Duration::from_micros(100));
    }
    Step::Advanced
}
