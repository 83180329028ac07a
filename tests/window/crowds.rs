//! Windows with as much in them as can be, and where their texts are.

use super::equation::equation;
use super::props::{checks, curves, finding, gathered, image, patch, photons, solution, trail};
use super::stage::{ADAPTER, Stage};
use egui::{Rect, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::NodeT;
use lightwell::app::model::{Look, LowerPanel, Notice};
use lightwell::methods::{FormFactorMethod, Settings, Solver};
use lightwell::scene::{FindingKind, Severity};
use lightwell::solution::{CameraImage, CameraView, Counters, Solution};
use lightwell::viewport::{PhotonColour, PhotonLook, View};
use std::sync::Arc;
use std::time::Duration;

/// Height of the status line.
const STATUS_LINE: f32 = 32.0;
/// Height of a line of small text.
const SMALL_TEXT: f32 = 14.5;

/// The widest figures that can come up: watts of a large scene, many rays, a long run; a patch is picked.
fn crowded() -> Stage {
    let mut solution = solution();
    solution.steps = 1_234_567;
    solution.elapsed = Duration::from_secs(7_500);
    solution.counters =
        Counters { rays: 987_654_321_012, clamped: 123_456_789, near_field: 123_456_789, ..Counters::default() };
    let findings = vec![finding(FindingKind::DegenerateFace, Severity::Warning); 20];
    let error = Some("cannot read a scene with a long name in a folder with an even longer name: no such file".into());
    let notices =
        vec![Notice { id: 0, text: "Saved lightwell-cornell-box-1.png".into(), is_error: false, until: None }];
    Stage { solution: Some(solution), findings, error, notices, patch: Some(patch()), ..Stage::default() }
}

/// Windows with as much in them as can be, each with something else below the viewport.
pub fn crowds() -> Vec<Stage> {
    let building = Solution { preparation: Some(0.43), bounces: vec![Arc::default(); 33], ..solution() };
    let look = Look { view: View::Bounces, ..Look::default() };
    let gather = CameraView::FinalGather;
    let settings = Settings { solver: Solver::GaussSeidel, form_factor: FormFactorMethod::Rays, ..Settings::default() };
    vec![
        crowded(),
        Stage { lower: Some(LowerPanel::Equation), equation: Some(equation()), ..crowded() },
        Stage { lower: Some(LowerPanel::Convergence), curves: curves(), ..crowded() },
        Stage { lower: Some(LowerPanel::HardCases), checks: Some(checks(false)), ..crowded() },
        Stage { solution: Some(building), look, settings, ..Stage::default() },
        crowded_photons(),
        Stage {
            image: Some(CameraImage { rays: 987_654_321_012, elapsed: Duration::from_secs(7_500), ..image(gather) }),
            missing: Some("This picture is read off photons, and there are none yet: press Run"),
            look: Look { view: View::Camera(gather), ..Look::default() },
            ..crowded_photons()
        },
    ]
}

/// Many photons, two of everything picked, a pattern that is none.
fn crowded_photons() -> Stage {
    let mut photons = photons();
    photons.counters.emitted = 48_765_432;
    photons.counters.caustic_emitted = 48_765_432;
    photons.counters.caustic_stored = 8_765_432;
    photons.counters.rays = 987_654_321_012;
    let mut settings = Settings::default();
    settings.photons.is_progressive = true;
    let photon_look = PhotonLook { colour: PhotonColour::Path, ..PhotonLook::default() };
    Stage {
        photons: Some(photons),
        trail: Some(trail()),
        gathered: Some(gathered()),
        filter_draft: Some("LD(E".to_owned()),
        settings,
        look: Look { view: View::KdTree, photons: photon_look, ..Look::default() },
        ..Stage::default()
    }
}

/// Every text on show and where it is, without what has to be scrolled to.
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
        // A list above the status line shows its last row in part, or only the space above its text. The status line is
        // written small.
        let is_in_list = min.y < size.y - STATUS_LINE || rect.height() > SMALL_TEXT;
        let is_scrolled_away = rect.bottom() > size.y - STATUS_LINE && (is_in_side_panel || is_in_list);
        (!is_scrolled_away).then_some((text, rect))
    };
    nodes.filter_map(text).collect()
}
