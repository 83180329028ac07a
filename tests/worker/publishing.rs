//! What is published, and how often.

use crate::fake::{self, Fakes};
use crate::{PATIENCE, load, name, steps, wait_for};
use lightwell::methods::Step;
use lightwell::worker::{Command, Phase, Snapshot, Worker};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// A worker of which no snapshot is missed: its thread waits until each has been looked at.
struct Watched {
    // In this order, so that the thread waits for nobody when the worker is dropped.
    published: Receiver<()>,
    seen: Sender<()>,
    worker: Worker,
}

impl Watched {
    fn new(fakes: Fakes) -> Self {
        let (publish, published) = channel();
        let (seen, wait) = channel();
        let wait = Mutex::new(wait);
        let worker = Worker::spawn_with(fakes, move || {
            // Both fail once the test is over.
            let _ = publish.send(());
            let _ = wait.lock().map(|wait: std::sync::MutexGuard<'_, Receiver<()>>| wait.recv());
        });
        Self { published, seen, worker }
    }

    fn next(&self) -> Arc<Snapshot> {
        self.published.recv_timeout(PATIENCE).expect("a snapshot");
        let snapshot = self.worker.latest();
        self.seen.send(()).expect("the thread waits");
        snapshot
    }

    /// All snapshots up to the first in this phase.
    fn until(&self, phase: &Phase) -> Vec<Arc<Snapshot>> {
        let mut snapshots = vec![self.next()];
        while snapshots.last().expect("one at least").phase != *phase {
            snapshots.push(self.next());
        }
        snapshots
    }

    fn is_quiet(&self) -> bool {
        self.published.recv_timeout(Duration::from_millis(100)).is_err()
    }
}

fn phases(snapshots: &[Arc<Snapshot>]) -> Vec<Phase> {
    let mut phases: Vec<Phase> = snapshots.iter().map(|snapshot| snapshot.phase.clone()).collect();
    phases.dedup();
    phases
}

#[test]
fn a_scene_is_opened_then_run_until_it_has_converged() {
    let work = |steps, _: &_| if steps < 3 { Step::Advanced } else { Step::Converged };
    let watched = Watched::new(fake::method(work));
    let nothing = watched.worker.latest();
    assert_eq!(nothing.phase, Phase::Empty);
    assert!(nothing.world.is_none() && nothing.solution.is_none() && nothing.error.is_none());

    watched.worker.send(Command::Load("furnace".to_owned()));
    let loading = watched.next();
    assert_eq!(loading.phase, Phase::Loading("furnace".to_owned()));
    assert!(loading.world.is_none());
    let loaded = watched.next();
    assert_eq!((&loaded.phase, name(&loaded), steps(&loaded)), (&Phase::Paused, "furnace", 0));
    assert!(watched.is_quiet());

    watched.worker.send(Command::Run);
    let running = watched.until(&Phase::Converged);
    assert_eq!(phases(&running), [Phase::Running, Phase::Converged]);
    assert_eq!(steps(running.last().expect("one at least")), 3);
    assert!(watched.is_quiet());
}

#[test]
fn so_many_steps_are_done_and_each_is_published() {
    let watched = Watched::new(fake::method(|_, _| Step::Advanced));
    watched.worker.send(Command::Load("furnace".to_owned()));
    watched.until(&Phase::Paused);
    for (asked, first) in [(1, 0), (10, 1), (100, 11)] {
        watched.worker.send(Command::Step(asked));
        let published = watched.until(&Phase::Paused);
        let counts: Vec<u64> = published.iter().map(|snapshot| steps(snapshot)).collect();
        // The first says that it runs, then there is one for each step.
        let expected: Vec<u64> = (first..=first + asked).collect();
        assert_eq!(counts, expected);
        assert_eq!(phases(&published), [Phase::Running, Phase::Paused]);
        assert!(watched.is_quiet());
    }
}

#[test]
fn no_step_is_done_where_none_is_asked_for() {
    let worker = fake::worker(fake::short_step);
    load(&worker, "furnace");
    worker.send(Command::Step(0));
    worker.send(Command::Step(2));
    let after = wait_for(&worker, "stepped", |snapshot| steps(snapshot) > 0 && snapshot.phase == Phase::Paused);
    assert_eq!(steps(&after), 2);
}

#[test]
fn a_run_publishes_at_most_thirty_times_a_second_and_still_often_enough_to_watch() {
    let published = Arc::new(AtomicU32::new(0));
    let counter = published.clone();
    let worker = Worker::spawn_with(fake::method(fake::short_step), move || {
        counter.fetch_add(1, Ordering::SeqCst);
    });
    load(&worker, "furnace");
    let start = Instant::now();
    published.store(0, Ordering::SeqCst);
    worker.send(Command::Run);
    std::thread::sleep(Duration::from_secs(1));
    let count = f64::from(published.load(Ordering::SeqCst));
    // One that says that it runs, and the last one of before, which may be counted late; then one every 33 ms.
    let most = 2.0 + start.elapsed().as_secs_f64() / 0.033;
    assert!(count <= most, "{count} in {:?}", start.elapsed());
    // A machine that is busy otherwise may miss two of three.
    assert!(count >= 10.0, "{count} in {:?}", start.elapsed());
}
