//! What the panels show. They read a [`Model`] and return [`super::action::Action`]s; nothing here can be changed by them.

use super::chart::Chart;
use super::diagrams::MatrixTexture;
use super::effects::EffectFacts;
use super::equation::EquationFacts;
use super::marks::Marks;
use super::patch::PatchFacts;
use super::wish::Wish;
use crate::accuracy::Truth;
use crate::choice::Choice;
use crate::cli::picture::{self, Format};
use crate::math::rgb::Rgb64;
use crate::methods::{Settings, Solver};
use crate::scene::{Finding, FindingKind};
use crate::solution::{CameraImage, Gathered, PhotonSolution, PhotonTrail, Solution, VertexShares};
use crate::study::Answer;
use crate::viewport::{Exposure, Legend, PhotonLook, ToneCurve, View};
use crate::worker::{CheckReport, Curve, LightKind, Phase, Snapshot, Subject, Track};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use egui::TextureHandle;
pub use egui::Theme;

/// Everything on show in one frame of the window.
pub struct Model<'a> {
    pub phase: &'a Phase,
    /// The open scene, if one is open.
    pub scene: Option<SceneFacts<'a>>,
    /// Which effects of light it calls for, and what they cost in the view on show.
    pub effects: Option<EffectFacts<'a>>,
    pub solution: Option<&'a Solution>,
    pub photons: Option<&'a PhotonSolution>,
    pub occlusion: Option<&'a VertexShares>,
    /// The picture from a camera that is on show, if the view is one.
    pub image: Option<&'a CameraImage>,
    /// The way of the picked photon.
    pub trail: Option<&'a PhotonTrail>,
    /// What the estimate at the picked point is made of.
    pub gathered: Option<&'a Gathered>,
    /// The pattern of paths that is being typed.
    pub filter_draft: Option<&'a str>,
    /// The settings as they stand in the controls: edited ones where an edit is under way, else those in force.
    pub settings: Settings,
    /// What went wrong last, unless it was dismissed.
    pub error: Option<&'a str>,
    pub look: Look,
    /// Width and height of the viewport in pixels.
    pub viewport_size: [u32; 2],
    /// The exposure that is in force, in EV.
    pub exposure_ev: f32,
    pub theme: Theme,
    /// What is open below the viewport.
    pub lower: Option<LowerPanel>,
    pub chart: Chart,
    /// What the view needs and does not have.
    pub missing: Option<&'static str>,
    /// Which numbers the false colours of the view stand for.
    pub legend: Option<Legend>,
    /// The matrix of form factors, where the solver keeps one and it is drawn.
    pub matrix: Option<&'a MatrixTexture>,
    /// What the picked patch sees through its hemicube.
    pub item_buffer: Option<&'a TextureHandle>,
    /// The picked patch, if one is.
    pub patch: Option<PatchFacts<'a>>,
    /// Where the light at the picked point comes from, in views of radiosity.
    pub equation: Option<EquationFacts<'a>>,
    /// The points of it, on the screen.
    pub marks: Option<Marks>,
    /// How the runs on this scene went, the one under way last.
    pub curves: &'a [Arc<Curve>],
    /// How far off they were, in the order in which they began.
    pub tracks: &'a [Arc<Track>],
    /// What they are held against, as far as it is known.
    pub truth: Option<&'a Truth>,
    /// What is wanted of light, and what is being looked for.
    pub wish: Wish,
    pub inquiry: Option<&'a Answer>,
    /// How the hard cases went; `None` before they were run.
    pub checks: Option<&'a CheckReport>,
    /// Scene files that were opened before, newest first.
    pub recent: &'a [PathBuf],
    pub notices: &'a [Notice],
    pub dialog: Option<&'a Dialog>,
    /// Name of the graphics adapter.
    pub adapter: &'a str,
    pub frame_time: FrameTime,
}

impl Model<'_> {
    /// Whose work is on show.
    pub fn subject(&self) -> Subject {
        picture::subject(self.look.view)
    }

    /// The light that the view shows or is read off, which runs and steps; `None` where rays from the camera find it.
    pub fn light(&self) -> Option<LightKind> {
        self.subject().light()
    }

    /// Whether there is light to compute: a scene with an emitter is open, or one of which ambient light is asked, and the
    /// solver is alive and not done.
    pub fn can_run(&self) -> bool {
        let needs_emitter = self.light() != Some(LightKind::Occlusion);
        let is_open = self.scene.is_some_and(|scene| !(needs_emitter && scene.is_dark()));
        is_open && self.light().is_some() && matches!(self.phase, Phase::Paused | Phase::Running)
    }

    pub fn is_running(&self) -> bool {
        *self.phase == Phase::Running
    }

    /// Whether a step of the solver is a sweep over all patches, and not a shot of one.
    pub fn sweeps(&self) -> bool {
        matches!(self.settings.solver, Solver::Jacobi | Solver::GaussSeidel)
    }

    /// What a step of the light on show is called.
    pub fn step_name(&self) -> &'static str {
        match self.light() {
            Some(LightKind::Photons | LightKind::Occlusion) => "batch",
            _ if self.sweeps() => "sweep",
            _ => "shot",
        }
    }

    /// Whether anything is picked that the view shows.
    pub fn has_pick(&self) -> bool {
        match self.subject() {
            Subject::Radiosity => self.patch.is_some(),
            Subject::Photons | Subject::Camera(_) => self.trail.is_some() || self.gathered.is_some(),
            Subject::Occlusion => false,
        }
    }

    /// Whether the view waits for the person. What comes by itself in a moment is no news: a message would come and go,
    /// and change the size of the picture each time.
    pub fn is_stuck(&self) -> bool {
        let has_light = match self.light() {
            Some(LightKind::Radiosity) => self.solution.is_some(),
            Some(LightKind::Photons) => self.photons.is_some_and(|photons| !photons.photons.is_empty()),
            Some(LightKind::Occlusion) => self.occlusion.is_some_and(|occlusion| !occlusion.shares.is_empty()),
            None => true,
        };
        // A picture that is there and shows nothing will not show more.
        let is_empty = self.look.view.is_comparison() && self.image.is_some();
        self.subject() == Subject::Radiosity || is_empty || !(has_light || self.is_running())
    }

    /// How much of the matrix is built, in [0, 1], while it is.
    pub fn preparation(&self) -> Option<f32> {
        let solution = self.solution.filter(|_| self.light() == Some(LightKind::Radiosity));
        solution.and_then(|solution| solution.preparation)
    }

    /// The most bounces of light that can be looked at.
    pub fn last_bounce(&self) -> usize {
        self.solution.map_or(0, |solution| solution.bounces.len().saturating_sub(1))
    }

    /// Share of the photons that are there, or of the passes of a progressive run, in [0, 1].
    pub fn photon_progress(&self) -> f32 {
        let wanted = self.settings.photons;
        let Some(photons) = self.photons else { return 0.0 };
        let emitted = photons.counters.emitted as f64 / f64::from(wanted.count.max(1));
        let pass = if photons.is_complete { 1.0 } else { emitted.min(1.0) };
        let before = photons.passes - u64::from(photons.is_complete);
        let passes = if wanted.is_progressive { wanted.passes.max(1) } else { 1 };
        ((before as f64 + pass) / f64::from(passes)).min(1.0) as f32
    }

    /// Share of the rounds over all vertices that are done, in [0, 1].
    pub fn occlusion_progress(&self) -> f32 {
        let rounds = self.occlusion.map_or(0, |occlusion| occlusion.rounds);
        (rounds as f32 / self.settings.image.samples.max(1) as f32).min(1.0)
    }

    /// How far the light is between the emitters (0) and the stop limit (1), on a logarithmic scale: a solver takes
    /// about as long from 10 % to 1 % of unshot flux as from 100 % to 10 %.
    pub fn radiosity_progress(&self) -> f32 {
        let Some(solution) = self.solution.filter(|solution| solution.energy.emitted != Rgb64::ZERO) else {
            return 0.0;
        };
        // Overshoot may lend more light than there is left.
        let unshot = solution.unshot_share;
        let limit = self.settings.unshot_limit;
        if solution.converged || unshot <= limit {
            return 1.0;
        }
        (unshot.ln() / limit.ln()).clamp(0.0, 1.0) as f32
    }
}

/// What is known of the open scene.
#[derive(Clone, Copy)]
pub struct SceneFacts<'a> {
    pub name: &'a str,
    pub patches: usize,
    pub elements: usize,
    /// Half the diagonal of the box around the scene, m.
    pub radius: f32,
    /// Longest edge of an element, m.
    pub element_size: f32,
    /// What the doctor and the mesher noticed.
    pub findings: &'a [Finding],
}

impl<'a> SceneFacts<'a> {
    pub fn of(snapshot: &'a Snapshot) -> Option<Self> {
        let world = snapshot.world.as_deref()?;
        Some(Self {
            name: &world.scene.name,
            patches: world.mesh.patches.len(),
            elements: world.mesh.elements.len(),
            radius: world.bounds.radius(),
            element_size: world.element_size,
            findings: &world.scene.findings,
        })
    }

    /// Whether the scene has no emitter and got no ceiling light instead.
    pub fn is_dark(&self) -> bool {
        let has = |kind| self.findings.iter().any(|finding| finding.kind == kind);
        has(FindingKind::NoEmitter) && !has(FindingKind::CeilingLightAdded)
    }
}

/// How the light is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    pub view: View,
    /// How many bounces of light [`View::Bounces`] shows.
    pub bounce: usize,
    /// Adds what the unshot light will bring on average.
    pub ambient: bool,
    pub wireframe: bool,
    /// Outlines the patch that shot last.
    pub show_shooter: bool,
    pub photons: PhotonLook,
    pub exposure: Exposure,
    pub tone: ToneCurve,
}

impl Default for Look {
    fn default() -> Self {
        Self {
            view: View::Smooth,
            bounce: 0,
            ambient: false,
            wireframe: false,
            show_shooter: true,
            photons: PhotonLook::default(),
            exposure: Exposure::Automatic,
            tone: ToneCurve::default(),
        }
    }
}

/// What can be open below the viewport.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LowerPanel {
    Equation,
    Convergence,
    Accuracy,
    HardCases,
}

impl Choice for LowerPanel {
    const ALL: &'static [Self] = &[Self::Equation, Self::Convergence, Self::Accuracy, Self::HardCases];
    const KIND: &'static str = "panel";

    fn name(self) -> &'static str {
        match self {
            Self::Equation => "equation",
            Self::Convergence => "convergence",
            Self::Accuracy => "accuracy",
            Self::HardCases => "hard-cases",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Equation => "Equation",
            Self::Convergence => "Convergence",
            Self::Accuracy => "Accuracy",
            Self::HardCases => "Hard cases",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Equation => {
                "The rendering equation at a point that you click, with its numbers, and where its light comes from"
            }
            Self::Convergence => "How fast each run on this scene came near its end, on one chart",
            Self::Accuracy => {
                "How far off each run on this scene was after how much time, against a path-traced reference"
            }
            Self::HardCases => "Numbers on which programs of this kind break, each held against what it should be",
        }
    }
}

/// A picture to be saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureRequest {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
    pub format: Format,
}

/// The ending of files of this format.
pub fn extension(format: Format) -> &'static str {
    match format {
        Format::Png => "png",
        Format::Exr => "exr",
    }
}

/// The one dialog that is open.
#[derive(Clone, Debug, PartialEq)]
pub enum Dialog {
    Picture(PictureRequest),
    /// A path to be typed, where the system has no file dialog.
    Path {
        purpose: PathPurpose,
        text: String,
    },
    /// The matrix of form factors.
    Matrix,
    /// What the picked patch sees.
    ItemBuffer,
    Keys,
    About,
}

/// What a typed path is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathPurpose {
    OpenScene,
    SavePicture(PictureRequest),
}

/// A message over the viewport.
#[derive(Clone, Debug, PartialEq)]
pub struct Notice {
    pub id: u64,
    pub text: String,
    pub is_error: bool,
    /// Until when it is shown, in seconds of egui's clock; errors stay until they are dismissed.
    pub until: Option<f64>,
}

/// The window's own work for a frame: its panels and the upload of new light, without the solver and the swap.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameTime {
    pub mean: Duration,
    pub worst: Duration,
}
