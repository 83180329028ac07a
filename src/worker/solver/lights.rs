//! Radiosity, photons and ambient light on the mesh: started, stepped and told of. Each has a run and a clock of its own, whichever is on show.

use super::{Light, Part, Solver};
use crate::effects::plan;
use crate::errors::with_causes;
use crate::methods::Step;
use crate::solution::{CameraView, PhotonSolution, Solution};
use crate::worker::going::Going;
use crate::worker::ray_price::seconds_per_ray;
use crate::worker::run::{OcclusionRun, PhotonRun, Run};
use crate::worker::workshop::Workshop;
use crate::worker::{LightKind, Refused};
use crate::world::World;
use std::sync::Arc;

impl<W: Workshop> Solver<W> {
    /// Runs the light on show, for so many steps or until it has converged.
    pub(super) fn go(&mut self, steps: Option<u64>) {
        let Some(kind) = self.subject().light().filter(|&kind| self.has_run(kind) && steps != Some(0)) else { return };
        self.going_mut(kind).go(steps);
        self.snapshot.error = None;
        self.publish();
    }

    pub(super) fn pause(&mut self) {
        let Some(kind) = self.subject().light().filter(|&kind| self.going(kind).is_running()) else { return };
        self.going_mut(kind).pause();
        self.publish_light(kind);
    }

    /// Starts the light on show over, paused, or the picture where there is no such light.
    pub(super) fn reset(&mut self) {
        let Some(world) = self.snapshot.world.clone() else { return };
        let kind = self.subject().light();
        if let Some(kind) = kind {
            self.going_mut(kind).pause();
            self.going_mut(kind).renew();
        }
        let started = match kind {
            Some(LightKind::Radiosity) => self.start_radiosity(world),
            Some(LightKind::Photons) => self.start_photons(&world),
            Some(LightKind::Occlusion) => {
                self.start_occlusion(&world);
                Ok(())
            }
            None => Ok(()),
        };
        match kind {
            Some(LightKind::Radiosity) => self.easel.forget(CameraView::needs_radiosity),
            Some(LightKind::Photons) => self.easel.forget(CameraView::needs_photons),
            Some(LightKind::Occlusion) => {}
            None => self.easel.clear(),
        }
        self.snapshot.error = started.err().map(|refused| with_causes(&refused));
        self.publish();
    }

    fn has_run(&self, kind: LightKind) -> bool {
        match kind {
            LightKind::Radiosity => self.radiosity.run.is_some(),
            LightKind::Photons => self.photons.run.is_some(),
            LightKind::Occlusion => self.occlusion.run.is_some(),
        }
    }

    /// Begins radiosity on a world; if it is refused, everything stays as it was.
    pub(super) fn start_radiosity(&mut self, world: Arc<World>) -> Result<(), Refused> {
        let is_same_world = self.snapshot.world.as_ref().is_some_and(|old| Arc::ptr_eq(old, &world));
        let settings = self.snapshot.settings;
        let is_kept = is_same_world && self.radiosity.run.as_mut().is_some_and(|run| run.restart(&settings));
        if is_kept {
            self.radiosity.restarted();
        } else {
            // Should the method panic before its first step, the world on show stays, and its light with it.
            let method = self.workshop.radiosity(&world, &settings)?;
            self.radiosity.begin(Run::of(method).with_clock(self.clock.clone()));
            self.judge.follow(&world);
            self.show_tracks();
            self.snapshot.plan = Some(Arc::new(plan(&world)));
            self.snapshot.seconds_per_ray = seconds_per_ray(&world);
            self.snapshot.world = Some(world);
        }
        self.look_again(is_same_world);
        self.history.begin(&settings);
        self.judge.tracks.begin(LightKind::Radiosity, &settings);
        if let Some(solution) = self.radiosity.run.as_ref().map(Run::solution) {
            self.record(solution);
        }
        Ok(())
    }

    /// Begins photons in the world on show; if they are refused, everything stays as it was.
    pub(super) fn start_photons(&mut self, world: &Arc<World>) -> Result<(), Refused> {
        self.at_work = Part::Light(LightKind::Photons);
        let method = self.workshop.photons(world, &self.snapshot.settings)?;
        self.photons.begin(PhotonRun::of(method).with_clock(self.clock.clone()));
        self.judge.tracks.begin(LightKind::Photons, &self.snapshot.settings);
        self.snapshot.trail = None;
        self.record_photons();
        Ok(())
    }

    /// Begins ambient occlusion on the mesh of the world on show.
    pub(super) fn start_occlusion(&mut self, world: &Arc<World>) {
        self.at_work = Part::Light(LightKind::Occlusion);
        let method = self.workshop.occlusion(world, &self.snapshot.settings);
        self.occlusion.begin(OcclusionRun::of(method).with_clock(self.clock.clone()));
        self.record_occlusion();
    }

    /// Begins light that is needed and is not there.
    pub(super) fn start_what_is_needed(&mut self) {
        self.start_photons_if_needed();
        let Light { run, going, .. } = &self.occlusion;
        let is_needed = self.subject().light() == Some(LightKind::Occlusion) || going.is_running();
        let is_there = run.is_some() || *going == Going::Crashed;
        if let Some(world) = self.snapshot.world.clone().filter(|_| is_needed && !is_there) {
            self.start_occlusion(&world);
        }
    }

    /// Says so where photons are refused.
    fn start_photons_if_needed(&mut self) {
        let Light { run, going, .. } = &self.photons;
        let is_needed = self.subject().light() == Some(LightKind::Photons) || going.is_running();
        let is_there = run.is_some() || *going == Going::Crashed;
        let Some(world) = self.snapshot.world.clone().filter(|_| is_needed && !is_there) else { return };
        if let Err(refused) = self.start_photons(&world) {
            self.photons.going.pause();
            self.snapshot.error = Some(with_causes(&refused));
        }
    }

    /// One step of a light, whether it is on show or not.
    pub(super) fn step(&mut self, kind: LightKind) {
        self.at_work = Part::Light(kind);
        let cancel = self.mailbox.step_cancel();
        let step = match kind {
            LightKind::Radiosity => self.radiosity.run.as_mut().map(|run| run.step(cancel)),
            LightKind::Photons => self.photons.run.as_mut().map(|run| run.step(cancel)),
            LightKind::Occlusion => self.occlusion.run.as_mut().map(|run| run.step(cancel)),
        };
        let Some(step) = step.filter(|&step| step != Step::Cancelled) else { return };
        let is_counted = self.going(kind).is_counted() && step != Step::Prepared;
        if step == Step::Advanced {
            match kind {
                LightKind::Radiosity => {
                    self.radiosity.steps += 1;
                    if let Some(run) = &self.radiosity.run {
                        self.history.record(run.progress(), run.elapsed());
                    }
                }
                LightKind::Photons => {
                    self.photons.steps += 1;
                    let is_whole = self.photons.run.as_ref().is_some_and(|run| run.progress().is_complete);
                    if is_whole && self.snapshot.settings.photons.is_progressive {
                        self.count_pass();
                    }
                }
                LightKind::Occlusion => self.occlusion.steps += 1,
            }
        }
        self.going_mut(kind).note(step);
        if is_counted || !self.going(kind).is_running() || self.is_due() {
            self.publish_light(kind);
        }
    }

    pub(super) fn record(&mut self, solution: Solution) {
        self.history.record(solution.progress(), solution.elapsed);
        self.snapshot.curves = self.history.curves().to_vec();
        self.snapshot.solution = Some(Arc::new(solution));
        self.picks.outdate();
    }

    pub(super) fn record_photons(&mut self) {
        let Some(solution) = self.photons.run.as_mut().map(PhotonRun::solution) else { return };
        let old = self.snapshot.photons.replace(Arc::new(solution));
        // A trail is of a photon that is still there.
        if old.map(|old| pass(&old)) != self.snapshot.photons.as_deref().map(pass) {
            self.snapshot.trail = None;
        }
        self.look_into_estimate();
    }

    pub(super) fn record_occlusion(&mut self) {
        if let Some(run) = &self.occlusion.run {
            self.snapshot.occlusion = Some(Arc::new(run.solution()));
        }
    }

    fn publish_light(&mut self, kind: LightKind) {
        if !self.going(kind).is_running() {
            // It may be complete now.
            self.show_picture();
        }
        match kind {
            LightKind::Radiosity => {
                if let Some(solution) = self.radiosity.run.as_ref().map(Run::solution) {
                    self.record(solution);
                }
            }
            LightKind::Photons => self.record_photons(),
            LightKind::Occlusion => self.record_occlusion(),
        }
        self.publish();
    }
}

/// Which pass of photons is under way or was just finished, from 0.
fn pass(photons: &PhotonSolution) -> u64 {
    photons.passes - u64::from(photons.is_complete)
}
