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
use egui::{Grid, Label, RichText, ScrollArea, Ui, vec2};

/// Of the equation, and between it and the lists of contributors beside it. Where there is less room, they stand below it.
const WIDTH: f32 = 140.0 * UNIT;
const GAP: f32 = 6.0 * UNIT;
/// Of the names of figures.
const NAME_WIDTH: f32 = 6.0 * UNIT;

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
        ui.spacing_mut().item_spacing.y = 0.0;
        let lists = ((ui.available_width() - WIDTH) / (GAP + contributors::WIDTH)).floor();
        if lists < 1.0 {
            equation(ui, model, &facts);
            ui.add_space(2.0 * UNIT);
            contributors::largest(ui, &facts, actions);
            contributors::rest(ui, &facts);
            return;
        }
        ui.horizontal_top(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            column(ui, WIDTH, |ui| equation(ui, model, &facts));
            column(ui, contributors::WIDTH, |ui| {
                contributors::largest(ui, &facts, actions);
                if lists < 2.0 {
                    contributors::rest(ui, &facts);
                }
            });
            if lists >= 2.0 {
                column(ui, contributors::WIDTH, |ui| contributors::rest(ui, &facts));
            }
        });
    });
}

fn column(ui: &mut Ui, width: f32, contents: impl FnOnce(&mut Ui)) {
    ui.vertical(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0 * UNIT;
        ui.set_width(width);
        contents(ui);
    });
}

fn equation(ui: &mut Ui, model: &Model, facts: &EquationFacts) {
    terms(ui, &all_terms(facts));
    ui.add_space(UNIT);
    let equation = facts.equation;
    point(ui, facts, ["x'", "δ(x, x')"], equation.balance.patch, equation.sight);
    let Some(source) = &equation.source else { return };
    point(ui, facts, ["x''", "δ(x', x'')"], source.patch, source.visibility);
    geometry(ui, source);
    let method = if equation.balance.is_by_matrix { "matrix" } else { model.settings.form_factor.label() };
    exchange(ui, facts, source, method);
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
fn fact(ui: &mut Ui, name: &str, hover: &str, say: impl FnOnce(&mut Ui)) {
    figure_row(ui, hover, |ui| {
        let size = vec2(NAME_WIDTH, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(size, *ui.layout(), |ui| {
            ui.set_min_width(NAME_WIDTH);
            ui.label(RichText::new(name).weak());
        });
        say(ui);
    });
}

fn text(ui: &mut Ui, text: impl Into<RichText>) {
    ui.add(Label::new(text.into()).truncate());
}

/// What a point lies on, and whether light gets there, in the colour that the way has in the viewport.
fn point(ui: &mut Ui, facts: &EquationFacts, [name, delta]: [&str; 2], patch: u32, visibility: Visibility) {
    let palette = Palette::of(ui.visuals());
    let color = if visibility == Visibility::Free { palette.pass } else { palette.error };
    fact(ui, name, "What it lies on, and whether light gets from there to the next point, 1, or not, 0", |ui| {
        text(ui, format!("{}, patch {}", facts.name_of_patch(patch), format::count(patch.into())));
        let sight = format!("{delta} = {}: {}", visibility.factor(), facts.between(visibility));
        text(ui, RichText::new(sight).color(color));
    });
}

fn geometry(ui: &mut Ui, source: &LightSource) {
    let [here, there] = source.cosines.map(format::figure);
    let distance = format::si(source.distance, "m");
    let geometry = format::figure(source.geometry());
    let hover = "The geometry term. The cosines are those between the normals and the way from x' to x'', r long; behind the \
                 horizon they are 0.";
    fact(ui, "G", hover, |ui| {
        text(ui, format!("cos θ' = {here}, cos θ'' = {there}, r = {distance}, cos θ' cos θ'' / r² = {geometry} 1/m²"));
    });
}

/// What the patches of both points exchange.
fn exchange(ui: &mut Ui, facts: &EquationFacts, source: &LightSource, method: &str) {
    let hover = "The form factor from the patch of x' to the patch of x'', with what stands between them, by the method of the \
                 solver, and what that patch contributes to the radiosity of the patch of x'";
    let form_factor = format::percent(source.form_factor);
    let light = format::rgb(source.contribution.as_vec3(), "W/m²");
    let share = facts.share(source.contribution).map(|share| format!(", {} of B", format::percent(share)));
    fact(ui, "F", hover, |ui| {
        text(ui, format!("{form_factor} ({method}), ρ F B = {light}{}", share.unwrap_or_default()));
    });
}

/// What there is beside a diffuse surface.
fn material(ui: &mut Ui, facts: &EquationFacts, source: &LightSource) {
    if source.gloss != Rgb64::ZERO {
        let [diffuse, gloss] = [source.diffuse, source.gloss].map(|part| format::rgb(part.as_vec3(), ""));
        fact(ui, "ρ", "Diffuse, ρ/π, and glossy. The radiosity solution has the diffuse part alone.", |ui| {
            text(ui, format!("diffuse {diffuse} + glossy {gloss} {PER_SR}"));
        });
    }
    if facts.is_sharp() {
        let note = "The part of a mirror or of glass is left out: it has no number for one direction.";
        fact(ui, "", "", |ui| text(ui, RichText::new(note).weak()));
    }
}
