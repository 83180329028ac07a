//! The program's own methods on the thread: all views of one scene.

use crate::{load, steps, wait_for};
use glam::Vec3;
use lightwell::camera::Camera;
use lightwell::choice::Choice;
use lightwell::effects::{Effect, Effects, Switches};
use lightwell::methods::{ImageSettings, PhotonSettings, Settings};
use lightwell::solution::{CameraImage, CameraView};
use lightwell::worker::{Command, Phase, Sight, Snapshot, Spot, Subject, Worker};
use std::sync::Arc;

/// From a camera that moved a little for each `place`.
fn look(worker: &Worker, subject: Subject, place: u32, size: [u32; 2]) -> Camera {
    let world = worker.latest().world.clone().expect("a world");
    let mut camera = Camera::new(&world.viewpoint, &world.bounds);
    camera.orbit(0.001 * place as f32, 0.0);
    worker.send(Command::Look(Sight { subject, camera, size }));
    camera
}

fn image_of(snapshot: &Snapshot, view: CameraView) -> Option<&CameraImage> {
    snapshot.image.as_deref().filter(|image| image.view == view)
}

fn brightness(image: &CameraImage) -> f32 {
    image.radiance.iter().map(|radiance| radiance.element_sum()).sum::<f32>() / image.radiance.len() as f32
}

/// The Cornell box with some light of both kinds, at rest.
fn lit() -> (Worker, Arc<Snapshot>) {
    let worker = Worker::spawn(None, || ());
    let photons = PhotonSettings { count: 50_000, caustic_count: 1_000, ..PhotonSettings::default() };
    let image = ImageSettings { samples: 2, gather_rays: 8, ..ImageSettings::default() };
    worker.send(Command::Configure(Settings { photons, image, ..crate::with_elements(0.1) }));
    load(&worker, "cornell-box");
    worker.send(Command::Step(30));
    wait_for(&worker, "stepped", |now| steps(now) == 30 && now.phase == Phase::Paused);
    look(&worker, Subject::Photons, 0, [64, 48]);
    worker.send(Command::Run);
    let lit = wait_for(&worker, "traced", |now| now.phase == Phase::Converged && now.photons.is_some());
    (worker, lit)
}

#[test]
fn every_view_of_a_scene_is_made_from_the_same_light() {
    let (worker, lit) = lit();
    let photons = lit.photons.as_ref().expect("photons");
    assert!(photons.is_complete && photons.counters.emitted == 50_000);
    for &view in CameraView::ALL {
        look(&worker, Subject::Camera(view), 0, [64, 48]);
        let end = wait_for(&worker, "finished", |now| image_of(now, view).is_some_and(|image| image.is_complete));
        let image = image_of(&end, view).expect("an image");
        assert_eq!((image.samples, image.resolution, image.size), (view.samples(2), [64, 48], [64, 48]));
        // Where there are no caustics there is still the lamp. A difference may be too dark on the whole.
        let is_seen = if view.is_comparison() { brightness(image) != 0.0 } else { brightness(image) > 0.0 };
        assert!(is_seen, "{view:?}");
    }
    let end = worker.latest();
    assert!(Arc::ptr_eq(end.photons.as_ref().expect("photons"), photons) && steps(&end) == 30);
}

#[test]
fn a_camera_that_moves_has_a_picture_of_its_own_in_every_view() {
    let (worker, _) = lit();
    for &view in CameraView::ALL {
        for place in 1..=3 {
            let camera = look(&worker, Subject::Camera(view), place, [640, 480]);
            wait_for(&worker, "seen", |now| image_of(now, view).is_some_and(|image| image.camera == camera));
        }
    }
}

#[test]
fn photons_and_estimates_are_looked_into() {
    let (worker, lit) = lit();
    let photons = lit.photons.as_ref().expect("photons");
    let bounced =
        photons.photons.iter().position(|photon| photon.path.len() == 2).expect("a photon that bounced twice");
    worker.send(Command::PickPhoton(Some(photons.photons[bounced])));
    let picked = wait_for(&worker, "picked", |now| now.trail.is_some());
    let places = &picked.trail.as_ref().expect("a trail").places;
    // It comes by where it was stored: the third surface, after the emitter.
    assert!(places[3].point.distance(photons.photons[bounced].position) < 1e-4, "{places:?}");
    let floor = Spot { point: Vec3::new(0.28, 0.0, 0.28), normal: Vec3::Y };
    worker.send(Command::Gather(Some(floor)));
    let gathered = wait_for(&worker, "gathered", |now| now.gathered.is_some());
    let gathered = gathered.gathered.as_ref().expect("an estimate");
    let is_near = |&index: &u32| photons.photons[index as usize].position.distance(floor.point) <= gathered.radius;
    assert!(gathered.used.len() > 50 && gathered.used.iter().all(is_near));
}

#[test]
fn progressive_passes_are_averaged() {
    let (worker, lit) = lit();
    let photons = PhotonSettings { count: 5_000, is_progressive: true, passes: 4, ..lit.settings.photons };
    worker.send(Command::Configure(Settings { photons, ..lit.settings }));
    look(&worker, Subject::Camera(CameraView::PhotonRadiance), 0, [64, 48]);
    worker.send(Command::Run);
    let end = wait_for(&worker, "finished", |now| {
        now.phase == Phase::Converged
            && image_of(now, CameraView::PhotonRadiance).is_some_and(|image| image.is_complete)
    });
    assert_eq!(end.photons.as_ref().map(|photons| photons.passes), Some(4));
    assert_eq!(image_of(&end, CameraView::PhotonRadiance).map(|image| image.samples), Some(4));
}

#[test]
fn more_photons_than_there_is_memory_are_refused() {
    let (worker, lit) = lit();
    // Fifty million photons that land some three times each take tens of gigabytes; where a machine has that much, the
    // arithmetic of it is all that can be looked at.
    let photons = PhotonSettings {
        count: PhotonSettings::MAX_COUNT,
        caustic_count: PhotonSettings::MAX_COUNT,
        ..lit.settings.photons
    };
    worker.send(Command::Configure(Settings { photons, ..lit.settings }));
    let after = wait_for(&worker, "answered", |now| now.error.is_some() || now.settings.photons == photons);
    match &after.error {
        Some(error) => {
            assert!(error.contains("photons") && error.contains("MiB"), "{error}");
            assert_eq!(after.settings, lit.settings);
        }
        None => println!("this machine has the memory"),
    }
}

#[test]
fn a_switch_begins_anew_what_it_concerns_and_nothing_else() {
    let (worker, lit) = lit();
    assert!(lit.plan.is_some() && lit.seconds_per_ray > 0.0);
    for (effect, keeps_radiosity, keeps_photons) in [
        (Effect::AmbientLight, true, true),
        (Effect::Shadows, false, true),
        (Effect::DirectLight, false, true),
        (Effect::Interreflection, false, false),
        (Effect::Caustics, true, true),
    ] {
        let (worker, before) = self::lit();
        let effects = Switches { off: Effects::of(&[effect]), ..Switches::default() };
        worker.send(Command::Configure(Settings { effects, ..before.settings }));
        let now = wait_for(&worker, "configured", |now| now.settings.effects == effects);
        let photons = now.photons.as_ref().zip(before.photons.as_ref());
        let same_photons = photons.is_some_and(|(now, before)| Arc::ptr_eq(now, before));
        assert_eq!((steps(&now) == 30, same_photons), (keeps_radiosity, keeps_photons), "{effect:?}");
    }
    // Another scene calls for other effects.
    let effects = Switches { off: Effects::of(&[Effect::Shadows]), ..Switches::default() };
    worker.send(Command::Configure(Settings { effects, ..lit.settings }));
    wait_for(&worker, "configured", |now| now.settings.effects == effects);
    worker.send(Command::Load("furnace".to_owned()));
    wait_for(&worker, "loaded", |now| now.settings.effects == Switches::default());
}
