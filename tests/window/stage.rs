//! A model made up for the panels, without a worker or a graphics adapter, and the window that shows it.

use egui::{TextureHandle, Vec2};
use egui_kittest::Harness;
use glam::Vec3;
use lightwell::accuracy::{Error, Truth};
use lightwell::app::action::Action;
use lightwell::app::chart::Chart;
use lightwell::app::diagrams::MatrixTexture;
use lightwell::app::effects::EffectFacts;
use lightwell::app::equation::EquationFacts;
use lightwell::app::marks::Marks;
use lightwell::app::model::{Dialog, FrameTime, Look, LowerPanel, Model, Notice, SceneFacts, Theme};
use lightwell::app::patch::{PatchFacts, PatchLight};
use lightwell::app::wish::Wish;
use lightwell::app::{panels, theme};
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::effects::{Bill, Effect, Plan, plan};
use lightwell::hard_cases::{Row, Verdict, cases};
use lightwell::math::bounds::Bounds;
use lightwell::math::rgb::{Rgb, Rgb64};
use lightwell::mesh::MeshSettings;
use lightwell::methods::{Settings, Solver};
use lightwell::scene::{Finding, FindingKind, Scene, Severity, Viewpoint};
use lightwell::solution::{
    CameraImage, CameraView, Closure, Counters, Energy, Equation, Gathered, PhotonCounters, PhotonEnergy,
    PhotonSolution, PhotonTrail, Progress, Scattering, Solution, TrailPlace, VertexShares,
};
use lightwell::study::Answer;
use lightwell::viewport::colour_map::ColourMap;
use lightwell::viewport::diagram::Swatch;
use lightwell::viewport::{Legend, View};
use lightwell::worker::{CheckReport, Curve, CurvePoint, Entry, LightKind, Phase, Track, TrackPoint};
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

/// 10 W emitted, of which 6 W are absorbed, 3 W unshot and 1 W escaped.
pub fn solution() -> Solution {
    let watts = |red: f64| Rgb64::new(red, 0.0, 0.0);
    Solution {
        steps: 1_234,
        elapsed: Duration::from_millis(2_500),
        converged: false,
        unshot_share: 0.3,
        energy: Energy { emitted: watts(10.0), absorbed: watts(6.0), unshot: watts(3.0), escaped: watts(1.0) },
        closure: Closure { mean: 0.0123, worst: 0.07, reciprocity: 2e-6 },
        counters: Counters { rays: 31_000_000, ..Counters::default() },
        shooter: None,
        ..Solution::default()
    }
}

pub fn finding(kind: FindingKind, severity: Severity) -> Finding {
    Finding {
        severity,
        kind,
        subject: "object 'lamp', line 12".to_owned(),
        problem: "the face has no area".to_owned(),
        remedy: "left out".to_owned(),
    }
}

/// A 500 × 500 matrix and an item buffer, both grey.
fn pictures(ctx: &egui::Context) -> (MatrixTexture, TextureHandle) {
    let texture = |name: &str| {
        let image = egui::ColorImage::filled([8, 8], egui::Color32::GRAY);
        ctx.load_texture(name, image, egui::TextureOptions::NEAREST)
    };
    let swatch = |(label, share)| Swatch { label, colour: Rgb::splat(0.5), share };
    let legend = Legend {
        title: "Form factor",
        unit: "",
        low: 1e-6,
        high: 1e-2,
        is_logarithmic: true,
        map: ColourMap::Sequential,
        ticks: vec![1e-4, 1e-2],
    };
    let matrix = MatrixTexture {
        texture: texture("matrix"),
        size: 500,
        legend: Some(legend),
        zeros: [("Same plane", 0.2), ("Faces away", 0.4), ("Occluded", 0.1)].map(swatch),
        filled: 0.3,
    };
    (matrix, texture("item buffer"))
}

pub fn patch() -> PatchFacts<'static> {
    let light = PatchLight {
        radiosity: Rgb::new(12.0, 6.0, 3.0),
        irradiance: Rgb::new(16.0, 8.0, 4.0),
        unshot: Rgb::new(1.0, 0.5, 0.25),
    };
    PatchFacts {
        index: 42,
        material: "white",
        area: 0.0123,
        reflectance: Rgb::new(0.725, 0.71, 0.68),
        exitance: Rgb::ZERO,
        light: Some(light),
        row_sum: 0.98,
        escaping: 0.02,
    }
}

/// Three runs, each ten times as fast as the one before.
pub fn curves() -> Vec<Arc<Curve>> {
    let solvers = [Solver::Progressive, Solver::Jacobi, Solver::GaussSeidel];
    let curve = |(i, solver): (u32, Solver)| {
        let point = |k: u64| CurvePoint {
            progress: Progress {
                steps: k * 10_u64.pow(2 - i),
                updates: 500 * k,
                rays: 1_000_000 * k,
                unshot_share: 0.5_f64.powi(k as i32),
                missing_share: 0.4_f64.powi(k as i32),
            },
            seconds: 0.1 * k as f64,
        };
        let settings = Settings { solver, ..Settings::default() };
        Arc::new(Curve { number: i + 1, settings, points: (0..10).map(point).collect() })
    };
    (0_u32..).zip(solvers).map(curve).collect()
}

/// A run of radiosity that levels off, and one of photons whose noise falls with the root of time.
pub fn tracks() -> Vec<Arc<Track>> {
    let track = |number, kind, error: fn(f64) -> f64| {
        let point = |k: i32| {
            let seconds = 0.01 * 2_f64.powi(k);
            TrackPoint { seconds, error: Error { rms: error(seconds), uncertainty: 0.001, floor: 0.004, noise: None } }
        };
        Arc::new(Track { number, kind, settings: Settings::default(), points: (0..9).map(point).collect() })
    };
    vec![
        track(1, LightKind::Radiosity, |seconds| 0.03 + 0.01 / seconds),
        track(2, LightKind::Photons, |seconds| 0.1 / seconds.sqrt()),
    ]
}

/// Three rows of the first case: one of each verdict.
pub fn checks(is_finished: bool) -> CheckReport {
    let case = cases().next().expect("there are hard cases").name;
    let row = |quantity: &str, expected, got, tolerance, verdict| Row {
        case,
        quantity: quantity.to_owned(),
        expected,
        got,
        tolerance,
        guard: "a guard".to_owned(),
        verdict,
    };
    let rows = vec![
        row("holds", 0.199_824_895_698, 0.199_824_895_699, 1e-9, Verdict::Pass),
        row("fails", 0.003_162_056_838_757_6, -1.25e-7, 0.0, Verdict::Fail),
        row("is a limit", 123_456.789, 123_456.789, 1e-3, Verdict::Limit),
    ];
    CheckReport { rows, running: (!is_finished).then_some(case), is_finished }
}

/// 10 W emitted as 50,000 photons of 200,000, of which 7 W are absorbed, 2.5 W escaped and 0.5 W truncated.
pub fn photons() -> PhotonSolution {
    let watts = |red: f64| Rgb64::new(red, 0.0, 0.0);
    PhotonSolution {
        batches: 4,
        elapsed: Duration::from_millis(250),
        max_radius: 0.04,
        energy: PhotonEnergy { emitted: watts(10.0), absorbed: watts(7.0), escaped: watts(2.5), truncated: watts(0.5) },
        counters: PhotonCounters {
            emitted: 50_000,
            caustic_emitted: 0,
            stored: 90_000,
            rays: 1_000_000,
            by_bounce: vec![60_000, 20_000, 0, 10_000],
            by_path: vec![("LD".to_owned(), 60_000), ("LDD".to_owned(), 30_000)],
            ..PhotonCounters::default()
        },
        ..PhotonSolution::default()
    }
}

/// A picture after 4 samples a pixel and 1.5 s.
pub fn image(view: CameraView) -> CameraImage {
    let viewpoint = Viewpoint { eye: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, vertical_fov: 45.0 };
    CameraImage {
        view,
        camera: Camera::new(&viewpoint, &Bounds { min: Vec3::ZERO, max: Vec3::ONE }),
        size: [1; 2],
        resolution: [1; 2],
        radiance: vec![Rgb::ONE],
        coverage: vec![1.0],
        contrast: None,
        samples: 4,
        rays: 3_000_000,
        bill: Bill::default(),
        elapsed: Duration::from_millis(1_500),
        is_complete: false,
    }
}

/// A photon that met a mirror, then a diffuse surface, and was absorbed.
pub fn trail() -> PhotonTrail {
    let place =
        |survival: f32, scattering| TrailPlace { point: Vec3::ZERO, flux: Rgb::splat(1e-3), survival, scattering };
    PhotonTrail {
        places: vec![
            place(1.0, Some(Scattering::Diffuse)),
            place(0.9, Some(Scattering::Specular)),
            place(0.7, Some(Scattering::Diffuse)),
            place(0.6, None),
        ],
        escape: None,
    }
}

pub fn gathered() -> Gathered {
    Gathered {
        normal: Vec3::Y,
        irradiance: Rgb::new(12.0, 6.0, 3.0),
        radius: 0.02,
        inside: 0.75,
        relative_error: 0.1,
        used: (0..100).collect(),
        rejected: vec![7, 8],
        ..Gathered::default()
    }
}

/// A stage that shows this view.
pub fn showing(view: View) -> Stage {
    Stage { look: Look { view, ..Look::default() }, ..Stage::default() }
}
