//! What is published, and how often.

use crate::fake;
use crate::pace::Watched;
use crate::{load, name, steps, wait_for};
use lightwell::clock::{Clock, ManualTime};
use lightwell::methods::Step;
use lightwell::worker::{Command, Phase, Snapshot};
use std::sync::Arc;
use std::time::Duration;

fn phases(snapshots: &[Arc<Snapshot>]) -> Vec<Phase> {
    let mut phases: Vec<Phase> = snapshots.iter().map(|snapshot| snapshot.phase.clone()).collect();
    phases.dedup();
    phases
}

#[test]
fn a_scene_is_opened_then_run_until_it_has_converged() {
    let work = |steps, _: &_| if steps < 3 { Step::Advanced } else { Step::Converged };
    let watched = Watched::spawn(fake::method(work), Clock::default());
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
    let running = watched.until_phase(&Phase::Converged);
    assert_eq!(phases(&running), [Phase::Running, Phase::Converged]);
    assert_eq!(steps(running.last().expect("one at least")), 3);
    assert!(watched.is_quiet());
}

#[test]
fn so_many_steps_are_done_and_each_is_published() {
    let watched = Watched::spawn(fake::method(|_, _| Step::Advanced), Clock::default());
    watched.worker.send(Command::Load("furnace".to_owned()));
    watched.until_phase(&Phase::Paused);
    for (asked, first) in [(1, 0), (10, 1), (100, 11)] {
        watched.worker.send(Command::Step(asked));
        let published = watched.until_phase(&Phase::Paused);
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
fn a_run_publishes_thirty_times_a_second() {
    const STEPS: u64 = 990;
    let time = ManualTime::default();
    let clock = time.clock();
    let work = move |steps, _: &_| {
        time.advance(Duration::from_millis(1));
        if steps < STEPS { Step::Advanced } else { Step::Converged }
    };
    let watched = Watched::spawn(fake::method(work), clock);
    watched.worker.send(Command::Load("furnace".to_owned()));
    watched.until_phase(&Phase::Paused);
    watched.worker.send(Command::Run);
    let published: Vec<u64> = watched.until_phase(&Phase::Converged).iter().map(|now| steps(now)).collect();
    // Every 33 ms, and so every 33 steps; and that it runs, and that it has converged.
    let expected: Vec<u64> = (0..=STEPS).step_by(33).chain([STEPS]).collect();
    assert_eq!(published, expected);
}
