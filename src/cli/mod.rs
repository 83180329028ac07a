//! The command line: the same code as the window, without one. One file a command.

mod budget;
mod camera_options;
mod check;
mod effect_options;
mod facts;
mod form_factor;
mod image_options;
mod inspect;
mod judge;
mod occlusion_options;
mod photon_options;
pub mod picture;
mod plan;
mod probe;
mod progress_line;
mod quality;
mod render;
mod run_options;
mod scenes;
mod seeking;
mod series;
mod solve;
mod study;
mod tracing;
mod values;

use crate::scene::{Finding, SceneError, Severity};
use crate::study::NotFound;
use crate::viewport::{AdapterChoice, GpuError};
use crate::worker::Refused;
use crate::world::WorldError;
use clap::error::ErrorKind;
use clap::{Args, CommandFactory, Parser, Subcommand};
use glam::DVec3;
use std::path::PathBuf;

/// Watch light spread through a scene, and read off what accuracy costs.
#[derive(Debug, Parser)]
#[command(name = "lightwell", version, args_conflicts_with_subcommands = true)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Option<Command>,
    #[command(flatten)]
    pub window: WindowOptions,
}

/// What the window takes.
#[derive(Args, Clone, Debug)]
pub struct WindowOptions {
    /// The scene to open: the path of an OBJ file, or the name of a built-in scene
    pub scene: Option<String>,
    /// The graphics adapter: `system` for the best one, `software`, or a part of its name
    #[arg(long, value_name = "software|NAME", default_value = "system")]
    pub adapter: AdapterChoice,
}

/// What can be done without a window.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Solve a scene and write a picture of it
    Render(render::Options),
    /// Write one scene as a series of pictures: ray-traced, its photons, light read off them, and gathered from them
    Series(series::Options),
    /// Solve a scene and print where its light went
    Solve(solve::Options),
    /// Solve a scene and print the irradiance, or the share of ambient light, at points
    Probe(probe::Options),
    /// Try ways to compute light on a scene, and write what accuracy costs in time: a table, a chart and a report
    Study(study::Options),
    /// Compute the form factor between two polygons by every method
    #[command(name = "formfactor")]
    FormFactor(form_factor::Options),
    /// Print what a scene holds and what was wrong with it
    Inspect(inspect::Options),
    /// Print which effects of light a scene calls for, and how it is best computed
    Plan(plan::Options),
    /// Run the gallery of hard cases and print how each went
    Check(check::Options),
    /// List the built-in scenes
    Scenes(scenes::Options),
}

impl Command {
    /// # Errors
    /// See [`CliError`].
    pub fn run(&self) -> Result<(), CliError> {
        match self {
            Self::Render(options) => render::run(options),
            Self::Series(options) => series::run(options),
            Self::Solve(options) => solve::run(options),
            Self::Probe(options) => probe::run(options),
            Self::Study(options) => study::run(options),
            Self::FormFactor(options) => form_factor::run(options),
            Self::Inspect(options) => inspect::run(options),
            Self::Plan(options) => plan::run(options),
            Self::Check(options) => check::run(options),
            Self::Scenes(options) => scenes::run(options),
        }
    }
}

/// Why a command failed. The command line itself was in order.
#[derive(Debug, thiserror::Error)]
pub enum CliError {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    World(#[from] WorldError),
    #[error(transparent)]
    Refused(#[from] Refused),
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error("cannot read points from {path}")]
    ReadPoints { path: PathBuf, source: std::io::Error },
    #[error("{path}, line {line}: {reason}")]
    Point { path: PathBuf, line: usize, reason: String },
    #[error("cannot write {path}")]
    Write { path: PathBuf, source: std::io::Error },
    #[error("cannot encode {path}")]
    Encode { path: PathBuf, source: Box<dyn std::error::Error + Send + Sync> },
    #[error("{path} is neither .png nor .exr")]
    PictureFormat { path: PathBuf },
    #[error("{failed} of {rows} rows fail")]
    Check { failed: usize, rows: usize },
    #[error("there is no patch {patch}: the scene has {patches}, counted from 0")]
    NoSuchPatch { patch: u32, patches: usize },
    #[error("no patch is seen at {},{}", .at[0], .at[1])]
    NothingPicked { at: [f32; 2] },
    #[error("only {kept} bounces of light were kept, and the light of the emitters")]
    NoSuchBounce { kept: usize },
    #[error(transparent)]
    NotFound(#[from] NotFound),
    #[error("there is nothing to draw: {0}")]
    Missing(&'static str),
    #[error("no surface is at {}, seen from where its normal points, and {reason}; the nearest is {distance:.2e} m away", text(.point))]
    InTheAir { point: DVec3, distance: f64, reason: &'static str },
    #[error("cannot make the folder {path}")]
    Folder { path: PathBuf, source: std::io::Error },
    #[error("cannot print")]
    Print(#[from] std::io::Error),
}

/// A point as options have it: `0,1.5,-2`.
fn text(point: &DVec3) -> String {
    format!("{},{},{}", point.x, point.y, point.z)
}

/// Ends the program, as any other wrong command line does, because options do not fit together.
fn refuse(reason: &str) -> ! {
    Cli::command().error(ErrorKind::ArgumentConflict, reason).exit()
}

/// Prints what may make a result differ from what the scene's author meant, on standard error.
fn warn_of(findings: &[Finding]) {
    for finding in findings.iter().filter(|finding| finding.severity == Severity::Warning) {
        eprintln!("warning: {}: {}; {}", finding.subject, finding.problem, finding.remedy);
    }
}
