//! How every run on a scene converged, kept for comparison.

use crate::methods::Settings;
use crate::solution::Progress;
use std::sync::Arc;
use std::time::Duration;

/// At most this many points are kept of a run; more are thinned out evenly.
const MAX_POINTS: usize = 1024;

/// A run and how it went.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Counts the runs on this scene, from 1.
    pub number: u32,
    pub settings: Settings,
    /// In the order of time.
    pub points: Vec<CurvePoint>,
}

/// Where a run stood at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    pub progress: Progress,
    pub seconds: f64,
}

/// The curves of all runs on one scene, the one under way last.
#[derive(Clone, Default)]
pub struct History {
    curves: Vec<Arc<Curve>>,
    started: u32,
}

impl History {
    /// All curves; each is immutable and shared.
    pub fn curves(&self) -> &[Arc<Curve>] {
        &self.curves
    }

    /// Begins the curve of a new run. A run that never moved leaves none.
    pub fn begin(&mut self, settings: &Settings) {
        if self.curves.last().is_some_and(|curve| curve.points.len() < 2) {
            self.curves.pop();
            self.started -= 1;
        }
        self.started += 1;
        self.curves.push(Arc::new(Curve { number: self.started, settings: *settings, points: Vec::new() }));
    }

    /// Adds a point to the curve under way.
    pub fn record(&mut self, progress: Progress, elapsed: Duration) {
        let Some(curve) = self.curves.last_mut().map(Arc::make_mut) else { return };
        let point = CurvePoint { progress, seconds: elapsed.as_secs_f64() };
        match curve.points.last_mut() {
            // Preparation costs time and rays, but moves no light.
            Some(last) if last.progress.steps == point.progress.steps => *last = point,
            _ => curve.points.push(point),
        }
        if curve.points.len() > MAX_POINTS {
            let newest = curve.points.len() - 1;
            let mut index = 0;
            curve.points.retain(|_| {
                let keep = index % 2 == 0 || index == newest;
                index += 1;
                keep
            });
        }
    }

    /// Takes over settings that changed without a new run.
    pub fn reconfigure(&mut self, settings: &Settings) {
        if let Some(curve) = self.curves.last_mut().map(Arc::make_mut) {
            curve.settings = *settings;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(history: &mut History, steps: u64) {
        history.record(Progress { steps, ..Progress::default() }, Duration::from_millis(steps));
    }

    #[test]
    fn long_runs_are_thinned_out_and_keep_their_ends() {
        let mut history = History::default();
        history.begin(&Settings::default());
        for steps in 0..10_000 {
            record(&mut history, steps);
        }
        let points = &history.curves()[0].points;
        assert!(points.len() <= MAX_POINTS && points.len() >= MAX_POINTS / 2);
        assert_eq!((points[0].progress.steps, points[points.len() - 1].progress.steps), (0, 9_999));
        assert!(points.windows(2).all(|pair| pair[0].progress.steps < pair[1].progress.steps));
    }

    #[test]
    fn runs_are_numbered_and_those_that_never_moved_leave_nothing() {
        let mut history = History::default();
        history.begin(&Settings::default());
        record(&mut history, 0);
        record(&mut history, 0);
        history.begin(&Settings::default());
        record(&mut history, 0);
        record(&mut history, 1);
        history.begin(&Settings::default());
        let numbers: Vec<u32> = history.curves().iter().map(|curve| curve.number).collect();
        assert_eq!(numbers, [1, 2]);
    }
}
