//! What is picked in the light on surfaces: looked into between steps, kept up with the light, forgotten with its world.

use crate::pace::Gate;
use crate::{fake, load, look, look_from, name, steps, wait_for, with_elements};
use glam::Vec3;
use lightwell::cancel::Cancel;
use lightwell::clock::ManualTime;
use lightwell::math::rgb::total;
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{Method, Settings, Step};
use lightwell::solution::{CameraView, Equation, Solution, Visibility};
use lightwell::worker::{Command, Phase, Place, Snapshot, Subject, Worker};
use lightwell::world::World;
use std::sync::Arc;
use std::time::Duration;

fn place(snapshot: &Snapshot, patch: u32) -> Place {
    let world = snapshot.world.clone().expect("a world");
    let point = world.mesh.patches[patch as usize].center.into();
    Place { world, patch, point }
}

/// The Cornell box with two patches picked, paused before the first shot.
fn picked() -> (Worker, Arc<Snapshot>) {
    let worker = Worker::spawn(None, || ());
    worker.send(Command::Configure(with_elements(0.1)));
    let loaded = load(&worker, "cornell-box");
    worker.send(Command::Pick(Some(place(&loaded, 0))));
    worker.send(Command::PickSource(place(&loaded, 9)));
    let picked = wait_for(&worker, "picked", |now| source_of(now) == Some(9));
    (worker, picked)
}

fn equation(snapshot: &Snapshot) -> &Equation {
    snapshot.equation.as_ref().expect("an equation")
}

fn source_of(snapshot: &Snapshot) -> Option<u32> {
    snapshot.equation.as_ref()?.source.map(|source| source.patch)
}

#[test]
fn the_equation_at_a_picked_point_follows_the_light() {
    let (worker, before) = picked();
    assert_eq!((equation(&before).balance.patch, before.picked.as_ref().expect("a patch").patch), (0, 0));
    assert_eq!(total(equation(&before).balance.radiosity), 0.0);
    worker.send(Command::Step(20));
    let after = wait_for(&worker, "followed", |now| {
        let is_lit = now.equation.as_ref().is_some_and(|equation| total(equation.balance.radiosity) > 0.0);
        is_lit && steps(now) == 20 && now.phase == Phase::Paused
    });
    // The last step is told of at once, and then looked into.
    let solution = after.solution.as_ref().expect("light");
    let world = after.world.as_ref().expect("a world");
    let shown = world.mesh.patch_mean(&world.mesh.patches[0], &solution.light.radiosity);
    let last = wait_for(&worker, "kept up", |now| equation(now).balance.radiosity == shown);
    assert_eq!(source_of(&last), Some(9));
}

#[test]
fn while_light_grows_it_is_looked_into_again_and_again() {
    // Every shot of the furnace brings light to the patch that is picked.
    let gate = Gate::default();
    let (worker, _) = gated(&gate, u64::MAX);
    worker.send(Command::Run);
    gate.wait_for_step_after(0);
    for _ in 0..3 {
        let before = total(equation(&worker.latest()).balance.radiosity);
        // After 100 ms, of 20 a shot, and between shots.
        (0..6).for_each(|_| gate.pass_one());
        let now = worker.latest();
        assert!(total(equation(&now).balance.radiosity) > before);
        assert_eq!(now.phase, Phase::Running);
    }
}

#[test]
fn an_eye_that_moves_sees_the_point_or_does_not() {
    let (worker, _) = picked();
    look_from(&worker, Subject::Radiosity, 3.0);
    let one = wait_for(&worker, "looked", |now| (equation(now).eye.z - 3.0).abs() < 1e-6);
    look_from(&worker, Subject::Radiosity, 4.0);
    let other = wait_for(&worker, "moved", |now| (equation(now).eye.z - 4.0).abs() < 1e-6);
    // Both are level with the floor.
    assert_eq!([one, other].map(|now| equation(&now).sight), [Visibility::FacesAway; 2]);
    // Nobody reads it in a picture from the camera.
    let before = worker.latest();
    look_from(&worker, Subject::Camera(CameraView::RayTraced), 5.0);
    wait_for(&worker, "painted", |now| now.image.is_some());
    let (old, new) = (before.equation.as_ref(), worker.latest());
    assert!(Arc::ptr_eq(old.expect("an equation"), new.equation.as_ref().expect("an equation")));
}

#[test]
fn what_is_picked_is_forgotten_on_demand_and_with_its_world() {
    let (worker, before) = picked();
    worker.send(Command::Pick(None));
    wait_for(&worker, "forgotten", |now| now.picked.is_none() && now.equation.is_none());
    worker.send(Command::Pick(Some(place(&before, 3))));
    let again = wait_for(&worker, "picked", |now| now.equation.is_some());
    assert_eq!((equation(&again).balance.patch, source_of(&again)), (3, None), "both points were forgotten");
    worker.send(Command::Load("furnace".to_owned()));
    let loaded = wait_for(&worker, "loaded", |now| name(now) == "furnace" && now.phase == Phase::Paused);
    assert!(loaded.picked.is_none() && loaded.equation.is_none());
    // Places of the world before mean nothing now.
    worker.send(Command::Pick(Some(place(&before, 0))));
    worker.send(Command::PickSource(place(&before, 1)));
    worker.send(Command::Step(1));
    let after = wait_for(&worker, "stepped", |now| steps(now) == 1 && now.phase == Phase::Paused);
    assert!(after.picked.is_none() && after.equation.is_none());
}

#[test]
fn other_settings_have_it_looked_into_anew() {
    let (worker, before) = picked();
    let settings = Settings { seed: 7, ..before.settings };
    worker.send(Command::Configure(settings));
    let after = wait_for(&worker, "looked again", |now| now.settings == settings && now.equation.is_some());
    assert!(!Arc::ptr_eq(before.picked.as_ref().expect("a patch"), after.picked.as_ref().expect("a patch")));
    assert_eq!((equation(&after).balance.patch, source_of(&after)), (0, Some(9)));
}

/// Progressive radiosity with shots of 20 ms that wait at a gate, which in the end tells of no light.
struct Gated {
    method: Progressive,
    gate: Gate,
    time: ManualTime,
    shots_with_light: u64,
}

impl Method for Gated {
    fn step(&mut self, cancel: &Cancel) -> Step {
        if self.gate.step(cancel) == Step::Cancelled {
            return Step::Cancelled;
        }
        self.time.advance(Duration::from_millis(20));
        self.method.step(cancel)
    }

    fn configure(&mut self, settings: &Settings) -> bool {
        self.method.configure(settings)
    }

    fn solution(&self) -> Solution {
        let solution = self.method.solution();
        if solution.steps <= self.shots_with_light {
            solution
        } else {
            Solution { light: Default::default(), ..solution }
        }
    }
}

/// A furnace with such radiosity, in which a patch is picked.
fn gated(gate: &Gate, shots_with_light: u64) -> (Worker, Arc<fake::Counts>) {
    let (gate, time) = (gate.clone(), ManualTime::default());
    let clock = time.clock();
    let start = move |world: Arc<World>, settings: &Settings| -> Box<dyn Method> {
        let method = Progressive::new(world, *settings);
        Box::new(Gated { method, gate: gate.clone(), time: time.clone(), shots_with_light })
    };
    let (worker, counts) = fake::Fakes::default().starting(start).on(clock).spawn();
    worker.send(Command::Configure(with_elements(0.125)));
    let loaded = load(&worker, "furnace");
    look(&worker, Subject::Radiosity);
    worker.send(Command::Pick(Some(place(&loaded, 0))));
    wait_for(&worker, "picked", |now| now.equation.is_some());
    (worker, counts)
}

#[test]
fn a_panic_while_it_is_looked_into_ends_that_alone() {
    let gate = Gate::default();
    gate.open(2);
    let (worker, counts) = gated(&gate, 0);
    worker.send(Command::Step(1));
    let crashed = wait_for(&worker, "crashed", |now| now.error.is_some());
    let error = crashed.error.as_ref().expect("a message");
    assert!(error.contains("the look at what is picked stopped"), "{error}");
    assert!(crashed.picked.is_none() && crashed.equation.is_none());
    assert_eq!((&crashed.phase, steps(&crashed)), (&Phase::Paused, 1));
    worker.send(Command::Step(1));
    let after = wait_for(&worker, "stepped", |now| steps(now) == 2);
    assert_eq!((&after.error, fake::Counts::of(&counts.radiosity_starts)), (&None, 1), "its light goes on");
}

#[test]
fn places_on_one_patch_are_looked_at_with_the_same_form_factors() {
    let (worker, before) = picked();
    let other = Place { point: place(&before, 0).point + Vec3::new(0.01, 0.0, 0.0), ..place(&before, 0) };
    worker.send(Command::Pick(Some(other.clone())));
    let after = wait_for(&worker, "moved", |now| equation(now).point == other.point);
    assert!(Arc::ptr_eq(before.picked.as_ref().expect("a patch"), after.picked.as_ref().expect("a patch")));
}
