//! What a panel or a key may ask for. Panels only return these; [`super::Explorer`] is the one place that acts on them.

use super::chart::Chart;
use super::model::{Dialog, Look, LowerPanel, PictureRequest, Theme};
use super::wish::Wish;
use crate::methods::Settings;
use crate::study::Question;
use crate::worker::Command;
use egui::Vec2;
use std::path::PathBuf;

/// One wish of the person at the window.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Passes a command on to the solver thread.
    Send(Command),
    /// Opens a scene: a path or the name of a built-in one.
    Open(String),
    /// Asks the system for a scene file to open.
    BrowseForScene,
    /// Shows the picture of the light in another way.
    SetLook(Look),
    /// Changes settings while a control is held; nothing is computed yet.
    EditSettings(Settings),
    /// Sends the edited settings to the solver.
    ApplySettings(Settings),
    /// Moves the camera.
    Camera(CameraMove),
    /// Picks what is at this point of the viewport, in shares of its width and height from the top left: a patch, or where
    /// photons are seen one of them or else the point of the surface.
    Pick(Vec2),
    /// Picks the point of the surface there: where photons are seen, one of which may be in the way, as the point of the
    /// estimate, and else as the second point of the rendering equation.
    PickPoint(Vec2),
    /// Forgets what is picked.
    Unpick,
    /// Changes the pattern of paths that is being typed, or leaves it; nothing is filtered by it yet.
    EditFilter(Option<String>),
    /// Picks the patch with this index.
    PickPatch(u32),
    /// Picks the middle of the patch with this index as the second point of the rendering equation.
    PickSource(u32),
    /// Saves the viewport as it is at once, under a name that is free.
    SavePictureNow,
    /// Asks the system for a file to save to, and saves a picture there.
    BrowseForPicture(PictureRequest),
    /// Saves a picture to this file.
    SavePicture(PictureRequest, PathBuf),
    SetTheme(Theme),
    /// Opens a panel below the viewport, or closes the one that is open.
    ShowLowerPanel(Option<LowerPanel>),
    SetChart(Chart),
    /// Says what is wanted of light.
    SetWish(Wish),
    /// Looks for settings in the background.
    Inquire(Question),
    StopInquiry,
    /// Runs all hard cases in the background.
    RunChecks,
    /// Opens the hard case of this name as a scene.
    ShowCase(&'static str),
    /// Opens a dialog, or replaces the contents of the one that is open.
    ShowDialog(Dialog),
    CloseDialog,
    DismissError,
    DismissNotice(u64),
    Quit,
}

/// A change of the camera. Distances are shares of the viewport's height, so that they do not depend on its pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CameraMove {
    Orbit(Vec2),
    Pan(Vec2),
    /// Factor on the distance to the target; below 1 moves closer.
    Zoom(f32),
    /// Flies to a view of the whole scene.
    Fit,
    /// Flies back to where the camera was when the scene was opened.
    Home,
}
