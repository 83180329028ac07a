//! A model made up for the panels, without a worker or a graphics adapter, and the window that shows it.

use super::props::{pictures, solution};
use egui::{TextureHandle, Vec2};
use egui_kittest::Harness;
use lightwell::accuracy::Truth;
use lightwell::app::action::Action;
use lightwell::app::chart::Chart;
use lightwell::app::diagrams::MatrixTexture;
use lightwell::app::effects::EffectFacts;
use lightwell::app::equation::EquationFacts;
use lightwell::app::marks::Marks;
use lightwell::app::model::{Dialog, FrameTime, Look, LowerPanel, Model, Notice, SceneFacts, Theme};
use lightwell::app::patch::PatchFacts;
use lightwell::app::wish::Wish;
use lightwell::app::{panels, theme};
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::effects::{Effect, Plan, plan};
use lightwell::mesh::MeshSettings;
use lightwell::methods::Settings;
use lightwell::scene::{Finding, Scene};
use lightwell::solution::{CameraImage, Equation, Gathered, PhotonSolution, PhotonTrail, Solution, VertexShares};
use lightwell::study::Answer;
use lightwell::viewport::{Legend, View};
use lightwell::worker::{CheckReport, Curve, Entry, Phase, Track};
use lightwell::world::World;
use std::path::PathBuf;
use std::sync::{Arc, LazyLock};
use std::time::Duration;

/// What a model borrows, and the wishes that came of it.
pub struct Stage {
    pub phase: Phase,
    pub is_open: bool,
    pub findings: Vec<Finding>,
    /// Of the effects that the view tells apart.
    pub effects: Vec<Entry>,
    pub solution: Option<Solution>,
    pub photons: Option<PhotonSolution>,
    pub occlusion: Option<VertexShares>,
    pub image: Option<CameraImage>,
    pub trail: Option<PhotonTrail>,
    pub gathered: Option<Gathered>,
    pub filter_draft: Option<String>,
    pub settings: Settings,
    pub error: Option<String>,
    pub look: Look,
    pub theme: Theme,
    pub lower: Option<LowerPanel>,
    pub chart: Chart,
    pub missing: Option<&'static str>,
    pub legend: Option<Legend>,
    /// Whether the matrix and the item buffer are drawn.
    pub has_pictures: bool,
    pub pictures: Option<(MatrixTexture, TextureHandle)>,
    pub checks: Option<CheckReport>,
    pub patch: Option<PatchFacts<'static>>,
    /// In [`WORLD`].
    pub equation: Option<Equation>,
    pub curves: Vec<Arc<Curve>>,
    pub tracks: Vec<Arc<Track>>,
    pub truth: Option<Truth>,
    pub wish: Wish,
    pub answer: Option<Answer>,
    pub notices: Vec<Notice>,
    pub dialog: Option<Dialog>,
    pub recent: Vec<PathBuf>,
    pub actions: Vec<Action>,
}

/// A scene that is all diffuse and open.
pub static WORLD: LazyLock<Arc<World>> = LazyLock::new(|| {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let mesh = MeshSettings { element_size: Some(0.2), ..MeshSettings::default() };
    Arc::new(World::build(scene, &mesh, &Cancel::default()).expect("a world"))
});

static PLAN: LazyLock<Plan> = LazyLock::new(|| plan(&WORLD));

/// Radiosity with shadows.
pub fn effects() -> Vec<Entry> {
    let simulated = |effect, spent| Entry { effect, is_simulated: true, spent, saved: 0 };
    vec![
        simulated(Effect::DirectLight, 0),
        simulated(Effect::Shadows, 29_400_000),
        simulated(Effect::Interreflection, 0),
        simulated(Effect::Colour, 0),
        simulated(Effect::Escape, 1_600_000),
    ]
}

impl Default for Stage {
    /// A scene is open, and some of its light is shot.
    fn default() -> Self {
        Self {
            phase: Phase::Paused,
            is_open: true,
            findings: Vec::new(),
            effects: effects(),
            solution: Some(solution()),
            photons: None,
            occlusion: None,
            image: None,
            trail: None,
            gathered: None,
            filter_draft: None,
            settings: Settings::default(),
            error: None,
            look: Look::default(),
            theme: Theme::Dark,
            lower: None,
            chart: Chart::default(),
            missing: None,
            legend: None,
            has_pictures: false,
            pictures: None,
            checks: None,
            patch: None,
            equation: None,
            curves: Vec::new(),
            tracks: Vec::new(),
            truth: None,
            wish: Wish::default(),
            answer: None,
            notices: Vec::new(),
            dialog: None,
            recent: vec![PathBuf::from("/scenes/attic.obj")],
            actions: Vec::new(),
        }
    }
}

impl Stage {
    /// Nothing is open.
    pub fn empty() -> Self {
        Self { phase: Phase::Empty, is_open: false, solution: None, ..Self::default() }
    }

    pub fn show(&mut self, ui: &mut egui::Ui) {
        if self.has_pictures && self.pictures.is_none() {
            self.pictures = Some(pictures(ui.ctx()));
        }
        let facts = SceneFacts {
            name: "cornell-box",
            patches: 800,
            elements: 12_752,
            radius: 0.5,
            element_size: 0.0156,
            findings: &self.findings,
        };
        let model = Model {
            phase: &self.phase,
            scene: self.is_open.then_some(facts),
            effects: self.is_open.then(|| EffectFacts {
                plan: &PLAN,
                needed: PLAN.needed(),
                entries: self.effects.clone(),
                elapsed: Duration::from_secs(3),
                seconds_per_ray: 5e-8,
            }),
            solution: self.solution.as_ref(),
            photons: self.photons.as_ref(),
            occlusion: self.occlusion.as_ref(),
            image: self.image.as_ref(),
            trail: self.trail.as_ref(),
            gathered: self.gathered.as_ref(),
            filter_draft: self.filter_draft.as_deref(),
            settings: self.settings,
            error: self.error.as_deref(),
            look: self.look,
            viewport_size: [952, 646],
            exposure_ev: 1.3,
            theme: self.theme,
            lower: self.lower,
            chart: self.chart,
            missing: self.missing,
            legend: self.legend.clone(),
            matrix: self.pictures.as_ref().map(|(matrix, _)| matrix),
            item_buffer: self.pictures.as_ref().map(|(_, item_buffer)| item_buffer),
            checks: self.checks.as_ref(),
            patch: self.patch,
            equation: self.equation.as_ref().map(|equation| EquationFacts { equation, world: &WORLD }),
            marks: self
                .equation
                .as_ref()
                .map(|equation| Marks::of(equation, &Camera::new(&WORLD.viewpoint, &WORLD.bounds), [952, 646])),
            curves: &self.curves,
            tracks: &self.tracks,
            truth: self.truth.as_ref(),
            wish: self.wish,
            inquiry: self.answer.as_ref(),
            recent: &self.recent,
            notices: &self.notices,
            dialog: self.dialog.as_ref(),
            adapter: ADAPTER,
            frame_time: FrameTime::default(),
        };
        panels::show(ui, &model, &mut self.actions, |_, _| {});
    }

    /// The window of this stage, after its layout has settled.
    pub fn window(self, size: Vec2) -> Harness<'static, Self> {
        let theme = self.theme;
        let mut harness = Harness::builder()
            .with_size(size)
            .with_theme(theme)
            .with_context_setup(theme::install)
            .build_ui_state(|ui, stage: &mut Self| stage.show(ui), self);
        harness.run();
        harness.state_mut().actions.clear();
        harness
    }

    pub fn small(self) -> Harness<'static, Self> {
        self.window(SMALL)
    }
}

/// The smallest that the window can be made.
pub const SMALLEST: Vec2 = Vec2::new(960.0, 600.0);
pub const SMALL: Vec2 = Vec2::new(1280.0, 800.0);
pub const LARGE: Vec2 = Vec2::new(1920.0, 1080.0);

pub const ADAPTER: &str = "llvmpipe (LLVM 15.0.6, 256 bits) (vulkan)";

/// A stage that shows this view.
pub fn showing(view: View) -> Stage {
    Stage { look: Look { view, ..Look::default() }, ..Stage::default() }
}
