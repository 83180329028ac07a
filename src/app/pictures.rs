//! Pictures saved from the window, one after the other on a thread of their own.

use super::model::extension;
use crate::cli::picture::{self, Format};
use crate::errors::with_causes;
use crate::viewport::{Frame, Gpu, Light, render_picture};
use crate::worker::check_picture;
use crate::world::World;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

/// Everything that a picture is made of. World and light are the ones on show when it was asked for.
pub struct Job {
    pub world: Arc<World>,
    pub light: Light,
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
    Free(Format),
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
    check_picture(job.frame.size).map_err(|refused| with_causes(&refused))?;
    let picture =
        render_picture(gpu, &job.world, &job.light, &job.frame, job.samples).map_err(|error| with_causes(&error))?;
    let path = match &job.destination {
        Destination::File(path) => path.clone(),
        Destination::Free(format) => free_path(&pictures_folder(), &job.world.scene.name, extension(*format)),
    };
    picture::save(&path, &picture, &job.facts).map_err(|error| with_causes(&error))?;
    Ok(path)
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
