//! Run, step and reset, and how far the light has come.

use super::widgets::{outline, primary_button, with_key};
use crate::app::action::Action;
use crate::app::format;
use crate::app::keys;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::worker::{Command, Phase};
use egui::accesskit::Role;
use egui::{Align2, Button, FontId, Rect, Response, Sense, Ui, WidgetInfo, pos2, vec2};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.add_enabled_ui(model.can_run(), |ui| {
            run_button(ui, model, actions);
            ui.add_space(2.0 * UNIT);
            step_buttons(ui, actions);
        });
        ui.add_space(2.0 * UNIT);
        ui.add_enabled_ui(model.scene.is_some(), |ui| {
            let hover = with_key(ui, "Starts over from the emitters, paused", Some(&keys::RESET));
            if ui.button("⟲ Reset").accessible_name("Reset").on_hover_text(hover).clicked() {
                actions.push(Action::Send(Command::Reset));
            }
        });
        ui.add_space(4.0 * UNIT);
        progress(ui, model);
    });
}

fn run_button(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let (text, name, hover) = if model.is_running() {
        ("⏸ Pause", "Pause", "Stops after the present shot")
    } else {
        ("▶ Run", "Run", "Shoots light until the stop limit is reached")
    };
    let button = if model.is_running() { Button::new(text) } else { primary_button(ui, text) };
    let response = ui
        .add(button.min_size(vec2(24.0 * UNIT, ui.spacing().interact_size.y)))
        .accessible_name(name)
        .on_hover_text(with_key(ui, hover, Some(&keys::RUN)));
    if response.clicked() {
        actions.push(keys::run_or_pause(model));
    }
}

fn step_buttons(ui: &mut Ui, actions: &mut Vec<Action>) {
    ui.label("Step");
    ui.spacing_mut().item_spacing.x = UNIT;
    let steps = [(1, keys::STEP_1), (10, keys::STEP_10), (100, keys::STEP_100)];
    for (shots, shortcut) in steps {
        let button = Button::new(shots.to_string()).min_size(ui.spacing().interact_size);
        let hover = with_key(ui, &format!("Does {}, then pauses", format::counted(shots, "shot")), Some(&shortcut));
        if ui.add(button).accessible_name(format!("Step {shots}")).on_hover_text(hover).clicked() {
            actions.push(Action::Send(Command::Step(shots)));
        }
    }
}

/// A bar of the flux that has been shot, with a tick at every tenth of what is left.
fn progress(ui: &mut Ui, model: &Model) -> Response {
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let text = progress_text(model);
    response.widget_info(|| WidgetInfo::labeled(Role::ProgressIndicator, true, format!("Progress: {text}")));
    if ui.is_rect_visible(rect) {
        paint_progress(ui, rect, model, &text);
    }
    response.on_hover_text(format!(
        "How much of the emitted light is still unshot, on a logarithmic scale from all of it down to the stop limit \
         of {}",
        format::percent(model.settings.unshot_limit)
    ))
}

fn progress_text(model: &Model) -> String {
    match (model.phase, model.solution) {
        (Phase::Loading(_), _) => "Loading".to_owned(),
        (_, None) => String::new(),
        (_, Some(solution)) if solution.converged => "Converged".to_owned(),
        (_, Some(solution)) => format!("{} unshot", format::percent(solution.energy.unshot_share())),
    }
}

fn paint_progress(ui: &Ui, rect: Rect, model: &Model, text: &str) {
    let palette = Palette::of(ui.visuals());
    let painter = ui.painter_at(rect);
    let text_width = 26.0 * UNIT;
    let bar = Rect::from_min_max(
        pos2(rect.left(), rect.center().y - UNIT),
        pos2((rect.right() - text_width).max(rect.left()), rect.center().y + UNIT),
    );
    painter.rect_filled(bar, UNIT, ui.visuals().widgets.inactive.bg_fill);
    let filled = bar.with_max_x(bar.left() + bar.width() * model.progress());
    painter.rect_filled(filled, UNIT, palette.accent);

    let decades = -model.settings.unshot_limit.log10();
    for decade in 1..decades.ceil() as u32 {
        let x = bar.left() + bar.width() * (f64::from(decade) / decades) as f32;
        painter.vline(x, bar.bottom() + 2.0..=bar.bottom() + 2.0 + UNIT, outline(ui));
    }
    let color = ui.visuals().text_color();
    painter.text(rect.right_center(), Align2::RIGHT_CENTER, text, FontId::proportional(14.0), color);
}
