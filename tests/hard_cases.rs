//! The gallery of hard cases passes, is complete, and survives a case that panics or is cancelled.

use lightwell::cancel::{Cancel, Cancelled};
use lightwell::hard_cases::{Case, Row, Verdict, cases};
use lightwell::worker::{CheckReport, Checks};
use std::collections::HashSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

/// So long that only a thread that will never answer takes longer, however busy the machine is.
const PATIENCE: Duration = Duration::from_secs(300);

fn all_rows() -> Vec<Row> {
    cases().flat_map(|case| case.run(&Cancel::default()).expect("nothing cancels it")).collect()
}

#[test]
fn every_row_passes_or_is_a_known_limit() {
    let rows = all_rows();
    let failed: Vec<&Row> = rows.iter().filter(|row| row.verdict == Verdict::Fail).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    assert!(rows.len() >= 40, "{} rows", rows.len());
    let limits = rows.iter().filter(|row| row.verdict == Verdict::Limit).count();
    assert!(limits > 0 && limits < rows.len() / 2, "{limits} limits");
    let names: HashSet<_> = rows.iter().map(|row| (row.case, &row.quantity)).collect();
    assert_eq!(names.len(), rows.len(), "a quantity is there twice in one case");
    assert!(rows.iter().all(|row| !row.guard.is_empty() && row.tolerance >= 0.0 && row.expected.is_finite()));
}

#[test]
fn cases_have_names_of_their_own_and_say_what_they_are_about() {
    let names: HashSet<_> = cases().map(|case| case.name).collect();
    assert_eq!(names.len(), cases().count());
    let is_word = |name: &str| name.chars().all(|c| c.is_ascii_lowercase() || c == '-');
    assert!(cases().all(|case| is_word(case.name) && case.about.len() > 20));
}

#[test]
fn scenes_of_cases_can_be_shown() {
    let scenes: Vec<_> = cases().filter_map(|case| (case.scene)().map(|scene| (case.name, scene))).collect();
    assert!(scenes.len() > cases().count() / 2);
    for (name, scene) in scenes {
        assert!(scene.name == name && !scene.polygons.is_empty(), "{name}");
    }
}

const QUICK: Case = Case {
    name: "quick",
    about: "a case for tests that takes no time",
    measure: |rows| {
        rows.check("one", 1.0, lightwell::hard_cases::exactly(1.0), "nothing to guard");
        rows.check("a number", f64::NAN, lightwell::hard_cases::exactly(1.0), "nothing to guard");
        Ok(())
    },
    scene: || None,
};

const PANICKING: Case = Case { name: "panicking", measure: |_| panic!("on purpose"), ..QUICK };

/// Waits to be cancelled.
const ENDLESS: Case = Case {
    name: "endless",
    measure: |rows| {
        while !rows.cancel.is_requested() {
            std::thread::sleep(Duration::from_millis(1));
        }
        Err(Cancelled)
    },
    ..QUICK
};

#[test]
fn what_is_no_number_fails_and_so_does_a_panic() {
    let rows = QUICK.run(&Cancel::default()).expect("nothing cancels it");
    assert_eq!(rows.iter().map(|row| row.verdict).collect::<Vec<_>>(), [Verdict::Pass, Verdict::Fail]);
    let rows = PANICKING.run(&Cancel::default()).expect("nothing cancels it");
    assert!(rows.len() == 1 && rows[0].verdict == Verdict::Fail && rows[0].guard.contains("on purpose"), "{rows:?}");
}

/// Waits until a report is as wanted.
fn wait(checks: &Checks, is_wanted: impl Fn(&CheckReport) -> bool) -> Arc<CheckReport> {
    let start = Instant::now();
    loop {
        let report = checks.latest();
        if is_wanted(&report) {
            return report;
        }
        assert!(start.elapsed() < PATIENCE, "{report:?}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn the_thread_publishes_case_by_case_and_goes_on_after_a_panic() {
    let woken = Arc::new(AtomicU32::new(0));
    let count = woken.clone();
    let wake = move || {
        count.fetch_add(1, Ordering::Relaxed);
    };
    let checks = Checks::spawn_with(vec![&QUICK, &PANICKING, &QUICK], wake);
    let report = wait(&checks, |report| report.is_finished);
    assert_eq!(
        report.rows.iter().map(|row| row.case).collect::<Vec<_>>(),
        ["quick", "quick", "panicking", "quick", "quick"]
    );
    assert!(report.running.is_none());
    // Before each case, and at the end.
    assert_eq!(woken.load(Ordering::Relaxed), 4);
}

#[test]
fn dropping_the_checks_ends_them_without_waiting() {
    let woken = Arc::new(AtomicU32::new(0));
    let held = woken.clone();
    let checks = Checks::spawn_with(vec![&QUICK, &ENDLESS], move || {
        held.fetch_add(1, Ordering::Relaxed);
    });
    let report = wait(&checks, |report| report.running == Some("endless"));
    assert_eq!(report.rows.len(), 2, "rows are there while later cases run");
    drop(checks);
    let start = Instant::now();
    // The thread drops its closure when it ends.
    while Arc::strong_count(&woken) > 1 {
        assert!(start.elapsed() < PATIENCE);
        std::thread::sleep(Duration::from_millis(1));
    }
}
