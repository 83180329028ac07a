//! Ambient occlusion on the mesh beside the lights.

use crate::fake::{self, Counts, Fakes};
use crate::{dark_scene, load, look, steps, wait_for, with_elements};
use lightwell::methods::{Falloff, ImageSettings, OcclusionSettings, Settings};
use lightwell::solution::CameraView;
use lightwell::worker::{Command, Phase, Snapshot, Subject, Worker};

fn rounds(snapshot: &Snapshot) -> u32 {
    snapshot.occlusion.as_ref().map_or(0, |occlusion| occlusion.rounds)
}

/// Looks at ambient occlusion on the mesh and does so many of its steps.
fn step(worker: &Worker, steps: u64) {
    look(worker, Subject::Occlusion);
    worker.send(Command::Step(steps));
}

#[test]
fn it_begins_when_its_view_is_looked_at() {
    let (worker, counts) = Fakes::default().spawn();
    let loaded = load(&worker, "furnace");
    assert!(loaded.occlusion.is_none());
    for subject in [Subject::Photons, Subject::Camera(CameraView::AmbientOcclusion), Subject::Radiosity] {
        look(&worker, subject);
        worker.send(Command::Run);
        wait_for(&worker, "looked at", |now| now.phase != Phase::Paused);
        worker.send(Command::Pause);
        assert_eq!(Counts::of(&counts.occlusion_starts), 0, "{subject:?}");
    }
    look(&worker, Subject::Occlusion);
    let there = wait_for(&worker, "there", |now| now.occlusion.is_some());
    assert_eq!((rounds(&there), &there.phase), (0, &Phase::Paused));
    assert_eq!(Counts::of(&counts.occlusion_starts), 1);
}

#[test]
fn commands_are_about_it_while_it_is_on_show() {
    let (worker, counts) = Fakes::default().spawn();
    load(&worker, "furnace");
    worker.send(Command::Step(3));
    wait_for(&worker, "stepped", |now| steps(now) == 3 && now.phase == Phase::Paused);
    step(&worker, 2);
    let both = wait_for(&worker, "stepped", |now| rounds(now) == 2 && now.phase == Phase::Paused);
    assert_eq!(steps(&both), 3);
    look(&worker, Subject::Radiosity);
    worker.send(Command::Reset);
    let reset = wait_for(&worker, "reset", |now| steps(now) == 0);
    assert_eq!(rounds(&reset), 2);
    look(&worker, Subject::Occlusion);
    worker.send(Command::Run);
    let end = wait_for(&worker, "complete", |now| now.phase == Phase::Converged);
    assert_eq!((rounds(&end), steps(&end)), (Settings::default().image.samples, 0));
    worker.send(Command::Reset);
    wait_for(&worker, "reset", |now| rounds(now) == 0 && now.phase == Phase::Paused);
    assert_eq!(Counts::of(&counts.occlusion_starts), 2);
}

#[test]
fn it_goes_on_where_only_more_rounds_are_wanted_and_else_starts_anew() {
    let (worker, counts) = Fakes::default().spawn();
    load(&worker, "furnace");
    worker.send(Command::Step(3));
    wait_for(&worker, "stepped", |now| steps(now) == 3 && now.phase == Phase::Paused);
    step(&worker, 2);
    let old = wait_for(&worker, "stepped", |now| rounds(now) == 2 && now.phase == Phase::Paused).settings;
    let configure = |settings: Settings| {
        worker.send(Command::Configure(settings));
        wait_for(&worker, "configured", |now| now.settings == settings)
    };
    let more = Settings { image: ImageSettings { samples: 20, ..old.image }, ..old };
    let after = configure(more);
    assert_eq!((rounds(&after), steps(&after), Counts::of(&counts.occlusion_starts)), (2, 3, 1));
    let faded = OcclusionSettings { falloff: Falloff::None, ..old.occlusion };
    let after = configure(Settings { occlusion: faded, ..more });
    assert_eq!((rounds(&after), steps(&after), Counts::of(&counts.occlusion_starts)), (0, 3, 2));
    step(&worker, 1);
    wait_for(&worker, "stepped", |now| rounds(now) == 1);
    let after = configure(Settings { seed: 7, occlusion: faded, ..more });
    assert_eq!((rounds(&after), Counts::of(&counts.occlusion_starts)), (0, 3));
    let after = configure(Settings { seed: 7, occlusion: faded, image: more.image, ..with_elements(0.5) });
    assert_eq!((rounds(&after), Counts::of(&counts.occlusion_starts)), (0, 4));
}

#[test]
fn it_runs_in_a_scene_without_an_emitter() {
    let (_folder, path) = dark_scene();
    let (worker, _) = Fakes::default().spawn();
    let loaded = load(&worker, path.to_str().expect("a path"));
    assert!(!loaded.world.as_ref().expect("a world").scene.has_emitter());
    look(&worker, Subject::Occlusion);
    worker.send(Command::Run);
    wait_for(&worker, "complete", |now| now.phase == Phase::Converged && rounds(now) > 0);
}

#[test]
fn its_crash_leaves_the_light_and_a_reset_mends_it() {
    let work = |round, cancel: &_| if round < 2 { fake::short_step(round, cancel) } else { panic!("no third round") };
    let (worker, _) = Fakes::default().occlusion(work).spawn();
    load(&worker, "furnace");
    worker.send(Command::Step(3));
    wait_for(&worker, "stepped", |now| steps(now) == 3 && now.phase == Phase::Paused);
    look(&worker, Subject::Occlusion);
    worker.send(Command::Run);
    let crashed = wait_for(&worker, "crashed", |now| now.phase == Phase::Crashed);
    let error = crashed.error.clone().unwrap_or_default();
    assert!(error.contains("ambient occlusion stopped: no third round"), "{error}");
    look(&worker, Subject::Radiosity);
    let radiosity = wait_for(&worker, "looked at", |now| now.phase == Phase::Paused);
    assert_eq!(steps(&radiosity), 3);
    look(&worker, Subject::Occlusion);
    worker.send(Command::Reset);
    wait_for(&worker, "reset", |now| now.phase == Phase::Paused && rounds(now) == 0 && now.error.is_none());
}
