//! The rendering equation at the picked point: in symbols, and below each of them its number.

use super::contributors;
use super::widgets::{figure_row, with_key};
use crate::app::action::Action;
use crate::app::equation::EquationFacts;
use crate::app::format;
use crate::app::keys;
use crate::app::model::Model;
use crate::app::theme::{Palette, UNIT};
use crate::app::views::ViewGroup;
use crate::choice::Choice;
use crate::math::rgb::Rgb64;
use crate::solution::{LightSource, Visibility};
use egui::{Color32, Grid, Label, RichText, ScrollArea, Ui};

/// Where there is less room than this, the contributors stand below the equation.
const WIDE: f32 = 200.0 * UNIT;
/// Of the contributors beside it.
const CONTRIBUTORS_WIDTH: f32 = 76.0 * UNIT;
/// Of the names of figures.
const NAME_WIDTH: f32 = 18.0 * UNIT;

const RADIANCE: &str = "W/(m²·sr)";
const PER_SR: &str = "1/sr";

/// Beside the tabs: what to do next.
pub fn head(ui: &mut Ui, model: &Model) {
    let text = match model.equation.map(|facts| facts.equation.source) {
        _ if ViewGroup::of(model.look.view) != ViewGroup::Radiosity => "Choose a view of radiosity first.".to_owned(),
        None => "Click a point x' to see where its light comes from.".to_owned(),
        Some(None) => "Shift and click a second point, x'', or click a patch in the list.".to_owned(),
        Some(Some(_)) => {
            with_key(ui, "Shift and click another x'', click another x', or forget both", Some(&keys::UNPICK))
        }
    };
    ui.add(Label::new(RichText::new(text).weak()).truncate());
}

pub fn show(ui: &mut Ui, model: &Model, actions: &mut Vec<Action>) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        let Some(facts) = model.equation else { return };
        ui.spacing_mut().item_spacing.y = UNIT;
        let width = ui.available_width();
        if width < WIDE {
            equation(ui, model, &facts);
            ui.add_space(2.0 * UNIT);
            contributors::show(ui, &facts, actions);
            return;
        }
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0 * UNIT;
            ui.vertical(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0 * UNIT;
                ui.set_width(width - CONTRIBUTORS_WIDTH - 8.0 * UNIT);
                equation(ui, model, &facts);
            });
            ui.vertical(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0 * UNIT;
                ui.set_width(CONTRIBUTORS_WIDTH);
                contributors::show(ui, &facts, actions);
            });
        });
    });
}

fn equation(ui: &mut Ui, model: &Model, facts: &EquationFacts) {
    terms(ui, &all_terms(facts));
    ui.add_space(UNIT);
    let equation = facts.equation;
    fact(ui, "x'", place(facts, equation.balance.patch), "The point that was clicked");
    sight(ui, facts, "δ(x, x')", equation.sight, ["the eye", "x'"]);
    let Some(source) = &equation.source else { return };
    fact(ui, "x''", place(facts, source.patch), "The second point");
    sight(ui, facts, "δ(x', x'')", source.visibility, ["x'", "x''"]);
    geometry(ui, source);
    let by = if equation.balance.is_by_matrix {
        "from the matrix".to_owned()
    } else {
        format!("by the method {}", model.settings.form_factor.label())
    };
    exchange(ui, facts, source, &by);
    material(ui, facts, source);
}

/// A symbol, its number in red, green and blue, and what it stands for.
struct Term {
    symbol: &'static str,
    numbers: [String; 3],
    unit: &'static str,
    meaning: &'static str,
}

impl Term {
    fn new(symbol: &'static str, numbers: [String; 3], unit: &'static str, meaning: &'static str) -> Self {
        Self { symbol, numbers, unit, meaning }
    }
}

fn all_terms(facts: &EquationFacts) -> [Term; 8] {
    let equation = facts.equation;
    let source = equation.source.as_ref();
    // What depends on a second point is not known before there is one.
    let unknown = || [(); 3].map(|()| format::NO_VALUE.to_owned());
    let of_source = |value: fn(&LightSource) -> Rgb64| source.map(value).map_or_else(unknown, channels);
    let geometry = source.map(|source| alike(format::figure(source.geometry())));
    [
        Term::new(
            "L(x, x')",
            channels(equation.radiance()),
            RADIANCE,
            "The radiance that arrives at the eye, x, from x'",
        ),
        Term::new(
            "= δ(x, x')",
            alike(equation.sight.factor().to_string()),
            "",
            "1 where the eye sees x', 0 where something is between",
        ),
        Term::new("[ E(x, x')", channels(equation.emitted), RADIANCE, "The radiance that the surface makes at x'"),
        Term::new(
            "+ ∫",
            channels(equation.reflected),
            RADIANCE,
            "The radiance that x' reflects: the integral over all surfaces, as the radiosity solution has it",
        ),
        Term::new(
            "ρ(x, x'')",
            of_source(LightSource::brdf),
            PER_SR,
            "How x' reflects light from x'' to the eye: the BRDF",
        ),
        Term::new(
            "L(x', x'')",
            of_source(LightSource::radiance),
            RADIANCE,
            "The radiance that arrives at x' from x'': δ(x', x'') B/π",
        ),
        Term::new("G(x', x'')", geometry.unwrap_or_else(unknown), "1/m²", "How the two surfaces lie to each other"),
        Term::new(
            "dx'' ]",
            of_source(LightSource::integrand),
            "W/(m²·sr) per m²",
            "ρ L G: what x' reflects to the eye for each square metre of surface round x''",
        ),
    ]
}

fn channels(value: Rgb64) -> [String; 3] {
    format::channels(value.as_vec3())
}

/// What is the same for every colour.
fn alike(number: String) -> [String; 3] {
    [number.clone(), number.clone(), number]
}

/// Symbols in one line, and their numbers in as many as there are colours.
fn terms(ui: &mut Ui, terms: &[Term]) {
    let is_grey = terms.iter().all(|Term { numbers: [r, g, b], .. }| r == g && g == b);
    Grid::new("terms").spacing([3.0 * UNIT, UNIT]).min_row_height(4.0 * UNIT).show(ui, |ui| {
        ui.label("");
        for term in terms {
            ui.label(RichText::new(term.symbol).strong()).on_hover_text(term.meaning);
        }
        ui.end_row();
        let names = if is_grey { &[""][..] } else { &["R", "G", "B"] };
        for (channel, name) in names.iter().enumerate() {
            ui.label(RichText::new(*name).weak());
            for term in terms {
                ui.label(&term.numbers[channel]).on_hover_text(term.meaning);
            }
            ui.end_row();
        }
        ui.label("");
        for term in terms {
            ui.label(RichText::new(term.unit).small().weak());
        }
        ui.end_row();
    });
}

/// A name, and what is to be said of it in the rest of the line.
fn fact(ui: &mut Ui, name: &str, text: impl Into<RichText>, hover: &str) {
    figure_row(ui, hover, |ui| {
        let size = egui::vec2(NAME_WIDTH, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, *ui.layout(), |ui| {
            ui.set_min_width(NAME_WIDTH);
            ui.label(RichText::new(name).weak());
        });
        ui.add(Label::new(text.into()).truncate());
    });
}

fn place(facts: &EquationFacts, patch: u32) -> String {
    format!("{}, patch {}", facts.name_of_patch(patch), format::count(patch.into()))
}

/// Whether light gets through, in the colour that the way has in the viewport.
fn sight(ui: &mut Ui, facts: &EquationFacts, name: &str, visibility: Visibility, [from, to]: [&str; 2]) {
    let palette = Palette::of(ui.visuals());
    let color: Color32 = if visibility == Visibility::Free { palette.pass } else { palette.error };
    let text = format!("{}. {}", visibility.factor(), facts.sentence(visibility, from, to));
    fact(ui, name, RichText::new(text).color(color), "1 where light gets from one to the other, else 0");
}

fn geometry(ui: &mut Ui, source: &LightSource) {
    let [here, there] = source.cosines.map(format::figure);
    let hover = "Between the normals of the surfaces and the way from one point to the other; 0 behind the horizon";
    fact(ui, "cos θ', cos θ''", format!("{here}, {there}"), hover);
    fact(ui, "r", format::si(source.distance, "m"), "From x' to x''");
    let text = format!("cos θ' cos θ'' / r² = {}", format::figure(source.geometry()));
    fact(ui, "G", format!("{text} 1/m²"), "The geometry term");
}

/// What the patches of both points exchange.
fn exchange(ui: &mut Ui, facts: &EquationFacts, source: &LightSource, by: &str) {
    let text = format!("{}, {by}", format::percent(source.form_factor));
    fact(ui, "F", text, "The form factor from the patch of x' to the patch of x'', with what stands between them");
    let light = format::rgb(source.contribution.as_vec3(), "W/m²");
    let text = match facts.share(source.contribution) {
        Some(share) => format!("{light}, {} of the radiosity", format::percent(share)),
        None => light,
    };
    fact(ui, "ρ F B", text, "What the patch of x'' contributes to the radiosity of the patch of x'");
}

/// What there is beside a diffuse surface.
fn material(ui: &mut Ui, facts: &EquationFacts, source: &LightSource) {
    if source.gloss != Rgb64::ZERO {
        let [diffuse, gloss] = [source.diffuse, source.gloss].map(|part| format::rgb(part.as_vec3(), ""));
        let hover = "Diffuse, ρ/π, and glossy. The radiosity solution has the diffuse part alone.";
        fact(ui, "ρ(x, x'')", format!("diffuse {diffuse} + glossy {gloss} {PER_SR}"), hover);
    }
    if facts.is_sharp() {
        let text = "The part of a mirror or of glass is left out: it has no number for one direction.";
        fact(ui, "", RichText::new(text).weak(), "");
    }
}
