//! Where time is read: from the system, or from time that a test sets.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// A source of time. Clones read the same source.
#[derive(Clone)]
pub struct Clock(Arc<dyn Fn() -> Instant + Send + Sync>);

/// The system's monotonic clock.
impl Default for Clock {
    fn default() -> Self {
        Self::new(Instant::now)
    }
}

impl fmt::Debug for Clock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Clock").finish_non_exhaustive()
    }
}

impl Clock {
    /// A clock that reads this. It must never go back.
    pub fn new(now: impl Fn() -> Instant + Send + Sync + 'static) -> Self {
        Self(Arc::new(now))
    }

    pub fn now(&self) -> Instant {
        (self.0)()
    }

    /// Time since `start`, which this clock has read; 0 for a start in the future.
    pub fn since(&self, start: Instant) -> Duration {
        self.now().saturating_duration_since(start)
    }
}

/// Time that passes only when it is told to, for tests whose outcome must not depend on how fast the machine is. Clones
/// share their time.
#[derive(Clone, Debug)]
pub struct ManualTime(Arc<Mutex<Instant>>);

impl Default for ManualTime {
    fn default() -> Self {
        Self(Arc::new(Mutex::new(Instant::now())))
    }
}

impl ManualTime {
    /// Lets this much time pass; returns what the time is then.
    pub fn advance(&self, by: Duration) -> Instant {
        let mut now = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        *now += by;
        *now
    }

    /// A clock that shows this time.
    pub fn clock(&self) -> Clock {
        let time = self.clone();
        Clock::new(move || time.advance(Duration::ZERO))
    }

    /// A clock on which this much time passes whenever it is read: work lasts as long as the clock is read often meanwhile.
    pub fn ticking(tick: Duration) -> Clock {
        let time = Self::default();
        Clock::new(move || time.advance(tick))
    }
}

/// Adds up how long pieces of work take.
#[derive(Clone, Debug, Default)]
pub struct Stopwatch {
    clock: Clock,
    elapsed: Duration,
}

impl Stopwatch {
    /// A stopwatch at 0.
    pub fn new(clock: Clock) -> Self {
        Self { clock, elapsed: Duration::ZERO }
    }

    /// Does the work and adds its time.
    pub fn time<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let start = self.clock.now();
        let result = work();
        self.elapsed += self.clock.since(start);
        result
    }

    /// The time of all work so far.
    pub fn elapsed(&self) -> Duration {
        self.elapsed
    }

    /// Goes on from an earlier reading.
    pub fn turn_back(&mut self, elapsed: Duration) {
        self.elapsed = elapsed;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn a_stopwatch_adds_up_the_time_of_work_alone() {
        let time = ManualTime::default();
        let mut watch = Stopwatch::new(time.clock());
        let result = watch.time(|| {
            time.advance(2 * SECOND);
            7
        });
        time.advance(5 * SECOND);
        watch.time(|| time.advance(SECOND));
        assert_eq!((result, watch.elapsed()), (7, 3 * SECOND));
        watch.turn_back(SECOND);
        assert_eq!(watch.elapsed(), SECOND);
    }

    #[test]
    fn a_ticking_clock_counts_its_readings() {
        let clock = ManualTime::ticking(SECOND);
        let start = clock.now();
        assert_eq!([clock.since(start), clock.since(start)], [SECOND, 2 * SECOND]);
        assert_eq!(clock.since(clock.now() + 9 * SECOND), Duration::ZERO);
    }
}
