//! Whether a light goes on, and until when.

use super::Phase;
use crate::methods::Step;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Going {
    #[default]
    Paused,
    Running {
        /// Steps still to do; `None` while there is no end to them.
        steps_left: Option<u64>,
    },
    Converged,
    Crashed,
}

impl Going {
    pub fn is_running(self) -> bool {
        matches!(self, Self::Running { .. })
    }

    /// Whether it runs until it has done a number of steps.
    pub fn is_counted(self) -> bool {
        matches!(self, Self::Running { steps_left: Some(_) })
    }

    /// Runs for so many steps, or until it has converged. Steps asked for while others are under way come on top.
    pub fn go(&mut self, steps: Option<u64>) {
        let under_way = match *self {
            Self::Running { steps_left: Some(left) } => left,
            _ => 0,
        };
        *self = Self::Running { steps_left: steps.map(|steps| steps + under_way) };
    }

    pub fn pause(&mut self) {
        if self.is_running() {
            *self = Self::Paused;
        }
    }

    /// Is about a run that begins anew, or has another end now.
    pub fn renew(&mut self) {
        if !self.is_running() {
            *self = Self::Paused;
        }
    }

    /// Takes note of what a step did.
    pub fn note(&mut self, step: Step) {
        match (step, self) {
            (Step::Converged, going) => *going = Self::Converged,
            (Step::Advanced, going @ Self::Running { steps_left: Some(..=1) }) => *going = Self::Paused,
            (Step::Advanced, Self::Running { steps_left: Some(left) }) => *left -= 1,
            _ => {}
        }
    }

    pub fn phase(self) -> Phase {
        match self {
            Self::Paused => Phase::Paused,
            Self::Running { .. } => Phase::Running,
            Self::Converged => Phase::Converged,
            Self::Crashed => Phase::Crashed,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_counted_and_add_up() {
        let mut going = Going::Paused;
        going.go(Some(2));
        going.note(Step::Prepared);
        going.go(Some(1));
        assert_eq!(going, Going::Running { steps_left: Some(3) });
        going.note(Step::Advanced);
        going.note(Step::Cancelled);
        going.note(Step::Advanced);
        assert!(going.is_counted());
        going.note(Step::Advanced);
        assert_eq!(going, Going::Paused);
        going.go(None);
        going.note(Step::Advanced);
        assert_eq!(going, Going::Running { steps_left: None });
        going.note(Step::Converged);
        assert_eq!(going, Going::Converged);
        going.pause();
        assert_eq!(going, Going::Converged);
        going.renew();
        assert_eq!(going, Going::Paused);
    }
}
