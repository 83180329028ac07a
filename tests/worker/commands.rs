//! What each command does.

use crate::{dark_scene, fake, load, name, steps, wait_for, with_elements};
use lightwell::methods::Settings;
use lightwell::scene::FindingKind;
use lightwell::worker::{Command, Phase, Snapshot, Worker};
use std::sync::Arc;

/// A worker that did five steps in the furnace and waits.
fn after_five_steps() -> (Worker, Arc<Snapshot>) {
    let worker = Worker::spawn(None, || ());
    worker.send(Command::Configure(with_elements(0.125)));
    load(&worker, "furnace");
    worker.send(Command::Step(5));
    let snapshot = wait_for(&worker, "stepped", |now| steps(now) == 5 && now.phase == Phase::Paused);
    (worker, snapshot)
}

fn same_world(a: &Snapshot, b: &Snapshot) -> bool {
    match (&a.world, &b.world) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        _ => false,
    }
}

fn same_solution(a: &Snapshot, b: &Snapshot) -> bool {
    match (&a.solution, &b.solution) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        _ => false,
    }
}

#[test]
fn the_newest_of_several_scenes_wins() {
    let worker = Worker::spawn(None, || ());
    for scene in ["gallery", "cornell-box", "no such scene", "two-rooms", "furnace"] {
        worker.send(Command::Load(scene.to_owned()));
    }
    let last =
        wait_for(&worker, "loaded", |now| now.phase == Phase::Paused && now.world.is_some() && name(now) == "furnace");
    assert_eq!(last.error, None);
    worker.send(Command::Step(1));
    let after = wait_for(&worker, "stepped", |now| steps(now) == 1);
    assert!(same_world(&after, &last));
}

#[test]
fn a_scene_that_is_opened_while_another_runs_goes_on_running() {
    let worker = fake::worker(fake::short_step);
    load(&worker, "furnace");
    worker.send(Command::Run);
    wait_for(&worker, "running", |now| steps(now) > 0);
    worker.send(Command::Load("empty-box".to_owned()));
    let after = wait_for(&worker, "running", |now| name(now) == "empty-box" && steps(now) > 0);
    assert_eq!(after.phase, Phase::Running);
}

#[test]
fn a_new_stop_rule_keeps_the_progress() {
    let (worker, before) = after_five_steps();
    let settings = Settings { unshot_limit: 0.9, ..before.settings };
    worker.send(Command::Configure(settings));
    let after = wait_for(&worker, "configured", |now| now.settings == settings);
    assert!(same_world(&after, &before) && same_solution(&after, &before));
    assert_eq!((steps(&after), &after.phase), (5, &Phase::Paused));
    worker.send(Command::Run);
    let end = wait_for(&worker, "converged", |now| now.phase == Phase::Converged);
    let solution = end.solution.as_ref().expect("a solution");
    assert!(solution.converged && solution.unshot_share <= 0.9);
    // A stricter rule takes the word back.
    worker.send(Command::Configure(Settings { unshot_limit: 0.5, ..settings }));
    let after = wait_for(&worker, "configured", |now| now.settings.unshot_limit == 0.5);
    assert_eq!((steps(&after), &after.phase), (solution.steps, &Phase::Paused));
}

#[test]
fn a_new_seed_starts_again_in_the_same_world() {
    let (worker, before) = after_five_steps();
    let settings = Settings { seed: 1, ..before.settings };
    worker.send(Command::Configure(settings));
    let after = wait_for(&worker, "configured", |now| now.settings == settings);
    assert!(same_world(&after, &before));
    assert_eq!((steps(&after), &after.phase), (0, &Phase::Paused));
}

#[test]
fn a_new_element_size_makes_a_new_world_of_the_same_scene() {
    let (worker, before) = after_five_steps();
    let settings = with_elements(0.0625);
    worker.send(Command::Configure(settings));
    let after = wait_for(&worker, "configured", |now| now.settings == settings);
    let (old, new) = (before.world.as_ref().expect("a world"), after.world.as_ref().expect("a world"));
    assert_eq!(new.mesh.elements.len(), 4 * old.mesh.elements.len());
    assert!(Arc::ptr_eq(&old.scene, &new.scene));
    assert_eq!((steps(&after), &after.phase), (0, &Phase::Paused));
    assert_eq!(after.solution.as_ref().expect("a solution").light.radiosity.len(), new.mesh.elements.len());
}

#[test]
fn an_element_size_that_is_too_fine_says_so_and_keeps_everything() {
    let (worker, before) = after_five_steps();
    for (size, reason) in [(1e-6, "at most"), (-1.0, "above 0"), (f32::NAN, "above 0")] {
        worker.send(Command::Configure(with_elements(size)));
        let after = wait_for(&worker, "refused", |now| now.error.as_ref().is_some_and(|error| error.contains(reason)));
        assert_eq!((after.settings, &after.phase), (before.settings, &Phase::Paused));
        assert!(same_world(&after, &before) && same_solution(&after, &before));
    }
    // The message stays until something succeeds.
    worker.send(Command::Configure(Settings { unshot_limit: 0.5, ..before.settings }));
    let after = wait_for(&worker, "configured", |now| now.settings.unshot_limit == 0.5);
    assert_eq!(after.error, None);
}

#[test]
fn reset_starts_from_the_emitters_again() {
    let (worker, before) = after_five_steps();
    worker.send(Command::Run);
    worker.send(Command::Reset);
    let after = wait_for(&worker, "reset", |now| steps(now) == 0);
    assert_eq!(after.phase, Phase::Paused);
    assert!(same_world(&after, &before));
    let energy = after.solution.as_ref().expect("a solution").energy;
    assert_eq!(energy.unshot, energy.emitted);
}

#[test]
fn a_scene_without_emitters_converges_at_once_and_says_why() {
    let (_folder, path) = dark_scene();
    let worker = Worker::spawn(None, || ());
    let loaded = load(&worker, &path.display().to_string());
    let kinds = |snapshot: &Snapshot| -> Vec<FindingKind> {
        snapshot.world.as_ref().expect("a world").scene.findings.iter().map(|finding| finding.kind).collect()
    };
    assert!(kinds(&loaded).contains(&FindingKind::NoEmitter));
    worker.send(Command::Run);
    let end = wait_for(&worker, "converged", |now| now.phase == Phase::Converged);
    assert_eq!((steps(&end), &end.error), (0, &None));

    worker.send(Command::AddCeilingLight);
    let lit = wait_for(&worker, "lit", |now| now.world.as_ref().is_some_and(|world| world.scene.has_emitter()));
    assert_eq!((steps(&lit), &lit.phase), (0, &Phase::Paused));
    assert!(kinds(&lit).contains(&FindingKind::CeilingLightAdded) && !kinds(&lit).contains(&FindingKind::NoEmitter));
    worker.send(Command::Run);
    let end = wait_for(&worker, "converged", |now| now.phase == Phase::Converged);
    let solution = end.solution.as_ref().expect("a solution");
    assert!(solution.steps > 0 && solution.energy.absorbed.min_element() > 0.0);
}

#[test]
fn a_scene_with_emitters_gets_no_ceiling_light() {
    let (worker, before) = after_five_steps();
    worker.send(Command::AddCeilingLight);
    worker.send(Command::Step(1));
    let after = wait_for(&worker, "stepped", |now| steps(now) == 6);
    assert!(same_world(&after, &before));
}

#[test]
fn commands_before_any_scene_do_no_harm() {
    let settings = Settings { seed: 7, ..with_elements(0.25) };
    let worker = Worker::spawn(None, || ());
    for command in [
        Command::Run,
        Command::Step(3),
        Command::Pause,
        Command::AddCeilingLight,
        Command::Configure(settings),
        Command::Reset,
    ] {
        worker.send(command);
    }
    let nothing = wait_for(&worker, "configured", |now| now.settings == settings);
    assert!(nothing.world.is_none() && nothing.solution.is_none() && nothing.error.is_none());
    assert_eq!(nothing.phase, Phase::Empty);
    let loaded = load(&worker, "furnace");
    assert_eq!((steps(&loaded), loaded.settings), (0, settings));
    assert_eq!(loaded.world.as_ref().expect("a world").element_size, 0.25);
}
