//! What keys ask for, and whom they belong to.

use super::key;
use super::stage::{LARGE, Stage};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use lightwell::app::action::{Action, CameraMove};
use lightwell::app::keys::of_view;
use lightwell::app::model::{Dialog, Look, PathPurpose};
use lightwell::choice::Choice;
use lightwell::solution::{CameraView, Judged};
use lightwell::viewport::View;
use lightwell::worker::{Command, Phase};

#[test]
fn space_runs_and_pauses() {
    assert_eq!(key(Stage::default(), Modifiers::NONE, Key::Space), [Action::Send(Command::Run)]);
    let running = Stage { phase: Phase::Running, ..Stage::default() };
    assert_eq!(key(running, Modifiers::NONE, Key::Space), [Action::Send(Command::Pause)]);
    assert_eq!(key(Stage::empty(), Modifiers::NONE, Key::Space), []);
}

#[test]
fn arrows_step() {
    let step = |modifiers| key(Stage::default(), modifiers, Key::ArrowRight);
    assert_eq!(step(Modifiers::NONE), [Action::Send(Command::Step(1))]);
    assert_eq!(step(Modifiers::SHIFT), [Action::Send(Command::Step(10))]);
    assert_eq!(step(Modifiers::COMMAND), [Action::Send(Command::Step(100))]);
}

#[test]
fn letters_and_digits_do_what_the_help_says() {
    let press = |pressed| key(Stage::default(), Modifiers::NONE, pressed);
    assert_eq!(press(Key::R), [Action::Send(Command::Reset)]);
    assert_eq!(press(Key::S), [Action::SavePictureNow]);
    assert_eq!(press(Key::F), [Action::Camera(CameraMove::Fit)]);
    let look = Look::default();
    assert_eq!(press(Key::W), [Action::SetLook(Look { wireframe: true, ..look })]);
    for &view in View::ALL {
        let shortcut = of_view(view);
        let pressed = key(Stage::default(), shortcut.modifiers, shortcut.logical_key);
        // One key for all errors: of what is shown.
        let is_error = matches!(view, View::Camera(CameraView::Error(_)));
        let view = if is_error { View::Camera(CameraView::Error(Judged::RadiositySpecular)) } else { view };
        assert_eq!(pressed, [Action::SetLook(Look { view, ..look })]);
    }
    assert_eq!(key(Stage::empty(), Modifiers::COMMAND, Key::O), [Action::BrowseForScene]);
}

#[test]
fn one_key_leads_to_the_error_of_what_is_shown_and_back() {
    for (view, judged, back) in [
        (View::Smooth, Judged::RadiositySpecular, View::Camera(CameraView::RadiositySpecular)),
        (View::Patches, Judged::Patches, View::Patches),
        (View::Photons, Judged::PhotonRadiance, View::Camera(CameraView::PhotonRadiance)),
        (View::Camera(CameraView::FinalGather), Judged::FinalGather, View::Camera(CameraView::FinalGather)),
    ] {
        let press = |view| {
            let look = Look { view, ..Look::default() };
            key(Stage { look, ..Stage::default() }, Modifiers::NONE, Key::X)
        };
        let error = View::Camera(CameraView::Error(judged));
        assert_eq!(press(view), [Action::SetLook(Look { view: error, ..Look::default() })]);
        assert_eq!(press(error), [Action::SetLook(Look { view: back, ..Look::default() })]);
    }
}

#[test]
fn a_digit_with_shift_is_told_by_its_place() {
    let mut harness = Stage::default().small();
    // As on a keyboard with English letters.
    harness.event(egui::Event::Key {
        key: Key::Exclamationmark,
        physical_key: Some(Key::Num1),
        pressed: true,
        repeat: false,
        modifiers: Modifiers::SHIFT,
    });
    harness.run();
    let view = View::Camera(CameraView::Caustics);
    assert_eq!(harness.state().actions, [Action::SetLook(Look { view, ..Look::default() })]);
}

#[test]
fn a_held_key_toggles_once() {
    let mut harness = Stage::default().small();
    for repeat in [false, true, true] {
        harness.event(egui::Event::Key {
            key: Key::W,
            physical_key: None,
            pressed: true,
            repeat,
            modifiers: Modifiers::NONE,
        });
    }
    harness.run();
    assert_eq!(harness.state().actions.len(), 1);
}

#[test]
fn keys_belong_to_a_field_while_it_is_edited() {
    let mut harness = Stage::default().window(LARGE);
    harness.get_by_label("Seed").click();
    harness.run();
    for pressed in [Key::Space, Key::R, Key::W, Key::Num1, Key::ArrowRight] {
        harness.key_press(pressed);
    }
    harness.run();
    assert_eq!(harness.state().actions, []);
}

#[test]
fn what_is_typed_with_the_enter_that_ends_it_stays_in_the_field() {
    let purpose = PathPurpose::OpenScene;
    let mut harness = Stage { dialog: Some(Dialog::Path { purpose, text: "a".into() }), ..Stage::default() }.small();
    let key =
        |key| egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers: Modifiers::NONE };
    let typed = [key(Key::O), egui::Event::Text("o".into()), key(Key::Enter)];
    harness.input_mut().events.extend(typed);
    harness.step();
    let dialog = Dialog::Path { purpose, text: "ao".into() };
    let opened = [Action::ShowDialog(dialog), Action::CloseDialog, Action::Open("ao".into())];
    assert_eq!(harness.state().actions, opened);
}
