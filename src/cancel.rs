//! A flag that asks long work to stop soon.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Instant;

/// Shared between whoever asks and whoever works. Workers poll it every few milliseconds.
#[derive(Clone, Debug, Default)]
pub struct Cancel {
    flag: Arc<Flag>,
    /// From when on the work should stop although nobody has asked.
    deadline: Option<Instant>,
}

#[derive(Debug, Default)]
struct Flag {
    is_requested: AtomicBool,
    polls: Option<Polls>,
}

/// How often a flag was read, and when it stops the work by itself.
#[derive(Debug, Default)]
struct Polls {
    count: AtomicU64,
    /// From so many polls on, the work should stop.
    limit: u64,
}

impl Cancel {
    /// A flag that counts how often it is polled and asks the work to stop from the poll after these on. It stands for a
    /// request in the middle of the work, at a place that does not depend on the clock.
    pub fn after(polls: u64) -> Self {
        let polls = Polls { count: AtomicU64::new(0), limit: polls };
        Self { flag: Arc::new(Flag { is_requested: AtomicBool::new(false), polls: Some(polls) }), deadline: None }
    }

    /// A flag that counts how often it is polled: the more often, the less work there is between two polls.
    pub fn counting() -> Self {
        Self::after(u64::MAX)
    }

    /// Asks the work that holds a clone of this flag to stop.
    pub fn request(&self) {
        self.flag.is_requested.store(true, Ordering::Relaxed);
    }

    /// Takes the request back, before new work begins.
    pub fn clear(&self) {
        self.flag.is_requested.store(false, Ordering::Relaxed);
    }

    /// The same flag for a part of the work that must be over by `deadline`.
    #[must_use]
    pub fn with_deadline(&self, deadline: Instant) -> Self {
        let deadline = self.deadline.map_or(deadline, |outer| outer.min(deadline));
        Self { flag: self.flag.clone(), deadline: Some(deadline) }
    }

    /// Whether the work should stop now.
    pub fn is_requested(&self) -> bool {
        let is_limited = self.flag.polls.as_ref().is_some_and(Polls::count_one);
        let is_late = || self.deadline.is_some_and(|deadline| Instant::now() >= deadline);
        is_limited || self.flag.is_requested.load(Ordering::Relaxed) || is_late()
    }

    /// How often it was polled; 0 where that is not counted.
    pub fn polls(&self) -> u64 {
        self.flag.polls.as_ref().map_or(0, |polls| polls.count.load(Ordering::Relaxed))
    }
}

impl Polls {
    /// Counts a poll; true if it is one too many.
    fn count_one(&self) -> bool {
        self.count.fetch_add(1, Ordering::Relaxed) >= self.limit
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
    fn a_flag_can_stop_work_after_some_polls() {
        let cancel = Cancel::after(2);
        assert_eq!([(); 4].map(|()| cancel.is_requested()), [false, false, true, true]);
        assert_eq!(cancel.clone().polls(), 4);
        let counting = Cancel::counting();
        assert_eq!((counting.is_requested(), counting.polls(), Cancel::default().polls()), (false, 1, 0));
        counting.request();
        assert!(counting.is_requested());
    }

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
