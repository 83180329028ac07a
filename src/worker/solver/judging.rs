//! How far off the lights are: measured while they run as far as that does not hold them up, and in full when they rest.

use super::{Part, Solver, Task};
use crate::accuracy::by_radiosity;
use crate::solution::Solution;
use crate::worker::LightKind;
use crate::worker::run::PhotonRun;
use crate::worker::workshop::{PhotonMethod, Workshop};
use std::time::Duration;

/// While the truth gets better known, snapshots are at least this far apart.
const PUBLISH_INTERVAL: Duration = Duration::from_millis(250);

impl<W: Workshop> Solver<W> {
    /// What there is to measure, for as long as nothing waits for it.
    pub(super) fn judging_to_do(&self, is_busy: bool) -> Option<Task> {
        self.snapshot.world.as_ref().filter(|world| world.census.light_may_arrive)?;
        if self.is_hushed || self.judge.is_given_up || is_busy && !self.judge.may_interrupt() {
            return None;
        }
        let measured = [LightKind::Radiosity, LightKind::Photons].into_iter().find(|&kind| self.is_measure_due(kind));
        match measured {
            Some(kind) => Some(Task::Measure(kind)),
            None if is_busy => self.judge.needs_more().then_some(Task::Refine),
            None => self.judge.wants_more().then_some(Task::Refine),
        }
    }

    /// What is measured is what was published last.
    fn is_measure_due(&self, kind: LightKind) -> bool {
        let knows_truth = self.judge.truth().is_some_and(|truth| truth.floor.is_finite());
        let elapsed = match kind {
            LightKind::Radiosity => self.snapshot.solution.as_ref().map(|solution| solution.elapsed),
            LightKind::Photons => self.photons.run.as_ref().filter(|_| self.photons.steps > 0).map(PhotonRun::elapsed),
            LightKind::Occlusion => None,
        };
        let is_resting = !self.going(kind).is_running();
        let is_due = |elapsed: Duration| self.judge.tracks.is_due(kind, elapsed.as_secs_f64(), is_resting);
        knows_truth && elapsed.is_some_and(is_due)
    }

    /// Holds what a light has found against the truth.
    pub(super) fn measure(&mut self, kind: LightKind) {
        self.at_work = Part::Truth;
        let (Some(world), Some(reference)) = (&self.snapshot.world, self.judge.reference()) else { return };
        let points = reference.points();
        let measured = match kind {
            LightKind::Radiosity => self.snapshot.solution.as_ref().map(|solution| {
                let Solution { elapsed, .. } = **solution;
                (elapsed, by_radiosity(world, solution, points, self.snapshot.settings.seed))
            }),
            LightKind::Photons => self.photons.run.as_mut().map(|run| (run.elapsed(), run.method().irradiance(points))),
            LightKind::Occlusion => None,
        };
        let (Some((elapsed, found)), Some(truth)) = (measured, self.judge.truth().cloned()) else { return };
        self.judge.tracks.record(kind, elapsed.as_secs_f64(), found, &truth);
        self.show_tracks();
        self.publish();
    }

    /// Makes the truth better known, or begins to.
    pub(super) fn refine(&mut self) {
        self.at_work = Part::Truth;
        let Some(world) = self.snapshot.world.clone() else { return };
        if self.judge.reference().is_none() {
            self.judge.turn_to(self.workshop.reference(&world));
        }
        if self.judge.is_given_up {
            return;
        }
        self.judge.refine(self.mailbox.step_cancel());
        self.show_tracks();
        if self.clock.since(self.published) >= PUBLISH_INTERVAL || !self.judge.wants_more() {
            self.publish();
        }
    }

    /// Does this on account: where nothing else is at work, nothing is held up.
    pub(super) fn on_account(&mut self, judge: impl FnOnce(&mut Self)) {
        let is_busy = self.next_of_light().is_some();
        let start = self.clock.now();
        judge(self);
        if is_busy {
            self.judge.spend(self.clock.since(start).as_secs_f64());
        }
    }

    /// Every pass of progressive photons has its part in their mean.
    pub(super) fn count_pass(&mut self) {
        let Some(reference) = self.judge.reference() else { return };
        let start = self.clock.now();
        if let Some(run) = &mut self.photons.run {
            run.method().count_pass(reference.points());
        }
        self.judge.spend(self.clock.since(start).as_secs_f64());
    }

    pub(super) fn show_tracks(&mut self) {
        self.snapshot.tracks = self.judge.tracks.measured();
        self.snapshot.truth = self.judge.truth().cloned();
    }
}
