//! The loop of the solver thread: what is done next, and what is told of it.

mod easel;
mod judging;
mod lights;
mod picks;
mod pictures;
mod scenes;

use super::going::Going;
use super::history::History;
use super::judge::Judge;
use super::mailbox::{Mail, Mailbox};
use super::run::{OcclusionRun, PhotonRun, Run};
use super::workshop::Workshop;
use super::{Command, LightKind, Phase, Sight, Slot, Snapshot, Spot, Subject};
use crate::clock::Clock;
use crate::errors::with_causes;
use crate::scene::Scene;
use crate::solution::CameraView;
use easel::Easel;
use picks::Picks;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// While running, snapshots are at least this far apart: 30 a second are as many as anyone sees.
const PUBLISH_INTERVAL: Duration = Duration::from_millis(33);

/// Share of the time that holding a picture against the truth takes from the light on show while that runs: who looks at errors
/// wants to see them fall. Other pictures take as much time as their light.
const COMPARING: f64 = 0.04;

/// The state of the thread.
pub struct Solver<W: Workshop> {
    mailbox: Arc<Mailbox>,
    slot: Arc<Slot>,
    workshop: W,
    clock: Clock,
    /// What was published last; its parts are shared with whoever looks at it.
    snapshot: Snapshot,
    /// The scene that is being read, if one is.
    loading: Option<String>,
    sight: Option<Sight>,
    radiosity: Light<Run>,
    photons: Light<PhotonRun<W::Photons>>,
    occlusion: Light<OcclusionRun>,
    easel: Easel<W::Image>,
    history: History,
    /// What is picked in the light on surfaces.
    picks: Picks,
    judge: Judge,
    /// Whether measuring waits for something else.
    is_hushed: bool,
    /// Where the estimate from photons is looked into.
    spot: Option<Spot>,
    /// By how much longer the light on show was worked on than the picture that is read off it is worth, since both wanted to be.
    lead: f64,
    /// What is being worked on: if it panics, it alone is given up.
    at_work: Part,
    published: Instant,
}

/// A light and whether it is worked on.
struct Light<R> {
    run: Option<R>,
    going: Going,
    /// Counts how often it started from the emitters.
    starts: u64,
    /// Steps since then that brought it further.
    steps: u64,
}

impl<R> Light<R> {
    fn begin(&mut self, run: R) {
        self.run = Some(run);
        self.restarted();
    }

    fn restarted(&mut self) {
        self.starts += 1;
        self.steps = 0;
    }
}

impl<R> Default for Light<R> {
    fn default() -> Self {
        Self { run: None, going: Going::default(), starts: 0, steps: 0 }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    Light(LightKind),
    Picture,
    Picks,
    Truth,
}

/// What there is to do without a command.
enum Task {
    LookFrom(u32),
    Equation,
    Light(LightKind),
    Picture,
    /// Says how far off a light is.
    Measure(LightKind),
    /// Makes the truth better known, which lights are held against.
    Refine,
}

impl<W: Workshop> Solver<W> {
    pub fn new(mailbox: Arc<Mailbox>, slot: Arc<Slot>, workshop: W, clock: Clock) -> Self {
        Self {
            published: clock.now(),
            mailbox,
            slot,
            workshop,
            clock,
            snapshot: Snapshot::default(),
            loading: None,
            sight: None,
            radiosity: Light::default(),
            photons: Light::default(),
            occlusion: Light::default(),
            easel: Easel::default(),
            history: History::default(),
            picks: Picks::default(),
            judge: Judge::default(),
            is_hushed: false,
            spot: None,
            lead: 0.0,
            at_work: Part::Light(LightKind::Radiosity),
        }
    }

    /// Serves until the mailbox is closed. A panic of a method ends its run, not the thread.
    pub fn serve(mut self) {
        loop {
            let task = self.next_task();
            self.at_work = Part::Light(LightKind::Radiosity);
            let work = match (self.mailbox.take(task.is_none()), task) {
                (Mail::Closed, _) => return,
                (Mail::Command(command), _) => catch_unwind(AssertUnwindSafe(|| self.apply(command))),
                (Mail::Empty, Some(task)) => catch_unwind(AssertUnwindSafe(|| self.work(task))),
                (Mail::Empty, None) => Ok(()),
            };
            if let Err(panic) = work {
                self.crash(&*panic);
            }
        }
    }

    fn apply(&mut self, command: Command) {
        match command {
            Command::Load(name) => self.load(&name, || Scene::open(&name).map_err(|error| with_causes(&error))),
            Command::Show(shown) => self.load(&shown.0.name, || Ok(Scene::clone(&shown.0))),
            Command::AddCeilingLight => self.add_ceiling_light(),
            Command::Configure(settings) => self.configure(settings),
            Command::Run => self.go(None),
            Command::Step(steps) => self.go(Some(steps)),
            Command::Pause => self.pause(),
            Command::Reset => self.reset(),
            Command::Pick(place) => self.pick(place),
            Command::PickSource(place) => self.pick_source(place),
            Command::PickPhoton(photon) => self.pick_photon(photon),
            Command::Gather(spot) => self.gather(spot),
            Command::Look(sight) => self.look(sight),
            Command::Hush(is_hushed) => self.is_hushed = is_hushed,
        }
    }

    /// What a person waits for comes first, and measuring when nothing else is to be done, or on account.
    fn next_task(&mut self) -> Option<Task> {
        if let Some(patch) = self.patch_to_look_from() {
            return Some(Task::LookFrom(patch));
        }
        if self.is_equation_due() {
            return Some(Task::Equation);
        }
        let task = self.next_of_light();
        let is_urgent = self.picture_to_do().is_some_and(|picture| picture.is_urgent);
        let judging = if is_urgent { None } else { self.judging_to_do(task.is_some()) };
        judging.or(task)
    }

    /// What is on show comes first: its picture and its light by turns, the first coarse picture before its light. Then the
    /// lights go on that are not on show.
    fn next_of_light(&mut self) -> Option<Task> {
        let light = self.subject().light().filter(|&kind| self.going(kind).is_running());
        let picture = self.picture_to_do();
        if picture.is_none() || light.is_none() {
            self.lead = 0.0;
        }
        match (light, picture) {
            (Some(kind), None) => Some(Task::Light(kind)),
            (Some(kind), Some(picture)) if !picture.is_urgent && self.lead < 0.0 => Some(Task::Light(kind)),
            (_, Some(_)) => Some(Task::Picture),
            (None, None) => LightKind::ALL.into_iter().find(|&kind| self.going(kind).is_running()).map(Task::Light),
        }
    }

    fn work(&mut self, task: Task) {
        let start = self.clock.now();
        let weight = match task {
            Task::LookFrom(patch) => return self.look_from(patch),
            Task::Equation => return self.look_into_equation(),
            Task::Measure(kind) => return self.on_account(|solver| solver.measure(kind)),
            Task::Refine => return self.on_account(Self::refine),
            Task::Light(kind) => {
                self.step(kind);
                1.0
            }
            Task::Picture => {
                self.work_on_picture();
                let is_comparison = self.subject().view().is_some_and(CameraView::is_comparison);
                if is_comparison { 1.0 - 1.0 / COMPARING } else { -1.0 }
            }
        };
        let seconds = self.clock.since(start).as_secs_f64();
        self.judge.earn(seconds);
        self.lead += weight * seconds;
    }

    fn subject(&self) -> Subject {
        self.sight.map_or_else(Subject::default, |sight| sight.subject)
    }

    fn going(&self, kind: LightKind) -> Going {
        match kind {
            LightKind::Radiosity => self.radiosity.going,
            LightKind::Photons => self.photons.going,
            LightKind::Occlusion => self.occlusion.going,
        }
    }

    fn going_mut(&mut self, kind: LightKind) -> &mut Going {
        match kind {
            LightKind::Radiosity => &mut self.radiosity.going,
            LightKind::Photons => &mut self.photons.going,
            LightKind::Occlusion => &mut self.occlusion.going,
        }
    }

    /// Of the light on show. What is found by rays from the camera alone runs until its picture is done.
    fn phase(&mut self) -> Phase {
        if let Some(name) = &self.loading {
            return Phase::Loading(name.clone());
        }
        let going = match self.subject().light() {
            Some(kind) => self.going(kind),
            None if self.easel.has_crashed => Going::Crashed,
            None if self.picture_to_do().is_some() => Going::Running { steps_left: None },
            None => Going::Converged,
        };
        if self.snapshot.world.is_none() && going != Going::Crashed { Phase::Empty } else { going.phase() }
    }

    /// Gives up what panicked and tells why. All else stays and goes on.
    fn crash(&mut self, panic: &(dyn Any + Send)) {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
        let what = match self.at_work {
            Part::Light(LightKind::Radiosity) => {
                self.radiosity.run = None;
                self.radiosity.going = Going::Crashed;
                "solver"
            }
            Part::Light(LightKind::Photons) => {
                self.photons.run = None;
                self.photons.going = Going::Crashed;
                "photon map"
            }
            Part::Light(LightKind::Occlusion) => {
                self.occlusion.run = None;
                self.occlusion.going = Going::Crashed;
                "ambient occlusion"
            }
            Part::Truth => {
                self.judge.is_given_up = true;
                "measuring of errors"
            }
            Part::Picture => {
                self.easel.clear();
                self.easel.has_crashed = true;
                "picture from the camera"
            }
            Part::Picks => {
                self.forget_picked();
                "look at what is picked"
            }
        };
        self.loading = None;
        self.snapshot.error = Some(format!("the {what} stopped: {text}"));
        self.publish();
    }

    fn is_due(&self) -> bool {
        self.clock.since(self.published) >= PUBLISH_INTERVAL
    }

    fn publish(&mut self) {
        self.published = self.clock.now();
        self.snapshot.phase = self.phase();
        self.slot.publish(self.snapshot.clone());
    }
}
