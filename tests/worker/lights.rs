//! Radiosity and photons side by side.

use crate::fake::{self, BATCHES, Counts, Fakes};
use crate::pace::Gate;
use crate::{load, look, steps, wait_for, wait_until};
use lightwell::methods::{PhotonSettings, Settings, Step};
use lightwell::solution::{CameraView, Photon};
use lightwell::worker::{Command, LightKind, Phase, Snapshot, Spot, Subject, Worker};
use std::sync::Arc;
use std::sync::mpsc::channel;
use std::time::Duration;

fn batches(snapshot: &Snapshot) -> u64 {
    snapshot.photons.as_ref().map_or(0, |photons| photons.batches)
}

fn step(worker: &Worker, steps: u64) {
    worker.send(Command::Step(steps));
}

/// A worker in the furnace with three steps of radiosity and four batches of photons, which are on show.
fn with_both() -> (Worker, Arc<Counts>, Arc<Snapshot>) {
    let (worker, counts) = Fakes::default().spawn();
    load(&worker, "furnace");
    step(&worker, 3);
    wait_for(&worker, "stepped", |now| steps(now) == 3 && now.phase == Phase::Paused);
    look(&worker, Subject::Photons);
    step(&worker, 4);
    let both = wait_for(&worker, "traced", |now| batches(now) == 4 && now.phase == Phase::Paused);
    (worker, counts, both)
}

#[test]
fn commands_are_about_the_light_on_show_and_the_other_is_kept() {
    let (worker, counts, both) = with_both();
    assert_eq!(steps(&both), 3);
    look(&worker, Subject::Radiosity);
    step(&worker, 1);
    let radiosity = wait_for(&worker, "stepped", |now| steps(now) == 4 && now.phase == Phase::Paused);
    assert_eq!(batches(&radiosity), 4);
    // What photons are read off a picture drives them, too; so it is with radiosity.
    look(&worker, Subject::Camera(CameraView::FinalGather));
    step(&worker, 1);
    wait_for(&worker, "traced", |now| batches(now) == 5 && now.phase == Phase::Paused);
    look(&worker, Subject::Camera(CameraView::RadiositySpecular));
    worker.send(Command::Reset);
    let reset = wait_for(&worker, "reset", |now| steps(now) == 0);
    assert_eq!((batches(&reset), &reset.phase), (5, &Phase::Paused));
    look(&worker, Subject::Photons);
    worker.send(Command::Run);
    let end = wait_for(&worker, "complete", |now| now.phase == Phase::Converged);
    assert_eq!((steps(&end), batches(&end)), (0, BATCHES));
    worker.send(Command::Reset);
    wait_for(&worker, "reset", |now| batches(now) == 0 && now.phase == Phase::Paused);
    assert_eq!((Counts::of(&counts.radiosity_starts), Counts::of(&counts.photon_starts)), (2, 2));
}

#[test]
fn switching_views_computes_nothing() {
    let (worker, counts, both) = with_both();
    for subject in [Subject::Radiosity, Subject::Photons, Subject::Radiosity, Subject::Photons] {
        look(&worker, subject);
        std::thread::sleep(Duration::from_millis(5));
    }
    step(&worker, 1);
    let after = wait_for(&worker, "traced", |now| batches(now) == 5);
    let (old, new) = (both.solution.as_ref().expect("light"), after.solution.as_ref().expect("light"));
    assert!(Arc::ptr_eq(old, new));
    let starts = [&counts.radiosity_starts, &counts.photon_starts].map(Counts::of);
    let steps = [&counts.radiosity_steps, &counts.photon_steps].map(Counts::of);
    assert_eq!((starts, steps), ([1, 1], [3, 5]));
}

#[test]
fn photons_begin_when_they_are_first_needed() {
    let (worker, counts) = Fakes::default().spawn();
    let loaded = load(&worker, "furnace");
    assert!(loaded.photons.is_none());
    look(&worker, Subject::Camera(CameraView::RayTraced));
    wait_for(&worker, "traced", |now| now.phase == Phase::Converged);
    assert_eq!(Counts::of(&counts.photon_starts), 0);
    look(&worker, Subject::Photons);
    let photons = wait_for(&worker, "there", |now| now.photons.is_some());
    assert_eq!((batches(&photons), &photons.phase), (0, &Phase::Paused));
}

#[test]
fn what_is_on_show_is_worked_on_first_and_then_the_other_light() {
    let fakes = Fakes::default();
    let (tell, told) = channel();
    let counts = fakes.counts();
    let (worker, counts) = fakes
        .photons(move |batch, cancel| {
            // Nobody listens once the test is over.
            let _ = tell.send(Counts::of(&counts.radiosity_steps));
            fake::short_step(batch, cancel)
        })
        .spawn();
    load(&worker, "furnace");
    worker.send(Command::Run);
    wait_for(&worker, "running", |now| steps(now) > 0);
    look(&worker, Subject::Photons);
    worker.send(Command::Run);
    wait_for(&worker, "traced", |now| batches(now) == BATCHES);
    let radiosity: Vec<u64> = told.try_iter().collect();
    assert_eq!(radiosity.len() as u64, BATCHES);
    assert!(radiosity[0] > 0 && radiosity.iter().all(|&steps| steps == radiosity[0]), "radiosity waits: {radiosity:?}");
    // It goes on where it was when there is nothing to do on the photons.
    let before = Counts::of(&counts.radiosity_steps);
    wait_for(&worker, "further", |_| Counts::of(&counts.radiosity_steps) > before + 10);
    assert_eq!(worker.latest().phase, Phase::Converged);
    look(&worker, Subject::Radiosity);
    wait_for(&worker, "running", |now| now.phase == Phase::Running);
}

#[test]
fn settings_start_only_that_light_anew_which_they_are_about() {
    let (worker, counts, both) = with_both();
    let starts = || [&counts.radiosity_starts, &counts.photon_starts].map(Counts::of);
    let photons = PhotonSettings { count: 1000, ..both.settings.photons };
    let settings = Settings { photons, ..both.settings };
    worker.send(Command::Configure(settings));
    let after = wait_for(&worker, "configured", |now| now.settings == settings);
    assert_eq!((starts(), steps(&after), batches(&after)), ([1, 2], 3, 0));
    step(&worker, 2);
    wait_for(&worker, "traced", |now| batches(now) == 2);
    let settings = Settings { shadow_rays: 7, ..settings };
    worker.send(Command::Configure(settings));
    let after = wait_for(&worker, "configured", |now| now.settings == settings);
    assert_eq!((starts(), steps(&after), batches(&after)), ([2, 2], 0, 2));
    let settings = Settings { seed: 3, ..settings };
    worker.send(Command::Configure(settings));
    let after = wait_for(&worker, "configured", |now| now.settings == settings);
    assert_eq!((starts(), batches(&after)), ([3, 3], 0));
}

#[test]
fn photons_that_do_not_fit_are_refused_and_those_that_are_there_stay() {
    let (worker, _, both) = with_both();
    let photons = PhotonSettings { count: 2_000_000, ..both.settings.photons };
    worker.send(Command::Configure(Settings { photons, shadow_rays: 7, ..both.settings }));
    let after = wait_for(&worker, "refused", |now| now.error.as_ref().is_some_and(|error| error.contains("photons")));
    // Radiosity takes over what is about it.
    assert_eq!(after.settings, Settings { shadow_rays: 7, ..both.settings });
    assert_eq!((batches(&after), steps(&after)), (4, 0));
    step(&worker, 1);
    wait_for(&worker, "traced", |now| batches(now) == 5 && now.error.is_none());
}

#[test]
fn another_scene_starts_both_anew_and_each_runs_on_if_it_ran() {
    let (worker, counts, _) = with_both();
    worker.send(Command::Gather(Some(Spot { point: glam::Vec3::ZERO, normal: glam::Vec3::Y })));
    wait_for(&worker, "gathered", |now| now.gathered.is_some());
    worker.send(Command::Load("empty-box".to_owned()));
    let after = wait_for(&worker, "loaded", |now| crate::name(now) == "empty-box" && now.phase == Phase::Paused);
    assert_eq!((steps(&after), batches(&after)), (0, 0));
    assert!(after.gathered.is_none() && after.image.is_none());
    assert_eq!((Counts::of(&counts.radiosity_starts), Counts::of(&counts.photon_starts)), (2, 2));

    let gate = Gate::default();
    let step = gate.clone();
    let (worker, _) = Fakes::default().photons(move |_, cancel| step.step(cancel)).spawn();
    load(&worker, "furnace");
    look(&worker, Subject::Photons);
    worker.send(Command::Run);
    gate.pass_one();
    // It interrupts the second batch; all batches of the other scene may pass.
    worker.send(Command::Load("empty-box".to_owned()));
    wait_until("interrupted", || gate.cancelled() == 1);
    gate.open(BATCHES);
    let end = wait_for(&worker, "complete", |now| crate::name(now) == "empty-box" && batches(now) == BATCHES);
    assert_eq!(steps(&end), 0);
}

#[test]
fn a_crash_of_one_light_leaves_the_other() {
    let work = |batch, cancel: &_| if batch < 2 { fake::short_step(batch, cancel) } else { panic!("no third batch") };
    let (worker, _) = Fakes::default().photons(work).spawn();
    load(&worker, "furnace");
    step(&worker, 3);
    wait_for(&worker, "stepped", |now| steps(now) == 3 && now.phase == Phase::Paused);
    look(&worker, Subject::Photons);
    worker.send(Command::Run);
    let crashed = wait_for(&worker, "crashed", |now| now.phase == Phase::Crashed);
    assert!(crashed.error.as_ref().is_some_and(|error| error.contains("no third batch")), "{:?}", crashed.error);
    look(&worker, Subject::Radiosity);
    let radiosity = wait_for(&worker, "looked at", |now| now.phase == Phase::Paused);
    assert_eq!(steps(&radiosity), 3);
    step(&worker, 1);
    wait_for(&worker, "stepped", |now| steps(now) == 4);
    look(&worker, Subject::Photons);
    wait_for(&worker, "looked at", |now| now.phase == Phase::Crashed);
    worker.send(Command::Reset);
    let fresh = wait_for(&worker, "reset", |now| now.phase == Phase::Paused);
    assert_eq!((batches(&fresh), steps(&fresh), &fresh.error), (0, 4, &None));
}

#[test]
fn what_is_picked_among_photons_keeps_up_with_them() {
    let (worker, _, _) = with_both();
    let photon = worker.latest().photons.as_ref().expect("photons").photons[2];
    worker.send(Command::PickPhoton(Some(photon)));
    let picked = wait_for(&worker, "picked", |now| now.trail.is_some());
    assert_eq!(picked.trail.as_ref().expect("a trail").places.len(), 3);
    worker.send(Command::Gather(Some(Spot { point: glam::Vec3::ZERO, normal: glam::Vec3::Y })));
    let used = |now: &Snapshot| now.gathered.as_ref().map_or(0, |gathered| gathered.used.len());
    wait_for(&worker, "gathered", |now| used(now) == 4);
    step(&worker, 1);
    let more = wait_for(&worker, "traced", |now| used(now) == 5);
    assert!(more.trail.is_some());
    // A photon that is not there has no way; a spot that makes the photons crash is not tried again.
    worker.send(Command::PickPhoton(Some(Photon { emission: 99, ..photon })));
    wait_for(&worker, "forgotten", |now| now.trail.is_none());
    worker.send(Command::Gather(Some(Spot { point: 2e6 * glam::Vec3::X, normal: glam::Vec3::Y })));
    wait_for(&worker, "crashed", |now| now.phase == Phase::Crashed);
    worker.send(Command::Reset);
    let fresh = wait_for(&worker, "reset", |now| now.phase == Phase::Paused);
    assert!(fresh.gathered.is_none());
}

#[test]
fn a_long_batch_is_interrupted_by_another_view_and_not_by_a_camera_that_moves() {
    let gate = Gate::default();
    let step = gate.clone();
    let (worker, _) = Fakes::default().photons(move |_, cancel| step.step(cancel)).spawn();
    load(&worker, "furnace");
    look(&worker, Subject::Photons);
    worker.send(Command::Run);
    gate.wait_for_step_after(0);
    for i in 0..40 {
        crate::look_from(&worker, Subject::Photons, 2.0 + i as f32);
    }
    gate.pass_one();
    assert_eq!(gate.cancelled(), 0, "a camera that moves stops the photons");
    look(&worker, Subject::Camera(CameraView::RayTraced));
    wait_for(&worker, "traced", |now| now.image.is_some());
    assert_eq!(gate.cancelled(), 1);
    assert_eq!(Subject::Camera(CameraView::RayTraced).light(), None);
    assert_eq!(Subject::Camera(CameraView::Caustics).light(), Some(LightKind::Photons));
}

#[test]
fn a_step_under_way_counts_once() {
    let (worker, _) =
        Fakes::default().radiosity(|steps, _| if steps < 5 { Step::Advanced } else { Step::Converged }).spawn();
    load(&worker, "furnace");
    look(&worker, Subject::Camera(CameraView::RadiositySpecular));
    worker.send(Command::Run);
    let end = wait_for(&worker, "converged", |now| now.phase == Phase::Converged);
    assert_eq!(steps(&end), 5);
    wait_for(&worker, "pictured", |now| now.image.as_ref().is_some_and(|image| image.rays == 5 && image.is_complete));
}
