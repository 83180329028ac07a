//! Commands in the middle of a step. A step under test ends only when it is told to, so that what is shown is that it is
//! told; how long it may work until it looks is in `promptness`.

use crate::fake;
use crate::pace::Gate;
use crate::{load, name, wait_for, with_elements};
use lightwell::cancel::Cancel;
use lightwell::choice::Choice;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{FormFactorMethod, Method, Settings, Step};
use lightwell::scene::Scene;
use lightwell::worker::{Command, Phase, Snapshot, Worker};
use lightwell::world::World;
use std::sync::Arc;

const TRIES: u64 = 7;

/// A worker in the furnace whose radiosity waits at a gate.
fn gated() -> (Worker, Gate) {
    let gate = Gate::default();
    let step = gate.clone();
    let worker = fake::worker(move |_, cancel| step.step(cancel));
    load(&worker, "furnace");
    (worker, gate)
}

/// Sends a command in the middle of a step and waits for its effect, several times.
fn interrupt(what: &str, command: impl Fn(u64) -> Command, shows: impl Fn(u64, &Snapshot) -> bool) {
    let (worker, gate) = gated();
    for i in 0..TRIES {
        let before = gate.arrived();
        worker.send(Command::Run);
        gate.wait_for_step_after(before);
        worker.send(command(i));
        wait_for(&worker, what, |snapshot| shows(i, snapshot));
    }
    drop(worker);
    // No step came to its end: each was interrupted, by the command or by the next `Run`.
    assert_eq!(gate.cancelled(), gate.arrived(), "{what}");
    assert!(gate.cancelled() >= TRIES, "{what}: {}", gate.cancelled());
}

#[test]
fn every_command_takes_effect_in_the_middle_of_a_step() {
    interrupt("paused", |_| Command::Pause, |_, now| now.phase == Phase::Paused);
    interrupt("reset", |_| Command::Reset, |_, now| now.phase == Phase::Paused);
    let limit = |i: u64| 0.1 / (i + 2) as f64;
    let with_limit = move |i| Command::Configure(Settings { unshot_limit: limit(i), ..Settings::default() });
    interrupt("configured", with_limit, |i, now| now.settings.unshot_limit == limit(i));
    // Another scene each time.
    let scene = |i: u64| if i.is_multiple_of(2) { "empty-box" } else { "furnace" }.to_owned();
    interrupt("loaded", |i| Command::Load(scene(i)), |i, now| name(now) == scene(i));
}

#[test]
fn a_worker_that_is_dropped_ends_its_step() {
    let (worker, gate) = gated();
    worker.send(Command::Run);
    gate.wait_for_step_after(0);
    drop(worker);
    assert_eq!((gate.arrived(), gate.cancelled()), (1, 1));
}

fn bits(light: &[Rgb]) -> Vec<[u32; 3]> {
    light.iter().map(|rgb| rgb.to_array().map(f32::to_bits)).collect()
}

/// A step is stopped at each of some polls of its flag, and then done: what comes of it is what comes of undisturbed steps.
#[test]
fn a_step_that_was_interrupted_changes_nothing() {
    const STEPS: u64 = 12;
    let settings = with_elements(0.03);
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let world = Arc::new(World::build(scene, &settings.mesh, &Cancel::default()).expect("a world"));
    for &form_factor in FormFactorMethod::ALL {
        let settings = Settings { form_factor, light_rays: 200_000, ..settings };
        let [mut disturbed, mut left_alone] = [(); 2].map(|()| Progressive::new(world.clone(), settings));
        for step in 0..STEPS {
            let counting = Cancel::counting();
            assert_eq!(left_alone.step(&counting), Step::Advanced);
            let polls = counting.polls();
            assert_eq!(disturbed.step(&Cancel::after(polls * step / STEPS)), Step::Cancelled, "{form_factor:?}");
            assert_eq!(disturbed.step(&Cancel::default()), Step::Advanced);
        }
        let (got, expected) = (disturbed.solution(), left_alone.solution());
        assert_eq!(bits(&got.light.irradiance), bits(&expected.light.irradiance), "{form_factor:?}");
        assert_eq!(bits(&got.light.radiosity), bits(&expected.light.radiosity), "{form_factor:?}");
        assert_eq!(bits(&got.light.unshot), bits(&expected.light.unshot), "{form_factor:?}");
        assert_eq!((got.energy, got.closure, got.counters), (expected.energy, expected.closure, expected.counters));
    }
}

#[test]
fn a_step_that_may_not_begin_changes_nothing() {
    let scene = Scene::open("furnace").expect("a built-in scene");
    let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
    let mut method = Progressive::new(Arc::new(world), Settings::default());
    let stopped = Cancel::default();
    stopped.request();
    let before = method.solution();
    assert_eq!(method.step(&stopped), Step::Cancelled);
    let after = method.solution();
    assert_eq!(bits(&after.light.unshot), bits(&before.light.unshot));
    assert_eq!((after.steps, after.energy, after.counters), (0, before.energy, before.counters));
}
