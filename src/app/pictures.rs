//! Pictures saved from the window, one after the other on a thread of their own.

use super::model::PictureFormat;
use crate::cli::picture;
use crate::methods::Settings;
use crate::solution::Solution;
use crate::viewport::{Frame, Gpu, render_picture};
use crate::world::World;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

/// Everything that a picture is made of. World and solution are the ones on show when it was asked for.
pub struct Job {
    pub world: Arc<World>,
    pub solution: Arc<Solution>,
    pub frame: Frame,
    pub samples: u32,
    /// Written into the file beside the picture.
    pub facts: Vec<(String, String)>,
    pub destination: Destination,
}

/// Where a picture goes.
pub enum Destination {
    File(PathBuf),
    /// The pictures folder, under a name that is free when the picture is ready.
    Free(PictureFormat),
}

/// The thread that renders and writes. It ends when this is dropped, after the picture it is at.
pub struct Pictures {
    jobs: Sender<Job>,
    outcomes: Receiver<Result<PathBuf, String>>,
}

impl Pictures {
    pub fn spawn(gpu: Gpu, context: egui::Context) -> Self {
        let (jobs, queue) = channel();
        let (sender, outcomes) = channel();
        std::thread::spawn(move || {
            for job in queue {
                if sender.send(save(&gpu, &job)).is_err() {
                    break;
                }
                context.request_repaint();
            }
        });
        Self { jobs, outcomes }
    }

    /// Puts a picture at the end of the queue.
    ///
    /// # Errors
    /// If the thread is gone, after a fault in it.
    pub fn save(&self, job: Job) -> Result<(), String> {
        self.jobs.send(job).map_err(|_| "pictures can no longer be saved; restart Lightwell".to_owned())
    }

    /// The file that was written since the last call, or why it was not.
    pub fn poll(&self) -> Option<Result<PathBuf, String>> {
        self.outcomes.try_recv().ok()
    }
}

fn save(gpu: &Gpu, job: &Job) -> Result<PathBuf, String> {
    let picture = render_picture(gpu, &job.world, &job.solution, &job.frame, job.samples).map_err(|e| chain(&e))?;
    let path = match &job.destination {
        Destination::File(path) => path.clone(),
        Destination::Free(format) => free_path(&pictures_folder(), &job.world.scene.name, format.extension()),
    };
    picture::save(&path, &picture, &job.facts).map_err(|error| chain(&error))?;
    Ok(path)
}

/// What a picture says of itself: enough to make it again.
pub fn facts(world: &World, solution: &Solution, settings: &Settings, frame: &Frame) -> Vec<(String, String)> {
    let element_size = settings.mesh.element_size.map_or_else(|| "automatic".to_owned(), |size| format!("{size} m"));
    let viewpoint = frame.camera.viewpoint();
    let facts = [
        ("Software", concat!("Lightwell ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("Scene", world.scene.name.clone()),
        ("View", frame.view.to_string()),
        ("Eye", format!("{}", viewpoint.eye)),
        ("Target", format!("{}", viewpoint.target)),
        ("Up", format!("{}", viewpoint.up)),
        ("Vertical field of view", format!("{} deg", viewpoint.vertical_fov)),
        ("Exposure", format!("{} EV, {}", frame.exposure_ev, frame.tone)),
        ("Method", "progressive radiosity".to_owned()),
        ("Element size", element_size),
        ("Shadow rays", settings.shadow_rays.to_string()),
        ("Stop limit", settings.unshot_limit.to_string()),
        ("Steps", solution.steps.to_string()),
        ("Seconds", format!("{:.3}", solution.elapsed.as_secs_f64())),
        ("Seed", settings.seed.to_string()),
    ];
    facts.map(|(key, value)| (key.to_owned(), value)).into()
}

/// The folder for pictures that were not given one: `Pictures` in the home folder, else the current one.
fn pictures_folder() -> PathBuf {
    let pictures = std::env::home_dir().map(|home| home.join("Pictures")).filter(|folder| folder.is_dir());
    pictures.or_else(|| std::env::current_dir().ok()).unwrap_or_default()
}

/// `lightwell-SCENE-N.EXTENSION` with the first N from 1 that no file has.
fn free_path(folder: &Path, scene: &str, extension: &str) -> PathBuf {
    let numbered = |n: u32| folder.join(format!("lightwell-{scene}-{n}.{extension}"));
    (1..).map(numbered).find(|path| !path.exists()).expect("a folder has less than 2³² files")
}

/// An error and its causes in one line.
fn chain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text = format!("{text}: {error}");
        cause = error.source();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_new_picture_overwrites_none() -> std::io::Result<()> {
        let folder = tempfile::tempdir()?;
        let first = free_path(folder.path(), "furnace", "png");
        assert_eq!(first, folder.path().join("lightwell-furnace-1.png"));
        std::fs::write(&first, "")?;
        assert_eq!(free_path(folder.path(), "furnace", "png"), folder.path().join("lightwell-furnace-2.png"));
        assert_eq!(free_path(folder.path(), "furnace", "exr"), folder.path().join("lightwell-furnace-1.exr"));
        Ok(())
    }
}
