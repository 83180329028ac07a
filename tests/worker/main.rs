//! The solver thread: what it publishes and when, how fast it obeys, and that nothing ends it but its owner.

mod commands;
mod fake;

mod interruption;
mod judging;
mod lights;
mod occlusion;
mod pace;
mod picks;
mod pictures;
mod promptness;
mod publishing;
mod real;
mod trouble;

use glam::Vec3;
use lightwell::camera::Camera;
use lightwell::math::bounds::Bounds;
use lightwell::mesh::MeshSettings;
use lightwell::methods::Settings;
use lightwell::scene::Viewpoint;
use lightwell::worker::{Command, Phase, Sight, Snapshot, Subject, Worker};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// So long that only a thread that will never answer takes longer, however busy the machine is.
const PATIENCE: Duration = Duration::from_secs(300);

/// The first snapshot seen with this property.
fn wait_for(worker: &Worker, what: &str, is_it: impl Fn(&Snapshot) -> bool) -> Arc<Snapshot> {
    let start = Instant::now();
    loop {
        let snapshot = worker.latest();
        if is_it(&snapshot) {
            return snapshot;
        }
        assert!(start.elapsed() < PATIENCE, "never {what}; it is {:?}, {:?}", snapshot.phase, snapshot.error);
        std::thread::sleep(Duration::from_micros(200));
    }
}

/// Waits for something that no snapshot tells.
fn wait_until(what: &str, is_it: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_it() {
        assert!(start.elapsed() < PATIENCE, "never {what}");
        std::thread::sleep(Duration::from_micros(200));
    }
}

/// A small picture from so far away.
fn sight(subject: Subject, distance: f32) -> Sight {
    let viewpoint = Viewpoint { eye: distance * Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, vertical_fov: 40.0 };
    let camera = Camera::new(&viewpoint, &Bounds { min: Vec3::ZERO, max: Vec3::ONE });
    Sight { subject, camera, size: [16, 12] }
}

fn look(worker: &Worker, subject: Subject) {
    look_from(worker, subject, 3.0);
}

fn look_from(worker: &Worker, subject: Subject, distance: f32) {
    worker.send(Command::Look(sight(subject, distance)));
}

/// Opens a scene and waits for it.
fn load(worker: &Worker, scene: &str) -> Arc<Snapshot> {
    worker.send(Command::Load(scene.to_owned()));
    wait_for(worker, "loaded", |snapshot| snapshot.world.is_some() && snapshot.phase == Phase::Paused)
}

fn steps(snapshot: &Snapshot) -> u64 {
    snapshot.solution.as_ref().expect("a solution").steps
}

fn name(snapshot: &Snapshot) -> &str {
    &snapshot.world.as_ref().expect("a world").scene.name
}

/// Settings for a mesh with elements of this size.
fn with_elements(element_size: f32) -> Settings {
    Settings {
        mesh: MeshSettings { element_size: Some(element_size), ..MeshSettings::default() },
        ..Settings::default()
    }
}

/// A floor in a folder of its own, with nothing that emits.
fn dark_scene() -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("dark.obj");
    std::fs::write(&path, "o floor\nv 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nf 1 2 3 4\n").expect("a file");
    (folder, path)
}
