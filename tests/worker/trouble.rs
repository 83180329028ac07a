//! Scenes that cannot be opened, and methods that panic.

use crate::{fake, load, name, steps, wait_for};
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{Method, Settings, Step};
use lightwell::worker::{Command, Phase, Worker};
use lightwell::world::World;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

#[test]
fn a_scene_that_cannot_be_opened_leaves_the_one_that_is_open() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    std::fs::create_dir(path("folder.obj")).expect("a folder");
    std::fs::write(path("empty.obj"), "").expect("a file");
    let worker = Worker::spawn(None, || ());
    load(&worker, "furnace");
    worker.send(Command::Step(2));
    let before = wait_for(&worker, "stepped", |now| steps(now) == 2 && now.phase == Phase::Paused);
    // Each with its cause: there is none, it is a folder, it is empty.
    for (file, cause) in
        [("missing.obj", "no such file"), ("folder.obj", "directory"), ("empty.obj", "the file is empty")]
    {
        worker.send(Command::Load(path(file)));
        let after = wait_for(&worker, "refused", |now| {
            now.error.as_ref().is_some_and(|error| error.contains(file) && error.contains(cause))
        });
        assert_eq!(after.phase, Phase::Paused);
        let (old, new) = (before.world.as_ref().expect("a world"), after.world.as_ref().expect("a world"));
        assert!(Arc::ptr_eq(old, new));
        let (old, new) = (before.solution.as_ref().expect("light"), after.solution.as_ref().expect("light"));
        assert!(Arc::ptr_eq(old, new));
    }
    worker.send(Command::Step(1));
    let after = wait_for(&worker, "stepped", |now| steps(now) == 3);
    assert_eq!(after.error, None);
}

#[test]
fn a_run_goes_on_where_another_scene_cannot_be_opened() {
    let worker = fake::worker(fake::short_step);
    load(&worker, "furnace");
    worker.send(Command::Run);
    wait_for(&worker, "running", |now| steps(now) > 0);
    worker.send(Command::Load("no such scene".to_owned()));
    let refused = wait_for(&worker, "refused", |now| now.error.is_some());
    let later = wait_for(&worker, "further", |now| steps(now) > steps(&refused));
    assert_eq!((&later.phase, &later.error), (&Phase::Running, &refused.error));
}

#[test]
fn a_panic_is_told_and_a_reset_starts_afresh() {
    let worker = fake::worker(|steps, _| if steps < 3 { Step::Advanced } else { panic!("step {steps} went wrong") });
    load(&worker, "furnace");
    for _ in 0..2 {
        worker.send(Command::Run);
        let crashed = wait_for(&worker, "crashed", |now| now.phase == Phase::Crashed);
        let error = crashed.error.as_ref().expect("a message");
        assert!(error.contains("step 3 went wrong"), "{error}");
        worker.send(Command::Reset);
        let fresh = wait_for(&worker, "reset", |now| now.phase == Phase::Paused);
        assert_eq!((steps(&fresh), &fresh.error), (0, &None));
    }
    worker.send(Command::Step(2));
    wait_for(&worker, "stepped", |now| steps(now) == 2 && now.phase == Phase::Paused);
}

#[test]
fn a_scene_that_is_opened_after_a_panic_is_as_good_as_any() {
    let worker = fake::worker(|_, _| panic!("a text without numbers"));
    load(&worker, "furnace");
    worker.send(Command::Run);
    let crashed = wait_for(&worker, "crashed", |now| now.phase == Phase::Crashed);
    assert!(crashed.error.as_ref().is_some_and(|error| error.contains("a text without numbers")));
    // None of these has anything to work on.
    for command in [Command::Run, Command::Pause, Command::Step(1)] {
        worker.send(command);
    }
    worker.send(Command::Load("empty-box".to_owned()));
    let loaded = wait_for(&worker, "loaded", |now| name(now) == "empty-box" && now.phase == Phase::Paused);
    assert_eq!((steps(&loaded), &loaded.error), (0, &None));
}

#[test]
fn new_settings_after_a_panic_start_afresh() {
    let is_broken = Arc::new(AtomicBool::new(true));
    let flag = is_broken.clone();
    let worker = fake::worker(move |_, _| {
        assert!(!flag.load(Ordering::SeqCst), "broken");
        Step::Advanced
    });
    let loaded = load(&worker, "furnace");
    worker.send(Command::Run);
    wait_for(&worker, "crashed", |now| now.phase == Phase::Crashed);
    is_broken.store(false, Ordering::SeqCst);
    let settings = Settings { seed: 1, ..loaded.settings };
    worker.send(Command::Configure(settings));
    let fresh = wait_for(&worker, "configured", |now| now.settings == settings);
    assert_eq!((steps(&fresh), &fresh.phase, &fresh.error), (0, &Phase::Paused, &None));
}

#[test]
fn a_method_that_panics_before_its_first_step_leaves_no_light_of_another_world() {
    let start = |world: Arc<World>, settings: &Settings| -> Box<dyn Method> {
        assert_ne!(world.scene.name, "empty-box", "no such method there");
        Box::new(Progressive::new(world, *settings))
    };
    let (worker, _) = fake::Fakes::default().starting(start).spawn();
    load(&worker, "furnace");
    worker.send(Command::Load("empty-box".to_owned()));
    let crashed = wait_for(&worker, "crashed", |now| now.phase == Phase::Crashed);
    assert!(crashed.error.as_ref().is_some_and(|error| error.contains("no such method there")));
    if let (Some(world), Some(solution)) = (&crashed.world, &crashed.solution) {
        assert_eq!(solution.light.radiosity.len(), world.mesh.elements.len());
    }
    load(&worker, "furnace");
}
