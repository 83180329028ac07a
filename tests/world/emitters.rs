//! Emitters that shine the wrong way, lie in a wall, or light nothing.

use crate::obj::Obj;
use crate::shapes::{placed, sphere};
use crate::{Side, build, build_with, element_at, kinds, sides};
use glam::{DVec3, Vec3, Vec3A};
use lightwell::cancel::Cancel;
use lightwell::math::polygon::form_factor;
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{Method, Settings, Step};
use lightwell::scene::{FindingKind, Severity};
use lightwell::solution::Solution;
use lightwell::tracer::Ray;
use lightwell::world::World;
use lightwell::world::with_ceiling_light;
use std::f64::consts::PI;
use std::sync::Arc;

/// A closed room of one cubic metre that reflects nothing, so that all light on its walls comes straight from the lamp.
fn black_room() -> Obj {
    Obj::new().object("room", "black").room(Vec3::ZERO, Vec3::ONE)
}

fn solve(world: World) -> (Arc<World>, Solution) {
    let world = Arc::new(world);
    let mut method = Progressive::new(world.clone(), Settings::default());
    while method.step(&Cancel::default()) == Step::Advanced {}
    (world, method.solution())
}

/// E in the middle of the floor of a cubic metre, W/m², from a lamp of 0.4 m × 0.4 m above it with M_e = π W/m².
fn expected_irradiance(height: f64) -> f64 {
    let lamp = [(0.3, 0.3), (0.7, 0.3), (0.7, 0.7), (0.3, 0.7)].map(|(x, z)| DVec3::new(x, height, z));
    PI * form_factor(DVec3::new(0.5, 0.0, 0.5), DVec3::Y, &lamp)
}

/// Asserts that the floor's middle has that irradiance, and that no light is lost.
fn assert_lit(world: World, expected: f64) {
    let middle = element_at(&world, Vec3::new(0.51, 0.0, 0.51), Vec3::Y);
    let (_, solution) = solve(world);
    let got = f64::from(solution.light.irradiance[middle].x);
    // Rows are scaled to close. The element's middle is 4 cm from the floor's, over 1 m: E there is lower by
    // (1 + 2 · 0.035²)^-2, half a percent, and so is its mean against its middle, by a tenth of that.
    let tolerance = solution.closure.worst + 6e-3;
    assert!((got / expected - 1.0).abs() < tolerance, "{got} for {expected}, within {tolerance}");
    assert_eq!(solution.energy.escaped, DVec3::ZERO);
    let emitted = 0.16 * PI;
    assert!((solution.energy.emitted.x / emitted - 1.0).abs() < 1e-5, "{}", solution.energy.emitted);
}

fn lamp_front(world: &World) -> Side {
    // Fronts come first.
    sides(world).into_iter().find(|side| side.object == "lamp").expect("a lamp")
}

#[test]
fn a_lamp_that_hangs_right_is_left_alone() {
    let world = build_with(black_room().object("lamp", "lamp").level_down([0.3, 0.7], 0.99, [0.3, 0.7]).open(), 0.07);
    assert_eq!(kinds(&world), []);
    assert_lit(world, expected_irradiance(0.99));
}

#[test]
fn a_lamp_that_shines_up_under_a_ceiling_is_turned() {
    let world = build_with(black_room().object("lamp", "lamp").level([0.3, 0.7], 0.99, [0.3, 0.7]).open(), 0.07);
    assert_eq!(kinds(&world), [FindingKind::EmitterTurned]);
    assert!(world.scene.findings[0].subject.contains("lamp"), "{}", world.scene.findings[0]);
    assert_eq!(lamp_front(&world).normal, Vec3::NEG_Y);
    let up = Ray::new(Vec3A::new(0.5, 0.1, 0.5), Vec3A::Y);
    assert!(world.tracer.closest(&up).is_some_and(|hit| hit.is_front), "rays meet what is drawn");
    assert_lit(world, expected_irradiance(0.99));
}

#[test]
fn a_lamp_in_the_plane_of_a_ceiling_is_moved_and_its_light_arrives() {
    for is_wrong_way in [false, true] {
        let obj = black_room().object("lamp", "lamp");
        let (x, z) = ([0.3, 0.7], [0.3, 0.7]);
        let obj = if is_wrong_way { obj.level(x, 1.0, z) } else { obj.level_down(x, 1.0, z) };
        let world = build_with(obj.open(), 0.07);
        let moved = kinds(&world);
        assert_eq!(moved.last(), Some(&FindingKind::EmitterMoved));
        assert_eq!(moved.contains(&FindingKind::EmitterTurned), is_wrong_way);
        let front = lamp_front(&world);
        assert!(front.normal == Vec3::NEG_Y && (0.999..1.0).contains(&front.center.y), "{}", front.center);
        assert_lit(world, expected_irradiance(1.0));
    }
}

#[test]
fn a_lamp_over_the_cut_of_a_ceiling_is_moved() {
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, z)| Vec3::new(x, 1.0, z));
    let obj = Obj::new().object("room", "black").room_open_to(Vec3::Y, Vec3::ZERO, Vec3::ONE);
    let obj = obj.face([0, 1, 2].map(|i| corners[i])).face([0, 2, 3].map(|i| corners[i]));
    let world = build_with(obj.object("lamp", "lamp").level_down([0.3, 0.7], 1.0, [0.3, 0.7]).open(), 0.07);
    assert_eq!(kinds(&world), [FindingKind::EmitterMoved]);
    assert_lit(world, expected_irradiance(1.0));
}

#[test]
fn a_lamp_that_nothing_sees_is_reported() {
    let world = build(black_room().object("lamp", "lamp").level([0.3, 0.7], 1.01, [0.3, 0.7]).open());
    assert_eq!(kinds(&world), [FindingKind::EmitterHidden]);
    assert_eq!(world.scene.findings[0].severity, Severity::Warning);
    assert!(!world.is_closed());
    let (_, solution) = solve(world);
    assert!((solution.energy.escaped - solution.energy.emitted).length() < 1e-9);
}

#[test]
fn a_spherical_lamp_that_is_inside_out_is_turned() {
    let mut ball = placed(&sphere(1), 0.2, Vec3::splat(2.5));
    let right = Obj::new().object("lamp", "lamp").triangles(&ball);
    ball.iter_mut().for_each(|corners| corners.reverse());
    let wrong = Obj::new().object("lamp", "lamp").triangles(&ball);
    let in_room = |obj: Obj| build(obj.object("room", "white").room(Vec3::ZERO, Vec3::ONE).open());
    assert_eq!(kinds(&in_room(right)), []);
    let world = in_room(wrong);
    assert_eq!(kinds(&world), [FindingKind::EmitterTurned; 32]);
    for side in sides(&world).iter().filter(|side| side.object == "lamp") {
        let is_outside = (side.center - Vec3::splat(0.5)).dot(side.normal) > 0.0;
        assert_eq!(side.is_meshed, is_outside, "at {} facing {}", side.center, side.normal);
    }
}

#[test]
fn the_ceiling_light_hangs_under_a_roof_that_is_thick() {
    // A closed hall under a slab: the top of the scene is the roof, and just under it is the inside of the slab.
    let (low, high) = (Vec3::ZERO, Vec3::new(10.0, 3.0, 10.0));
    let slab = [Vec3::new(0.0, 3.0, 0.0), Vec3::new(10.0, 3.2, 10.0)];
    let scene =
        Obj::new().object("hall", "white").room(low, high).object("roof", "white").block(slab[0], slab[1]).open();
    let lit = with_ceiling_light(&scene);
    let light = lit.polygons.last().expect("the light");
    let height = lit.positions[light.corners()[0] as usize].y;
    assert!(height < 3.0 && height > 2.7, "it hangs at {height} m");
    assert_eq!(with_ceiling_light(&lit).polygons.len(), lit.polygons.len(), "one light is enough");
}
