//! The chart of errors over time, and looking for settings that suit a wish.

use super::props::tracks;
use super::stage::{LARGE, SMALL, SMALLEST, Stage, WORLD};
use super::{click, key};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use lightwell::accuracy::{Error, Truth};
use lightwell::app::action::Action;
use lightwell::app::model::{LowerPanel, Theme};
use lightwell::app::wish::Wish;
use lightwell::methods::Settings;
use lightwell::study::{Answer, Choice, Measured, Prediction, Price, Question, Recipe, State, Study, Way};
use std::sync::Arc;
use std::time::Duration;

fn opened() -> Stage {
    let truth = Truth { paths: 4_096, irradiance: Vec::new(), mean: 1.0, floor: 0.004 };
    Stage { lower: Some(LowerPanel::Accuracy), tracks: tracks(), truth: Some(truth), ..Stage::default() }
}

fn answered(state: State) -> Option<Answer> {
    Some(Answer { question: Question::Error(0.05), state })
}

fn found(rms: f64) -> Option<Answer> {
    let error = Error { rms, uncertainty: 0.001, upper: rms + 0.0017, floor: 0.01, noise: None };
    let recipe = Recipe { way: Way::PhotonMap, settings: Settings::default() };
    let prediction = Prediction { error: None, seconds: None };
    answered(State::Found(Arc::new(Choice { recipe, error, seconds: 0.5, prediction })))
}

#[test]
fn the_panel_opens_and_closes_by_tab_and_key() {
    let open = [Action::ShowLowerPanel(Some(LowerPanel::Accuracy))];
    assert_eq!(click(Stage::default(), "Accuracy"), open);
    assert_eq!(key(Stage::default(), Modifiers::NONE, Key::P), open);
    assert_eq!(key(opened(), Modifiers::NONE, Key::P), [Action::ShowLowerPanel(None)]);
}

/// 0.03 + 0.01 / 2.56 is 3.39 %, and 0.1 / 1.6 is 6.25 %; noise falls with −1/2.
#[test]
fn each_run_has_its_error_and_its_slope_and_a_click_brings_its_settings_back() {
    let window = opened().window(LARGE);
    window.get_by_label("1 Progressive: 3.39\u{2009}%, slope −0.28");
    window.get_by_label("2 200\u{2009}k photons: 6.25\u{2009}%, slope −0.50");
    window.get_by_label("Reference: 4.1\u{2009}k paths a point, 0.40\u{2009}%");
    let settings = tracks()[1].settings;
    assert_eq!(
        click(opened(), "2 200\u{2009}k photons: 6.25\u{2009}%, slope −0.50"),
        [Action::ApplySettings(settings)]
    );
}

#[test]
fn wishes_are_asked_for_by_buttons_and_answered_in_words() {
    assert_eq!(click(opened(), "Reach it"), [Action::Inquire(Question::Error(0.05))]);
    let wish = Wish { error: 0.02, seconds: 3.0 };
    let stage = Stage { wish, ..opened() };
    assert_eq!(click(stage, "Use it"), [Action::Inquire(Question::Time(Duration::from_secs(3)))]);
    let busy = Stage { answer: answered(State::Doing("3 of 9: Radiosity".to_owned())), ..opened() };
    assert_eq!(click(busy, "Stop"), [Action::StopInquiry]);
    let kept = Stage { answer: found(0.045), ..opened() }.window(LARGE);
    kept.get_by_label_contains("error target met: error 4.50\u{2009}% ± 0.1\u{2009}% in 500\u{2009}ms by Photon map");
    let missed = Stage { answer: found(0.06), ..opened() }.window(LARGE);
    missed.get_by_label_contains("target missed: 6.0 % > 5.0 %: error 6.00\u{2009}% ±");
    let failed = Stage { answer: answered(State::Failed("a fault of the program".to_owned())), ..opened() };
    failed.window(LARGE).get_by_label("It stopped: a fault of the program");
}

#[test]
fn a_study_shows_what_each_way_comes_to() {
    let measured = |run: usize, way, seconds, rms| Measured {
        run,
        recipe: Recipe { way, settings: Settings::default() },
        is_finished: true,
        price: Price { seconds, ..Price::default() },
        error: Error { rms, ..Error::default() },
    };
    let study = Study {
        measured: vec![
            measured(0, Way::Radiosity, 0.1, 0.2),
            measured(0, Way::Radiosity, 0.5, 0.05),
            measured(1, Way::Reference, 0.2, 0.08),
            measured(1, Way::Reference, 0.8, 0.04),
        ],
        front: vec![0, 2, 1, 3],
        slopes: vec![(Way::Reference, -0.5)],
        ..Study::default()
    };
    let window = Stage { answer: answered(State::Studied(Arc::new(study))), ..opened() }.window(LARGE);
    window.get_by_label("Radiosity: 5.00\u{2009}% at best");
    window.get_by_label("Path tracing: 4.00\u{2009}% at best, slope −0.50");
    assert!(window.query_by_label_contains("Photon map:").is_none());
}

/// Of the light on show alone.
#[test]
fn the_status_line_has_the_error_of_what_is_on_show() {
    let window = Stage { tracks: tracks(), ..Stage::default() }.window(LARGE);
    window.get_by_label("error 3.39\u{2009}%");
    assert!(window.query_by_label("error 6.25\u{2009}%").is_none());
}

#[test]
fn nothing_is_cut_in_any_size_and_theme() {
    assert!(WORLD.census.light_may_arrive);
    for size in [SMALLEST, SMALL, LARGE] {
        for theme in [Theme::Dark, Theme::Light] {
            let window = Stage { theme, ..opened() }.window(size);
            for label in ["Reach it", "Use it", "Study"] {
                let rect = window.get_by_label(label).rect();
                assert!(rect.right() <= size.x - 300.0 && rect.width() > 20.0, "{label} {rect:?} in {size}");
            }
        }
    }
}
