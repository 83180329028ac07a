//! The system's own file dialogs, each on a thread of its own, so that the window goes on meanwhile.

use super::model::{PathPurpose, PictureRequest, extension};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

/// What came of a dialog.
#[derive(Debug, PartialEq)]
pub enum Outcome {
    Chosen(PathPurpose, PathBuf),
    Cancelled,
    /// The system has no file dialog.
    Unavailable(PathPurpose),
}

pub struct FileDialogs {
    context: egui::Context,
    sender: Sender<Outcome>,
    receiver: Receiver<Outcome>,
    is_open: bool,
}

impl FileDialogs {
    /// Nobody closes a dialog this soon after it was asked for. rfd says "cancelled" where there is none to open, and
    /// says it at once.
    const SOONEST_CANCEL: Duration = Duration::from_millis(250);

    pub fn new(context: &egui::Context) -> Self {
        let (sender, receiver) = channel();
        Self { context: context.clone(), sender, receiver, is_open: false }
    }

    pub fn open_scene(&mut self) {
        let dialog = rfd::FileDialog::new().set_title("Open a scene").add_filter("Wavefront OBJ", &["obj", "OBJ"]);
        self.show(PathPurpose::OpenScene, move || dialog.pick_file());
    }

    pub fn save_picture(&mut self, request: PictureRequest, name: String) {
        let extension = extension(request.format);
        let dialog = rfd::FileDialog::new()
            .set_title("Save a picture")
            .add_filter(extension.to_uppercase(), &[extension])
            .set_file_name(name);
        self.show(PathPurpose::SavePicture(request), move || dialog.save_file());
    }

    /// Runs one dialog at a time; asked for another while one is open, it does nothing.
    fn show(&mut self, purpose: PathPurpose, ask: impl FnOnce() -> Option<PathBuf> + Send + 'static) {
        if std::mem::replace(&mut self.is_open, true) {
            return;
        }
        let (sender, context) = (self.sender.clone(), self.context.clone());
        std::thread::spawn(move || {
            let start = Instant::now();
            let outcome = match ask() {
                Some(path) => Outcome::Chosen(purpose, path),
                None if start.elapsed() < Self::SOONEST_CANCEL => Outcome::Unavailable(purpose),
                None => Outcome::Cancelled,
            };
            // The window may be gone by now; then nobody waits for the path.
            if sender.send(outcome).is_ok() {
                context.request_repaint();
            }
        });
    }

    /// The outcome of a dialog that was closed since the last call.
    pub fn poll(&mut self) -> Option<Outcome> {
        let outcome = self.receiver.try_recv().ok()?;
        self.is_open = false;
        Some(outcome)
    }
}
