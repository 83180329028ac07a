//! Pictures from the camera: begun, exposed and told of. They are made without being asked for, also while their light
//! is paused, and made anew when it has grown.

use super::easel::{Amount, Next, Picture, Source};
use super::{Light, Part, Solver};
use crate::clock::Stopwatch;
use crate::methods::{ImageSettings, Settings, Step};
use crate::solution::{CameraImage, CameraView};
use crate::worker::going::Going;
use crate::worker::run::{PhotonRun, Run};
use crate::worker::workshop::{CameraShot, Lights, PhotonMethod, Workshop};
use crate::worker::{Sight, Snapshot};
use std::sync::Arc;

/// A picture that is to be worked on.
pub(super) struct ToDo {
    next: Next,
    /// Whether it cannot wait for its light: nothing has been shown from where the camera is, or the light goes on to
    /// another pass.
    pub is_urgent: bool,
}

impl<W: Workshop> Solver<W> {
    /// Turns to what is on show now.
    pub(super) fn look(&mut self, sight: Sight) {
        let old = self.sight.replace(sight);
        if old == Some(sight) {
            return;
        }
        if old.is_none_or(|old| old.subject != sight.subject) {
            self.lead = 0.0;
        }
        self.easel.has_crashed = false;
        self.picks.outdate();
        self.start_what_is_needed();
        if let Some(shot) = self.shot() {
            self.easel.look(&shot);
            // A view that was looked at from here before is there at once.
            self.show_picture();
        }
        self.publish();
    }

    fn shot(&self) -> Option<CameraShot> {
        let Sight { subject, camera, size } = self.sight?;
        let view = subject.view().filter(|_| self.snapshot.world.is_some() && !size.contains(&0))?;
        Some(CameraShot { view, camera, size })
    }

    /// What there is to do on the picture on show, if there is anything.
    pub(super) fn picture_to_do(&self) -> Option<ToDo> {
        let shot = self.shot().filter(|_| !self.easel.has_crashed)?;
        let source = self.source(shot.view)?;
        let Some(picture) = self.easel.picture(shot.view) else {
            return Some(ToDo { next: Next::Begin, is_urgent: true });
        };
        let next = picture.next(&source, self.snapshot.settings.image.samples_of(shot.view));
        let is_urgent = picture.is_first() || source.amount.is_whole_pass;
        (next != Next::Nothing).then_some(ToDo { next, is_urgent })
    }

    /// The light that a view is read off; `None` where there is none of its kind.
    fn source(&self, view: CameraView) -> Option<Source> {
        if view.needs_photons() {
            let progress = self.photons.run.as_ref()?.progress();
            let going = self.photons.going;
            Some(Source {
                amount: Amount {
                    start: self.photons.starts,
                    pass: progress.passes - u64::from(progress.is_complete),
                    count: progress.batches,
                    is_whole_pass: progress.is_complete && self.snapshot.settings.photons.is_progressive,
                },
                is_growing: going.is_running(),
                is_done: going == Going::Converged,
            })
        } else if view.needs_radiosity() {
            self.radiosity.run.as_ref()?;
            let amount = Amount { start: self.radiosity.starts, count: self.radiosity.steps, ..Amount::default() };
            Some(Source { amount, is_growing: self.radiosity.going.is_running(), is_done: false })
        } else {
            Some(Source::default())
        }
    }

    /// One step of the picture on show.
    pub(super) fn work_on_picture(&mut self) {
        self.at_work = Part::Picture;
        let (Some(shot), Some(ToDo { next, .. })) = (self.shot(), self.picture_to_do()) else { return };
        let Some(source) = self.source(shot.view) else { return };
        match next {
            Next::Begin => self.begin_picture(shot, source.amount),
            Next::GoOn => self.go_on_with_picture(&shot, source.amount),
            Next::Nothing | Next::Expose => {}
        }
        let Some(picture) = self.easel.picture_mut(shot.view) else { return };
        if picture.step(self.mailbox.step_cancel()) == Step::Cancelled {
            return;
        }
        let is_first = picture.is_first();
        if (is_first || self.is_due() || self.picture_to_do().is_none()) && self.show_picture() {
            self.publish();
        }
    }

    fn begin_picture(&mut self, shot: CameraShot, amount: Amount) {
        let watch = Stopwatch::new(self.clock.clone());
        if let Some(image) = self.easel.moved_to(&shot, amount) {
            return self.easel.begin(shot, image, amount, watch);
        }
        let settings = self.snapshot.settings;
        // How many samples it gets is decided from step to step.
        let image = ImageSettings { samples: ImageSettings::MAX_SAMPLES, ..settings.image };
        self.record_source(shot.view);
        let Some(lights) = lights(&self.snapshot, &mut self.photons, shot.view) else { return };
        let image = self.workshop.image(lights, &shot, &Settings { image, ..settings });
        self.easel.begin(shot, image, amount, watch);
    }

    fn go_on_with_picture(&mut self, shot: &CameraShot, amount: Amount) {
        self.record_source(shot.view);
        let Some(lights) = lights(&self.snapshot, &mut self.photons, shot.view) else { return };
        if let Some(picture) = self.easel.picture_mut(shot.view) {
            self.workshop.go_on(picture.go_on(amount), lights);
        }
    }

    /// A radiosity solution is handed out when it is published; a picture is made of the newest.
    fn record_source(&mut self, view: CameraView) {
        let run = self.radiosity.run.as_ref().filter(|_| view.needs_radiosity());
        if let Some(solution) = run.map(Run::solution) {
            self.record(solution);
        }
    }

    /// Puts the picture on show into the snapshot, if there is one that should take the place of what is there.
    pub(super) fn show_picture(&mut self) -> bool {
        let Some(shot) = self.shot() else { return false };
        let is_growing = self.source(shot.view).is_some_and(|source| source.is_growing);
        let is_complete = !is_growing && self.picture_to_do().is_none();
        let Some(image) = self.easel.picture_mut(shot.view).and_then(Picture::publish) else { return false };
        self.snapshot.image = Some(Arc::new(CameraImage { is_complete, ..image }));
        true
    }
}

/// What pictures of a view are read off; `None` without a world.
fn lights<'a, P: PhotonMethod>(
    snapshot: &'a Snapshot,
    photons: &'a mut Light<PhotonRun<P>>,
    view: CameraView,
) -> Option<Lights<'a, P>> {
    Some(Lights {
        world: snapshot.world.as_ref()?,
        radiosity: snapshot.solution.clone().filter(|_| view.needs_radiosity()),
        photons: photons.run.as_mut().filter(|_| view.needs_photons()).map(PhotonRun::method),
    })
}
