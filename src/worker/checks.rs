//! The gallery of hard cases on a thread of its own.

use super::background::{Background, Desk};
use crate::hard_cases::{Case, Row, cases};
use std::sync::Arc;

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
pub struct Checks(Background<CheckReport>);

impl Checks {
    /// Starts the run. `wake` is called from its thread after every new report.
    pub fn spawn(wake: impl Fn() + Send + 'static) -> Self {
        Self::spawn_with(cases().collect(), wake)
    }

    /// The same with other cases.
    pub fn spawn_with(cases: Vec<&'static Case>, wake: impl Fn() + Send + 'static) -> Self {
        Self(Background::spawn("checks", CheckReport::default(), wake, |desk| run_all(cases, desk)))
    }

    /// The newest report. Never waits for a case.
    pub fn latest(&self) -> Arc<CheckReport> {
        self.0.latest()
    }
}

fn run_all(cases: Vec<&'static Case>, desk: &Desk<CheckReport>) {
    let mut report = CheckReport::default();
    for case in cases {
        report.running = Some(case.name);
        desk.publish(report.clone());
        let Some(rows) = case.run(&desk.cancel) else { return };
        report.rows.extend(rows);
    }
    report.running = None;
    report.is_finished = true;
    desk.publish(report);
}
