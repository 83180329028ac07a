//! The loop of the solver thread.

use super::history::History;
use super::mailbox::{Mail, Mailbox};
use super::{Command, Phase, Place, Refused, Run, Slot, Snapshot, StartMethod};
use crate::errors::with_causes;
use crate::mesh::MeshSettings;
use crate::methods::{Settings, Step, radiosity};
use crate::scene::Scene;
use crate::solution::Solution;
use crate::world::{World, WorldError, with_ceiling_light};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// While running, snapshots are at least this far apart: 30 a second are as many as anyone sees.
const PUBLISH_INTERVAL: Duration = Duration::from_millis(33);

/// Why there is no new world.
enum NoWorld {
    /// A newer command made it pointless, which is no trouble.
    Superseded,
    Failed(String),
}

impl From<Refused> for NoWorld {
    fn from(refused: Refused) -> Self {
        Self::Failed(with_causes(&refused))
    }
}

impl From<WorldError> for NoWorld {
    fn from(error: WorldError) -> Self {
        match error {
            WorldError::Cancelled => Self::Superseded,
            error => Self::Failed(with_causes(&error)),
        }
    }
}

/// The state of the thread.
pub struct Solver {
    mailbox: Arc<Mailbox>,
    slot: Arc<Slot>,
    start_method: Box<StartMethod>,
    /// What was published last; its parts are shared with whoever looks at it.
    snapshot: Snapshot,
    run: Option<Run>,
    history: History,
    /// A patch to be looked from when there is no command to serve.
    wish: Option<u32>,
    /// Steps still to do; `None` while there is no end to them.
    steps_left: Option<u64>,
    published: Instant,
}

impl Solver {
    pub fn new(mailbox: Arc<Mailbox>, slot: Arc<Slot>, start_method: Box<StartMethod>) -> Self {
        let snapshot = Snapshot::default();
        Self {
            mailbox,
            slot,
            start_method,
            snapshot,
            run: None,
            history: History::default(),
            wish: None,
            steps_left: None,
            published: Instant::now(),
        }
    }

    /// Serves until the mailbox is closed. A panic of a method ends its run, not the thread.
    pub fn serve(mut self) {
        loop {
            let mail = self.mailbox.take(self.snapshot.phase != Phase::Running && self.wish.is_none());
            let work = match mail {
                Mail::Closed => return,
                Mail::Command(command) => catch_unwind(AssertUnwindSafe(|| self.apply(command))),
                Mail::Empty => catch_unwind(AssertUnwindSafe(|| self.work())),
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
            Command::Reset => self.restart(),
            Command::Pick(place) => self.pick(place),
            Command::PickPhoton(_) | Command::Gather(_) | Command::Look(_) => {}
        }
    }

    fn load(&mut self, name: &str, open: impl FnOnce() -> Result<Scene, String>) {
        let before = self.snapshot.phase.clone();
        self.snapshot.phase = Phase::Loading(name.to_owned());
        self.publish();
        let old_mesh = self.snapshot.settings.mesh;
        if self.snapshot.world.is_some() {
            // A size in metres that suits one scene may be far too fine for another.
            self.snapshot.settings.mesh = MeshSettings { element_size: None, ..old_mesh };
        }
        let built = open().map_err(NoWorld::Failed).and_then(|scene| self.build(scene));
        let old_history = std::mem::take(&mut self.history);
        if !self.take_over(built, before) {
            self.snapshot.settings.mesh = old_mesh;
            self.history = old_history;
        }
        self.publish();
    }

    fn add_ceiling_light(&mut self) {
        let Some(world) = self.snapshot.world.clone().filter(|world| !world.scene.has_emitter()) else { return };
        let before = self.snapshot.phase.clone();
        let built = self.build(with_ceiling_light(&world.scene));
        self.take_over(built, before);
        self.publish();
    }

    fn build(&self, scene: Scene) -> Result<World, NoWorld> {
        Ok(World::build(scene, &self.snapshot.settings.mesh, self.mailbox.load_cancel())?)
    }

    fn configure(&mut self, settings: Settings) {
        let old = std::mem::replace(&mut self.snapshot.settings, settings);
        let Some(world) = self.snapshot.world.clone() else { return self.publish() };
        if old.mesh == settings.mesh {
            self.snapshot.error = None;
            if self.run.as_mut().is_some_and(|run| run.configure(&settings)) {
                self.history.reconfigure(&settings);
            } else if let Err(refused) = self.start(world) {
                self.snapshot.error = Some(with_causes(&refused));
                self.snapshot.settings = old;
            }
            if self.snapshot.phase != Phase::Running {
                self.snapshot.phase = Phase::Paused;
            }
            return self.publish();
        }
        let phase = self.snapshot.phase.clone();
        let remeshed = world.remeshed(&settings.mesh, self.mailbox.mesh_cancel()).map_err(NoWorld::from);
        if !self.take_over(remeshed, phase) {
            self.snapshot.settings = old;
        }
        self.publish();
    }

    /// Shows a new world before its first step, or says why there is none, leaves everything as it was and returns false.
    fn take_over(&mut self, built: Result<World, NoWorld>, before: Phase) -> bool {
        let started = built.and_then(|world| Ok(self.start(Arc::new(world))?));
        match started {
            Ok(()) => {
                self.snapshot.error = None;
                self.snapshot.phase = if before == Phase::Running { Phase::Running } else { Phase::Paused };
                true
            }
            Err(no_world) => {
                if let NoWorld::Failed(reason) = no_world {
                    self.snapshot.error = Some(reason);
                }
                self.snapshot.phase = before;
                false
            }
        }
    }

    /// Begins a run on a world; if it is refused, everything stays as it was.
    fn start(&mut self, world: Arc<World>) -> Result<(), Refused> {
        let is_same_world = self.snapshot.world.as_ref().is_some_and(|old| Arc::ptr_eq(old, &world));
        if !(is_same_world && self.run.as_mut().is_some_and(|run| run.restart(&self.snapshot.settings))) {
            let old_world = self.snapshot.world.replace(world.clone());
            // Should the method panic before its first step, there is no light that belongs to this world.
            let old_solution = self.snapshot.solution.take();
            match (self.start_method)(world, &self.snapshot.settings) {
                Ok(method) => self.run = Some(Run::of(method)),
                Err(refused) => {
                    self.snapshot.world = old_world;
                    self.snapshot.solution = old_solution;
                    return Err(refused);
                }
            }
        }
        // What is picked is seen by another method now, or is gone with its world.
        let picked = self.snapshot.picked.take().map(|picked| picked.patch);
        self.wish = self.wish.or(picked).filter(|_| is_same_world);
        self.history.begin(&self.snapshot.settings);
        if let Some(solution) = self.run.as_ref().map(Run::solution) {
            self.record(solution);
        }
        Ok(())
    }

    fn restart(&mut self) {
        let Some(world) = self.snapshot.world.clone() else { return };
        self.snapshot.phase = Phase::Paused;
        self.snapshot.error = self.start(world).err().map(|refused| with_causes(&refused));
        self.publish();
    }

    /// Wishes to look from a patch, or forgets about it.
    fn pick(&mut self, place: Option<Place>) {
        let is_on_show =
            |place: &Place| self.snapshot.world.as_ref().is_some_and(|world| Arc::ptr_eq(world, &place.world));
        match place {
            Some(place) if is_on_show(&place) => self.wish = Some(place.patch),
            Some(_) => {}
            None => {
                self.wish = None;
                self.snapshot.picked = None;
                self.publish();
            }
        }
    }

    /// What there is to do without a command.
    fn work(&mut self) {
        match self.wish {
            Some(patch) => self.look_from(patch),
            None => self.step(),
        }
    }

    /// Computes what a patch sees by the method of the settings; if interrupted, the wish stays.
    fn look_from(&mut self, patch: u32) {
        let Some(world) = self.snapshot.world.as_ref() else { return };
        // Should it panic, it is not tried again.
        self.wish = None;
        match radiosity::pick(world, &self.snapshot.settings, patch, self.mailbox.step_cancel()) {
            Some(picked) => {
                self.snapshot.picked = Some(Arc::new(picked));
                self.publish();
            }
            None => self.wish = Some(patch),
        }
    }

    fn record(&mut self, solution: Solution) {
        self.history.record(solution.progress(), solution.elapsed);
        self.snapshot.curves = self.history.curves().to_vec();
        self.snapshot.solution = Some(Arc::new(solution));
    }

    fn go(&mut self, steps: Option<u64>) {
        if self.run.is_some() && steps != Some(0) {
            // Steps asked for while others are under way come on top.
            let under_way = self.steps_left.filter(|_| self.snapshot.phase == Phase::Running).unwrap_or(0);
            self.steps_left = steps.map(|steps| steps + under_way);
            self.snapshot.error = None;
            self.snapshot.phase = Phase::Running;
            self.publish();
        }
    }

    fn pause(&mut self) {
        if self.snapshot.phase == Phase::Running {
            self.snapshot.phase = Phase::Paused;
            self.publish_solution();
        }
    }

    fn step(&mut self) {
        let Some(run) = &mut self.run else { return };
        let step = run.step(self.mailbox.step_cancel());
        if step == Step::Advanced {
            self.history.record(run.progress(), run.elapsed());
        }
        match step {
            Step::Cancelled => return,
            Step::Prepared => {}
            Step::Converged => self.snapshot.phase = Phase::Converged,
            Step::Advanced => {
                if let Some(left) = &mut self.steps_left {
                    *left -= 1;
                    if *left == 0 {
                        self.snapshot.phase = Phase::Paused;
                    }
                }
            }
        }
        let is_stepping = self.steps_left.is_some() && step != Step::Prepared;
        if is_stepping || self.snapshot.phase != Phase::Running || self.published.elapsed() >= PUBLISH_INTERVAL {
            self.publish_solution();
        }
    }

    fn crash(&mut self, panic: &(dyn Any + Send)) {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
        self.run = None;
        self.snapshot.error = Some(format!("the solver stopped: {text}"));
        self.snapshot.phase = Phase::Crashed;
        self.publish();
    }

    fn publish_solution(&mut self) {
        if let Some(solution) = self.run.as_ref().map(Run::solution) {
            self.record(solution);
        }
        self.publish();
    }

    fn publish(&mut self) {
        self.published = Instant::now();
        self.slot.publish(self.snapshot.clone());
    }
}
