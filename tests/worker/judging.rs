//! How far off the lights on the thread are, against the truth.

use crate::fake::{Counts, Fakes};
use crate::pace::Watched;
use crate::{PATIENCE, load, sight, wait_for, with_elements};
use lightwell::accuracy::{Error, Reference, by_radiosity};
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::clock::{Clock, ManualTime};
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{Method, PhotonSettings, Settings, Step};
use lightwell::solution::{CameraView, Judged, Solution};
use lightwell::worker::{Command, LightKind, Methods, Phase, Sight, Snapshot, Subject, Worker};
use lightwell::world::World;
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};
use std::time::{Duration, Instant};

/// What a reading of a ticking clock takes.
const TICK: Duration = Duration::from_millis(1);

/// A clock for the program's own methods that ticks whenever it is read: when errors are measured does not depend on how busy
/// the machine is. A step has some ticks, and so has what refines the reference: it is published after each few of them.
fn ticking() -> Clock {
    ManualTime::ticking(50 * TICK)
}

fn on_ticks() -> Worker {
    Worker::spawn_with(Methods::default(), ticking(), || ())
}

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
    let worker = on_ticks();
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
    let watched = Watched::spawn(Methods::default(), ticking());
    watched.worker.send(Command::Configure(with_elements(0.04)));
    watched.worker.send(Command::Load("cornell-box".to_owned()));
    watched.until(is_known);
    watched.worker.send(Command::Run);
    let floor = |now: &Snapshot| now.truth.as_ref().map_or(f64::INFINITY, |truth| truth.floor);
    let until_last = |is_it: &dyn Fn(&Snapshot) -> bool| watched.until(is_it).pop().expect("one at least");
    let early = until_last(&|now| error(now, LightKind::Radiosity).is_some());
    let late = until_last(&|now| floor(now) < floor(&early));
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

/// Radiosity that tells the time before each step. It never converges.
struct Timed(Progressive, Sender<Instant>, Clock);

impl Method for Timed {
    fn step(&mut self, cancel: &Cancel) -> Step {
        // Nobody listens once the test is over.
        let _ = self.1.send(self.2.now());
        self.0.step(cancel)
    }

    fn configure(&mut self, settings: &Settings) -> bool {
        self.0.configure(settings)
    }

    fn solution(&self) -> Solution {
        self.0.solution()
    }
}

/// The time from the first of 500 steps of radiosity to the last, on a clock that ticks whenever it is read: so each piece of
/// work is as long as the next of its kind, however busy the machine is.
fn time_of_steps(is_hushed: bool) -> Duration {
    const STEPS: usize = 500;
    let clock = ManualTime::ticking(TICK);
    let (tell, told) = channel();
    let its_clock = clock.clone();
    let start = move |world: Arc<World>, settings: &Settings| -> Box<dyn Method> {
        Box::new(Timed(Progressive::new(world, *settings), tell.clone(), its_clock.clone()))
    };
    let (worker, _) = Fakes::default().starting(start).with_reference().on(clock).spawn();
    worker.send(Command::Configure(Settings { unshot_limit: 0.0, ..with_elements(0.1) }));
    load(&worker, "cornell-box");
    worker.send(Command::Hush(is_hushed));
    worker.send(Command::Run);
    let times: Vec<Instant> = told.iter().take(STEPS).collect();
    assert_eq!(worker.latest().tracks.is_empty(), is_hushed);
    times[STEPS - 1] - times[0]
}

/// A run whose errors are measured meanwhile, and whose reference is refined, takes hardly longer than one that is left alone.
#[test]
fn measuring_hardly_holds_a_run_up() {
    let [alone, measured] = [true, false].map(time_of_steps);
    println!("{alone:?} alone, {measured:?} measured");
    // 3 %, and 20 ms in advance; what is begun within them, of a few ticks, is brought to its end.
    let most = alone.mul_f64(1.03) + Duration::from_millis(20) + 10 * TICK;
    assert!(measured > alone && measured < most, "{alone:?} {measured:?}");
}

/// Neither does one whose errors are watched: 4 % of the time goes into pictures of them.
#[test]
fn watching_errors_hardly_holds_a_run_up() {
    const STEPS: u64 = 2000;
    let time = ManualTime::default();
    let clock = time.clock();
    let [light, picture] = [time.clone(), time].map(|time| move || time.advance(TICK));
    let fakes = Fakes::default().on(clock).image(move |_, _| {
        picture();
        Step::Advanced
    });
    let counts = fakes.counts();
    let (tell, told) = channel();
    let fakes = fakes.radiosity(move |steps, _| {
        light();
        if steps == 0 || steps == STEPS {
            // Nobody listens once the test is over.
            let _ = tell.send(Counts::of(&counts.image_steps));
        }
        if steps < STEPS { Step::Advanced } else { Step::Converged }
    });
    let (worker, _) = fakes.spawn();
    load(&worker, "furnace");
    worker.send(Command::Look(sight(Subject::Camera(CameraView::Error(Judged::RadiositySpecular)), 3.0)));
    wait_for(&worker, "seen", |now| now.image.is_some());
    worker.send(Command::Run);
    let [before, after] = [(); 2].map(|()| told.recv_timeout(PATIENCE).expect("it runs until it converges"));
    // All steps are as long. The pictures are begun anew and exposed all the time, until the light has hardly grown.
    let (steps, most) = (after - before, STEPS * 4 / 96 + 1);
    assert!((most / 2..=most).contains(&steps), "{steps} of {most}");
}
