//! The picked patch, diagrams and the hard cases.

use super::props::{checks, patch};
use super::stage::Stage;
use super::{click, key, thin};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Vec2};
use egui_kittest::kittest::Queryable;
use lightwell::app::action::Action;
use lightwell::app::model::{Dialog, LowerPanel};
use lightwell::hard_cases::cases;
use lightwell::methods::{Settings, Solver};
use lightwell::viewport::colour_map::{ColourMap, colour};
use lightwell::viewport::{Legend, View};
use lightwell::worker::Command;

fn picked() -> Stage {
    Stage { patch: Some(patch()), has_pictures: true, ..Stage::default() }
}

#[test]
fn a_click_picks_what_is_under_it_and_a_drag_does_not() {
    let mut harness = Stage::default().small();
    let rect = harness.get_by_label("Viewport").rect();
    harness.get_by_label("Viewport").click();
    harness.run();
    assert!(matches!(harness.state().actions[..], [Action::Pick(at)] if (at - Vec2::splat(0.5)).length() < 0.01));
    harness.state_mut().actions.clear();
    harness.drag_at(rect.center());
    harness.step();
    harness.hover_at(rect.center() + Vec2::new(50.0, 0.0));
    harness.step();
    harness.drop_at(rect.center() + Vec2::new(50.0, 0.0));
    harness.run();
    assert!(harness.state().actions.iter().all(|action| matches!(action, Action::Camera(_))));
}

#[test]
fn a_picked_patch_is_described_and_can_be_forgotten() {
    let harness = picked().small();
    for text in ["Patch 42", "white", "0.0123_m²", "0.725 0.710 0.680", "12.0 6.0 3.0_W/m²", "98.0_%", "2.00_%"] {
        harness.get_by_label(&thin(text));
    }
    let forget = [Action::Unpick];
    assert_eq!(click(picked(), "Forget patch"), forget);
    assert_eq!(key(picked(), Modifiers::NONE, Key::Escape), forget);
    assert_eq!(key(Stage::default(), Modifiers::NONE, Key::Escape), []);
    assert_eq!(click(picked(), "Enlarge"), [Action::ShowDialog(Dialog::ItemBuffer)]);
    let enlarged = Stage { dialog: Some(Dialog::ItemBuffer), ..picked() }.small();
    enlarged.get_by_role_and_label(Role::Image, "The item buffer, large");
}

#[test]
fn the_matrix_is_explained() {
    assert_eq!(key(Stage::default(), Modifiers::NONE, Key::M), [Action::ShowDialog(Dialog::Matrix)]);
    let harness = Stage { dialog: Some(Dialog::Matrix), has_pictures: true, ..Stage::default() }.small();
    harness.get_by_role_and_label(Role::Image, "The matrix as a picture");
    for text in ["Same plane", "Faces away", "Occluded", "Not zero", &thin("30.0_%"), "Legend: Form factor"] {
        assert!(harness.query_all_by_label(text).next().is_some(), "{text}");
    }
}

#[test]
fn where_there_is_no_matrix_the_way_to_one_is_offered() {
    let without = |solver| {
        let settings = Settings { solver, ..Settings::default() };
        Stage { dialog: Some(Dialog::Matrix), settings, ..Stage::default() }
    };
    for solver in [Solver::Jacobi, Solver::GaussSeidel, Solver::Southwell] {
        let settings = Settings { solver, ..Settings::default() };
        let name = format!("Use {}", lightwell::choice::Choice::label(solver));
        assert_eq!(click(without(Solver::Progressive), &name), [Action::ApplySettings(settings)]);
    }
    assert_eq!(click(without(Solver::Jacobi), "Do the first step"), [Action::Send(Command::Step(1))]);
}

#[test]
fn false_colours_have_a_legend() {
    let legend = Legend {
        title: "Form factor",
        unit: "",
        low: 1e-6,
        high: 1e-2,
        is_logarithmic: true,
        map: ColourMap::Sequential,
        ticks: vec![1e-4, 1e-2],
    };
    assert_eq!(legend.colour(1e-2), colour(1.0));
    let mut stage = Stage { legend: Some(legend), ..Stage::default() };
    stage.look.view = View::FormFactors;
    stage.small().get_by_label("Legend: Form factor");
}

#[test]
fn hard_cases_are_listed_run_and_opened() {
    let shown = |checks| Stage { lower: Some(LowerPanel::HardCases), checks, ..Stage::default() };
    assert_eq!(key(Stage::default(), Modifiers::NONE, Key::K), [Action::ShowLowerPanel(Some(LowerPanel::HardCases))]);
    assert_eq!(click(shown(None), "Run all"), [Action::RunChecks]);
    let first = cases().next().expect("there are hard cases").name;
    assert_eq!(click(shown(None), first), [Action::ShowCase(first)]);
    let harness = shown(Some(checks(false))).small();
    harness.get_by_label(&format!("1 pass, 1 fail, 1 known limit; running {first}"));
    for text in ["holds", "fails", "is a limit", "0.199825", "3.16206e−3", "exact"] {
        assert!(harness.query_all_by_label(text).next().is_some(), "{text}");
    }
    assert_eq!(click(shown(Some(checks(false))), "Run all"), [], "one run at a time");
    assert_eq!(click(shown(Some(checks(true))), "Run all"), [Action::RunChecks]);
}
