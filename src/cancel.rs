//! A flag that asks long work to stop soon.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Shared between whoever asks and whoever works. Workers poll it every few milliseconds.
#[derive(Clone, Debug, Default)]
pub struct Cancel {
    flag: Arc<AtomicBool>,
    /// From when on the work should stop although nobody has asked.
    deadline: Option<Instant>,
}

impl Cancel {
    /// Asks the work that holds a clone of this flag to stop.
    pub fn request(&self) {
        self.flag.store(true, Ordering::Relaxed);
    }

    /// Takes the request back, before new work begins.
    pub fn clear(&self) {
        self.flag.store(false, Ordering::Relaxed);
    }

    /// The same flag for a part of the work that must be over by `deadline`.
    #[must_use]
    pub fn with_deadline(&self, deadline: Instant) -> Self {
        let deadline = self.deadline.map_or(deadline, |outer| outer.min(deadline));
        Self { flag: self.flag.clone(), deadline: Some(deadline) }
    }

    /// Whether the work should stop now.
    pub fn is_requested(&self) -> bool {
        self.flag.load(Ordering::Relaxed) || self.deadline.is_some_and(|deadline| Instant::now() >= deadline)
    }
}

/// The work was stopped before it had a result; nothing changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cancelled;

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn a_deadline_stops_its_part_and_nothing_else() {
        let whole = Cancel::default();
        let now = Instant::now();
        let [over, open] = [now, now + Duration::from_secs(3600)].map(|deadline| whole.with_deadline(deadline));
        assert_eq!([&whole, &over, &open].map(Cancel::is_requested), [false, true, false]);
        assert!(over.with_deadline(now + Duration::from_secs(3600)).is_requested(), "the outer deadline counts");
        open.request();
        assert_eq!([&whole, &over, &open].map(Cancel::is_requested), [true; 3]);
    }
}
