//! Irradiance read off a solution.

use crate::obj::Obj;
use crate::{build_with, builtin};
use glam::{Vec3, Vec3A};
use lightwell::cancel::Cancel;
use lightwell::math::rgb::Rgb;
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{Method, Settings};
use lightwell::solution::{Solution, SurfaceProbe};
use lightwell::world::World;
use std::sync::Arc;

/// Linear in the coordinates, another one in each channel.
fn field(point: Vec3A) -> Rgb {
    Rgb::new(1.0 + point.x - 0.5 * point.z, 2.0 + point.y + point.z, 3.0 - point.x - 0.25 * point.y)
}

/// A solution with the field's value in the middle of every element.
fn solution(world: &Arc<World>) -> Solution {
    let mut solution = Progressive::new(world.clone(), Settings::default()).solution();
    solution.light.irradiance = world.mesh.elements.iter().map(|element| field(element.center)).collect();
    solution
}

/// A closed room with a floor of two triangles; everything else is quads.
fn room() -> Arc<World> {
    let obj = Obj::new().object("room", "glow").room_open_to(Vec3::NEG_Y, Vec3::ZERO, Vec3::ONE);
    let obj = obj.face([Vec3::ZERO, Vec3::Z, Vec3::new(1.0, 0.0, 1.0)]);
    Arc::new(build_with(obj.face([Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0), Vec3::X]).open(), 0.125))
}

#[test]
fn a_linear_field_is_interpolated_exactly() {
    let world = room();
    let probe = SurfaceProbe::new(&world, &solution(&world));
    // Away from the edges of a side, whose vertices have no elements on the far side to balance the mean.
    for i in 0..40 {
        let (u, v) = (0.13 + 0.74 * i as f32 / 39.0, 0.13 + 0.74 * (0.37 * i as f32).fract());
        for (point, normal) in [
            (Vec3A::new(u, 0.0, v), Vec3A::Y),
            (Vec3A::new(u, 0.0, u), Vec3A::Y),
            (Vec3A::new(u, 1.0, v), Vec3A::NEG_Y),
            (Vec3A::new(0.0, u, v), Vec3A::X),
            (Vec3A::new(u, v, 1.0), Vec3A::NEG_Z),
        ] {
            let got = probe.irradiance(point, normal).expect("a surface");
            // Rounding of a few operations in single precision on numbers up to 4.
            assert!((got - field(point)).abs().max_element() < 1e-5, "at {point}: {got} for {}", field(point));
        }
    }
}

#[test]
fn there_is_no_irradiance_where_there_is_no_lit_surface() {
    let world = room();
    let probe = SurfaceProbe::new(&world, &solution(&world));
    for (point, normal) in [
        (Vec3A::splat(0.5), Vec3A::Y),
        (Vec3A::new(0.5, 0.05, 0.5), Vec3A::Y),
        (Vec3A::new(0.5, 0.0, 0.5), Vec3A::NEG_Y),
        (Vec3A::splat(5.0), Vec3A::Y),
    ] {
        assert_eq!(probe.irradiance(point, normal), None, "at {point} facing {normal}");
    }
}

#[test]
fn a_point_a_little_under_a_surface_has_its_irradiance() {
    let world = Arc::new(build_with(builtin("cornell-box"), 0.1));
    let mut solver = Progressive::new(world.clone(), Settings::default());
    for _ in 0..8 {
        solver.step(&Cancel::default());
    }
    let solution = solver.solution();
    let probe = SurfaceProbe::new(&world, &solution);
    let at = |height: f32| probe.irradiance(Vec3A::new(0.278, height, 0.1), Vec3A::Y).expect("the floor");
    let on_floor = at(0.0);
    assert!(on_floor.min_element() > 0.0);
    // Six digits of any exporter, and rounding, leave a point on either side.
    for height in [-1e-4, -1e-5, -1e-6, 1e-6, 1e-5, 1e-4] {
        assert!(
            (at(height) - on_floor).abs().max_element() < 1e-4 * on_floor.max_element(),
            "{height}: {}",
            at(height)
        );
    }
}

/// Points of a floor under what is nearer than a thousandth of the scene's radius, and points a little off it.
#[test]
fn the_surface_nearest_to_a_point_is_the_one_that_is_meant() {
    let world = |height: f32| {
        let obj = Obj::new().object("floor", "glow").level([0.0, 8.0], 0.0, [0.0, 8.0]);
        build_with(obj.object("ceiling", "glow").level_down([0.0, 8.0], height, [0.0, 8.0]).open(), 0.5)
    };
    for height in [5e-3, 1e-3, 1e-4] {
        let world = world(height);
        for (off, side) in [(0.0, (0, true)), (1e-6, (0, true)), (-1e-5, (0, true)), (height, (1, false))] {
            let hit = world.meet_at(Vec3A::new(4.0, off, 4.0), Vec3A::Y).expect("a surface");
            assert_eq!((hit.polygon, hit.is_front), side, "{off} above the floor, {height} below the ceiling");
        }
        let hit = world.meet_at(Vec3A::new(4.0, height, 4.0), Vec3A::NEG_Y).expect("a surface");
        assert_eq!((hit.polygon, hit.is_front), (1, true));
        assert_eq!(world.meet_at(Vec3A::new(4.0, 1.0, 4.0), Vec3A::Y), None);
    }
}

/// A rug in the plane of a floor that comes before it in the file.
#[test]
fn of_surfaces_in_one_place_the_one_on_top_is_meant() {
    let obj = Obj::new().object("floor", "glow").level([0.0, 8.0], 0.0, [0.0, 8.0]);
    let world = build_with(obj.object("rug", "white").level([2.0, 6.0], 0.0, [2.0, 6.0]).open(), 0.5);
    let met = |x: f32, normal| world.meet_at(Vec3A::new(x, 0.0, 4.1), normal).map(|hit| (hit.polygon, hit.is_front));
    assert_eq!([met(1.0, Vec3A::Y), met(4.0, Vec3A::Y)], [Some((0, true)), Some((1, true))]);
}
