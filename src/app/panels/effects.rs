//! Which effects of light the scene calls for, which are simulated, and what that costs and saves.

use super::widgets::figure_row;
use crate::app::action::Action;
use crate::app::effects::EffectFacts;
use crate::app::format;
use crate::app::model::Model;
use crate::app::theme::UNIT;
use crate::choice::Choice;
use crate::effects::{Switches, Verdict};
use crate::methods::Settings;
use crate::worker::Entry;
use egui::{Align, Button, Checkbox, Layout, RichText, Ui};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let Some(facts) = &model.effects else {
        ui.label(RichText::new("No scene is open").weak());
        return;
    };
    let advice = &facts.plan.advice;
    ui.label(format!("This scene suits {}.", advice.approach.label())).on_hover_text(&advice.reason);
    ui.add_space(UNIT);
    for verdict in &facts.plan.verdicts {
        row(ui, model.settings, facts, verdict, actions);
    }
    for part in &facts.plan.parts {
        ui.label(RichText::new(part).small().weak());
    }
    if model.settings.effects != Switches::default() {
        let button = ui.add(Button::new("As planned"));
        if button.on_hover_text("Simulates what the scene calls for, and nothing else").clicked() {
            actions.push(as_planned(model.settings));
        }
    }
}

/// Takes all switches back.
pub fn as_planned(settings: Settings) -> Action {
    Action::ApplySettings(Settings { effects: Switches::default(), ..settings })
}

fn row(ui: &mut Ui, settings: Settings, facts: &EffectFacts, verdict: &Verdict, actions: &mut Vec<Action>) {
    let entry = facts.entry(verdict.effect);
    let hover = hover(verdict, entry);
    figure_row(ui, &hover, |ui| {
        let mut is_on = entry.map_or(verdict.is_needed, |entry| entry.is_simulated);
        let checkbox = Checkbox::new(&mut is_on, verdict.effect.label());
        let response = ui.add_enabled(entry.is_some(), checkbox);
        if response.on_hover_text(&hover).on_disabled_hover_text(&hover).changed() {
            let effects = settings.effects.with(verdict.effect, is_on, facts.needed);
            actions.push(Action::ApplySettings(Settings { effects, ..settings }));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label(RichText::new(price(facts, verdict, entry)).weak());
        });
    });
}

/// What an effect cost, or skipping it saved.
fn price(facts: &EffectFacts, verdict: &Verdict, entry: Option<&Entry>) -> String {
    let need = if verdict.is_needed { "needed" } else { "not needed" };
    let rays = |rays: u64| format::short(rays as f64, "");
    let time = |seconds: f64| format::short(seconds, "s");
    match entry {
        Some(&Entry { is_simulated: true, spent, .. }) if spent > 0 => {
            format!("{} rays, ≈ {}", rays(spent), time(facts.seconds_spent(spent)))
        }
        Some(&Entry { is_simulated: false, saved, .. }) if saved > 0 => {
            format!("saved {} rays, ≈ {}", rays(saved), time(facts.seconds_saved(saved)))
        }
        _ => need.to_owned(),
    }
}

fn hover(verdict: &Verdict, entry: Option<&Entry>) -> String {
    let (need, consequence) = if verdict.is_needed {
        ("Needed", format!("Without it: {}", verdict.if_missed))
    } else {
        ("Not needed", format!("Skipping it saves: {}", verdict.saves))
    };
    let not_here =
        if entry.is_none() { "\nThis view does not tell it apart, so that it cannot be switched here." } else { "" };
    format!("{}. {need}. {}\n{consequence}{not_here}", verdict.effect.meaning(), verdict.reason)
}
