//! What stands between the person and the light, above the viewport, each with the way out of it.

use super::effects;
use super::icons::Icon;
use super::widgets::primary_button;
use crate::app::action::Action;
use crate::app::model::{Look, Model};
use crate::app::theme::{Palette, UNIT};
use crate::app::views::ViewGroup;
use crate::choice::Choice;
use crate::effects::Effect;
use crate::methods::{Settings, Solver};
use crate::viewport::View;
use crate::worker::{Command, LightKind, Phase};
use egui::{Align, Button, Layout, RichText, Ui};
use std::borrow::Cow;

/// One message and what can be done about it.
pub struct Banner<'a> {
    pub message: Cow<'a, str>,
    is_error: bool,
    /// The best one first.
    remedies: Vec<Remedy>,
}

/// A button that helps.
struct Remedy {
    name: &'static str,
    hover: &'static str,
    action: Action,
}

pub fn all<'a>(model: &Model<'a>) -> Vec<Banner<'a>> {
    let crash = (*model.phase == Phase::Crashed).then(|| Banner {
        message: model.error.unwrap_or("The solver stopped because of a fault in the program.").into(),
        is_error: true,
        remedies: vec![Remedy {
            name: "Restart solver",
            hover: "Starts afresh on the same scene; the light that was computed is lost",
            action: Action::Send(Command::Reset),
        }],
    });
    let error = model.error.filter(|_| crash.is_none()).map(|message| Banner {
        message: message.into(),
        is_error: true,
        remedies: vec![Remedy { name: "Dismiss", hover: "Takes this message away", action: Action::DismissError }],
    });
    let missing = model.missing.filter(|_| model.is_stuck()).map(|message| Banner {
        message: message.into(),
        is_error: false,
        remedies: remedy_for_view(model).into_iter().collect(),
    });
    [crash, error, dark(model), missing, left_out(model)].into_iter().flatten().collect()
}

/// Nothing emits. Views of ambient occlusion show such a scene as well as any other.
fn dark<'a>(model: &Model) -> Option<Banner<'a>> {
    let is_seen = ViewGroup::of(model.look.view) == ViewGroup::Occlusion;
    model.scene.filter(|scene| scene.is_dark() && !is_seen).map(|_| Banner {
        message: "Nothing in this scene emits light. Ambient occlusion shows it in an even light from everywhere."
            .into(),
        is_error: false,
        remedies: vec![
            Remedy {
                name: "Show ambient occlusion",
                hover: "Opens the views that need no emitter",
                action: Action::SetLook(Look { view: ViewGroup::Occlusion.first(), ..model.look }),
            },
            Remedy {
                name: "Add a ceiling light",
                hover: "Adds a rectangle of light below the ceiling, which is not in the file",
                action: Action::Send(Command::AddCeilingLight),
            },
        ],
    })
}

/// Effects that the scene calls for and somebody has switched off.
fn left_out<'a>(model: &Model) -> Option<Banner<'a>> {
    let facts = model.effects.as_ref()?;
    let missing = facts.missing();
    let names: Vec<_> = missing.iter().map(Effect::label).collect();
    let loss = facts.plan.verdicts.iter().find(|verdict| missing.contains(verdict.effect))?.if_missed;
    // One sentence for one effect; for more, their names.
    let loss = if names.len() == 1 { loss } else { "This is not what the scene looks like." };
    Some(Banner {
        message: format!("Left out: {}. {loss}", names.join(", ").to_lowercase()).into(),
        is_error: false,
        remedies: vec![Remedy {
            name: "As planned",
            hover: "Simulates what the scene calls for, and nothing else",
            action: effects::as_planned(model.settings),
        }],
    })
}

/// What brings a view that needs what is not there.
fn remedy_for_view(model: &Model) -> Option<Remedy> {
    match model.look.view {
        View::Bounces if model.settings.solver != Solver::Jacobi => Some(Remedy {
            name: "Use Jacobi",
            hover: "Chooses the solver that goes bounce by bounce, and starts the light over",
            action: Action::ApplySettings(Settings { solver: Solver::Jacobi, ..model.settings }),
        }),
        View::Bounces if model.can_run() && !model.is_running() => Some(Remedy {
            name: "Run",
            hover: "Builds the matrix and goes bounce by bounce",
            action: Action::Send(Command::Run),
        }),
        View::Bounces => None,
        View::FormFactors if model.solution.is_some() => {
            model.solution.and_then(|solution| solution.shooter).map(|shooter| Remedy {
                name: "Pick the shooter",
                hover: "Picks the patch that shot last",
                action: Action::PickPatch(shooter),
            })
        }
        View::Camera(view) if !view.needs_photons() && !view.needs_radiosity() => None,
        _ if model.can_run() && !model.is_running() => Some(Remedy {
            name: "Run",
            hover: match model.light() {
                Some(LightKind::Photons) => "Emits photons until all that are wanted are there",
                Some(LightKind::Occlusion) => "Looks for open sky from every vertex, until all rays are there",
                _ => "Spreads light until the stop limit is reached",
            },
            action: Action::Send(Command::Run),
        }),
        _ => None,
    }
}

pub fn show(ui: &mut Ui, banner: &Banner, actions: &mut Vec<Action>) {
    let palette = Palette::of(ui.visuals());
    let color = if banner.is_error { palette.error } else { palette.warning };
    ui.horizontal(|ui| {
        Icon::Warning.show(ui, color);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            for (place, remedy) in banner.remedies.iter().enumerate() {
                let is_plain = place > 0 || remedy.action == Action::DismissError;
                let button = if is_plain { Button::new(remedy.name) } else { primary_button(ui, remedy.name) };
                if ui.add(button).on_hover_text(remedy.hover).clicked() {
                    actions.push(remedy.action.clone());
                }
                ui.add_space(UNIT);
            }
            ui.with_layout(Layout::left_to_right(Align::Center).with_main_wrap(true), |ui| {
                ui.label(RichText::new(&*banner.message).color(color));
            });
        });
    });
}
