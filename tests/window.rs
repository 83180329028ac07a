//! The window without a graphics adapter: its panels, found by the labels that a screen reader reads, against a model
//! made up here.

#[path = "window/accuracy.rs"]
mod accuracy;
#[path = "window/crowds.rs"]
mod crowds;
#[path = "window/effects.rs"]
mod effects;
#[path = "window/equation.rs"]
mod equation;
#[path = "window/errors.rs"]
mod errors;
#[path = "window/keyboard.rs"]
mod keyboard;
#[path = "window/looking.rs"]
mod looking;
#[path = "window/occlusion.rs"]
mod occlusion;
#[path = "window/photons.rs"]
mod photons;
#[path = "window/props.rs"]
mod props;
#[path = "window/solvers.rs"]
mod solvers;
#[path = "window/stage.rs"]
mod stage;

use crowds::{crowds, texts};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Rect, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lightwell::app::action::{Action, CameraMove};
use lightwell::app::model::{Dialog, Look, Notice, PathPurpose};
use lightwell::app::views::ViewGroup;
use lightwell::app::{Explorer, theme};
use lightwell::choice::Choice;
use lightwell::methods::Settings;
use lightwell::scene::{FindingKind, Severity};
use lightwell::solution::CameraView;
use lightwell::viewport::{AdapterChoice, Gpu, View};
use lightwell::worker::{Command, Phase};
use props::{finding, solution};
use stage::{LARGE, SMALL, SMALLEST, Stage, showing};
use std::time::{Duration, Instant};

/// What one key asks for.
fn key(stage: Stage, modifiers: Modifiers, key: Key) -> Vec<Action> {
    let mut harness = stage.small();
    harness.key_press_modifiers(modifiers, key);
    harness.run();
    std::mem::take(&mut harness.state_mut().actions)
}

/// What a click on the control with this label asks for.
fn click(stage: Stage, label: &str) -> Vec<Action> {
    let mut harness = stage.small();
    harness.get_by_label(label).click();
    harness.run();
    std::mem::take(&mut harness.state_mut().actions)
}

/// A text as the window writes it, with a thin space for each `_`.
fn thin(text: &str) -> String {
    text.replace('_', "\u{2009}")
}

/// So long that only a program that will never answer takes longer, however busy the machine is.
const PATIENCE: Duration = Duration::from_secs(300);

/// Frames until one of them shows this label.
fn wait_for(harness: &mut Harness<Explorer>, label: &str) {
    let deadline = Instant::now() + PATIENCE;
    while harness.query_by_label(label).is_none() {
        assert!(Instant::now() < deadline, "`{label}` did not come on show");
        std::thread::sleep(Duration::from_millis(10));
        harness.step();
    }
}

/// The whole program, with its solver thread and its viewport: a scene comes on show, light spreads, the picture shows it.
#[test]
fn the_window_shows_the_light_of_a_scene() {
    if let Err(error) = Gpu::new(&AdapterChoice::Software) {
        assert!(std::env::var("REQUIRE_GPU").map_or(true, |value| value != "1"), "{error}");
        println!("skipped: {error}");
        return;
    }
    let builder = Harness::builder().with_size(SMALL).wgpu();
    let mut harness = builder.build_eframe(|context| Explorer::new(context, "furnace".to_owned(), None).unwrap());
    // The start page, which is shown until the scene comes, has its name, too.
    wait_for(&mut harness, &thin("Progress: 100.0_% unshot"));
    harness.get_by_label("furnace");
    let middle = harness.get_by_label("Viewport").rect().center();
    harness.key_press(Key::Space);
    wait_for(&mut harness, "Progress: Converged");
    let picture = harness.render().unwrap();
    let shown = picture.get_pixel(middle.x as u32, middle.y as u32).0;
    // Every surface of the furnace is grey and has a radiance of 2/π, which no tone curve shows darker than the background.
    assert!(shown[0] > 64 && shown[0] == shown[1] && shown[1] == shown[2], "{shown:?}");
}

#[test]
fn files_are_dropped_on_the_viewport() {
    #[derive(Debug)]
    struct Dropped;
    impl egui::DroppedFile for Dropped {
        fn path(&self) -> &std::path::Path {
            std::path::Path::new("/scenes/attic.obj")
        }
        fn bytes(&self) -> Result<Vec<u8>, String> {
            Err("only its path is asked for".into())
        }
    }
    let mut harness = Stage::default().small();
    harness.input_mut().hovered_files.push(egui::HoveredFile::default());
    harness.run_steps(2);
    harness.get_by_label("Drop to open");
    harness.input_mut().hovered_files.clear();
    harness.input_mut().dropped_files.push(std::sync::Arc::new(Dropped));
    harness.run();
    assert_eq!(harness.state().actions, [Action::Open("/scenes/attic.obj".to_owned())]);
    assert!(harness.query_by_label("Drop to open").is_none());
}

#[test]
fn the_mouse_moves_the_camera() {
    let mut harness = Stage::default().small();
    let center = harness.get_by_label("Viewport").rect().center();
    harness.drag_at(center);
    harness.hover_at(center + Vec2::new(60.0, 0.0));
    harness.run();
    assert!(matches!(harness.state().actions[..], [Action::Camera(CameraMove::Orbit(drag))] if drag.x > 0.0));
    harness.drop_at(center);
    harness.hover_at(center);
    harness.run();
    harness.state_mut().actions.clear();
    harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: Vec2::new(0.0, 1.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    harness.run();
    let zooms = |action: &Action| matches!(action, Action::Camera(CameraMove::Zoom(factor)) if *factor < 1.0);
    assert!(!harness.state().actions.is_empty() && harness.state().actions.iter().all(zooms));
}

#[test]
fn a_scene_that_is_read_is_named() {
    let phase = Phase::Loading("attic.obj".to_owned());
    let mut harness = Harness::builder()
        .with_size(SMALL)
        .with_context_setup(theme::install)
        .build_ui_state(|ui, stage: &mut Stage| stage.show(ui), Stage { phase, ..Stage::empty() });
    harness.step();
    harness.get_by_label("Opening attic.obj");
}

#[test]
fn the_transport_sends_commands() {
    assert_eq!(click(Stage::default(), "Run"), [Action::Send(Command::Run)]);
    assert_eq!(click(Stage::default(), "Step 1"), [Action::Send(Command::Step(1))]);
    assert_eq!(click(Stage::default(), "Step 10"), [Action::Send(Command::Step(10))]);
    assert_eq!(click(Stage::default(), "Step 100"), [Action::Send(Command::Step(100))]);
    assert_eq!(click(Stage::default(), "Reset"), [Action::Send(Command::Reset)]);
    let running = Stage { phase: Phase::Running, ..Stage::default() };
    assert_eq!(click(running, "Pause"), [Action::Send(Command::Pause)]);
}

#[test]
fn without_a_scene_there_is_nothing_to_run_but_something_to_open() {
    assert_eq!(click(Stage::empty(), "Run"), []);
    assert_eq!(click(Stage::empty(), "cornell-box"), [Action::Open("cornell-box".to_owned())]);
    assert_eq!(click(Stage::empty(), "Open…"), [Action::BrowseForScene]);
}

#[test]
fn the_view_bar_changes_the_look() {
    let look = Look::default();
    for &view in View::ALL {
        let first = ViewGroup::of(view).first();
        let mut harness = showing(first).small();
        harness.get_by_role_and_label(Role::Button, view.label()).click();
        harness.run();
        // One button for all errors.
        let is_error = matches!(view, View::Camera(CameraView::Error(_)));
        let view = if is_error { View::Camera(CameraView::Error(first.judged())) } else { view };
        assert_eq!(harness.state().actions, [Action::SetLook(Look { view, ..look })]);
    }
    for &group in ViewGroup::ALL {
        let other = ViewGroup::ALL.iter().find(|other| **other != group).expect("there are several").first();
        let chosen = [Action::SetLook(Look { view: group.first(), ..look })];
        let mut harness = showing(other).small();
        harness.get_by_role_and_label(Role::Button, group.label()).click();
        harness.run();
        assert_eq!(harness.state().actions, chosen);
        assert_eq!(click(showing(group.first()), group.label()), [], "it is on show");
    }
    for (toggle, wanted) in [
        ("Ambient", Look { ambient: true, ..look }),
        ("Wireframe", Look { wireframe: true, ..look }),
        ("Shooter", Look { show_shooter: false, ..look }),
    ] {
        let mut harness = Stage::default().small();
        harness.get_by_label("Show").click();
        harness.run();
        harness.get_by_label(toggle).click();
        harness.run();
        assert_eq!(harness.state().actions, [Action::SetLook(wanted)]);
    }
}

#[test]
fn recent_files_and_built_in_scenes_open_from_the_menu() {
    let mut harness = Stage::default().small();
    harness.get_by_label("File").click();
    harness.run();
    harness.get_by_label("Recent files").click();
    harness.run();
    harness.get_by_label("attic.obj").click();
    harness.run();
    assert_eq!(harness.state().actions, [Action::Open("/scenes/attic.obj".to_owned())]);
}

#[test]
fn the_ledger_shows_where_the_light_is() {
    let harness = Stage::default().small();
    for figure in ["10.0_W", "6.00_W", "60.0_%", "3.00_W", "30.0_%", "1.00_W", "10.0_%"] {
        harness.get_by_label(&thin(figure));
    }
    harness.get_by_label("0 W, closes");
    harness.get_by_label(&thin("Energy: Absorbed 60.0_%, Unshot 30.0_%, Escaped 10.0_%"));
    harness.get_by_label(&thin("mean 1.23_%, worst 7.00_%"));
}

#[test]
fn a_ledger_that_does_not_close_says_so() {
    let mut leaking = solution();
    leaking.energy.absorbed.x -= 0.03125;
    let harness = Stage { solution: Some(leaking), ..Stage::default() }.small();
    harness.get_by_label("3.1e−2 W, does not close");
}

#[test]
fn the_status_line_counts() {
    let harness = Stage::default().small();
    for figure in ["800 patches", "12_752 elements", "1_234 shots", "12.4_Mrays/s", "2.50_s", "30.0_% unshot"] {
        assert!(harness.query_all_by_label(&thin(figure)).next().is_some(), "{figure} is not shown");
    }
    harness.get_by_label(&thin("Progress: 30.0_% unshot"));
}

#[test]
fn findings_are_listed_with_what_was_done() {
    let findings = vec![finding(FindingKind::DegenerateFace, Severity::Warning)];
    let harness = Stage { findings, ..Stage::default() }.small();
    for text in ["Findings (1)", "object 'lamp', line 12", "the face has no area", "left out"] {
        harness.get_by_label(text);
    }
    assert!(harness.query_by_label("Add a ceiling light").is_none());
}

#[test]
fn a_dark_scene_is_offered_a_light_once() {
    let dark = vec![finding(FindingKind::NoEmitter, Severity::Warning)];
    let stage = || Stage { findings: dark.clone(), ..Stage::default() };
    assert_eq!(click(stage(), "Add a ceiling light"), [Action::Send(Command::AddCeilingLight)]);
    let mut lit = dark.clone();
    lit.push(finding(FindingKind::CeilingLightAdded, Severity::Note));
    let harness = Stage { findings: lit, ..Stage::default() }.small();
    assert!(harness.query_by_label("Add a ceiling light").is_none());
}

#[test]
fn a_crash_is_told_and_can_be_mended() {
    let error = Some("the solver stopped: index out of bounds".to_owned());
    let crashed = Stage { phase: Phase::Crashed, error, ..Stage::default() };
    assert_eq!(click(crashed, "Restart solver"), [Action::Send(Command::Reset)]);
    let error = Some("cannot read attic.obj".to_owned());
    assert_eq!(click(Stage { error, ..Stage::default() }, "Dismiss"), [Action::DismissError]);
}

#[test]
fn notices_can_be_dismissed() {
    let notice = Notice { id: 7, text: "Saved a.png".to_owned(), is_error: false, until: None };
    let actions = click(Stage { notices: vec![notice], ..Stage::default() }, "Dismiss message");
    assert_eq!(actions, [Action::DismissNotice(7)]);
}

#[test]
fn settings_take_effect_when_a_value_is_given() {
    let mut harness = Stage::default().small();
    harness.get_by_label("Automatic mesh").click();
    harness.run();
    let mut settings = Settings::default();
    settings.mesh.element_size = Some(0.0156);
    assert_eq!(harness.state().actions, [Action::ApplySettings(settings)]);
}

#[test]
fn a_slider_is_applied_when_it_is_let_go() {
    let mut harness = Stage::default().small();
    let rail =
        harness.get_all_by_label("Shadow rays").map(|node| node.rect()).max_by(|a, b| a.width().total_cmp(&b.width()));
    let at = rail.expect("the slider has a rail").center();
    harness.drag_at(at);
    harness.step();
    assert!(matches!(harness.state().actions.last(), Some(Action::EditSettings(_))), "{:?}", harness.state().actions);
    harness.drop_at(at);
    harness.step();
    assert!(matches!(harness.state().actions.last(), Some(Action::ApplySettings(_))), "{:?}", harness.state().actions);
}

#[test]
fn nothing_is_asked_for_while_nobody_does_anything() {
    for stage in [Stage::default(), Stage::empty()] {
        let mut harness = stage.small();
        harness.run();
        assert_eq!(harness.state().actions, []);
    }
}

#[test]
fn texts_lie_inside_the_window_and_apart_from_each_other() {
    for size in [SMALLEST, SMALL, LARGE] {
        for stage in crowds().into_iter().chain([Stage::default(), Stage::empty()]) {
            let harness = stage.window(size);
            let screen = Rect::from_min_size(egui::Pos2::ZERO, size);
            let texts = texts(&harness, size);
            assert!(texts.len() > 10, "only {} texts were found", texts.len());
            for (i, (text, rect)) in texts.iter().enumerate() {
                assert!(screen.contains_rect(*rect), "`{text}` lies at {rect:?} of {size}");
                for (other, other_rect) in &texts[..i] {
                    let shared = rect.intersect(*other_rect);
                    let overlaps = shared.width() > 1.0 && shared.height() > 1.0;
                    assert!(!overlaps, "`{text}` at {rect:?} covers `{other}` at {other_rect:?} in {size}");
                }
            }
        }
    }
}

#[test]
fn dialogs_fit_into_the_smallest_window() {
    for dialog in [Dialog::Keys, Dialog::About, Dialog::Matrix, Dialog::ItemBuffer] {
        let stage = Stage { dialog: Some(dialog.clone()), has_pictures: true, ..Stage::default() };
        let close = stage.window(SMALLEST).get_by_label("Close").rect();
        let screen = Rect::from_min_size(egui::Pos2::ZERO, SMALLEST);
        assert!(screen.contains_rect(close), "{dialog:?} ends at {close:?}");
    }
}

#[test]
fn dialogs_open_and_answer() {
    let about = Stage { dialog: Some(Dialog::About), ..Stage::default() };
    assert_eq!(click(about, "Close"), [Action::CloseDialog]);
    let keys = Stage { dialog: Some(Dialog::Keys), ..Stage::default() }.small();
    keys.get_by_label("Run or pause");
    let purpose = PathPurpose::OpenScene;
    let path = Stage { dialog: Some(Dialog::Path { purpose, text: "a.obj".into() }), ..Stage::default() };
    assert_eq!(click(path, "Open"), [Action::CloseDialog, Action::Open("a.obj".into())]);
}
