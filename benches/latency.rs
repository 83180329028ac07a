//! How soon a command shows, in real time. `cargo bench --bench latency` prints the median of several tries: tests count work
//! instead, since how long that takes depends on what else the machine does. A command should show within 50 ms, the first
//! coarse picture of a view within 100 ms; measuring errors should take at most 3 % of a run's time.

use lightwell::camera::Camera;
use lightwell::choice::Choice;
use lightwell::effects::plan;
use lightwell::mesh::MeshSettings;
use lightwell::methods::{ImageSettings, PhotonSettings, Settings};
use lightwell::solution::CameraView;
use lightwell::worker::{Command, Phase, Sight, Snapshot, Subject, Worker};
use std::sync::Arc;
use std::time::{Duration, Instant};

const TRIES: usize = 7;
/// So long that a step is under way.
const INTO_A_STEP: Duration = Duration::from_millis(20);

fn wait_for(worker: &Worker, is_it: impl Fn(&Snapshot) -> bool) -> Arc<Snapshot> {
    loop {
        let snapshot = worker.latest();
        if is_it(&snapshot) {
            return snapshot;
        }
        std::thread::sleep(Duration::from_micros(200));
    }
}

fn open(settings: Settings) -> (Worker, Arc<Snapshot>) {
    let worker = Worker::spawn(None, || ());
    worker.send(Command::Configure(settings));
    worker.send(Command::Load("cornell-box".to_owned()));
    let loaded = wait_for(&worker, |now| now.world.is_some() && now.phase == Phase::Paused);
    (worker, loaded)
}

fn with_elements(element_size: f32) -> Settings {
    Settings {
        mesh: MeshSettings { element_size: Some(element_size), ..MeshSettings::default() },
        ..Settings::default()
    }
}

fn print(what: &str, mut times: Vec<Duration>) {
    times.sort();
    println!("{what:40} {:8.1} ms", 1e3 * times[times.len() / 2].as_secs_f64());
}

fn timed(act: impl FnOnce()) -> Duration {
    let start = Instant::now();
    act();
    start.elapsed()
}

/// In the middle of a shot of some 600,000 elements.
fn pauses() {
    let (worker, _) =
        open(Settings { shadow_rays: Settings::MAX_SHADOW_RAYS, unshot_limit: 1e-12, ..with_elements(0.0018) });
    let run = || {
        worker.send(Command::Run);
        wait_for(&worker, |now| now.phase == Phase::Running);
        std::thread::sleep(INTO_A_STEP);
    };
    let pause = || {
        run();
        timed(|| {
            worker.send(Command::Pause);
            wait_for(&worker, |now| now.phase == Phase::Paused);
        })
    };
    print("pause in a long shot", (0..TRIES).map(|_| pause()).collect());
    run();
    print("end in a long shot", vec![timed(|| drop(worker))]);
}

/// From a camera that has moved, of every view.
fn first_pictures() {
    let photons = PhotonSettings { count: 50_000, caustic_count: 1_000, ..PhotonSettings::default() };
    let image = ImageSettings { samples: 2, ..ImageSettings::default() };
    let (worker, loaded) = open(Settings { photons, image, ..with_elements(0.1) });
    let world = loaded.world.clone().expect("a world");
    let mut camera = Camera::new(&world.viewpoint, &world.bounds);
    let look = |subject, camera| worker.send(Command::Look(Sight { subject, camera, size: [640, 480] }));
    worker.send(Command::Step(30));
    wait_for(&worker, |now| now.solution.as_ref().is_some_and(|light| light.steps == 30) && now.phase == Phase::Paused);
    look(Subject::Photons, camera);
    worker.send(Command::Run);
    wait_for(&worker, |now| now.phase == Phase::Converged && now.photons.is_some());
    for &view in CameraView::ALL {
        let mut first = || {
            camera.orbit(0.001, 0.0);
            timed(|| {
                look(Subject::Camera(view), camera);
                let is_it = |now: &Snapshot| now.image.as_ref().is_some_and(|i| i.camera == camera && i.view == view);
                wait_for(&worker, is_it);
            })
        };
        print(&format!("first picture, {}", view.name()), (0..TRIES).map(|_| first()).collect());
    }
    print("plan of effects", (0..TRIES).map(|_| timed(|| drop(std::hint::black_box(plan(&world))))).collect());
}

/// Wall time over solver time of a second of radiosity, with and without a reference that is refined meanwhile.
fn measuring() {
    for (what, is_hushed) in [("alone", true), ("measured", false)] {
        let (worker, _) = open(Settings { unshot_limit: 1e-12, ..with_elements(0.05) });
        worker.send(Command::Hush(is_hushed));
        let solver = |now: &Snapshot| now.solution.as_ref().map_or(Duration::ZERO, |light| light.elapsed);
        let start = Instant::now();
        worker.send(Command::Run);
        let end = wait_for(&worker, |now| solver(now) > Duration::from_secs(1));
        println!(
            "{:40} {:8.3}",
            format!("wall time over solver time, {what}"),
            start.elapsed().as_secs_f64() / solver(&end).as_secs_f64()
        );
    }
}

fn main() {
    pauses();
    first_pictures();
    measuring();
}
