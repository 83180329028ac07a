//! The rendering equation at a picked point, with its numbers.

use super::props::patch;
use super::stage::{LARGE, SMALL, Stage, WORLD, showing};
use super::{click, key, thin};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use glam::{DVec3, Vec3};
use lightwell::app::action::Action;
use lightwell::app::format;
use lightwell::app::model::{LowerPanel, Theme};
use lightwell::cancel::Cancel;
use lightwell::math::rgb::{Rgb64, total};
use lightwell::methods::radiosity::{self, PickedLight, Points};
use lightwell::methods::{Settings, Solver, Step};
use lightwell::solution::{Equation, Visibility};
use lightwell::viewport::View;

/// What sends light to the floor of the Cornell box, and what the middle of the patch that contributes most sends there.
pub fn equation() -> Equation {
    let settings = Settings { solver: Solver::GaussSeidel, ..Settings::default() };
    let mut method = radiosity::start(WORLD.clone(), &settings);
    while matches!(method.step(&Cancel::default()), Step::Advanced | Step::Prepared) {}
    let solution = method.solution();
    let picked = radiosity::pick(&WORLD, &settings, 0, &Cancel::default()).expect("nothing cancels it");
    let light = PickedLight::new(&WORLD, &settings, &solution, &picked);
    let balance = light.balance(&Cancel::default()).expect("nothing cancels it");
    let middle = |patch: u32| Vec3::from(WORLD.mesh.patches[patch as usize].center);
    let lamp = balance.largest[0].patch;
    // On the floor before the blocks.
    let point = Vec3::new(0.3, 0.0, 0.03);
    let points = Points { eye: WORLD.viewpoint.eye.as_dvec3(), point, source: Some((middle(lamp), lamp)) };
    light.equation(&points, balance)
}

fn opened(equation: Option<Equation>) -> Stage {
    Stage { patch: Some(patch()), equation, lower: Some(LowerPanel::Equation), ..Stage::default() }
}

#[test]
fn the_panel_opens_and_closes_by_tab_key_and_button() {
    let open = [Action::ShowLowerPanel(Some(LowerPanel::Equation))];
    assert_eq!(click(Stage::default(), "Equation"), open);
    assert_eq!(key(Stage::default(), Modifiers::NONE, Key::E), open);
    assert_eq!(click(Stage { patch: Some(patch()), ..Stage::default() }, "Its light"), open);
    assert_eq!(key(opened(None), Modifiers::NONE, Key::E), [Action::ShowLowerPanel(None)]);
}

#[test]
fn it_says_what_to_do_next() {
    let one = Equation { source: None, ..equation() };
    for (stage, hint) in [
        (opened(None), "Click a point x' to see where its light comes from."),
        (opened(Some(one)), "Shift and click a second point, x'', or click a patch in the list."),
        (Stage { lower: Some(LowerPanel::Equation), ..showing(View::Photons) }, "Choose a view of radiosity first."),
    ] {
        stage.window(LARGE).get_by_label(hint);
    }
}

#[test]
fn the_equation_is_written_in_symbols_and_in_numbers() {
    for (size, theme) in [(SMALL, Theme::Dark), (LARGE, Theme::Light)] {
        let equation = equation();
        let source = equation.source.expect("a second point");
        let harness = Stage { theme, ..opened(Some(equation.clone())) }.window(size);
        for symbol in [
            "L(x, x')",
            "= δ(x, x')",
            "[ E(x, x')",
            "+ ∫",
            "ρ(x, x'')",
            "L(x', x'')",
            "G(x', x'')",
            "dx'' ]",
            "1/sr",
            "1/m²",
        ] {
            assert!(harness.query_all_by_label(symbol).next().is_some(), "{symbol}");
        }
        for number in format::channels(source.integrand().as_vec3()) {
            assert!(harness.query_all_by_label(&number).next().is_some(), "{number}");
        }
        let [here, there] = source.cosines.map(format::figure);
        let (distance, geometry) = (format::si(source.distance, "m"), format::figure(source.geometry()));
        harness.get_by_label(&format!(
            "cos θ' = {here}, cos θ'' = {there}, r = {distance}, cos θ' cos θ'' / r² = {geometry} 1/m²"
        ));
        harness.get_by_label("δ(x, x') = 1: nothing stands between");
        harness.get_by_label("δ(x', x'') = 1: nothing stands between");
        harness.get_by_label("floor (white), patch 0");
        let light = format::rgb(source.contribution.as_vec3(), "W/m²");
        let share = format::percent(total(source.contribution) / total(equation.balance.radiosity));
        let form_factor = format::percent(source.form_factor);
        harness.get_by_label(&format!("{form_factor} (matrix), ρ F B = {light}, {share} of B"));
    }
}

#[test]
fn what_blocks_the_way_is_named() {
    let mut equation = equation();
    let block = WORLD.scene.objects.iter().position(|object| object == "tall_block").expect("a block");
    let polygon = WORLD.scene.polygons.iter().position(|polygon| polygon.object as usize == block).expect("a face");
    let source = equation.source.as_mut().expect("a second point");
    source.visibility = Visibility::Blocked { polygon: polygon as u32, at: 0.5 * (equation.point + source.point) };
    equation.sight = Visibility::FacesAway;
    let harness = opened(Some(equation)).small();
    harness.get_by_label("δ(x', x'') = 0: tall_block (white) stands between");
    harness.get_by_label("δ(x, x') = 0: they do not face each other");
}

#[test]
fn contributors_are_listed_with_shares_that_sum_to_all() {
    let equation = equation();
    let balance = &equation.balance;
    let harness = opened(Some(equation.clone())).window(LARGE);
    let radiosity = format::rgb(balance.radiosity.as_vec3(), "W/m²");
    assert!(harness.query_all_by_label(&radiosity).next().is_some(), "{radiosity}");
    let share = |part: Rgb64| total(part) / total(balance.radiosity);
    for part in balance.largest.iter().map(|contribution| contribution.light).chain([balance.others, -balance.unshot]) {
        assert!(harness.query_all_by_label(&format::percent(share(part))).next().is_some(), "{part}");
    }
    harness.get_by_label(&format::counted(balance.other_count as u64, "other patch"));
    for text in ["Not shot yet", "Form factors differ", &thin("100.0_%")] {
        harness.get_by_label(text);
    }
    let lamp = balance.largest[0].patch;
    let name = format!("lamp, {lamp}");
    assert_eq!(click(opened(Some(equation)), &name), [Action::PickSource(lamp)]);
}

#[test]
fn without_light_there_are_no_shares() {
    let mut dark = equation();
    dark.balance.radiosity = Rgb64::ZERO;
    dark.eye = DVec3::ZERO;
    let harness = opened(Some(dark)).window(LARGE);
    assert!(harness.query_all_by_label(format::NO_VALUE).count() > 10);
    assert!(harness.query_all_by_label(&thin("0_W/m²")).next().is_some());
}
