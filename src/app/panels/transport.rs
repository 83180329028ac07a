//! Run, step and reset, and how far the light has come.

use super::icons::Icon;
use super::widgets::with_key;
use crate::app::action::Action;
use crate::app::format;
use crate::app::keys;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::math::rgb::Rgb64;
use crate::solution::Solution;
use crate::worker::{Command, Phase};
use egui::accesskit::Role;
use egui::{
    Align2, Atom, Button, FontId, IdSalt, Painter, Rect, Response, RichText, Sense, Ui, WidgetInfo, pos2, vec2,
};

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        ui.add_enabled_ui(model.can_run(), |ui| {
            run_button(ui, model, actions);
            ui.add_space(2.0 * UNIT);
            step_buttons(ui, model, actions);
        });
        ui.add_space(2.0 * UNIT);
        ui.add_enabled_ui(model.scene.is_some(), |ui| {
            let hover = with_key(ui, "Starts over from the emitters, paused", Some(&keys::RESET));
            if ui.button("Reset").on_hover_text(hover).clicked() {
                actions.push(Action::Send(Command::Reset));
            }
        });
        ui.add_space(4.0 * UNIT);
        progress(ui, model);
    });
}

fn run_button(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let palette = Palette::of(ui.visuals());
    let (icon, name, hover, color) = if model.is_running() {
        let hover = format!("Stops before the next {}", model.step_name());
        (Icon::Pause, "Pause", hover, ui.visuals().text_color())
    } else {
        (Icon::Run, "Run", "Spreads light until the stop limit is reached".to_owned(), palette.on_accent)
    };
    let icon_place = IdSalt::new("icon");
    let place = Atom::custom(icon_place, vec2(Icon::SIZE, Icon::SIZE));
    let mut button = Button::new((place, RichText::new(name).color(color)));
    if !model.is_running() {
        button = button.fill(palette.accent);
    }
    let button = button.min_size(vec2(24.0 * UNIT, ui.spacing().interact_size.y)).atom_ui(ui);
    if let Some(rect) = button.rect(icon_place) {
        icon.paint(ui.painter(), rect, color);
    }
    if button.response.on_hover_text(with_key(ui, &hover, Some(&keys::RUN))).clicked() {
        actions.push(keys::run_or_pause(model));
    }
}

fn step_buttons(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ui.label("Step");
    ui.spacing_mut().item_spacing.x = UNIT;
    let steps = [(1, keys::STEP_1), (10, keys::STEP_10), (100, keys::STEP_100)];
    for (steps, shortcut) in steps {
        let button = Button::new(steps.to_string()).min_size(ui.spacing().interact_size);
        let sentence = format!("Does {}, then pauses", format::counted(steps, model.step_name()));
        let hover = with_key(ui, &sentence, Some(&shortcut));
        if ui.add(button).accessible_name(format!("Step {steps}")).on_hover_text(hover).clicked() {
            actions.push(Action::Send(Command::Step(steps)));
        }
    }
}

/// A bar of the flux that has been shot, with a tick at every tenth of what is left; while a matrix is built, how much
/// of it there is.
fn progress(ui: &mut Ui, model: &Model) -> Response {
    let size = vec2(ui.available_width(), ui.spacing().interact_size.y);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let text = progress_text(model);
    response.widget_info(|| WidgetInfo::labeled(Role::ProgressIndicator, true, format!("Progress: {text}")));
    if ui.is_rect_visible(rect) {
        paint_progress(ui, rect, model, text);
    }
    response.on_hover_text(if model.preparation().is_some() {
        "How much of the matrix of form factors is there. The first light moves when it is whole.".to_owned()
    } else {
        format!(
            "How much of the emitted light is still unshot, on a logarithmic scale from all of it down to the stop \
             limit of {}",
            format::percent(model.settings.unshot_limit)
        )
    })
}

fn progress_text(model: &Model) -> String {
    match (model.phase, model.solution) {
        (Phase::Loading(_), _) => "Loading".to_owned(),
        (_, None) => String::new(),
        (_, Some(solution)) => solution_text(solution),
    }
}

fn solution_text(solution: &Solution) -> String {
    match solution.preparation {
        Some(share) => format!("Building matrix {}", format::percent_whole(share)),
        None if solution.energy.emitted == Rgb64::ZERO => "No light".to_owned(),
        None if solution.converged => "Converged".to_owned(),
        None => format!("{} unshot", format::percent(solution.unshot_share)),
    }
}

fn paint_progress(ui: &Ui, rect: Rect, model: &Model, text: String) {
    let palette = Palette::of(ui.visuals());
    let painter = ui.painter_at(rect);
    let galley = painter.layout_no_wrap(text, FontId::proportional(14.0), ui.visuals().text_color());
    let text_width = (galley.size().x + 3.0 * UNIT).max(28.0 * UNIT);
    let bar = Rect::from_min_max(
        pos2(rect.left(), rect.top() + UNIT),
        pos2((rect.right() - text_width).max(rect.left()), rect.top() + 3.0 * UNIT),
    );
    painter.rect_filled(bar, UNIT, ui.visuals().widgets.inactive.bg_fill);
    let (filled, color) = match model.preparation() {
        Some(share) => (share, palette.absorbed),
        None => (model.progress(), palette.accent),
    };
    painter.rect_filled(bar.with_max_x(bar.left() + bar.width() * filled), UNIT, color);
    if model.preparation().is_none() {
        ticks(ui, &painter, bar, model.settings.unshot_limit);
    }
    let place = Align2::RIGHT_CENTER.anchor_size(pos2(rect.right(), rect.center().y), galley.size());
    painter.galley(place.min, galley, ui.visuals().text_color());
}

/// A tick below the bar at each tenth of what is left, from 100 % at its left end to the limit at its right end.
fn ticks(ui: &Ui, painter: &Painter, bar: Rect, limit: f64) {
    let color = ui.visuals().weak_text_color();
    let decades = -limit.log10();
    let label = |x: f32, align: Align2, share: f64| {
        painter.text(
            pos2(x, bar.bottom() + 2.0),
            align,
            format::percent_short(share),
            FontId::proportional(10.0),
            color,
        );
    };
    label(bar.left(), Align2::LEFT_TOP, 1.0);
    label(bar.right(), Align2::RIGHT_TOP, limit);
    for decade in (1..).take_while(|&decade| f64::from(decade) < decades - 0.3) {
        let x = bar.left() + bar.width() * (f64::from(decade) / decades) as f32;
        label(x, Align2::CENTER_TOP, 10_f64.powi(-decade));
    }
}
