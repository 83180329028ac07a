//! The window: it shows what the solver thread publishes and passes on what the person wants.
//!
//! Data goes one way round: [`model::Model`] → [`panels`] → [`action::Action`] → [`Explorer`], which is the one place
//! where anything changes. Only this module names egui, eframe and rfd.

pub mod action;
mod asking;
pub mod chart;
pub mod diagrams;
pub mod effects;
pub mod equation;
mod explorer;
mod file_dialogs;
pub mod format;
mod frame_clock;
pub mod keys;
pub mod marks;
pub mod model;
mod notices;
pub mod panels;
pub mod patch;
mod pictures;
mod preferences;
pub mod theme;
mod viewport_pane;
pub mod views;
pub mod wish;

pub use explorer::Explorer;

use crate::accuracy::Cache;
use crate::viewport::{AdapterChoice, GpuError, adapter_selector, device_descriptor};
use eframe::egui_wgpu::{WgpuConfiguration, WgpuError, WgpuSetup, WgpuSetupCreateNew};
use eframe::wgpu;
use std::sync::Arc;

/// What the command line says about the window.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// A path or the name of a built-in scene; the Cornell box where none is given.
    pub scene: Option<String>,
    pub adapter: AdapterChoice,
}

/// Why there is no window.
#[derive(Debug, thiserror::Error)]
pub enum AppError {
    #[error(
        "there is no display to open a window on ({0}); \
         without one, `lightwell render SCENE -o FILE.png` writes a picture"
    )]
    NoDisplay(String),
    #[error("{0}")]
    NoAdapter(String),
    #[error("the window failed")]
    Window(#[source] Box<eframe::Error>),
}

/// The scene that is opened where none is named.
const FIRST_SCENE: &str = "cornell-box";

/// Opens the window and returns when it is closed.
///
/// # Errors
/// If there is no display, no graphics adapter that matches, or the window system fails.
pub fn run(options: Options) -> Result<(), AppError> {
    let scene = options.scene.unwrap_or_else(|| FIRST_SCENE.to_owned());
    let native = eframe::NativeOptions {
        viewport: egui::ViewportBuilder::default()
            .with_title("Lightwell")
            .with_app_id("lightwell")
            .with_icon(theme::icon())
            .with_inner_size([1280.0, 800.0])
            .with_min_inner_size([960.0, 600.0]),
        wgpu_options: wgpu_configuration(options.adapter),
        ..eframe::NativeOptions::default()
    };
    eframe::run_native(
        "lightwell",
        native,
        Box::new(|context| Ok(Box::new(Explorer::new(context, scene, Cache::of_user())?))),
    )
    .map_err(app_error)
}

fn wgpu_configuration(adapter: AdapterChoice) -> WgpuConfiguration {
    let mut setup = WgpuSetupCreateNew {
        native_adapter_selector: Some(Arc::new(adapter_selector(adapter))),
        device_descriptor: Arc::new(device_descriptor),
        ..WgpuSetupCreateNew::without_display_handle()
    };
    // As without a window. OpenGL would take its time to start and lacks what the viewport needs.
    setup.instance_descriptor.backends = wgpu::Backends::from_env().unwrap_or(wgpu::Backends::PRIMARY);
    WgpuConfiguration { wgpu_setup: WgpuSetup::CreateNew(setup), ..WgpuConfiguration::default() }
}

fn app_error(error: eframe::Error) -> AppError {
    match error {
        eframe::Error::Winit(_) | eframe::Error::WinitEventLoop(_) => {
            // What winit says ends with the reason, after a place in its own source.
            let text = error.to_string();
            let reason = text.rsplit(": ").next().unwrap_or(&text);
            AppError::NoDisplay(reason.trim_end_matches('.').to_owned())
        }
        eframe::Error::Wgpu(WgpuError::CustomNativeAdapterSelectionError(reason)) => AppError::NoAdapter(reason),
        // No backend has started, so there was no adapter to select from.
        eframe::Error::Wgpu(WgpuError::CreateSurfaceError(_)) => AppError::NoAdapter(GpuError::NoAdapter.to_string()),
        other => AppError::Window(Box::new(other)),
    }
}
