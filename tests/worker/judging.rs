//! How far off the lights on the thread are, against the truth.

use crate::{load, steps, wait_for, with_elements};
use lightwell::accuracy::{Error, Reference, by_radiosity};
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::methods::{PhotonSettings, Settings};
use lightwell::solution::{CameraView, Judged};
use lightwell::worker::{Command, LightKind, Phase, Sight, Snapshot, Subject, Worker};
use std::time::{Duration, Instant};

/// Of the last run of a kind, measured last.
fn error(snapshot: &Snapshot, kind: LightKind) -> Option<(f64, Error)> {
    let track = snapshot.tracks.iter().rfind(|track| track.kind == kind)?;
    track.points.last().map(|point| (point.seconds, point.error))
}

fn is_known(snapshot: &Snapshot) -> bool {
    snapshot.truth.as_ref().is_some_and(|truth| truth.floor < 0.02)
}

#[test]
fn the_error_of_a_run_is_that_of_its_solution() {
    let worker = Worker::spawn(None, || ());
    worker.send(Command::Configure(with_elements(0.05)));
    load(&worker, "cornell-box");
    wait_for(&worker, "a truth", is_known);
    worker.send(Command::Run);
    let is_measured = |now: &Snapshot| {
        let elapsed = now.solution.as_ref().map(|solution| solution.elapsed.as_secs_f64());
        now.phase == Phase::Converged && error(now, LightKind::Radiosity).map(|(seconds, _)| seconds) == elapsed
    };
    let end = wait_for(&worker, "measured", is_measured);
    let (_, stated) = error(&end, LightKind::Radiosity).expect("an error");
    let (world, solution) = (end.world.as_ref().expect("a world"), end.solution.as_ref().expect("a solution"));
    let mut reference = Reference::new(world.clone());
    (0..64).for_each(|_| assert!(reference.refine(&Cancel::default())));
    let found = by_radiosity(world, solution, reference.points(), end.settings.seed);
    let outside = reference.truth().error(&found).expect("light");
    // The same points and, as far as it goes, the same paths: nothing but the noise of the two truths lies between.
    let limit = 3.0 * (stated.uncertainty + outside.uncertainty);
    assert!((stated.rms - outside.rms).abs() < limit, "{stated:?} {outside:?}");
    let track = &end.tracks[0];
    assert!(track.points.len() > 2 && track.points[0].error.rms > 2.0 * stated.rms, "{track:?}");
}

#[test]
fn what_was_measured_is_held_against_every_better_truth() {
    let worker = Worker::spawn(None, || ());
    worker.send(Command::Configure(with_elements(0.04)));
    load(&worker, "cornell-box");
    wait_for(&worker, "a truth", is_known);
    worker.send(Command::Run);
    let floor = |now: &Snapshot| now.truth.as_ref().map_or(f64::INFINITY, |truth| truth.floor);
    let early = wait_for(&worker, "measured", |now| error(now, LightKind::Radiosity).is_some());
    let late = wait_for(&worker, "a better truth", |now| floor(now) < 0.8 * floor(&early));
    let track = &late.tracks[0];
    assert!(track.points.iter().all(|point| point.error.floor == floor(&late)), "{} {track:?}", floor(&late));
}

#[test]
fn each_run_leaves_a_track_and_another_scene_none() {
    let worker = Worker::spawn(None, || ());
    let photons = PhotonSettings { count: 20_000, is_progressive: true, passes: 4, ..PhotonSettings::default() };
    let settings = Settings { photons, ..with_elements(0.2) };
    worker.send(Command::Configure(settings));
    load(&worker, "cornell-box");
    wait_for(&worker, "a truth", is_known);
    worker.send(Command::Run);
    wait_for(&worker, "converged", |now| now.phase == Phase::Converged && error(now, LightKind::Radiosity).is_some());
    let world = worker.latest().world.clone().expect("a world");
    let camera = Camera::new(&world.viewpoint, &world.bounds);
    worker.send(Command::Look(Sight { subject: Subject::Photons, camera, size: [64, 64] }));
    worker.send(Command::Run);
    let is_traced = |now: &Snapshot| now.photons.as_ref().is_some_and(|photons| photons.passes == 4);
    let traced = wait_for(&worker, "traced", |now| {
        is_traced(now) && now.phase == Phase::Converged && error(now, LightKind::Photons).is_some()
    });
    // Passes tell their own noise.
    let is_told = |now: &Snapshot| error(now, LightKind::Photons).is_some_and(|(_, error)| error.noise > Some(0.0));
    wait_for(&worker, "told apart", is_told);
    assert_eq!(traced.tracks.len(), 2);
    // A finer mesh is another run on the same scene.
    worker.send(Command::Look(Sight { subject: Subject::Radiosity, camera, size: [64, 64] }));
    worker.send(Command::Configure(Settings { photons, ..with_elements(0.15) }));
    worker.send(Command::Run);
    let finer = wait_for(&worker, "measured", |now| now.tracks.len() == 3);
    assert!(finer.tracks[2].settings.mesh != finer.tracks[0].settings.mesh);
    load(&worker, "furnace");
    let other =
        wait_for(&worker, "another scene", |now| now.world.as_ref().is_some_and(|now| now.scene.name == "furnace"));
    assert!(other.tracks.is_empty(), "{:?}", other.tracks);
}

/// Wall time over solver time of a second of radiosity, the median of three runs.
fn time_over_solver_time(prepare: &dyn Fn(&Worker)) -> f64 {
    let run = || {
        let worker = Worker::spawn(None, || ());
        worker.send(Command::Configure(Settings { unshot_limit: 1e-12, ..with_elements(0.05) }));
        load(&worker, "cornell-box");
        prepare(&worker);
        let solver = |now: &Snapshot| now.solution.as_ref().map_or(Duration::ZERO, |solution| solution.elapsed);
        let start = Instant::now();
        worker.send(Command::Run);
        let end = wait_for(&worker, "a second of work", |now| solver(now) > Duration::from_secs(1) && steps(now) > 0);
        start.elapsed().as_secs_f64() / solver(&end).as_secs_f64()
    };
    let mut times: Vec<f64> = (0..3).map(|_| run()).collect();
    times.sort_by(f64::total_cmp);
    times[1]
}

/// A run with a truth that is being refined takes hardly longer than one that is left alone.
#[test]
fn measuring_hardly_holds_a_run_up() {
    let [alone, measured] =
        [true, false].map(|is_hushed| time_over_solver_time(&|worker| worker.send(Command::Hush(is_hushed))));
    println!("time over solver time: {alone:.3} alone, {measured:.3} measured");
    // The program allows 3 %; the rest is room for a machine that is busy otherwise.
    assert!(measured < 1.10 * alone, "{alone} {measured}");
}

/// Neither does one whose errors are watched.
#[test]
fn watching_errors_hardly_holds_a_run_up() {
    let watch = |subject| {
        move |worker: &Worker| {
            worker.send(Command::Hush(true));
            let world = worker.latest().world.clone().expect("a world");
            let camera = Camera::new(&world.viewpoint, &world.bounds);
            worker.send(Command::Look(Sight { subject, camera, size: [800, 600] }));
        }
    };
    let errors = Subject::Camera(CameraView::Error(Judged::RadiositySpecular));
    let [alone, watched] = [Subject::Radiosity, errors].map(|subject| time_over_solver_time(&watch(subject)));
    println!("time over solver time: {alone:.3} alone, {watched:.3} watched");
    // The program allows 4 %, and a first coarse picture; the rest is room for a machine that is busy otherwise.
    assert!(watched < 1.12 * alone, "{alone} {watched}");
}
