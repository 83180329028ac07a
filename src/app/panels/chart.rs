//! The convergence chart: one curve for each run on this scene, the one under way drawn thicker.

use super::widgets::{chip, combo};
use crate::app::action::Action;
use crate::app::chart::{Chart, Rest, descriptions};
use crate::app::format;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::choice::Choice;
use egui::{Color32, Label, RichText, ScrollArea, Ui, vec2};
use egui_plot::{
    GridInput, GridMark, HLine, HoverPosition, Line, LineStyle, Plot, PlotPoint, PlotPoints, uniform_grid_spacer,
};

/// Room below the stop limit, in powers of ten.
const BELOW_LIMIT: f64 = 0.2;
/// Lines over the work are at least this many of the plot's smallest steps apart, so that each has room for its number.
const LEAST_STEPS: f64 = 10.0;
/// Width of the legend.
const LEGEND_WIDTH: f32 = 52.0 * UNIT;

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let descriptions = descriptions(model.curves);
    let height = ui.available_height();
    ui.horizontal_top(|ui| {
        plot(ui, model, &descriptions, vec2(ui.available_width() - LEGEND_WIDTH - 3.0 * UNIT, height));
        ui.vertical(|ui| {
            axes(ui, model.chart, actions);
            legend(ui, model, &descriptions);
        });
    });
}

/// What is drawn over what.
fn axes(ui: &mut Ui, chart: Chart, actions: &mut Vec<Action>) {
    let (rest, response) = combo(ui, LEGEND_WIDTH - UNIT, chart.rest);
    response.accessible_name("What is left");
    let work = ui.horizontal(|ui| {
        ui.label("over");
        let (work, response) = combo(ui, ui.available_width() - UNIT, chart.work);
        response.accessible_name("Work");
        work
    });
    let work = work.inner;
    let chosen = Chart { rest: rest.unwrap_or(chart.rest), work: work.unwrap_or(chart.work) };
    if chosen != chart {
        actions.push(Action::SetChart(chosen));
    }
}

fn plot(ui: &mut Ui, model: &Model, descriptions: &[String], size: egui::Vec2) {
    let palette = Palette::of(ui.visuals());
    let chart = model.chart;
    let is_stopped_by = chart.rest == Rest::Unshot;
    let limit = model.settings.unshot_limit.log10();
    // What was moved by hand fits these axes alone.
    let plot = Plot::new(("convergence", chart.rest.name(), chart.work.name()))
        .width(size.x)
        .height(size.y)
        .show_background(false)
        .grid_color(ui.visuals().weak_text_color().gamma_multiply(0.6))
        .include_x(0.0)
        .include_y(0.0)
        .include_y(limit - BELOW_LIMIT)
        .allow_scroll(false)
        .y_axis_min_width(12.0 * UNIT)
        .x_grid_spacer(uniform_grid_spacer(|input| [round_step(LEAST_STEPS * input.base_step_size); 3]))
        .y_grid_spacer(decades)
        .y_axis_formatter(
            |mark, _| if is_power(mark) { format::percent_short(10_f64.powf(mark.value)) } else { String::new() },
        )
        .x_axis_formatter(move |mark, _| if mark.value < 0.0 { String::new() } else { chart.work.amount(mark.value) })
        .label_formatter(move |position| match position {
            HoverPosition::NearDataPoint { plot_name, position, .. } => Some(hover(chart, plot_name, *position)),
            HoverPosition::Elsewhere { .. } => None,
        });
    plot.show(ui, |plot| {
        if is_stopped_by {
            let style = LineStyle::dashed_loose();
            plot.hline(HLine::new("Stop limit", limit).color(palette.escaped).style(style).allow_hover(false));
        }
        for (i, (curve, description)) in model.curves.iter().zip(descriptions).enumerate() {
            let is_under_way = i + 1 == model.curves.len();
            let points: PlotPoints = curve.points.iter().filter_map(|point| chart.point(point)).collect();
            let line = Line::new(name(curve.number, description), points).id(curve.number);
            plot.line(line.color(color(palette, curve.number)).width(if is_under_way { 3.0 } else { 1.5 }));
        }
    });
}

/// The smallest of 1, 2 and 5 times a power of ten that is at least this.
fn round_step(least: f64) -> f64 {
    let power = 10_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0].map(|digit| digit * power).into_iter().find(|step| *step >= least).unwrap_or(10.0 * power)
}

/// Lines at every tenth, and faint ones at 2, 3, … 9 times that.
pub fn decades(input: GridInput) -> Vec<GridMark> {
    let (low, high) = (input.bounds.0.floor() as i32, input.bounds.1.ceil() as i32);
    let within = |value: f64| (input.bounds.0..=input.bounds.1).contains(&value);
    let marks = (low..=high).flat_map(|decade| {
        (1..10).map(move |digit| {
            let value = f64::from(decade) + f64::from(digit).log10();
            GridMark { value, step_size: if digit == 1 { 1.0 } else { 0.1 } }
        })
    });
    marks.filter(|mark| within(mark.value)).collect()
}

fn is_power(mark: GridMark) -> bool {
    mark.step_size == 1.0
}

fn hover(chart: Chart, name: &str, position: PlotPoint) -> String {
    format!("{name}\n{} after {}", format::percent(10_f64.powf(position.y)), chart.work.amount(position.x))
}

/// The runs, the newest first: it is the one that is looked at.
fn legend(ui: &mut Ui, model: &Model, descriptions: &[String]) {
    let palette = Palette::of(ui.visuals());
    ScrollArea::vertical().id_salt("runs").auto_shrink(false).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = UNIT;
        if model.curves.is_empty() {
            ui.label(RichText::new("Runs on this scene come here").weak());
        }
        for (curve, description) in model.curves.iter().zip(descriptions).rev() {
            ui.horizontal_top(|ui| {
                chip(ui, color(palette, curve.number));
                let name = name(curve.number, description);
                // What does not fit is told by the hover.
                ui.add(Label::new(RichText::new(&name).small()).truncate()).on_hover_text(name);
            });
        }
        if model.chart.rest == Rest::Unshot && !model.curves.is_empty() {
            let limit = format!("Stop limit {}", format::percent(model.settings.unshot_limit));
            ui.horizontal_top(|ui| {
                chip(ui, palette.escaped);
                ui.label(RichText::new(limit).small());
            });
        }
    });
}

/// What a run is called.
pub fn name(number: u32, description: &str) -> String {
    format!("{number} {description}")
}

/// A run keeps its colour as long as it is shown.
pub fn color(palette: Palette, number: u32) -> Color32 {
    palette.curves[(number as usize - 1) % palette.curves.len()]
}
