//! The list of effects: what it says, what it asks for, and what is told of what is missing.

use crate::stage::{Stage, showing};
use crate::thin;
use egui::Vec2;
use egui::accesskit::{Role, Toggled};
use egui_kittest::kittest::{NodeT, Queryable};
use lightwell::app::action::Action;
use lightwell::choice::Choice;
use lightwell::effects::{Effect, Effects, Switches};
use lightwell::methods::Settings;
use lightwell::viewport::View;
use lightwell::worker::Entry;

/// All of the side panel is in sight.
const TALL: Vec2 = Vec2::new(1280.0, 1600.0);

fn switched(effects: Switches) -> Action {
    Action::ApplySettings(Settings { effects, ..Settings::default() })
}

/// What a click on the checkbox of an effect asks for.
fn toggle(stage: Stage, effect: Effect) -> Vec<Action> {
    let mut harness = stage.window(TALL);
    harness.get_by_role_and_label(Role::CheckBox, effect.label()).click();
    harness.run();
    std::mem::take(&mut harness.state_mut().actions)
}

/// Shadows, which the scene calls for, are not simulated.
fn without_shadows() -> Stage {
    let mut stage = Stage::default();
    stage.settings.effects.off = Effects::of(&[Effect::Shadows]);
    stage.effects[1] = Entry { effect: Effect::Shadows, is_simulated: false, spent: 0, saved: 40_000_000 };
    stage
}

#[test]
fn effects_have_switches_where_the_view_tells_them_apart() {
    let harness = Stage::default().window(TALL);
    for &effect in Effect::ALL {
        let checkbox = harness.get_by_role_and_label(Role::CheckBox, effect.label());
        let node = checkbox.accesskit_node();
        let entry = Stage::default().effects.iter().any(|entry| entry.effect == effect);
        assert_eq!(node.is_disabled(), !entry, "{effect:?}");
        assert_eq!(node.toggled(), Some(if entry { Toggled::True } else { Toggled::False }), "{effect:?}");
    }
    harness.get_by_label("This scene suits radiosity.");
    // 29.4 million rays of 50 ns.
    harness.get_by_label(&thin("29.4_M rays, ≈ 1.47_s"));
}

#[test]
fn an_effect_is_left_out_and_taken_back() {
    let off = Switches { off: Effects::of(&[Effect::Escape]), ..Switches::default() };
    assert_eq!(toggle(Stage::default(), Effect::Escape), [switched(off)]);
    assert_eq!(toggle(without_shadows(), Effect::Shadows), [switched(Switches::default())]);
}

#[test]
fn an_effect_that_is_not_needed_is_forced_and_taken_back() {
    let stage = |is_simulated| {
        let mut stage = Stage::default();
        stage.effects.push(Entry { effect: Effect::Caustics, is_simulated, spent: 0, saved: 0 });
        stage
    };
    let forced = Switches { forced: Effects::of(&[Effect::Caustics]), ..Switches::default() };
    assert_eq!(toggle(stage(false), Effect::Caustics), [switched(forced)]);
    let mut with = stage(true);
    with.settings.effects = forced;
    assert_eq!(toggle(with, Effect::Caustics), [switched(Switches::default())]);
}

#[test]
fn what_is_missing_is_told_with_a_way_back() {
    let text = "Left out: shadows. Light would shine through whatever stands in its way.";
    without_shadows().window(TALL).get_by_label(text);
    assert!(Stage::default().window(TALL).query_by_label(text).is_none());
    // What the view does not tell apart is not missing from it.
    let mut other = without_shadows();
    other.effects.clear();
    assert!(other.window(TALL).query_by_label(text).is_none());
    let harness = without_shadows().window(TALL);
    assert_eq!(harness.get_all_by_label("As planned").count(), 2, "above the view and below the list");
    for button in 0..2 {
        let mut harness = without_shadows().window(TALL);
        harness.get_all_by_label("As planned").nth(button).expect("two of them").click();
        harness.run();
        assert_eq!(harness.state().actions, [switched(Switches::default())]);
    }
    without_shadows().window(TALL).get_by_label(&thin("saved 40_M rays, ≈ 2_s"));
}

#[test]
fn nothing_is_said_of_effects_where_no_scene_is_open() {
    let stage = Stage { is_open: false, ..showing(View::Smooth) };
    assert!(stage.window(TALL).query_by_label("Direct light").is_none());
}
