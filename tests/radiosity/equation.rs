//! The rendering equation at a picked point: its terms by hand, and contributors that add up to the radiosity shown.

use super::quads::Quads;
use super::{furnace, world_of};
use glam::{DVec3, Vec3};
use lightwell::cancel::Cancel;
use lightwell::effects::{Effect, Effects, Switches};
use lightwell::math::polygon::parallel_rectangles;
use lightwell::math::rgb::{Rgb64, total};
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::{self, PickedLight, Points};
use lightwell::methods::{Settings, Solver, Step};
use lightwell::scene::Scene;
use lightwell::solution::{Balance, Equation, LightSource, Picked, Solution, Visibility};
use lightwell::world::World;
use std::f64::consts::PI;
use std::sync::Arc;

fn mesh(element_size: f32) -> MeshSettings {
    MeshSettings { element_size: Some(element_size), ..MeshSettings::default() }
}

/// After at most so many sweeps or shots.
fn solved(world: &Arc<World>, settings: &Settings, steps: u64) -> Solution {
    let mut method = radiosity::start(world.clone(), settings);
    let mut left = steps;
    while left > 0 {
        match method.step(&Cancel::default()) {
            Step::Advanced => left -= 1,
            Step::Prepared => {}
            Step::Converged | Step::Cancelled => break,
        }
    }
    method.solution()
}

fn looked_from(world: &World, settings: &Settings, patch: u32) -> Picked {
    radiosity::pick(world, settings, patch, &Cancel::default()).expect("nothing cancels it")
}

fn balance(world: &World, settings: &Settings, solution: &Solution, patch: u32) -> Balance {
    let picked = looked_from(world, settings, patch);
    PickedLight::new(world, settings, solution, &picked).balance(&Cancel::default()).expect("nothing cancels it")
}

/// The patch on the front of a polygon that has a point.
fn patch_at(world: &World, polygon: u32, point: Vec3) -> u32 {
    let element = world.mesh.element_at(polygon, true, point.into()).expect("the front is meshed");
    world.mesh.elements[element as usize].patch
}

/// The equation for points of polygons, after the lamps have shot.
fn equation(world: &Arc<World>, eye: Vec3, at: (u32, Vec3), source: (u32, Vec3)) -> Equation {
    let settings = Settings::default();
    let solution = solved(world, &settings, 4);
    let picked = looked_from(world, &settings, patch_at(world, at.0, at.1));
    let light = PickedLight::new(world, &settings, &solution, &picked);
    let source = Some((source.1, patch_at(world, source.0, source.1)));
    let balance = light.balance(&Cancel::default()).expect("nothing cancels it");
    light.equation(&Points { eye: eye.as_dvec3(), point: at.1, source }, balance)
}

fn source(equation: &Equation) -> &LightSource {
    equation.source.as_ref().expect("a second point")
}

/// Whether all three channels are this, but for a share of it.
fn is_grey(rgb: Rgb64, expected: f64, tolerance: f64) -> bool {
    (rgb - expected).abs().max_element() <= tolerance * expected
}

/// A grey floor of a square metre, one metre below a lamp as large. Each is one patch.
fn facing_squares() -> Arc<World> {
    world_of(Quads::new().up("grey", 0.5, 0.0).down("lamp", 0.5, 1.0).scene(), &mesh(0.25))
}

#[test]
fn a_lamp_contributes_its_exitance_times_form_factor_and_reflectance() {
    let world = facing_squares();
    let floor = patch_at(&world, 0, Vec3::ZERO);
    let settings = Settings::default();
    let balance = balance(&world, &settings, &solved(&world, &settings, 1), floor);
    let [lamp] = &balance.largest[..] else { panic!("one patch sends light: {balance:?}") };
    // The closed form is integrated over elements that are near to 1e-4.
    let expected = parallel_rectangles(1.0, 1.0, 1.0);
    assert!((lamp.form_factor / expected - 1.0).abs() < 2e-4, "{} for {expected}", lamp.form_factor);
    assert!(is_grey(lamp.light, 0.5 * expected * PI, 2e-4), "{} W/m²", lamp.light);
    assert_eq!((balance.other_count, balance.others, balance.emission), (0, Rgb64::ZERO, Rgb64::ZERO));
    // All is shot; what does not arrive escapes, which the solver finds by 2^12 rays or more: it scales its row to 1 by that.
    assert!(balance.unshot == Rgb64::ZERO && balance.difference.abs().max_element() < 0.03 * balance.radiosity.x);
}

#[test]
fn light_that_is_not_shot_yet_is_told_apart() {
    let world = facing_squares();
    let settings = Settings::default();
    let balance = balance(&world, &settings, &solved(&world, &settings, 0), patch_at(&world, 0, Vec3::ZERO));
    assert_eq!((balance.radiosity, balance.difference), (Rgb64::ZERO, Rgb64::ZERO));
    assert!(balance.unshot.x > 0.0 && balance.unshot == balance.gathered(), "{balance:?}");
}

#[test]
fn in_a_furnace_the_shares_sum_to_one() {
    // Every patch has B = M / (1 − ρ), and rows sum to 1, so that ρ Σ F B = ρ B = B − M. Of the flux 1e-6 is not followed to
    // its end; the light of elements is kept in single precision, sums of some hundred terms of which are good to 1e-5.
    let world = world_of(furnace(0.5), &mesh(0.125));
    let settings = Settings { solver: Solver::GaussSeidel, unshot_limit: 1e-6, ..Settings::default() };
    let solution = solved(&world, &settings, 1000);
    let exitance = world.scene.materials[0].exitance().as_dvec3().x;
    for patch in [0, world.mesh.patches.len() as u32 / 2] {
        let balance = balance(&world, &settings, &solution, patch);
        assert!(balance.is_by_matrix);
        assert!(is_grey(balance.radiosity, 2.0 * exitance, 1e-4), "{}", balance.radiosity);
        assert!(is_grey(balance.gathered(), exitance, 1e-4), "{}", balance.gathered());
        for contribution in &balance.largest {
            let expected = 0.5 * contribution.form_factor * 2.0 * exitance;
            assert!(is_grey(contribution.light, expected, 1e-4), "{contribution:?}");
        }
        assert!(balance.difference.abs().max_element() < 1e-5 * balance.radiosity.x, "{}", balance.difference);
        assert_eq!(balance.largest.len(), Balance::MOST);
        let is_sorted = balance.largest.is_sorted_by(|a, b| total(a.light) >= total(b.light));
        assert!(is_sorted && balance.other_count + Balance::MOST < world.mesh.patches.len());
    }
}

/// By the matrix nothing is left but rounding, wherever the light is: what the sums do not have is not shot yet.
#[test]
fn parts_add_up_to_the_radiosity_shown_at_every_moment() {
    let world = world_of(Scene::open("cornell-box").expect("a built-in scene"), &mesh(0.1));
    for (solver, steps) in [(Solver::Jacobi, 2), (Solver::GaussSeidel, 1), (Solver::Southwell, 30)] {
        let settings = Settings { solver, ..Settings::default() };
        let solution = solved(&world, &settings, steps);
        for patch in [0, 20, world.mesh.patches.len() as u32 - 1] {
            let balance = balance(&world, &settings, &solution, patch);
            let what = format!("{solver:?}, patch {patch}: {balance:?}");
            // Single precision, over some hundred terms of one sign.
            let tolerance = 1e-5 * total(balance.emission + balance.gathered());
            assert!(total(balance.difference.abs()) < tolerance, "{what}");
            assert!(total(balance.unshot) > 1e-3 * total(balance.gathered()), "{what}");
        }
    }
}

#[test]
fn only_what_is_simulated_contributes() {
    let world = world_of(Scene::open("cornell-box").expect("a built-in scene"), &mesh(0.1));
    for effect in [Effect::Interreflection, Effect::Colour] {
        let effects = Switches { off: Effects::of(&[effect]), ..Switches::default() };
        let settings = Settings { solver: Solver::GaussSeidel, effects, ..Settings::default() };
        let balance = balance(&world, &settings, &solved(&world, &settings, 1000), 0);
        assert!(total(balance.difference.abs()) < 1e-5 * total(balance.gathered()), "{effect:?}: {balance:?}");
        let material = |patch: u32| &world.scene.materials[world.mesh.patches[patch as usize].material as usize];
        let mut senders = balance.largest.iter().map(|contribution| material(contribution.patch));
        match effect {
            Effect::Interreflection => assert!(balance.other_count == 0 && senders.all(|from| from.is_emitter())),
            _ => assert!(is_grey(balance.radiosity, balance.radiosity.x, 1e-6), "{}", balance.radiosity),
        }
    }
}

#[test]
fn shot_by_shot_only_the_noise_of_form_factors_is_left() {
    let world = world_of(Scene::open("empty-box").expect("a built-in scene"), &mesh(0.1));
    let settings = Settings::default();
    let solution = solved(&world, &settings, 50);
    for patch in [0, world.mesh.patches.len() as u32 / 2] {
        let balance = balance(&world, &settings, &solution, patch);
        let parts = balance.emission + balance.gathered() - balance.unshot + balance.difference;
        assert!((parts - balance.radiosity).abs().max_element() < 1e-12 * balance.radiosity.max_element());
        // Rows of shooters are scaled by what they do not close by, and both ways of one form factor by elements at four
        // radii are apart by up to 1/3 · (1/4)².
        let closed = solution.closure.worst + 0.02;
        assert!(total(balance.difference.abs()) < closed * total(balance.gathered()), "{balance:?}");
    }
}

/// A floor of 2 m and a lamp of 1 m, one metre above it.
fn lamp_over(floor: &str) -> Arc<World> {
    world_of(Quads::new().up(floor, 1.0, 0.0).down("lamp", 0.5, 1.0).scene(), &mesh(0.25))
}

#[test]
fn terms_of_two_points_by_hand() {
    let (at, lamp) = (Vec3::new(0.6, 0.0, 0.0), Vec3::new(-0.15, 1.0, 0.0));
    let equation = equation(&lamp_over("grey"), Vec3::new(0.6, 0.5, 2.0), (0, at), (1, lamp));
    let source = source(&equation);
    // 0.75 m aside and 1 m up: r = 1.25 m, both cosines 0.8, G = 0.64 / 1.5625. Coordinates have single precision.
    let tolerance = 1e-6;
    assert!((source.distance - 1.25).abs() < tolerance && (source.geometry() - 0.4096).abs() < tolerance);
    assert!(source.cosines.iter().all(|cosine| (cosine - 0.8).abs() < tolerance), "{:?}", source.cosines);
    assert_eq!((equation.sight, source.visibility), (Visibility::Free, Visibility::Free));
    // The lamp has Ke 1, the floor Kd 0.5.
    assert!(is_grey(source.radiance(), 1.0, tolerance) && is_grey(source.brdf(), 0.5 / PI, tolerance));
    assert!(is_grey(source.integrand(), 0.5 / PI * 0.4096, tolerance), "{}", source.integrand());
    assert_eq!((equation.emitted, equation.radiance()), (Rgb64::ZERO, equation.reflected));
    // The lamp is one patch.
    assert_eq!(source.contribution, equation.balance.gathered());
}

#[test]
fn the_integrand_adds_up_to_what_is_reflected() {
    // The lamp as 64 × 64 pieces: the midpoint rule is off by h²/24 times the second derivatives, 1e-4 here. The mean over
    // an element of the floor of 0.25 m stands for its middle, off by 1 % at most; what the row lacks, by 3 % of noise.
    let (world, at) = (lamp_over("grey"), Vec3::new(0.125, 0.0, 0.125));
    let settings = Settings::default();
    let solution = solved(&world, &settings, 8);
    let picked = looked_from(&world, &settings, patch_at(&world, 0, at));
    let light = PickedLight::new(&world, &settings, &solution, &picked);
    let balance = light.balance(&Cancel::default()).expect("nothing cancels it");
    let (mut sum, pieces) = (Rgb64::ZERO, 64);
    let mut reflected = Rgb64::ZERO;
    for (i, j) in (0..pieces).flat_map(|i| (0..pieces).map(move |j| (i, j))) {
        let middle = |k: i32| (k as f32 + 0.5) / pieces as f32 - 0.5;
        let lamp = Vec3::new(middle(i), 1.0, middle(j));
        let points = Points { eye: DVec3::Y, point: at, source: Some((lamp, patch_at(&world, 1, lamp))) };
        let equation = light.equation(&points, balance.clone());
        sum += source(&equation).integrand() / f64::from(pieces * pieces);
        reflected = equation.reflected;
    }
    assert!(is_grey(sum, reflected.x, 0.04), "{sum} for {reflected}");
}

#[test]
fn what_stands_between_is_named() {
    // Floor, ceiling, four walls, then a block from 0.3 m to 0.6 m: its underside, its top and its sides.
    let world = world_of(Quads::room("grey", "glow", "grey").block("red").scene(), &mesh(0.25));
    let above = Vec3::new(0.0, 0.9, 0.0);
    let hidden = equation(&world, above, (0, Vec3::ZERO), (1, Vec3::Y));
    let Visibility::Blocked { polygon, at } = source(&hidden).visibility else { panic!("{hidden:?}") };
    assert_eq!((polygon, source(&hidden).visibility.factor()), (6, 0.0));
    assert!((at - 0.3 * Vec3::Y).length() < 1e-4, "{at}");
    assert_eq!((source(&hidden).radiance(), source(&hidden).integrand()), (Rgb64::ZERO, Rgb64::ZERO));
    assert!(source(&hidden).geometry() > 0.9 && total(source(&hidden).sent) > 0.0);
    // From above the top hides it from the eye as well.
    assert!(matches!(hidden.sight, Visibility::Blocked { polygon: 7, .. }), "{:?}", hidden.sight);
    assert!(hidden.radiance() == Rgb64::ZERO && total(hidden.reflected) > 0.0);
    let beside = Vec3::new(0.9, 0.0, 0.9);
    let free = equation(&world, above, (0, beside), (1, Vec3::new(0.9, 1.0, 0.9)));
    assert_eq!((free.sight, source(&free).visibility), (Visibility::Free, Visibility::Free));
}

#[test]
fn behind_the_horizon_there_is_nothing_and_no_nan() {
    let world = world_of(Quads::room("grey", "glow", "grey").block("red").scene(), &mesh(0.25));
    let at = (0, Vec3::new(0.0, 0.0, 0.9));
    let below = Vec3::new(0.0, -1.0, 0.0);
    for (to, is_zero) in [
        // In the plane of the floor, x′ itself, and the top of the block, which faces away.
        ((0, Vec3::new(0.5, 0.0, 0.5)), [true, true]),
        (at, [true, true]),
        ((7, Vec3::new(0.0, 0.6, 0.0)), [false, true]),
    ] {
        let equation = equation(&world, below, at, to);
        let source = source(&equation);
        assert_eq!(source.cosines.map(|cosine| cosine == 0.0), is_zero, "{to:?}: {source:?}");
        assert_eq!((source.visibility, source.geometry()), (Visibility::FacesAway, 0.0), "{to:?}");
        assert!(source.integrand() == Rgb64::ZERO && source.brdf().is_finite(), "{to:?}: {source:?}");
        assert_eq!((equation.sight, equation.radiance()), (Visibility::FacesAway, Rgb64::ZERO));
    }
}

#[test]
fn a_glossy_floor_reflects_a_mirrored_point_by_its_lobe() {
    let (at, lamp, eye) = (Vec3::ZERO, Vec3::new(0.3, 1.0, 0.0), Vec3::new(-0.3, 1.0, 0.0));
    let equation = equation(&lamp_over("gloss"), eye, (0, at), (1, lamp));
    // Kd 0.25, and Ks 0.5 with Ns 50 at the peak of Phong's lobe, (n + 2) / 2π. The cosine there is 1 but for a few roundings,
    // of which the power makes fifty.
    let (diffuse, gloss) = (0.25 / PI, 0.5 * 52.0 / (2.0 * PI));
    assert!(is_grey(source(&equation).gloss, gloss, 1e-4), "{} for {gloss}", source(&equation).gloss);
    assert!(is_grey(source(&equation).brdf(), diffuse + gloss, 1e-4));
}

#[test]
fn a_cancelled_balance_is_none() {
    let world = facing_squares();
    let settings = Settings::default();
    let solution = solved(&world, &settings, 1);
    let picked = looked_from(&world, &settings, 0);
    let cancel = Cancel::default();
    cancel.request();
    assert_eq!(PickedLight::new(&world, &settings, &solution, &picked).balance(&cancel), None);
}
