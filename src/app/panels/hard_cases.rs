//! The gallery of hard cases: a lamp for each number that is held against what it should be.

use super::widgets::primary_button;
use crate::app::action::Action;
use crate::app::format;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::hard_cases::{Case, Row, Verdict, cases};
use crate::worker::CheckReport;
use egui::{Align, Button, Label, Layout, Rect, RichText, ScrollArea, Sense, Shape, Stroke, Ui, vec2};

/// Height of a row.
const HEIGHT: f32 = 6.0 * UNIT;
const LAMP_WIDTH: f32 = 4.0 * UNIT;
const CASE_WIDTH: f32 = 38.0 * UNIT;
const NUMBER_WIDTH: f32 = 21.0 * UNIT;
const TOLERANCE_WIDTH: f32 = 15.0 * UNIT;

/// In a row: the button that starts the run, and how the run is going.
pub fn controls(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    let is_running = model.checks.is_some_and(|report| !report.is_finished);
    let hover = "Runs every case in the background; it takes a while";
    if ui.add_enabled(!is_running, primary_button(ui, "Run all")).on_hover_text(hover).clicked() {
        actions.push(Action::RunChecks);
    }
    let Some(report) = model.checks else { return };
    ui.add(Label::new(summary(report)).truncate());
}

fn summary(report: &CheckReport) -> String {
    let count = |verdict| report.rows.iter().filter(|row| row.verdict == verdict).count();
    let [pass, fail, limit] = [Verdict::Pass, Verdict::Fail, Verdict::Limit].map(count);
    let limits = format::counted(limit as u64, "known limit");
    let so_far = format!("{pass} pass, {fail} fail, {limits}");
    report.running.map_or(so_far.clone(), |running| format!("{so_far}; running {running}"))
}

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ui.spacing_mut().item_spacing.y = 0.0;
    head(ui);
    let lines = lines(model.checks);
    ScrollArea::vertical().auto_shrink(false).show_rows(ui, HEIGHT, lines.len(), |ui, visible| {
        for line in &lines[visible] {
            show_line(ui, line, actions);
        }
    });
}

/// A row of the list: a number, or a case that was not run yet.
struct Line<'a> {
    case: &'static Case,
    row: Option<&'a Row>,
    /// Whether it is the first of its case, which has its name.
    is_first: bool,
}

fn lines(report: Option<&CheckReport>) -> Vec<Line<'_>> {
    let rows = report.map_or(&[][..], |report| &report.rows);
    let of_case = |case: &'static Case| {
        let found = rows.iter().filter(|row| row.case == case.name).map(Some).collect::<Vec<_>>();
        let found = if found.is_empty() { vec![None] } else { found };
        found.into_iter().enumerate().map(move |(i, row)| Line { case, row, is_first: i == 0 })
    };
    cases().flat_map(of_case).collect()
}

fn head(ui: &mut Ui) {
    columns(ui, true, |ui, column| {
        let text = ["", "Case", "Quantity", "Expected", "Got", "Tolerance"][column];
        ui.label(RichText::new(text).small().weak());
    });
}

fn show_line(ui: &mut Ui, line: &Line, actions: &mut Vec<Action>) {
    let verdict = line.row.map(|row| row.verdict);
    let hover = line.row.map_or(line.case.about, |row| &row.guard);
    columns(ui, line.row.is_some(), |ui, column| match (column, line.row) {
        (0, _) => lamp(ui, verdict),
        (1, _) if line.is_first => {
            let name = ui.add(Button::new(line.case.name).frame(false).truncate());
            if name.on_hover_text(format!("{}. Click to open it as a scene.", line.case.about)).clicked() {
                actions.push(Action::ShowCase(line.case.name));
            }
        }
        (2, Some(row)) => cell(ui, RichText::new(&row.quantity), hover),
        (2, None) => cell(ui, RichText::new(line.case.about).weak(), hover),
        (3, Some(row)) => cell(ui, RichText::new(format::figures(row.expected)), hover),
        (4, Some(row)) => cell(ui, RichText::new(format::figures(row.got)), hover),
        (5, Some(row)) if row.tolerance == 0.0 => cell(ui, RichText::new("exact").weak(), hover),
        (5, Some(row)) => cell(ui, RichText::new(format::scientific(row.tolerance)).weak(), hover),
        _ => {}
    });
}

fn cell(ui: &mut Ui, text: RichText, hover: &str) {
    ui.add(Label::new(text).truncate()).on_hover_text(hover);
}

/// One line of cells; the numbers stand at the right of theirs. A line without numbers has their room for its text.
fn columns(ui: &mut Ui, has_numbers: bool, mut cell: impl FnMut(&mut Ui, usize)) {
    let spacing = 2.0 * UNIT;
    let numbers = if has_numbers { &[NUMBER_WIDTH, NUMBER_WIDTH, TOLERANCE_WIDTH][..] } else { &[] };
    let fixed = LAMP_WIDTH + CASE_WIDTH + numbers.iter().sum::<f32>() + (3 + numbers.len()) as f32 * spacing;
    let text = (ui.available_width() - fixed).max(NUMBER_WIDTH);
    let widths = [LAMP_WIDTH, CASE_WIDTH, text].into_iter().chain(numbers.iter().copied());
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = spacing;
        ui.spacing_mut().interact_size.y = HEIGHT;
        for (column, width) in widths.enumerate() {
            let is_number = column > 2;
            let layout =
                if is_number { Layout::right_to_left(Align::Center) } else { Layout::left_to_right(Align::Center) };
            ui.allocate_ui_with_layout(vec2(width, HEIGHT), layout, |ui| {
                ui.set_min_width(width);
                cell(ui, column);
            });
        }
    });
}

/// Tells the verdict by colour and by shape: a disc holds, a square fails, a triangle is a known limit, a ring was not run.
fn lamp(ui: &mut Ui, verdict: Option<Verdict>) {
    let (rect, response) = ui.allocate_exact_size(vec2(3.0 * UNIT, 3.0 * UNIT), Sense::hover());
    let rect = Rect::from_center_size(rect.center(), vec2(10.0, 10.0));
    let palette = Palette::of(ui.visuals());
    let painter = ui.painter();
    let meaning = match verdict {
        Some(Verdict::Pass) => {
            painter.circle_filled(rect.center(), 5.0, palette.pass);
            "Holds"
        }
        Some(Verdict::Fail) => {
            painter.rect_filled(rect, 0, palette.error);
            "Fails"
        }
        Some(Verdict::Limit) => {
            let corners = vec![rect.center_top(), rect.right_bottom(), rect.left_bottom()];
            painter.add(Shape::convex_polygon(corners, palette.warning, Stroke::NONE));
            "A known limit"
        }
        None => {
            painter.circle_stroke(rect.center(), 4.5, Stroke::new(1.5, palette.escaped));
            "Not run yet"
        }
    };
    response.on_hover_text(meaning);
}
