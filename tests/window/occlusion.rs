//! Ambient occlusion on the mesh, and scenes that nothing else would show.

use super::props::{finding, image};
use super::stage::{LARGE, Stage, showing};
use super::{click, key, thin};
use egui::accesskit::{Role, Toggled};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use lightwell::app::action::Action;
use lightwell::app::model::Look;
use lightwell::app::views::ViewGroup;
use lightwell::methods::{ImageSettings, Settings};
use lightwell::scene::{FindingKind, Severity};
use lightwell::solution::{CameraView, VertexShares};
use lightwell::viewport::colour_map::ColourMap;
use lightwell::viewport::{Legend, View};
use lightwell::worker::{Command, Phase};
use std::sync::Arc;
use std::time::Duration;

/// After 4 rounds and 1.5 s.
fn shares() -> VertexShares {
    VertexShares {
        shares: Arc::new(vec![0.5; 1234]),
        rounds: 4,
        batches: 8,
        rays: 3_000_000,
        elapsed: Duration::from_millis(1_500),
        is_complete: false,
    }
}

fn stage() -> Stage {
    Stage { occlusion: Some(shares()), effects: Vec::new(), ..showing(View::OcclusionVertices) }
}

fn dark(view: View) -> Stage {
    Stage { findings: vec![finding(FindingKind::NoEmitter, Severity::Warning)], solution: None, ..showing(view) }
}

#[test]
fn it_is_told_how_far_it_has_come_and_what_that_cost() {
    let harness = stage().window(LARGE);
    harness.get_by_role_and_label(Role::ProgressIndicator, "Progress: 4 of 16 rounds");
    for figure in ["1_234", "4", "3_M", "1.50_s", "2.00_Mrays/s", "4 rounds"] {
        assert!(harness.query_all_by_label(&thin(figure)).next().is_some(), "{figure}");
    }
    for absent in ["Emitted", "Automatic exposure", "Paths", "Solver"] {
        let labels = harness.query_all_by_role_and_label(Role::Label, absent);
        assert_eq!(labels.count(), 0, "{absent}");
    }
    let harness = Stage { occlusion: None, ..stage() }.window(LARGE);
    harness.get_by_label("No rays yet");
}

#[test]
fn it_runs_steps_and_pauses() {
    assert_eq!(click(stage(), "Run"), [Action::Send(Command::Run)]);
    assert_eq!(click(stage(), "Step 10"), [Action::Send(Command::Step(10))]);
    let running = Stage { phase: Phase::Running, ..stage() };
    assert_eq!(click(running, "Pause"), [Action::Send(Command::Pause)]);
    assert_eq!(key(stage(), Modifiers::NONE, Key::Escape), [], "nothing is picked");
    // No emitter is needed.
    let in_the_dark = Stage { occlusion: Some(shares()), ..dark(View::OcclusionVertices) };
    assert_eq!(click(in_the_dark, "Run"), [Action::Send(Command::Run)]);
    assert_eq!(click(dark(View::Smooth), "Run"), []);
}

#[test]
fn its_rounds_are_a_setting() {
    let mut harness = stage().window(LARGE);
    let field = harness.get_all_by_label("Rounds").find(|node| node.accesskit_node().role() == Role::SpinButton);
    field.expect("a number beside a slider").focus();
    harness.run();
    harness.key_press(Key::ArrowUp);
    harness.run();
    let settings = Settings::default();
    let more = |action: &Action| {
        let Action::ApplySettings(Settings { image: ImageSettings { samples, .. }, .. }) = action else { return false };
        *samples > settings.image.samples
    };
    assert!(harness.state().actions.iter().any(more), "{:?}", harness.state().actions);
}

#[test]
fn a_scene_without_an_emitter_is_shown_by_it_or_gets_a_light() {
    let view = ViewGroup::Occlusion.first();
    let open = [Action::SetLook(Look { view, ..Look::default() })];
    assert_eq!(click(dark(View::Smooth), "Show ambient occlusion"), open);
    assert_eq!(click(dark(View::Smooth), "Add a ceiling light"), [Action::Send(Command::AddCeilingLight)]);
    for view in ViewGroup::Occlusion.views() {
        let harness = dark(view).window(LARGE);
        assert!(harness.query_by_label("Show ambient occlusion").is_none(), "{view:?} shows it");
    }
    // The other way is in the menu, for dark scenes alone.
    for (stage, is_offered) in [(dark(View::OcclusionVertices), true), (stage(), false)] {
        let mut harness = stage.window(LARGE);
        harness.get_by_label("File").click();
        harness.run();
        let entry = harness.get_by_label("Add a ceiling light");
        assert_eq!(!entry.accesskit_node().is_disabled(), is_offered);
        assert_ne!(entry.accesskit_node().toggled(), Some(Toggled::True));
    }
}

#[test]
fn a_comparison_has_a_legend_or_says_that_there_is_nothing_to_compare() {
    let view = CameraView::AmbientMinusIndirect;
    let compared = || Stage { image: Some(image(view)), ..showing(View::Camera(view)) };
    let legend = Legend {
        title: "Ambient occlusion less indirect light",
        unit: "",
        low: -0.5,
        high: 0.5,
        is_logarithmic: false,
        map: ColourMap::Diverging,
        ticks: vec![-0.5, 0.0, 0.5],
    };
    let harness = Stage { legend: Some(legend), ..compared() }.window(LARGE);
    harness.get_by_label("Legend: Ambient occlusion less indirect light");
    for (label, is_shown) in [("AO rays", true), ("Samples", true), ("Paths", false), ("Automatic exposure", false)] {
        assert_eq!(harness.query_all_by_label(label).next().is_some(), is_shown, "{label}");
    }
    let missing = Some("There is nothing to compare");
    let harness = Stage { missing, ..compared() }.window(LARGE);
    harness.get_by_label("There is nothing to compare");
    // A picture that is on its way is no news.
    let harness = Stage { missing, image: None, ..compared() }.window(LARGE);
    assert!(harness.query_by_label("There is nothing to compare").is_none());
}
