//! Pictures from a camera: coarse first, refined without being told to, made anew when their light has grown.

use crate::fake::{BATCHES, Counts, Fakes};
use crate::pace::{Gate, Watched};
use crate::{PATIENCE, load, look, look_from, steps, wait_for, wait_until};
use lightwell::clock::{Clock, ManualTime};
use lightwell::methods::{ImageSettings, Kernel, OcclusionSettings, PhotonSettings, Settings, Step};
use lightwell::solution::{CameraImage, CameraView};
use lightwell::worker::{Command, Phase, Snapshot, Subject, Worker};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::time::Duration;

const RAYS: Subject = Subject::Camera(CameraView::RayTraced);
const GATHER: Subject = Subject::Camera(CameraView::FinalGather);

fn image(snapshot: &Snapshot) -> Option<&CameraImage> {
    snapshot.image.as_deref()
}

fn samples(snapshot: &Snapshot) -> u32 {
    image(snapshot).map_or(0, |image| image.samples)
}

/// Waits for a picture of this view with all samples.
fn finished(worker: &Worker, view: CameraView) -> Arc<Snapshot> {
    wait_for(worker, "finished", |now| image(now).is_some_and(|image| image.is_complete && image.view == view))
}

#[test]
fn a_picture_refines_by_itself_and_ends() {
    let (time, gate) = (ManualTime::default(), Gate::default());
    let (clock, step) = (time.clock(), gate.clone());
    let work = move |_, cancel: &_| {
        time.advance(Duration::from_millis(5));
        step.step(cancel)
    };
    let (worker, counts) = Fakes::default().on(clock).image(work).spawn();
    load(&worker, "furnace");
    look(&worker, RAYS);
    gate.open(1);
    let coarse = wait_for(&worker, "seen", |now| now.image.is_some());
    let first = image(&coarse).expect("an image");
    assert!(first.resolution == [1, 1] && !first.is_complete, "coarse first");
    assert_eq!(coarse.phase, Phase::Running);
    gate.open(100);
    let end = finished(&worker, CameraView::RayTraced);
    assert_eq!((samples(&end), &end.phase), (end.settings.image.samples, &Phase::Converged));
    // The coarse pass and all samples.
    let steps = 1 + end.settings.image.samples;
    assert_eq!(image(&end).map(|image| image.elapsed), Some(steps * Duration::from_millis(5)));
    // It has nothing to do until another command comes.
    worker.send(Command::Pause);
    look(&worker, Subject::Radiosity);
    wait_for(&worker, "looked at", |now| now.phase == Phase::Paused);
    assert_eq!(Counts::of(&counts.image_steps), u64::from(steps));
}

#[test]
fn a_camera_that_moves_interrupts_the_picture_and_starts_it_coarse() {
    let gate = Gate::default();
    let step = gate.clone();
    let work = move |steps, cancel: &_| if steps == 0 { Step::Advanced } else { step.step(cancel) };
    let (worker, counts) = Fakes::default().image(work).spawn();
    load(&worker, "furnace");
    for i in 0..7 {
        look_from(&worker, RAYS, 1.0 + i as f32);
        let camera = crate::sight(RAYS, 1.0 + i as f32).camera;
        let seen = wait_for(&worker, "seen", |now| image(now).is_some_and(|image| image.camera == camera));
        assert_eq!(image(&seen).map(|image| (image.samples, image.resolution)), Some((0, [1, 1])));
        // The next step never ends, unless a camera that moves interrupts it.
        gate.wait_for_step_after(i);
    }
    assert_eq!(Counts::of(&counts.cancelled_images), 6);
}

#[test]
fn another_size_starts_the_picture_anew_and_an_empty_one_is_none() {
    let (worker, counts) = Fakes::default().spawn();
    load(&worker, "furnace");
    let sight = crate::sight(RAYS, 3.0);
    for size in [[0, 8], [8, 0]] {
        worker.send(Command::Look(lightwell::worker::Sight { size, ..sight }));
        std::thread::sleep(Duration::from_millis(5));
    }
    assert!(worker.latest().image.is_none());
    look(&worker, RAYS);
    finished(&worker, CameraView::RayTraced);
    worker.send(Command::Look(lightwell::worker::Sight { size: [20, 10], ..sight }));
    wait_for(&worker, "finished", |now| image(now).is_some_and(|image| image.size == [20, 10] && image.is_complete));
    assert_eq!([&counts.image_starts, &counts.image_moves].map(Counts::of), [1, 1]);
}

#[test]
fn a_view_that_was_looked_at_from_here_before_is_there_at_once() {
    let (worker, counts) = Fakes::default().spawn();
    load(&worker, "furnace");
    look(&worker, RAYS);
    finished(&worker, CameraView::RayTraced);
    look(&worker, GATHER);
    finished(&worker, CameraView::FinalGather);
    let steps = Counts::of(&counts.image_steps);
    for subject in [RAYS, Subject::Radiosity, GATHER, Subject::Photons, RAYS] {
        look(&worker, subject);
        if let Subject::Camera(view) = subject {
            finished(&worker, view);
        }
    }
    assert_eq!((Counts::of(&counts.image_steps), Counts::of(&counts.image_starts)), (steps, 2));
    // From elsewhere nothing of it is of use.
    look_from(&worker, RAYS, 9.0);
    wait_until("anew", || Counts::of(&counts.image_moves) == 1);
}

#[test]
fn a_camera_that_moves_looks_at_the_same_light() {
    let (worker, counts) = Fakes::default().spawn();
    load(&worker, "furnace");
    let made_of = |now: &Snapshot| image(now).filter(|image| image.is_complete).map(|image| image.rays);
    let look = |subject, distance| {
        look_from(&worker, subject, distance);
        let camera = crate::sight(subject, distance).camera;
        let is_it = |image: &CameraImage| image.camera == camera && Subject::Camera(image.view) == subject;
        wait_for(&worker, "finished", |now| made_of(now).is_some() && image(now).is_some_and(is_it))
    };
    let counted = || [&counts.image_starts, &counts.image_moves].map(Counts::of);
    worker.send(Command::Look(crate::sight(Subject::Photons, 1.0)));
    worker.send(Command::Step(2));
    wait_for(&worker, "traced", |now| now.photons.as_ref().is_some_and(|photons| photons.batches == 2));
    assert_eq!(made_of(&look(GATHER, 1.0)), Some(2));
    look(RAYS, 1.0);
    look(GATHER, 2.0);
    look(RAYS, 2.0);
    assert_eq!(counted(), [2, 2]);
    // More light is another light.
    look(GATHER, 2.0);
    worker.send(Command::Step(1));
    wait_for(&worker, "anew", |now| made_of(now) == Some(3));
    look(GATHER, 3.0);
    assert_eq!(counted(), [3, 3]);
}

#[test]
fn photons_that_are_read_off_in_another_way_give_another_picture() {
    let (worker, counts) = Fakes::default().spawn();
    let loaded = load(&worker, "furnace");
    look(&worker, RAYS);
    finished(&worker, CameraView::RayTraced);
    look(&worker, GATHER);
    worker.send(Command::Step(2));
    wait_for(&worker, "traced", |now| image(now).is_some_and(|image| image.rays == 2 && image.is_complete));
    let starts = Counts::of(&counts.image_starts);
    let photons = PhotonSettings { kernel: Kernel::Cone, ..loaded.settings.photons };
    worker.send(Command::Configure(Settings { photons, ..loaded.settings }));
    wait_until("anew", || Counts::of(&counts.image_starts) == starts + 1);
    finished(&worker, CameraView::FinalGather);
    // Rays know nothing of photons.
    look(&worker, RAYS);
    finished(&worker, CameraView::RayTraced);
    assert_eq!((Counts::of(&counts.image_starts), Counts::of(&counts.photon_starts)), (starts + 1, 1));
}

#[test]
fn a_paused_light_leaves_its_picture_refining() {
    let (worker, counts) = Fakes::default().spawn();
    load(&worker, "furnace");
    look(&worker, GATHER);
    worker.send(Command::Step(3));
    wait_for(&worker, "traced", |now| now.photons.as_ref().is_some_and(|photons| photons.batches == 3));
    let end = finished(&worker, CameraView::FinalGather);
    assert_eq!((samples(&end), &end.phase), (end.settings.image.samples, &Phase::Paused));
    assert_eq!(image(&end).map(|image| image.rays), Some(3), "made of all the light that there is");
    assert_eq!(Counts::of(&counts.photon_steps), 3);
}

#[test]
fn a_picture_and_its_growing_light_share_the_time() {
    const STEPS: u64 = 40;
    let time = ManualTime::default();
    let clock = time.clock();
    let [of_light, of_picture] = [time.clone(), time].map(|time| move || time.advance(Duration::from_millis(3)));
    let fakes = Fakes::default().on(clock).image(move |_, _| {
        of_picture();
        Step::Advanced
    });
    let (tell, told) = channel();
    let counts = fakes.counts();
    let work = move |steps, _: &_| {
        of_light();
        if steps == 0 || steps == STEPS {
            // Nobody listens once the test is over.
            let _ = tell.send([&counts.image_steps, &counts.image_starts].map(Counts::of));
        }
        if steps < STEPS { Step::Advanced } else { Step::Converged }
    };
    let (worker, _) = fakes.radiosity(work).spawn();
    load(&worker, "furnace");
    look(&worker, Subject::Camera(CameraView::RadiositySpecular));
    wait_for(&worker, "seen", |now| now.image.is_some());
    worker.send(Command::Run);
    let [before, after] = [(); 2].map(|()| told.recv_timeout(PATIENCE).expect("it runs until it converges"));
    let [picture, starts] = [0, 1].map(|count: usize| after[count] - before[count]);
    // Each of them is as long, and they take turns while the picture has something to do: until it has all samples of light
    // that has not grown by a quarter.
    assert!((STEPS / 2..=STEPS + 1).contains(&picture), "{picture} steps of the picture for {STEPS} of the light");
    // Made anew at a quarter more light each: from 1 to 40 steps that is at most log 40 / log 1.25, and one at the start.
    assert!((2..=18).contains(&starts), "{starts}");
    let end = finished(&worker, CameraView::RadiositySpecular);
    assert_eq!(image(&end).map(|image| image.rays), Some(steps(&end)));
}

#[test]
fn a_picture_on_show_stays_until_the_next_one_is_as_fine() {
    let watched = Watched::spawn(Fakes::default(), Clock::default());
    let worker = &watched.worker;
    worker.send(Command::Load("furnace".to_owned()));
    watched.until_phase(&Phase::Paused);
    worker.send(Command::Step(10));
    watched.until(|now| steps(now) == 10 && now.phase == Phase::Paused);
    look(worker, Subject::Camera(CameraView::RadiositySpecular));
    watched.until(|now| image(now).is_some_and(|image| image.is_complete));
    worker.send(Command::Step(20));
    // Until there is twice the light, nothing coarse is seen.
    for now in watched.until(|now| steps(now) >= 20) {
        assert!(steps(&now) >= 20 || samples(&now) > 0, "made of {:?} steps", image(&now).map(|image| image.rays));
    }
}

#[test]
fn each_progressive_pass_gives_one_sample_of_every_pixel() {
    // The picture takes longer than its photons, which wait for it all the same.
    let slow = |_, _: &_| {
        std::thread::sleep(Duration::from_millis(3));
        Step::Advanced
    };
    let (worker, counts) = Fakes::default().image(slow).spawn();
    let loaded = load(&worker, "furnace");
    let photons = PhotonSettings { is_progressive: true, passes: 6, ..loaded.settings.photons };
    let image_settings = ImageSettings { samples: 3, ..loaded.settings.image };
    worker.send(Command::Configure(Settings { photons, image: image_settings, ..loaded.settings }));
    look(&worker, GATHER);
    worker.send(Command::Run);
    let end = finished(&worker, CameraView::FinalGather);
    let photons = end.photons.as_ref().expect("photons");
    assert_eq!((photons.passes, samples(&end), &end.phase), (6, 6, &Phase::Converged));
    let end = image(&end).expect("an image");
    // Its fake tells how many passes it is the mean of, and of how many batches the last one was.
    assert_eq!((end.coverage[0], end.rays), (6.0, BATCHES));
    assert_eq!(Counts::of(&counts.photon_steps), 6 * BATCHES);
}

#[test]
fn settings_of_pictures_start_only_pictures_anew_and_more_samples_not_even_these() {
    let (worker, counts) = Fakes::default().spawn();
    let loaded = load(&worker, "furnace");
    look(&worker, GATHER);
    worker.send(Command::Step(2));
    let before = finished(&worker, CameraView::FinalGather);
    let starts = Counts::of(&counts.image_starts);
    let more = Settings { image: ImageSettings { samples: 20, ..loaded.settings.image }, ..loaded.settings };
    worker.send(Command::Configure(more));
    let after = wait_for(&worker, "refined", |now| samples(now) == 20);
    assert_eq!((Counts::of(&counts.image_starts), &after.phase), (starts, &Phase::Paused));
    let filtered = ImageSettings { filter: "LDE".parse().expect("a pattern"), ..more.image };
    worker.send(Command::Configure(Settings { image: filtered, ..more }));
    wait_until("anew", || Counts::of(&counts.image_starts) == starts + 1);
    assert_eq!((Counts::of(&counts.radiosity_starts), Counts::of(&counts.photon_starts)), (1, 1));
    let (old, new) = (&before.photons, worker.latest().photons.clone());
    assert_eq!(old.as_ref().map(|photons| photons.batches), new.map(|photons| photons.batches));
}

#[test]
fn settings_of_ambient_occlusion_start_only_its_pictures_anew() {
    let (worker, counts) = Fakes::default().spawn();
    let Settings { occlusion, image, .. } = load(&worker, "furnace").settings;
    for (view, rays, more, new_starts) in [(CameraView::AmbientOcclusion, 3, 20, 1), (CameraView::Diffuse, 4, 24, 0)] {
        look(&worker, Subject::Camera(view));
        let before = finished(&worker, view);
        let starts = Counts::of(&counts.image_starts);
        let occlusion = OcclusionSettings { rays, ..occlusion };
        let image = ImageSettings { samples: more, ..image };
        worker.send(Command::Configure(Settings { occlusion, image, ..before.settings }));
        wait_for(&worker, "refined", |now| samples(now) == more);
        assert_eq!(Counts::of(&counts.image_starts), starts + new_starts, "{view:?}");
    }
    assert_eq!(Counts::of(&counts.radiosity_starts), 1);
}

#[test]
fn a_crash_of_a_picture_leaves_the_lights() {
    let is_broken = Arc::new(AtomicBool::new(true));
    let flag = is_broken.clone();
    let work = move |steps, _: &_| {
        assert!(steps == 0 || !flag.load(Ordering::SeqCst), "a broken lens");
        Step::Advanced
    };
    let (worker, _) = Fakes::default().image(work).spawn();
    load(&worker, "furnace");
    look(&worker, RAYS);
    let crashed = wait_for(&worker, "crashed", |now| now.phase == Phase::Crashed);
    assert!(crashed.error.as_ref().is_some_and(|error| error.contains("a broken lens")), "{:?}", crashed.error);
    look(&worker, Subject::Radiosity);
    worker.send(Command::Step(2));
    wait_for(&worker, "stepped", |now| steps(now) == 2 && now.phase == Phase::Paused);
    is_broken.store(false, Ordering::SeqCst);
    look(&worker, RAYS);
    finished(&worker, CameraView::RayTraced);
    worker.send(Command::Reset);
    finished(&worker, CameraView::RayTraced);
}

#[test]
fn a_new_world_has_no_picture_of_the_old_one() {
    let (worker, _) = Fakes::default().spawn();
    load(&worker, "furnace");
    look(&worker, RAYS);
    finished(&worker, CameraView::RayTraced);
    worker.send(Command::Load("empty-box".to_owned()));
    let end = wait_for(&worker, "finished", |now| {
        crate::name(now) == "empty-box" && image(now).is_some_and(|image| image.is_complete)
    });
    assert_eq!(end.phase, Phase::Converged);
}
