//! Solvers, form factors, their settings, and how runs converge.

use super::props::{curves, solution};
use super::stage::{LARGE, Stage};
use super::{click, key, thin};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use lightwell::app::action::Action;
use lightwell::app::chart::{Chart, Rest, Work};
use lightwell::app::model::{Look, LowerPanel};
use lightwell::methods::{FormFactorMethod, Settings, Solver};
use lightwell::solution::Solution;
use lightwell::viewport::View;
use lightwell::worker::{Command, Phase};
use std::sync::Arc;

/// What choosing an entry of a box that drops down asks for.
fn choose(stage: Stage, label: &str, entry: &str) -> Vec<Action> {
    let mut harness = stage.window(LARGE);
    harness.get_by_role_and_label(Role::ComboBox, label).click();
    harness.run();
    harness.get_by_role_and_label(Role::Button, entry).click();
    harness.run();
    std::mem::take(&mut harness.state_mut().actions)
}

fn with_settings(settings: Settings) -> Stage {
    Stage { settings, ..Stage::default() }
}

#[test]
fn solver_and_form_factors_are_chosen_from_boxes() {
    let settings = Settings::default();
    let jacobi = Settings { solver: Solver::Jacobi, ..settings };
    assert_eq!(choose(Stage::default(), "Solver", "Jacobi"), [Action::ApplySettings(jacobi)]);
    assert_eq!(choose(Stage::default(), "Solver", "Progressive"), []);
    let hemicube = Settings { form_factor: FormFactorMethod::Hemicube, ..settings };
    assert_eq!(choose(Stage::default(), "Form factors", "Hemicube"), [Action::ApplySettings(hemicube)]);
}

#[test]
fn only_the_settings_that_the_choice_uses_are_shown() {
    for (form_factor, shown) in [
        (FormFactorMethod::Centroid, "Shadow rays"),
        (FormFactorMethod::Disc, "Shadow rays"),
        (FormFactorMethod::Polygon, "Shadow rays"),
        (FormFactorMethod::Rays, "Light rays"),
        (FormFactorMethod::Hemicube, "Resolution"),
    ] {
        let harness = with_settings(Settings { form_factor, ..Settings::default() }).small();
        for label in ["Shadow rays", "Light rays", "Resolution"] {
            let is_shown = harness.query_all_by_label(label).next().is_some();
            assert_eq!(is_shown, label == shown, "{label} with {form_factor:?}");
        }
    }
    for solver in [Solver::Progressive, Solver::Jacobi] {
        let harness = with_settings(Settings { solver, ..Settings::default() }).small();
        let is_shown = harness.query_by_role_and_label(Role::CheckBox, "Overshoot").is_some();
        assert_eq!(is_shown, solver == Solver::Progressive);
    }
}

#[test]
fn elements_along_a_patch_are_chosen_from_a_few() {
    let mut settings = Settings::default();
    settings.mesh.elements_per_patch_edge = 8;
    assert_eq!(click(Stage::default(), "8"), [Action::ApplySettings(settings)]);
}

#[test]
fn the_words_fit_the_solver() {
    for (solver, expected) in [(Solver::Jacobi, "1_234 sweeps"), (Solver::Southwell, "1_234 shots")] {
        with_settings(Settings { solver, ..Settings::default() }).small().get_by_label(&thin(expected));
    }
    let building = Solution { preparation: Some(0.437), ..solution() };
    let harness = Stage { solution: Some(building), ..Stage::default() }.small();
    harness.get_by_label(&thin("Progress: Building matrix 43_%"));
}

#[test]
fn light_that_overshoot_has_lent_is_told() {
    let mut lent = solution();
    lent.energy.absorbed.x = 9.5;
    lent.energy.unshot.x = -0.5;
    let harness = Stage { solution: Some(lent), ..Stage::default() }.small();
    harness.get_by_label(&thin("Energy: Absorbed 95.0_%, Unshot −5.00_%, Escaped 10.0_%"));
    harness.get_by_label("0 W, closes");
}

#[test]
fn what_a_form_factor_could_not_do_is_told_where_it_came_up() {
    let mut broken = solution();
    broken.counters.clamped = 1_500;
    broken.counters.near_field = 12;
    let harness = Stage { solution: Some(broken), ..Stage::default() }.small();
    harness.get_by_label(&thin("The centroid estimate broke down on 1_500 pairs"));
    harness.get_by_label("12 pairs");
    assert!(Stage::default().small().query_by_label("Near field").is_none());
}

#[test]
fn the_chart_opens_and_closes_by_tab_and_key() {
    let open = [Action::ShowLowerPanel(Some(LowerPanel::Convergence))];
    assert_eq!(click(Stage::default(), "Convergence"), open);
    assert_eq!(key(Stage::default(), Modifiers::NONE, Key::C), open);
    let shown = || Stage { lower: Some(LowerPanel::Convergence), ..Stage::default() };
    assert_eq!(click(shown(), "Convergence"), [Action::ShowLowerPanel(None)]);
    assert_eq!(key(shown(), Modifiers::NONE, Key::C), [Action::ShowLowerPanel(None)]);
}

#[test]
fn the_axes_of_the_chart_can_be_chosen() {
    let shown = || Stage { lower: Some(LowerPanel::Convergence), curves: curves(), ..Stage::default() };
    let chart = Chart { work: Work::Rays, ..Chart::default() };
    assert_eq!(choose(shown(), "Work", "Rays"), [Action::SetChart(chart)]);
    let chart = Chart { rest: Rest::Missing, ..Chart::default() };
    assert_eq!(choose(shown(), "What is left", "Missing light, estimated"), [Action::SetChart(chart)]);
}

#[test]
fn the_chart_names_its_runs_and_the_stop_limit() {
    let harness = Stage { lower: Some(LowerPanel::Convergence), curves: curves(), ..Stage::default() }.small();
    for run in ["1 Progressive", "2 Jacobi", "3 Gauss-Seidel", &thin("Stop limit 0.10_%")] {
        harness.get_by_label(run);
    }
    let chart = Chart { rest: Rest::Missing, ..Chart::default() };
    let lower = Some(LowerPanel::Convergence);
    let harness = Stage { lower, chart, curves: curves(), ..Stage::default() }.small();
    assert!(harness.query_by_label(&thin("Stop limit 0.10_%")).is_none(), "it is about unshot light");
}

/// Bounces 0 to 3 are there, 2 is on show.
fn bounces() -> Stage {
    let solution = Solution { bounces: vec![Arc::default(); 4], ..solution() };
    let look = Look { view: View::Bounces, bounce: 2, ..Look::default() };
    Stage { look, solution: Some(solution), ..Stage::default() }
}

#[test]
fn bounces_are_looked_at_one_by_one() {
    let shows = |bounce| vec![Action::SetLook(Look { view: View::Bounces, bounce, ..Look::default() })];
    assert_eq!(click(bounces(), "One bounce more"), shows(3));
    assert_eq!(click(bounces(), "One bounce less"), shows(1));
    assert_eq!(key(bounces(), Modifiers::NONE, Key::Comma), shows(1));
    assert_eq!(key(bounces(), Modifiers::NONE, Key::Period), shows(3));
    let mut at_end = bounces();
    at_end.look.bounce = 9;
    assert_eq!(key(at_end, Modifiers::NONE, Key::Period), []);
    assert_eq!(key(Stage::default(), Modifiers::NONE, Key::Period), []);
    assert!(Stage::default().small().query_by_label("One bounce more").is_none());
}

#[test]
fn a_view_that_lacks_something_says_what_to_do() {
    let missing = Some("bounces are missing");
    let look = Look { view: View::Bounces, ..Look::default() };
    let stage = || Stage { missing, look, ..Stage::default() };
    stage().small().get_by_label("bounces are missing");
    let jacobi = Settings { solver: Solver::Jacobi, ..Settings::default() };
    assert_eq!(click(stage(), "Use Jacobi"), [Action::ApplySettings(jacobi)]);
    let chosen = Stage { settings: jacobi, ..stage() }.small();
    assert!(chosen.query_by_label("Use Jacobi").is_none());
    assert_eq!(chosen.query_all_by_label("Run").count(), 2, "the transport's and the banner's");
    let look = Look { view: View::FormFactors, ..Look::default() };
    let solution = Some(Solution { shooter: Some(17), ..solution() });
    let pick = [Action::PickPatch(17)];
    assert_eq!(click(Stage { missing, look, solution, ..Stage::default() }, "Pick the shooter"), pick);
}

#[test]
fn a_run_in_preparation_can_be_paused() {
    let solution = Some(Solution { preparation: Some(0.1), ..solution() });
    let stage = Stage { solution, phase: Phase::Running, ..Stage::default() };
    assert_eq!(click(stage, "Pause"), [Action::Send(Command::Pause)]);
}
