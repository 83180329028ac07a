//! Commands on their way to the solver thread: a queue in which the newest of a kind wins.

use super::{Command, Sight};
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
    /// What is on show, or will be once all commands are taken.
    sight: Option<Sight>,
    is_closed: bool,
}

impl Queue {
    /// Whether a command cannot wait for the end of a step.
    fn is_urgent(&mut self, command: &Command) -> bool {
        match command {
            // More steps can wait for the one under way, and what is picked is looked into between steps.
            Command::Step(_)
            | Command::Pick(_)
            | Command::PickSource(_)
            | Command::PickPhoton(_)
            | Command::Gather(_) => false,
            // A camera that moves round meshes or photons leaves the solver nothing to do.
            Command::Look(sight) => {
                let old = self.sight.replace(*sight);
                let is_new_subject = old.is_none_or(|old| old.subject != sight.subject);
                is_new_subject || sight.subject.view().is_some() && old != Some(*sight)
            }
            _ => true,
        }
    }
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
        if queue.is_urgent(&command) {
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
        // Neither settings nor what is looked at are about one scene.
        Command::Load(_) | Command::Show(_) => {
            commands.retain(|old| matches!(old, Command::Configure(_) | Command::Look(_)));
        }
        Command::Configure(_) => commands.retain(|old| !matches!(old, Command::Configure(_))),
        Command::Run | Command::Pause => drop_since_look(commands, |old| matches!(old, Command::Run | Command::Pause)),
        Command::Step(more) => {
            if let Some(Command::Step(steps)) = commands.back_mut() {
                *steps += more;
                return;
            }
        }
        Command::Reset => drop_since_look(commands, drives_light),
        Command::Pick(_) => commands.retain(|old| !matches!(old, Command::Pick(_))),
        Command::PickSource(_) => commands.retain(|old| !matches!(old, Command::PickSource(_))),
        Command::PickPhoton(_) => commands.retain(|old| !matches!(old, Command::PickPhoton(_))),
        Command::Gather(_) => commands.retain(|old| !matches!(old, Command::Gather(_))),
        Command::Look(_) => {
            let since = since_look(commands);
            // One that says which light is driven is still needed.
            if since > 0 && !commands.range(since..).any(drives_light) {
                commands.remove(since - 1);
            }
        }
        Command::Hush(_) => commands.retain(|old| !matches!(old, Command::Hush(_))),
        Command::AddCeilingLight => {}
    }
    commands.push_back(new);
}

/// Whether a command is about the light of what is on show.
fn drives_light(command: &Command) -> bool {
    matches!(command, Command::Run | Command::Pause | Command::Step(_) | Command::Reset)
}

/// Where the commands begin that are about what was looked at last.
fn since_look(commands: &VecDeque<Command>) -> usize {
    commands.iter().rposition(|command| matches!(command, Command::Look(_))).map_or(0, |look| look + 1)
}

/// Drops commands of a kind that are about what was looked at last.
fn drop_since_look(commands: &mut VecDeque<Command>, is_dropped: impl Fn(&Command) -> bool) {
    let since = since_look(commands);
    let mut index = 0;
    commands.retain(|command| {
        index += 1;
        index <= since || !is_dropped(command)
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::math::bounds::Bounds;
    use crate::methods::Settings;
    use crate::scene::Viewpoint;
    use crate::solution::{CameraView, Path, Photon};
    use crate::worker::Subject;
    use glam::Vec3;

    fn merged(commands: impl IntoIterator<Item = Command>) -> Vec<Command> {
        let mut queue = VecDeque::new();
        for command in commands {
            merge(&mut queue, command);
        }
        queue.into()
    }

    fn photon() -> Photon {
        let (position, flux, direction) = (Vec3::ZERO, Vec3::ONE, Vec3::NEG_Y);
        Photon { position, flux, direction, side: 0, path: Path::LIGHT, emission: 7 }
    }

    #[test]
    fn the_newest_of_a_kind_wins() {
        let with_seed = |seed| Command::Configure(Settings { seed, ..Settings::default() });
        assert_eq!(merged([with_seed(1), Command::Run, with_seed(2)]), [Command::Run, with_seed(2)]);
        assert_eq!(merged([Command::Run, Command::Pause, Command::Run]), [Command::Run]);
        assert_eq!(merged([Command::Step(1), Command::Step(10)]), [Command::Step(11)]);
        assert_eq!(merged([Command::Run, Command::Step(5), Command::Reset]), [Command::Reset]);
        let photons = [Some(photon()), None].map(Command::PickPhoton);
        assert_eq!(
            merged([photons[0].clone(), Command::Gather(None), photons[1].clone()]),
            [Command::Gather(None), Command::PickPhoton(None)]
        );
        let load = Command::Load("furnace".to_owned());
        assert_eq!(merged([with_seed(1), Command::Run, load.clone()]), [with_seed(1), load]);
    }

    fn look(subject: Subject, distance: f32) -> Command {
        let eye = distance * Vec3::Z;
        let viewpoint = Viewpoint { eye, target: Vec3::ZERO, up: Vec3::Y, vertical_fov: 40.0 };
        let bounds = Bounds { min: -Vec3::ONE, max: Vec3::ONE };
        Command::Look(Sight { subject, camera: Camera::new(&viewpoint, &bounds), size: [8, 8] })
    }

    #[test]
    fn the_newest_look_wins_and_commands_stay_with_the_light_that_they_are_about() {
        let (photons, radiosity) = (look(Subject::Photons, 1.0), look(Subject::Radiosity, 1.0));
        let moved = look(Subject::Radiosity, 2.0);
        let last = merged([photons.clone(), radiosity.clone(), moved.clone()]);
        assert_eq!(last, std::slice::from_ref(&moved));
        let both = [photons.clone(), Command::Run, moved.clone(), Command::Pause];
        assert_eq!(
            merged([photons.clone(), Command::Run, radiosity, moved.clone(), Command::Run, Command::Pause]),
            both
        );
        assert_eq!(merged(both.clone().into_iter().chain([Command::Reset]))[..3], both[..3]);
        let load = Command::Load("furnace".to_owned());
        assert_eq!(merged([photons.clone(), Command::Run, load.clone()]), [photons, load]);
    }

    #[test]
    fn a_camera_that_moves_interrupts_pictures_from_it_alone() {
        let is_urgent = |commands: [Command; 2]| {
            let mailbox = Mailbox::default();
            mailbox.post(commands[0].clone());
            mailbox.take(false);
            mailbox.post(commands[1].clone());
            mailbox.step_cancel().is_requested()
        };
        let (rays, photons) = (Subject::Camera(CameraView::RayTraced), Subject::Photons);
        assert!(!is_urgent([look(photons, 1.0), look(photons, 2.0)]));
        assert!(is_urgent([look(photons, 1.0), look(Subject::Radiosity, 1.0)]));
        assert!(is_urgent([look(rays, 1.0), look(rays, 2.0)]));
        assert!(!is_urgent([look(rays, 1.0), look(rays, 1.0)]));
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
