//! Commands in the middle of a step.

use crate::fake;
use crate::{load, median, name, steps, wait_for, with_elements};
use lightwell::cancel::Cancel;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{Method, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::Solution;
use lightwell::worker::{Command, Phase, Run, Snapshot, Worker};
use lightwell::world::World;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// What a command may take until it shows.
const PROMPT: Duration = Duration::from_millis(50);
/// So long that a step is certainly under way.
const INTO_A_STEP: Duration = Duration::from_millis(20);
const TRIES: u64 = 7;

/// The time from a command to its effect, with `worker` in the middle of a step each time.
fn time_to(worker: &Worker, command: impl Fn(u64) -> Command, shows: impl Fn(u64, &Snapshot) -> bool) -> Duration {
    let times = (0..TRIES).map(|i| {
        worker.send(Command::Run);
        wait_for(worker, "running", |snapshot| snapshot.phase == Phase::Running);
        std::thread::sleep(INTO_A_STEP);
        let start = Instant::now();
        worker.send(command(i));
        wait_for(worker, "obeyed", |snapshot| shows(i, snapshot));
        start.elapsed()
    });
    median(times.collect())
}

#[test]
fn every_command_takes_effect_in_the_middle_of_a_step() {
    let worker = fake::worker(fake::long_step);
    load(&worker, "furnace");
    let pause = time_to(&worker, |_| Command::Pause, |_, snapshot| snapshot.phase == Phase::Paused);
    let reset = time_to(&worker, |_| Command::Reset, |_, snapshot| snapshot.phase == Phase::Paused);
    let with_limit = |i: u64| Settings { unshot_limit: 0.1 / (i + 2) as f64, ..Settings::default() };
    let configure = time_to(
        &worker,
        |i| Command::Configure(with_limit(i)),
        |i, now| now.settings.unshot_limit == with_limit(i).unshot_limit,
    );
    // Another scene each time, so that it is seen when it is there; to read and mesh the furnace takes a while, too.
    let scene = |i: u64| if i.is_multiple_of(2) { "empty-box" } else { "furnace" }.to_owned();
    let load = time_to(
        &worker,
        |i| Command::Load(scene(i)),
        |i, now| now.phase == Phase::Loading(scene(i)) || name(now) == scene(i),
    );
    for (command, time) in [("pause", pause), ("reset", reset), ("configure", configure), ("load", load)] {
        assert!(time < PROMPT, "{command} took {time:?}");
    }
}

#[test]
fn a_long_shot_is_interrupted() {
    // Some 600,000 elements with many rays each: on two cores a shot takes a good part of a second.
    let worker = Worker::spawn(None, || ());
    worker.send(Command::Configure(Settings { shadow_rays: Settings::MAX_SHADOW_RAYS, ..with_elements(0.0018) }));
    load(&worker, "cornell-box");
    worker.send(Command::Step(2));
    let stepped = wait_for(&worker, "stepped", |now| steps(now) == 2 && now.phase == Phase::Paused);
    println!("a shot takes {:?}", stepped.solution.as_ref().expect("a solution").elapsed / 2);
    let pause = time_to(&worker, |_| Command::Pause, |_, snapshot| snapshot.phase == Phase::Paused);
    assert!(pause < PROMPT, "pause took {pause:?}");
    worker.send(Command::Run);
    wait_for(&worker, "running", |snapshot| snapshot.phase == Phase::Running);
    std::thread::sleep(INTO_A_STEP);
    let start = Instant::now();
    drop(worker);
    assert!(start.elapsed() < 2 * PROMPT, "to end took {:?}", start.elapsed());
}

#[test]
fn a_worker_that_is_dropped_ends_its_thread_at_once() {
    let times = (0..TRIES).map(|_| {
        let worker = fake::worker(fake::long_step);
        load(&worker, "furnace");
        worker.send(Command::Run);
        wait_for(&worker, "running", |snapshot| snapshot.phase == Phase::Running);
        std::thread::sleep(INTO_A_STEP);
        let start = Instant::now();
        drop(worker);
        start.elapsed()
    });
    let time = median(times.collect());
    assert!(time < 2 * PROMPT, "{time:?}");
}

/// Counts the steps that were stopped.
struct Counting(Progressive, Arc<AtomicU64>);

impl Method for Counting {
    fn step(&mut self, cancel: &Cancel) -> Step {
        let step = self.0.step(cancel);
        self.1.fetch_add(u64::from(step == Step::Cancelled), Ordering::SeqCst);
        step
    }

    fn configure(&mut self, settings: &Settings) -> bool {
        self.0.configure(settings)
    }

    fn solution(&self) -> Solution {
        self.0.solution()
    }
}

fn bits(light: &[Rgb]) -> Vec<[u32; 3]> {
    light.iter().map(|rgb| rgb.to_array().map(f32::to_bits)).collect()
}

#[test]
fn a_step_that_was_interrupted_changes_nothing() {
    const STEPS: u64 = 20;
    let settings = with_elements(0.012);
    let cancelled = Arc::new(AtomicU64::new(0));
    let counter = cancelled.clone();
    let start = move |world: Arc<World>, settings: &Settings| -> Box<dyn Method> {
        Box::new(Counting(Progressive::new(world, *settings), counter.clone()))
    };
    let (worker, _) = fake::Fakes::default().starting(start).spawn();
    worker.send(Command::Configure(settings));
    load(&worker, "cornell-box");
    worker.send(Command::Step(STEPS));
    // A new stop rule interrupts a step and leaves all that was done; new limits are all far below what is reached.
    for i in 1..=50 {
        worker.send(Command::Configure(Settings { unshot_limit: 1e-6 / f64::from(i), ..settings }));
        std::thread::sleep(Duration::from_micros(700));
    }
    let got = wait_for(&worker, "stepped", |now| steps(now) == STEPS && now.phase == Phase::Paused);
    assert!(cancelled.load(Ordering::SeqCst) > 0, "no step was interrupted");

    let world = got.world.clone().expect("a world");
    let mut run = Run::start(world, &settings).expect("enough memory");
    for _ in 0..STEPS {
        assert_eq!(run.step(&Cancel::default()), Step::Advanced);
    }
    let (got, expected) = (got.solution.clone().expect("a solution"), run.solution());
    assert_eq!(bits(&got.light.irradiance), bits(&expected.light.irradiance));
    assert_eq!(bits(&got.light.radiosity), bits(&expected.light.radiosity));
    assert_eq!(bits(&got.light.unshot), bits(&expected.light.unshot));
    assert_eq!((got.energy, got.closure, got.counters), (expected.energy, expected.closure, expected.counters));
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
