//! Commands on their way to the solver thread: a queue in which the newest of a kind wins.

use super::Command;
use crate::cancel::Cancel;
use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

#[derive(Default)]
pub struct Mailbox {
    queue: Mutex<Queue>,
    posted: Condvar,
    /// Stops a step: commands do that change what is computed, or whether.
    step: Cancel,
    /// Stops the opening of a scene: only another scene does.
    load: Cancel,
    /// Stops a new mesh: another scene or other settings do.
    mesh: Cancel,
}

#[derive(Default)]
struct Queue {
    commands: VecDeque<Command>,
    is_closed: bool,
}

/// What the solver finds when it looks.
pub enum Mail {
    Command(Command),
    /// Nothing to read now.
    Empty,
    /// The window is gone.
    Closed,
}

impl Mailbox {
    /// Puts a command in and interrupts the work that it supersedes.
    pub fn post(&self, command: Command) {
        let mut queue = self.lock();
        if opens_a_scene(&command) {
            self.load.request();
        }
        if opens_a_scene(&command) || matches!(command, Command::Configure(_)) {
            self.mesh.request();
        }
        // More steps can wait for the one under way, and what is picked is looked into between steps.
        if !matches!(command, Command::Step(_) | Command::Pick(_) | Command::PickPhoton(_) | Command::Gather(_)) {
            self.step.request();
        }
        merge(&mut queue.commands, command);
        self.posted.notify_one();
    }

    /// Tells the solver to end.
    pub fn close(&self) {
        self.lock().is_closed = true;
        self.load.request();
        self.mesh.request();
        self.step.request();
        self.posted.notify_one();
    }

    /// Takes the oldest command out. With `wait`, sleeps until there is one.
    pub fn take(&self, wait: bool) -> Mail {
        let mut queue = self.lock();
        while wait && queue.commands.is_empty() && !queue.is_closed {
            queue = self.posted.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
        if queue.is_closed {
            return Mail::Closed;
        }
        let command = queue.commands.pop_front();
        // Under the lock, so that a request which belongs to a command still in the queue is never lost.
        if queue.commands.is_empty() {
            self.step.clear();
        }
        if !queue.commands.iter().any(opens_a_scene) {
            self.load.clear();
        }
        if !queue.commands.iter().any(|command| opens_a_scene(command) || matches!(command, Command::Configure(_))) {
            self.mesh.clear();
        }
        command.map_or(Mail::Empty, Mail::Command)
    }

    /// The flag for steps.
    pub fn step_cancel(&self) -> &Cancel {
        &self.step
    }

    /// The flag for new meshes.
    pub fn mesh_cancel(&self) -> &Cancel {
        &self.mesh
    }

    /// The flag for the opening of scenes.
    pub fn load_cancel(&self) -> &Cancel {
        &self.load
    }

    fn lock(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn opens_a_scene(command: &Command) -> bool {
    matches!(command, Command::Load(_) | Command::Show(_))
}

/// Adds a command and drops those that it makes pointless.
fn merge(commands: &mut VecDeque<Command>, new: Command) {
    match &new {
        // Settings are not about one scene.
        Command::Load(_) | Command::Show(_) => commands.retain(|old| matches!(old, Command::Configure(_))),
        Command::Configure(_) => commands.retain(|old| !matches!(old, Command::Configure(_))),
        Command::Run | Command::Pause => commands.retain(|old| !matches!(old, Command::Run | Command::Pause)),
        Command::Step(more) => {
            if let Some(Command::Step(steps)) = commands.back_mut() {
                *steps += more;
                return;
            }
        }
        Command::Reset => {
            commands.retain(|old| !matches!(old, Command::Run | Command::Pause | Command::Step(_) | Command::Reset));
        }
        Command::Pick(_) => commands.retain(|old| !matches!(old, Command::Pick(_))),
        Command::PickPhoton(_) => commands.retain(|old| !matches!(old, Command::PickPhoton(_))),
        Command::Gather(_) => commands.retain(|old| !matches!(old, Command::Gather(_))),
        Command::Look(_) => commands.retain(|old| !matches!(old, Command::Look(_))),
        Command::AddCeilingLight => {}
    }
    commands.push_back(new);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::Settings;

    fn merged(commands: impl IntoIterator<Item = Command>) -> Vec<Command> {
        let mut queue = VecDeque::new();
        for command in commands {
            merge(&mut queue, command);
        }
        queue.into()
    }

    #[test]
    fn the_newest_of_a_kind_wins() {
        let with_seed = |seed| Command::Configure(Settings { seed, ..Settings::default() });
        assert_eq!(merged([with_seed(1), Command::Run, with_seed(2)]), [Command::Run, with_seed(2)]);
        assert_eq!(merged([Command::Run, Command::Pause, Command::Run]), [Command::Run]);
        assert_eq!(merged([Command::Step(1), Command::Step(10)]), [Command::Step(11)]);
        assert_eq!(merged([Command::Run, Command::Step(5), Command::Reset]), [Command::Reset]);
        let photons = [Some(7), None].map(Command::PickPhoton);
        assert_eq!(
            merged([photons[0].clone(), Command::Gather(None), photons[1].clone()]),
            [Command::Gather(None), Command::PickPhoton(None)]
        );
        let load = Command::Load("furnace".to_owned());
        assert_eq!(merged([with_seed(1), Command::Run, load.clone()]), [with_seed(1), load]);
    }

    #[test]
    fn only_a_scene_interrupts_the_opening_of_a_scene() {
        let mailbox = Mailbox::default();
        mailbox.post(Command::Run);
        assert!(mailbox.step_cancel().is_requested() && !mailbox.load_cancel().is_requested());
        mailbox.post(Command::Load("furnace".to_owned()));
        assert!(mailbox.load_cancel().is_requested());
        assert!(matches!(mailbox.take(false), Mail::Command(Command::Load(_))));
        assert!(!mailbox.step_cancel().is_requested() && !mailbox.load_cancel().is_requested());
        assert!(matches!(mailbox.take(false), Mail::Empty));
        mailbox.close();
        assert!(matches!(mailbox.take(true), Mail::Closed));
    }
}
