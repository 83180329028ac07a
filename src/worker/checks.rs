//! The gallery of hard cases on a thread of its own.

use super::pool;
use crate::cancel::Cancel;
use crate::hard_cases::{Case, Row, cases};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// How far the checks are.
#[derive(Clone, Debug, Default)]
pub struct CheckReport {
    /// Of all cases that are done, in the order of the gallery.
    pub rows: Vec<Row>,
    /// The case that is being run; `None` before the first and after the last.
    pub running: Option<&'static str>,
    pub is_finished: bool,
}

/// A run of all hard cases in the background. Dropping it cancels what is left of it, without waiting.
pub struct Checks {
    cancel: Cancel,
    latest: Arc<Mutex<Arc<CheckReport>>>,
}

impl Checks {
    /// Starts the run. `wake` is called from its thread after every new report.
    pub fn spawn(wake: impl Fn() + Send + 'static) -> Self {
        Self::spawn_with(cases().collect(), wake)
    }

    /// The same with other cases.
    pub fn spawn_with(cases: Vec<&'static Case>, wake: impl Fn() + Send + 'static) -> Self {
        let (cancel, latest) = (Cancel::default(), Arc::<Mutex<Arc<CheckReport>>>::default());
        let run = Run { cancel: cancel.clone(), latest: latest.clone(), wake };
        let thread = std::thread::Builder::new().name("checks".to_owned());
        thread.spawn(|| pool::in_background(|| run.all(cases))).expect("the system can start a thread");
        Self { cancel, latest }
    }

    /// The newest report. Never waits for a case.
    pub fn latest(&self) -> Arc<CheckReport> {
        lock(&self.latest).clone()
    }
}

impl Drop for Checks {
    fn drop(&mut self) {
        self.cancel.request();
    }
}

fn lock(latest: &Mutex<Arc<CheckReport>>) -> MutexGuard<'_, Arc<CheckReport>> {
    latest.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What the thread owns.
struct Run<W> {
    cancel: Cancel,
    latest: Arc<Mutex<Arc<CheckReport>>>,
    wake: W,
}

impl<W: Fn()> Run<W> {
    fn all(self, cases: Vec<&'static Case>) {
        let mut report = CheckReport::default();
        for case in cases {
            report.running = Some(case.name);
            self.publish(&report);
            let Some(rows) = case.run(&self.cancel) else { return };
            report.rows.extend(rows);
        }
        report.running = None;
        report.is_finished = true;
        self.publish(&report);
    }

    fn publish(&self, report: &CheckReport) {
        *lock(&self.latest) = Arc::new(report.clone());
        (self.wake)();
    }
}
