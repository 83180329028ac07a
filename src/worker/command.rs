//! What the window may ask of the solver thread.

use crate::methods::Settings;

/// Commands take effect in the order they are sent; of several of one kind the newest wins.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Opens a scene: a path or the name of a built-in one.
    Load(String),
    /// Adds a ceiling light to a scene that has no emitter.
    AddCeilingLight,
    /// Applies settings; a new mesh or a new method starts from the emitters again.
    Configure(Settings),
    Run,
    Pause,
    /// Does this many steps, publishing each, then pauses.
    Step(u64),
    /// Starts over from the emitters, paused.
    Reset,
}
