//! Error over solver time, both by their logarithms: one curve for each run on this scene, and what is wanted.

use super::chart::{color, decades, name};
use super::widgets::chip;
use crate::accuracy::{Offer, exponent, slope_at_end};
use crate::app::action::Action;
use crate::app::chart::descriptions_of_tracks;
use crate::app::format;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::app::wish::Wish;
use crate::choice::Choice as _;
use crate::cli::picture::{TargetMet, TargetsMet};
use crate::methods::Settings;
use crate::study::{Answer, Choice, Measured, Question, State, Study, Way};
use crate::worker::{Track, TrackPoint};
use egui::{Button, Color32, DragValue, Label, RichText, ScrollArea, Sense, Ui, Vec2, vec2};
use egui_plot::{
    GridMark, HLine, HoverPosition, ItemId, Line, LineStyle, Plot, PlotPoints, PlotUi, Points, Polygon, VLine,
};
use std::sync::Arc;
use std::time::Duration;

/// Width of the legend.
const LEGEND_WIDTH: f32 = 76.0 * UNIT;
/// What is on show before anything was measured: seconds and errors as powers of ten.
const SECONDS: [f64; 2] = [-2.0, 1.0];
const ERRORS: [f64; 2] = [-2.0, 0.0];
/// How long a study from the window takes.
const STUDY: Duration = Duration::from_secs(60);

/// What is wanted, and the buttons that look for it.
fn controls(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let Wish { mut error, mut seconds } = model.wish;
    ui.horizontal(|ui| {
        ui.label("Error up to");
        let percent = DragValue::from_get_set(|new| {
            error = new.map_or(error, |percent| percent / 100.0);
            100.0 * error
        });
        ui.add(percent.range(0.1..=100.0).speed(0.1).suffix(" %"))
            .on_hover_text("The error that is wanted, as a share of the mean irradiance: the horizontal line");
        let hover = "Look for the cheapest method and settings with at most this error, and run them";
        ask(ui, model, "Reach it", hover, Question::Error(error), actions);
        let hover = "Try all ways on this scene for a minute, and draw what each costs";
        ask(ui, model, "Study", hover, Question::Study(STUDY), actions);
    });
    ui.horizontal(|ui| {
        ui.label("Time up to");
        ui.add(DragValue::new(&mut seconds).range(0.1..=3600.0).speed(0.1).suffix(" s"))
            .on_hover_text("The time allowed: the vertical line");
        let hover = "Look for the most accurate method and settings in this time, and run them";
        ask(ui, model, "Use it", hover, Question::Time(Duration::from_secs_f64(seconds)), actions);
    });
    let wish = Wish { error, seconds };
    if wish != model.wish {
        actions.push(Action::SetWish(wish));
    }
    if let Some(answer) = model.inquiry {
        ui.horizontal(|ui| tell(ui, answer, actions));
    }
}

/// A button that asks a question about the open scene.
fn ask(ui: &mut Ui, model: &Model, label: &str, hover: &str, question: Question, actions: &mut Vec<Action>) {
    let is_asking = model.inquiry.is_some_and(Answer::is_awaited);
    let can_ask = model.scene.is_some_and(|scene| !scene.is_dark()) && !is_asking;
    if ui.add_enabled(can_ask, Button::new(label)).on_hover_text(hover).clicked() {
        actions.push(Action::Inquire(question));
    }
}

/// How far an answer is, or what it is.
fn tell(ui: &mut Ui, answer: &Answer, actions: &mut Vec<Action>) {
    let text = match &answer.state {
        State::Doing(doing) => {
            if ui.button("Stop").clicked() {
                actions.push(Action::StopInquiry);
            }
            doing.clone()
        }
        State::Found(choice) => in_words(answer.question, choice),
        State::Studied(_) => "Studied: runs, and the front that none beats".to_owned(),
        State::Dark => "No light arrives at any surface: there is no error to measure".to_owned(),
        State::Failed(reason) => format!("It stopped: {reason}"),
    };
    ui.add(Label::new(RichText::new(&text).small()).truncate()).on_hover_text(text);
}

/// What came of it, and whether that is what was wanted.
fn in_words(question: Question, choice: &Choice) -> String {
    let Choice { recipe, error, seconds, .. } = choice;
    let targets = TargetsMet {
        error: question.error().map(|wanted| TargetMet::of_error(wanted, error)),
        time: question.time().map(|allowed| TargetMet::of_time(allowed, *seconds)),
    };
    let error = error.in_words_by(format::percent, format::percent_short);
    format!("{}: error {error} in {} by {}", targets.in_words(), format::si(*seconds, "s"), recipe.label())
}

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let descriptions = descriptions_of_tracks(model.tracks);
    let height = ui.available_height();
    ui.horizontal_top(|ui| {
        plot(ui, model, &descriptions, vec2(ui.available_width() - LEGEND_WIDTH - 3.0 * UNIT, height), actions);
        ui.vertical(|ui| {
            controls(ui, model, actions);
            legend(ui, model, &descriptions, actions);
        });
    });
}

fn plot(ui: &mut Ui, model: &Model, descriptions: &[String], size: Vec2, actions: &mut Vec<Action>) {
    let palette = Palette::of(ui.visuals());
    let strong = ui.visuals().strong_text_color();
    let range = range(model);
    let is_power = |mark: GridMark| mark.step_size == 1.0;
    let plot =
        Plot::new("errors over time")
            .width(size.x)
            .height(size.y)
            .show_background(false)
            .grid_color(ui.visuals().weak_text_color().gamma_multiply(0.6))
            .include_x(range[0][0])
            .include_x(range[1][0])
            .include_y(range[0][1])
            .include_y(range[1][1])
            .allow_scroll(false)
            .y_axis_min_width(12.0 * UNIT)
            .x_grid_spacer(decades)
            .y_grid_spacer(decades)
            .x_axis_formatter(
                move |mark, _| {
                    if is_power(mark) { format::short(10_f64.powf(mark.value), "s") } else { String::new() }
                },
            )
            .y_axis_formatter(move |mark, _| {
                if is_power(mark) { format::percent_short(10_f64.powf(mark.value)) } else { String::new() }
            })
            .label_formatter(|position| match position {
                HoverPosition::NearDataPoint { plot_name, position, .. } => {
                    let [seconds, error] = [position.x, position.y].map(|power| 10_f64.powf(power));
                    Some(format!("{plot_name}\n{} after {}", format::percent(error), format::si(seconds, "s")))
                }
                HoverPosition::Elsewhere { .. } => None,
            });
    let shown = plot.show(ui, |plot| {
        floor(plot, model, range, palette);
        wish(plot, model.wish, palette);
        if let Some(study) = study(model) {
            studied(plot, study, palette, strong);
        }
        for (index, (track, description)) in model.tracks.iter().zip(descriptions).enumerate() {
            let points: Vec<[f64; 2]> = track.points.iter().filter_map(logarithms).collect();
            let is_last = index + 1 == model.tracks.len();
            let (name, color) = (name(track.number, description), color(palette, track.number));
            let line = Line::new(&name, PlotPoints::from(points.clone())).id(track.number).color(color);
            plot.line(line.width(if is_last { 3.0 } else { 1.5 }));
            plot.points(Points::new(name, points).id((track.number, "points")).color(color).radius(2.5));
        }
    });
    if shown.response.clicked()
        && let Some(settings) = shown.hovered_plot_item.and_then(|item| settings_of(item, model))
    {
        actions.push(Action::ApplySettings(settings));
    }
}

/// Those of the run that an item of the plot is of.
fn settings_of(item: ItemId, model: &Model) -> Option<Settings> {
    let is_of_track =
        |track: &&Arc<Track>| [ItemId::new(track.number), ItemId::new((track.number, "points"))].contains(&item);
    let of_track = model.tracks.iter().find(is_of_track).map(|track| track.settings);
    let of_study = || {
        let measured = &study(model)?.measured;
        let last = measured.iter().rfind(|measured| run_ids(measured).map(ItemId::new).contains(&item))?;
        let Settings { seed, effects, .. } = model.settings;
        Some(Settings { seed, effects, ..last.recipe.settings })
    };
    of_track.or_else(of_study)
}

/// Of the line and of the dots of a run of a study.
fn run_ids(measured: &Measured) -> [(&'static str, usize); 2] {
    ["line of a study", "dots of a study"].map(|part| (part, measured.run))
}

/// The corners of what is on show, as powers of ten: whole ones, so that they rest while runs go on.
fn range(model: &Model) -> [[f64; 2]; 2] {
    let [mut least, mut most] = [[SECONDS[0], ERRORS[0]], [SECONDS[1], ERRORS[1]]];
    let of_study = study(model).into_iter().flat_map(|study| &study.measured).filter_map(place);
    let of_tracks = model.tracks.iter().flat_map(|track| &track.points).filter_map(logarithms);
    for at in of_tracks.chain(of_study) {
        for axis in 0..2 {
            least[axis] = least[axis].min(at[axis].floor());
            most[axis] = most[axis].max(at[axis].ceil());
        }
    }
    [least, most]
}

/// The band in which the reference's own error is, and little can be told.
fn floor(plot: &mut PlotUi<'_>, model: &Model, range: [[f64; 2]; 2], palette: Palette) {
    let Some(floor) = model.truth.map(|truth| truth.floor).filter(|floor| floor.is_finite() && *floor > 0.0) else {
        return;
    };
    let [[left, low], [right, top]] = range;
    let high = floor.log10().clamp(low, top);
    let band = PlotPoints::from(vec![[left, low], [right, low], [right, high], [left, high]]);
    let color = palette.escaped.gamma_multiply(0.15);
    plot.add(Polygon::new("The reference's own error", band).fill_color(color).stroke((0.0, color)).allow_hover(false));
}

fn wish(plot: &mut PlotUi<'_>, wish: Wish, palette: Palette) {
    let style = LineStyle::dashed_loose();
    let (error, seconds) = (wish.error.log10(), wish.seconds.log10());
    plot.hline(HLine::new("Wanted error", error).color(palette.accent).style(style).allow_hover(false));
    plot.vline(VLine::new("Time allowed", seconds).color(palette.accent).style(style).allow_hover(false));
}

/// The study of this scene, if there was one.
fn study<'a>(model: &Model<'a>) -> Option<&'a Study> {
    match model.inquiry {
        Some(Answer { state: State::Studied(study), .. }) => Some(study),
        _ => None,
    }
}

/// All runs of a study, and those that no other beats.
fn studied(plot: &mut PlotUi<'_>, study: &Study, palette: Palette, strong: Color32) {
    for run in study.measured.chunk_by(|one, next| one.run == next.run) {
        let places: Vec<[f64; 2]> = run.iter().filter_map(place).collect();
        let (name, color) = (run[run.len() - 1].recipe.label(), of_way(run[0].recipe.way, palette));
        let [line, dots] = run_ids(&run[0]);
        plot.line(Line::new(&name, places.clone()).id(line).color(color.gamma_multiply(0.5)).width(1.0));
        plot.points(Points::new(name, places).id(dots).color(color).radius(2.0));
    }
    let front: Vec<[f64; 2]> = study.front.iter().filter_map(|&index| place(&study.measured[index])).collect();
    plot.line(Line::new("The front", front).color(strong).width(2.5).allow_hover(false));
}

fn of_way(way: Way, palette: Palette) -> Color32 {
    let index = Way::ALL.iter().position(|other| *other == way).unwrap_or_default();
    palette.curves[index % palette.curves.len()]
}

fn place(measured: &Measured) -> Option<[f64; 2]> {
    powers(measured.price.seconds, measured.error.rms)
}

fn logarithms(point: &TrackPoint) -> Option<[f64; 2]> {
    powers(point.seconds, point.error.rms)
}

/// Both as powers of ten, where they have one.
fn powers(seconds: f64, error: f64) -> Option<[f64; 2]> {
    (seconds > 0.0 && error > 0.0).then(|| [seconds.log10(), error.log10()])
}

/// The runs, the newest first; a click brings the settings of one back.
fn legend(ui: &mut Ui, model: &Model, descriptions: &[String], actions: &mut Vec<Action>) {
    let palette = Palette::of(ui.visuals());
    ScrollArea::vertical().id_salt("measured runs").auto_shrink(false).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = UNIT;
        if model.tracks.is_empty() && study(model).is_none() {
            ui.label(RichText::new(without_runs(model)).weak());
        }
        for (track, description) in model.tracks.iter().zip(descriptions).rev() {
            ui.horizontal_top(|ui| {
                chip(ui, color(palette, track.number));
                let text = format!("{}: {}", name(track.number, description), state(track));
                let label = ui.add(Label::new(RichText::new(&text).small()).truncate().sense(Sense::click()));
                if label.on_hover_text(format!("{text}\nA click brings these settings back")).clicked() {
                    actions.push(Action::ApplySettings(track.settings));
                }
            });
        }
        if let Some(study) = study(model) {
            ways(ui, study, palette);
        }
        if let Some(truth) = model.truth.filter(|truth| truth.floor.is_finite()) {
            let text = format!(
                "Reference: {} paths a point, {}",
                format::short(truth.paths as f64, ""),
                format::percent(truth.floor)
            );
            ui.horizontal_top(|ui| {
                chip(ui, palette.escaped);
                ui.label(RichText::new(text).small()).on_hover_text(
                    "The truth at 1024 points, path traced, and its own error; it gets better in the background",
                );
            });
        }
    });
}

/// What a study has found of each way.
fn ways(ui: &mut Ui, study: &Study, palette: Palette) {
    for &way in Way::ALL {
        let errors = study.measured.iter().filter(|measured| measured.recipe.way == way).map(|one| one.error.rms);
        let Some(best) = errors.reduce(f64::min) else { continue };
        let slope = study.slopes.iter().find(|(other, _)| *other == way).map(|(_, slope)| in_short(*slope));
        let text = format!("{}: {} at best{}", way.label(), format::percent(best), slope.unwrap_or_default());
        ui.horizontal_top(|ui| {
            chip(ui, of_way(way, palette));
            ui.add(Label::new(RichText::new(&text).small()).truncate()).on_hover_text(way.meaning());
        });
    }
}

fn without_runs(model: &Model) -> &'static str {
    if model.scene.is_some_and(|scene| scene.is_dark()) {
        "Without an emitter there is no light to measure"
    } else {
        "Runs on this scene come here once they are measured"
    }
}

/// How far off a run is, and how fast that falls.
fn state(track: &Track) -> String {
    let Some(last) = track.points.last() else { return String::new() };
    let error = format::percent(last.error.rms);
    let offers: Vec<Offer> =
        track.points.iter().map(|point| Offer { seconds: point.seconds, error: point.error.rms }).collect();
    format!("{error}{}", slope_at_end(&offers).map(in_short).unwrap_or_default())
}

fn in_short(slope: f64) -> String {
    format!(", slope {}", exponent(slope))
}
