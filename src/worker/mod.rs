//! The solver thread: it owns the methods, takes commands and publishes what they know.

mod command;
mod slot;

pub use command::Command;

use crate::methods::Settings;
use crate::solution::Solution;
use crate::world::World;
use std::sync::Arc;

/// Everything that the thread publishes. Each part is immutable and shared.
#[derive(Clone, Default)]
pub struct Snapshot {
    pub phase: Phase,
    pub world: Option<Arc<World>>,
    /// Belongs to `world`, element by element.
    pub solution: Option<Arc<Solution>>,
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
