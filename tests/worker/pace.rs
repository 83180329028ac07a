//! Steps that wait for the test and snapshots that none is missed of, so that no outcome depends on how busy the machine is.

use crate::{PATIENCE, wait_until};
use lightwell::cancel::Cancel;
use lightwell::clock::Clock;
use lightwell::methods::Step;
use lightwell::worker::{Phase, Snapshot, Worker, Workshop};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// A gate at which steps wait until they may pass, or are told to stop. It is closed at first.
#[derive(Clone, Default)]
pub struct Gate(Arc<Counts>);

#[derive(Default)]
struct Counts {
    arrived: AtomicU64,
    permits: AtomicU64,
    cancelled: AtomicU64,
}

impl Gate {
    /// A step that takes as long as the test wants.
    pub fn step(&self, cancel: &Cancel) -> Step {
        let Counts { arrived, permits, cancelled } = &*self.0;
        arrived.fetch_add(1, Ordering::SeqCst);
        let start = Instant::now();
        loop {
            if cancel.is_requested() {
                cancelled.fetch_add(1, Ordering::SeqCst);
                return Step::Cancelled;
            }
            let take = |left: u64| left.checked_sub(1);
            if permits.fetch_update(Ordering::SeqCst, Ordering::SeqCst, take).is_ok() {
                return Step::Advanced;
            }
            // Rather than to wait for ever for a test that has failed.
            assert!(start.elapsed() < 2 * PATIENCE, "nobody lets this step pass");
            std::thread::sleep(Duration::from_micros(100));
        }
    }

    /// Lets so many steps pass.
    pub fn open(&self, steps: u64) {
        self.0.permits.fetch_add(steps, Ordering::SeqCst);
    }

    /// How many steps came to the gate.
    pub fn arrived(&self) -> u64 {
        self.0.arrived.load(Ordering::SeqCst)
    }

    /// Waits until another step than those of before is at the gate.
    pub fn wait_for_step_after(&self, arrived: u64) {
        wait_until("in a step", || self.arrived() > arrived);
    }

    /// Lets one step pass and waits until the next one is at the gate: what is to be done between the two is done.
    pub fn pass_one(&self) {
        let before = self.arrived();
        self.open(1);
        self.wait_for_step_after(before);
    }

    /// How many steps were stopped at the gate.
    pub fn cancelled(&self) -> u64 {
        self.0.cancelled.load(Ordering::SeqCst)
    }
}

/// A worker of which no snapshot is missed: its thread waits until each has been looked at.
pub struct Watched {
    // In this order, so that the thread waits for nobody when the worker is dropped.
    published: Receiver<()>,
    seen: Sender<()>,
    pub worker: Worker,
}

impl Watched {
    pub fn spawn(workshop: impl Workshop, clock: Clock) -> Self {
        let (publish, published) = channel();
        let (seen, wait) = channel();
        let wait = Mutex::new(wait);
        let worker = Worker::spawn_with(workshop, clock, move || {
            // Both fail once the test is over.
            let _ = publish.send(());
            let _ = wait.lock().map(|wait: std::sync::MutexGuard<'_, Receiver<()>>| wait.recv());
        });
        Self { published, seen, worker }
    }

    pub fn next(&self) -> Arc<Snapshot> {
        self.published.recv_timeout(PATIENCE).expect("a snapshot");
        let snapshot = self.worker.latest();
        self.seen.send(()).expect("the thread waits");
        snapshot
    }

    /// All snapshots up to the first with this property.
    pub fn until(&self, is_it: impl Fn(&Snapshot) -> bool) -> Vec<Arc<Snapshot>> {
        let mut snapshots = vec![self.next()];
        while !is_it(&snapshots[snapshots.len() - 1]) {
            snapshots.push(self.next());
        }
        snapshots
    }

    /// All snapshots up to the first in this phase.
    pub fn until_phase(&self, phase: &Phase) -> Vec<Arc<Snapshot>> {
        self.until(|now| now.phase == *phase)
    }

    /// Whether nothing is published for a while.
    pub fn is_quiet(&self) -> bool {
        self.published.recv_timeout(Duration::from_millis(100)).is_err()
    }
}
