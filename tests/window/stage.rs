//! A model made up for the panels, without a worker or a graphics adapter, and the window that shows it.

use egui::{Rect, TextureHandle, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT;
use lightwell::app::action::Action;
use lightwell::app::chart::Chart;
use lightwell::app::diagrams::MatrixTexture;
use lightwell::app::model::{Dialog, FrameTime, Look, LowerPanel, Model, Notice, SceneFacts, Theme};
use lightwell::app::patch::PatchFacts;
use lightwell::app::{panels, theme};
use lightwell::math::rgb::Rgb64;
use lightwell::methods::Settings;
use lightwell::scene::{Finding, FindingKind, Severity};
use lightwell::solution::{Closure, Counters, Energy, Solution};
use lightwell::viewport::Legend;
use lightwell::worker::{CheckReport, Curve, Phase};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// What a model borrows, and the wishes that came of it.
pub struct Stage {
    pub phase: Phase,
    pub is_open: bool,
    pub findings: Vec<Finding>,
    pub solution: Option<Solution>,
    pub settings: Settings,
    pub error: Option<String>,
    pub look: Look,
    pub theme: Theme,
    pub lower: Option<LowerPanel>,
    pub chart: Chart,
    pub missing: Option<&'static str>,
    pub legend: Option<Legend>,
    pub matrix: Option<MatrixTexture>,
    pub item_buffer: Option<TextureHandle>,
    pub checks: Option<CheckReport>,
    pub patch: Option<PatchFacts<'static>>,
    pub curves: Vec<Arc<Curve>>,
    pub notices: Vec<Notice>,
    pub dialog: Option<Dialog>,
    pub recent: Vec<PathBuf>,
    pub actions: Vec<Action>,
}

impl Default for Stage {
    /// A scene is open, and some of its light is shot.
    fn default() -> Self {
        Self {
            phase: Phase::Paused,
            is_open: true,
            findings: Vec::new(),
            solution: Some(solution()),
            settings: Settings::default(),
            error: None,
            look: Look::default(),
            theme: Theme::Dark,
            lower: None,
            chart: Chart::default(),
            missing: None,
            legend: None,
            matrix: None,
            item_buffer: None,
            checks: None,
            patch: None,
            curves: Vec::new(),
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
            solution: self.solution.as_ref(),
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
            matrix: self.matrix.as_ref(),
            item_buffer: self.item_buffer.as_ref(),
            checks: self.checks.as_ref(),
            patch: self.patch,
            curves: &self.curves,
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

const ADAPTER: &str = "llvmpipe (LLVM 15.0.6, 256 bits) (vulkan)";

/// Height of the status line.
const STATUS_LINE: f32 = 32.0;

/// 10 W emitted, of which 6 W are absorbed, 3 W unshot and 1 W escaped.
pub fn solution() -> Solution {
    let watts = |red: f64| Rgb64::new(red, 0.0, 0.0);
    Solution {
        steps: 1_234,
        elapsed: Duration::from_millis(2_500),
        converged: false,
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

/// The widest figures that can come up: watts of a large scene, many rays, a long run.
pub fn crowded() -> Stage {
    let mut solution = solution();
    solution.steps = 1_234_567;
    solution.elapsed = Duration::from_secs(7_500);
    solution.counters.rays = 987_654_321_012;
    let findings = vec![finding(FindingKind::DegenerateFace, Severity::Warning); 20];
    let error = Some("cannot read a scene with a long name in a folder with an even longer name: no such file".into());
    let notices =
        vec![Notice { id: 0, text: "Saved lightwell-cornell-box-1.png".into(), is_error: false, until: None }];
    Stage { solution: Some(solution), findings, error, notices, ..Stage::default() }
}

/// Every text on show and where it is, without the part of the side panel that has to be scrolled to.
pub fn texts(harness: &Harness<Stage>, size: Vec2) -> Vec<(String, Rect)> {
    let nodes = harness.root().children_recursive();
    let text = |node: egui_kittest::Node| {
        let accesskit_node = node.accesskit_node();
        let bounds = accesskit_node.bounding_box()?;
        let min = egui::pos2(bounds.x0 as f32, bounds.y0 as f32);
        let rect = Rect::from_min_max(min, egui::pos2(bounds.x1 as f32, bounds.y1 as f32));
        let is_label = accesskit_node.role() == egui::accesskit::Role::Label;
        let text = accesskit_node.value().filter(|text| is_label && !text.is_empty())?;
        let is_in_side_panel = min.x > size.x - 320.0 && min.y > 80.0 && text != ADAPTER;
        let is_scrolled_away = is_in_side_panel && rect.bottom() > size.y - STATUS_LINE;
        (!is_scrolled_away).then_some((text, rect))
    };
    nodes.filter_map(text).collect()
}
