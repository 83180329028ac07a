//! The solver thread: it owns the methods, takes commands and publishes what they know.
//!
//! Commands go into a mailbox, where the newest wins; snapshots come out of a slot that holds the latest. Neither side
//! ever waits for the other.

mod account;
mod background;
mod checks;
mod command;
mod going;
mod history;
mod judge;
mod mailbox;
mod methods;
mod pool;
mod ray_price;
mod run;
mod solver;
mod track;
mod workshop;

pub use account::Entry;
pub use background::{Background, Desk};
pub use checks::{CheckReport, Checks};
pub use command::{Command, LightKind, Place, Shown, Sight, Spot, Subject};
pub use history::{Curve, CurvePoint};
pub use methods::{Methods, TracedPhotons};
pub use run::{PhotonRun, Refused, Run, check_picture};
pub use track::{Track, TrackPoint};
pub use workshop::{CameraShot, ImageMethod, Lights, OcclusionMethod, PhotonMethod, PhotonProgress, Workshop};

use crate::accuracy::{Cache, Truth};
use crate::clock::Clock;
use crate::effects::Plan;
use crate::methods::Settings;
use crate::solution::{CameraImage, Equation, Gathered, PhotonSolution, PhotonTrail, Picked, Solution, VertexShares};
use crate::world::World;
use mailbox::Mailbox;
use solver::Solver;
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

/// Everything that the thread publishes. Each part is immutable and shared.
#[derive(Clone, Default)]
pub struct Snapshot {
    pub phase: Phase,
    pub world: Option<Arc<World>>,
    /// Which effects of light `world` calls for.
    pub plan: Option<Arc<Plan>>,
    /// What a ray takes in `world` at least.
    pub seconds_per_ray: f64,
    /// Belongs to `world`, element by element.
    pub solution: Option<Arc<Solution>>,
    /// What the picked patch sees; belongs to `world`.
    pub picked: Option<Arc<Picked>>,
    /// Where the light at the picked point comes from; belongs to `world`. It may be a little older than `solution`.
    pub equation: Option<Arc<Equation>>,
    /// What photons have brought; belongs to `world`.
    pub photons: Option<Arc<PhotonSolution>>,
    /// How much ambient light arrives at each vertex; belongs to `world`.
    pub occlusion: Option<Arc<VertexShares>>,
    /// The picture from a camera that was made last; belongs to `world`.
    pub image: Option<Arc<CameraImage>>,
    /// The way of the picked photon.
    pub trail: Option<Arc<PhotonTrail>>,
    /// What the estimate at the picked point is made of.
    pub gathered: Option<Arc<Gathered>>,
    /// How the runs on this scene went, the one under way last.
    pub curves: Vec<Arc<Curve>>,
    /// How far off the runs on this scene were, in the order in which they began.
    pub tracks: Vec<Arc<Track>>,
    /// What they are held against, as far as it is known.
    pub truth: Option<Arc<Truth>>,
    /// The settings that `world` and `solution` were made with.
    pub settings: Settings,
    /// The last thing that went wrong, until the next command succeeds. The world and the solution of before stay.
    pub error: Option<String>,
}

/// What the solver thread is doing.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Phase {
    /// No scene is open.
    #[default]
    Empty,
    /// A scene is being read and meshed.
    Loading(String),
    Paused,
    Running,
    Converged,
    /// The solver panicked; `Command::Reset` starts it afresh.
    Crashed,
}

/// A handle on the solver thread. Dropping it ends the thread.
pub struct Worker {
    mailbox: Arc<Mailbox>,
    slot: Arc<Slot>,
    thread: Option<JoinHandle<()>>,
}

/// The latest snapshot, and whom to tell of a new one.
struct Slot {
    latest: Mutex<Arc<Snapshot>>,
    wake: Box<dyn Fn() + Send + Sync>,
}

impl Slot {
    fn publish(&self, snapshot: Snapshot) {
        // The old snapshot is dropped after the lock is free again: freeing a large solution takes a while.
        let old = std::mem::replace(&mut *self.lock(), Arc::new(snapshot));
        drop(old);
        (self.wake)();
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Arc<Snapshot>> {
        self.latest.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Worker {
    /// Starts the thread. `wake` is called from it after every new snapshot. What is found out about scenes is kept in the
    /// cache, if there is one.
    pub fn spawn(cache: Option<Cache>, wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self::spawn_with(Methods::with_cache(cache), Clock::default(), wake)
    }

    /// Starts the thread with methods from elsewhere. All that it does by the time it does by this clock.
    pub fn spawn_with(workshop: impl Workshop, clock: Clock, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let mailbox = Arc::new(Mailbox::default());
        let slot = Arc::new(Slot { latest: Mutex::default(), wake: Box::new(wake) });
        let solver = Solver::new(mailbox.clone(), slot.clone(), workshop, clock);
        let thread =
            std::thread::Builder::new().name("solver".to_owned()).spawn(|| pool::in_background(|| solver.serve()));
        Self { mailbox, slot, thread: Some(thread.expect("the system can start a thread")) }
    }

    /// Hands a command over. It takes effect within a few milliseconds, in the middle of a step if need be.
    pub fn send(&self, command: Command) {
        self.mailbox.post(command);
    }

    /// The newest snapshot. Never waits for the solver.
    pub fn latest(&self) -> Arc<Snapshot> {
        self.slot.lock().clone()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.mailbox.close();
        if let Some(thread) = self.thread.take() {
            // The solver catches panics of methods; one of its own has been printed already.
            let _ = thread.join();
        }
    }
}
