//! T-junctions: sides of one surface that meet and are cut differently.

use crate::build_with;
use crate::obj::Obj;
use glam::{Quat, Vec2, Vec3, Vec3A};
use lightwell::math::random::Stream;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::{Hanging, Mesh, Shape, Side};
use lightwell::world::World;
use proptest::prelude::*;

/// A unit square to the left of the line x = 0 and, to its right, a trapezoid whose far edge is `far` long, which is what
/// it is cut by. The trapezoid is bent up by an angle.
fn square_and_trapezoid(far: f32, bend: f32, material: &str, element_size: f32) -> World {
    let square = [(-1.0, 1.0), (0.0, 1.0), (0.0, 0.0), (-1.0, 0.0)].map(|(x, z)| Vec3::new(x, 0.0, z));
    let (low, high) = (0.5 - 0.5 * far, 0.5 + 0.5 * far);
    let trapezoid = [(0.0, 1.0), (1.0, high), (1.0, low), (0.0, 0.0)]
        .map(|(x, z)| Quat::from_rotation_z(bend) * Vec3::new(x, 0.0, z));
    let obj = Obj::new().object("square", "glow").face(square);
    build_with(obj.object("trapezoid", material).face(trapezoid).open(), element_size)
}

/// Vertices that hang on the fronts. Light of these comes nowhere, so that their backs, which the sky reaches, are meshed, too.
fn hanging_on_fronts(mesh: &Mesh) -> Vec<Hanging> {
    let is_on_a_front = |vertex: u32| {
        [0, 1].iter().any(|&polygon| mesh.side(polygon, true).is_some_and(|side| is_corner(mesh, side, vertex)))
    };
    mesh.hanging.iter().copied().filter(|hanging| is_on_a_front(hanging.vertex)).collect()
}

/// What is interpolated on the front of a polygon at a point of it.
fn value_on(mesh: &Mesh, polygon: u32, point: Vec3A, vertex_values: &[Rgb]) -> f32 {
    let location = mesh.locate(polygon, true, point).expect("a meshed front");
    mesh.interpolate(&location, vertex_values).x
}

/// A value for each element, from a function of its middle.
fn smoothed(mesh: &Mesh, field: impl Fn(Vec3A) -> f32) -> Vec<Rgb> {
    let values: Vec<Rgb> = mesh.elements.iter().map(|element| Rgb::splat(field(element.center))).collect();
    let mut vertex_values = Vec::new();
    mesh.smooth(&values, &mut vertex_values);
    vertex_values
}

/// Not linear anywhere.
fn uneven(point: Vec3A) -> f32 {
    1.0 + (3.0 * point.x + 5.0 * point.z).sin()
}

/// The largest difference between square and trapezoid along their edge.
fn largest_gap(world: &World, vertex_values: &[Rgb]) -> f32 {
    let gap = |i: u16| {
        let point = Vec3A::new(0.0, 0.0, f32::from(i) / 1000.0);
        (value_on(&world.mesh, 0, point, vertex_values) - value_on(&world.mesh, 1, point, vertex_values)).abs()
    };
    (0..=1000).map(gap).fold(0.0, f32::max)
}

/// Rounding of weights and of a few products of numbers up to 2.
const ROUNDING: f32 = 8.0 * f32::EPSILON;

/// Whether one of a side's elements has this vertex as a corner.
fn is_corner(mesh: &Mesh, side: &Side, vertex: u32) -> bool {
    let elements = &mesh.elements[side.elements.start as usize..side.elements.end as usize];
    elements.iter().any(|element| element.corners().contains(&vertex))
}

#[test]
fn where_one_cut_contains_the_other_nothing_cracks() {
    for (element_size, far, hanging) in [(0.25, 2.0, 4), (0.5, 3.9, 6), (0.125, 2.0, 8), (0.25, 1.0, 0)] {
        let world = square_and_trapezoid(far, 0.0, "glow", element_size);
        assert_eq!(hanging_on_fronts(&world.mesh).len(), hanging, "cells of {element_size} m against {far} m");
        let gap = largest_gap(&world, &smoothed(&world.mesh, uneven));
        assert!(gap <= ROUNDING, "{gap} with cells of {element_size} m against {far} m");
    }
}

#[test]
fn where_neither_cut_contains_the_other_what_is_left_is_of_second_order() {
    // The square, cut more coarsely, leads.
    for (element_size, far, cells, finer) in [(0.34, 1.2, 3_u16, 4), (0.126, 1.1, 8, 9), (0.085, 1.06, 12, 16)] {
        let world = square_and_trapezoid(far, 0.0, "glow", element_size);
        let mesh = &world.mesh;
        let cuts = [0, 1].map(|polygon| mesh.side(polygon, true).expect("its front glows").grid);
        assert_eq!(cuts.map(|grid| grid.patches[1] * grid.elements[1]), [u32::from(cells), finer]);
        let values = smoothed(mesh, uneven);
        for hanging in hanging_on_fronts(mesh) {
            let point = Vec3A::from(mesh.vertices[hanging.vertex as usize]);
            assert!(
                mesh.side(1, true).is_some_and(|side| is_corner(mesh, side, hanging.vertex)),
                "the finer side hangs"
            );
            let [square, trapezoid] = [0, 1].map(|polygon| value_on(mesh, polygon, point, &values));
            assert!((square - trapezoid).abs() <= 4.0 * ROUNDING, "at {point}");
        }
        let at = |i: u16| value_on(mesh, 0, Vec3A::new(0.0, 0.0, f32::from(i) / f32::from(cells)), &values);
        let bend = |i: u16| (at(i + 1) - 2.0 * at(i) + at(i - 1)).abs();
        let largest_bend = (1..cells).map(bend).fold(0.0, f32::max);
        // A kink of slope `bend / cell` in the middle of a finer cell, cut short by a straight line.
        let gap = largest_gap(&world, &values);
        assert!(gap <= 0.25 * largest_bend + 4.0 * ROUNDING, "{gap} for {largest_bend} with {cells} cells");
    }
}

#[test]
fn nothing_is_averaged_across_a_crease_or_between_materials() {
    for (bend, material, is_smooth) in
        [(0.0, "glow", true), (0.5, "glow", true), (0.6, "glow", false), (1.5, "glow", false), (0.0, "lamp", false)]
    {
        for far in [1.0, 1.2, 2.0] {
            let world = square_and_trapezoid(far, bend, material, 0.25);
            let mesh = &world.mesh;
            assert_eq!(!mesh.hanging.is_empty(), is_smooth && far > 1.0);
            let of_square = mesh.side(0, true).expect("its front glows").elements.clone();
            let values: Vec<Rgb> =
                (0u32..).zip(&mesh.elements).map(|(i, _)| Rgb::splat(f32::from(of_square.contains(&i)))).collect();
            let mut vertex_values = Vec::new();
            mesh.smooth(&values, &mut vertex_values);
            let is_mixed = vertex_values.iter().any(|value| value.x > 0.0 && value.x < 1.0);
            assert_eq!(is_mixed, is_smooth, "bent by {bend}, {material}, against {far} m");
        }
    }
}

/// A rectangle that is cut at random places, along and across by turns of chance, into `count` ones.
fn tiles(seed: u64, count: usize) -> Vec<[Vec2; 2]> {
    const SMALLEST: f32 = 0.15;
    let mut stream = Stream::new(seed, 0, 0);
    let mut tiles = vec![[Vec2::ZERO, Vec2::new(1.5, 1.0)]];
    for _ in 0..20 * count {
        if tiles.len() == count {
            break;
        }
        let index = (stream.bits() % tiles.len() as u64) as usize;
        let (axis, at) = ((stream.bits() % 2) as usize, stream.uniform());
        let [low, high] = tiles[index];
        let cut = low[axis] + at * (high[axis] - low[axis]);
        if cut - low[axis] > SMALLEST && high[axis] - cut > SMALLEST {
            let (mut middle_high, mut middle_low) = (high, low);
            middle_high[axis] = cut;
            middle_low[axis] = cut;
            tiles[index] = [low, middle_high];
            tiles.push([middle_low, high]);
        }
    }
    tiles
}

/// Tiles as faces of one plane, turned so that no edge is along an axis.
fn tiled(tiles: &[[Vec2; 2]], scale: f32) -> World {
    let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.3, 0.7, 1.1);
    let mut obj = Obj::scaled(scale).object("tiles", "glow");
    for [low, high] in tiles {
        let corners = [(low.x, high.y), (high.x, high.y), (high.x, low.y), (low.x, low.y)];
        obj = obj.face(corners.map(|(x, z)| turn * Vec3::new(x, 0.0, z)));
    }
    build_with(obj.open(), 0.1 * scale)
}

/// The polygons that a point lies on, or is nearer to than this, m.
fn polygons_at(mesh: &Mesh, point: Vec3A, near: f32) -> Vec<u32> {
    let point = point.as_dvec3();
    let holds = |shape: &Shape| shape.point(shape.nearest_coordinates(point)).distance(point) <= near.into();
    (0..mesh.sides.len() as u32 / 2)
        .filter(|&polygon| mesh.side(polygon, true).is_some_and(|side| holds(&side.shape)))
        .collect()
}

/// Four rectangles round a fifth, each with a corner in the middle of an edge of the next.
fn pinwheel() -> Vec<[Vec2; 2]> {
    [[0.0, 0.0, 0.9, 0.4], [0.9, 0.0, 1.4, 0.9], [0.5, 0.9, 1.4, 1.3], [0.0, 0.4, 0.5, 1.3], [0.5, 0.4, 0.9, 0.9]]
        .map(|[x, y, to_x, to_y]| [Vec2::new(x, y), Vec2::new(to_x, to_y)])
        .to_vec()
}

fn check_tiles(tiles: &[[Vec2; 2]], scale: f32) {
    let world = tiled(tiles, scale);
    let mesh = &world.mesh;
    let position = |vertex: u32| mesh.vertices[vertex as usize] / scale;
    // Corners are rounded to half a unit in the last place of coordinates below 2, cells are at least 0.05 wide, and
    // values differ by at most 2.
    let rounding = 4.0 * f32::EPSILON;
    let tolerance = 2.0 * rounding / 0.05;

    let mut is_free: Vec<bool> = vec![true; mesh.vertices.len()];
    mesh.hanging.iter().for_each(|hanging| is_free[hanging.vertex as usize] = false);
    for hanging in &mesh.hanging {
        let [from, to] = hanging.ends.map(position);
        assert!(position(hanging.vertex).distance(from.lerp(to, hanging.at)) < tolerance, "a linear field is kept");
        assert!(hanging.ends.iter().all(|&end| is_free[end as usize]), "it comes after its ends");
        is_free[hanging.vertex as usize] = true;
    }

    assert!(smoothed(mesh, |_| 1.0).iter().all(|value| *value == Rgb::ONE), "a constant stays as it is");
    let values = smoothed(mesh, |point| uneven(point / scale));
    for hanging in &mesh.hanging {
        let point = Vec3A::from(mesh.vertices[hanging.vertex as usize]);
        let value = values[hanging.vertex as usize].x;
        for polygon in polygons_at(mesh, point, rounding * scale) {
            let on_polygon = value_on(mesh, polygon, point, &values);
            assert!((on_polygon - value).abs() < tolerance, "{on_polygon} on polygon {polygon}, {value} at its edge");
        }
    }
}

#[test]
fn vertices_that_only_rounding_tells_apart_are_one() {
    let square =
        |x: f32, z: f32| [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)].map(|(u, v)| Vec3::new(x + u, 0.0, z + v));
    // Six decimals of coordinates of a metre.
    let obj = Obj::new().object("squares", "glow").face(square(-1.0, 0.0)).face(square(5e-7, 5e-7));
    let world = build_with(obj.open(), 0.25);
    let mesh = &world.mesh;
    let is_at_its_end = |hanging: &&Hanging| hanging.ends[0] == hanging.ends[1] && hanging.at == 0.0;
    assert_eq!(hanging_on_fronts(mesh).iter().filter(is_at_its_end).count(), 5);
    // Values differ by at most 2 from one vertex to the next, which is 0.25 m away.
    let gap = largest_gap(&world, &smoothed(mesh, uneven));
    assert!(gap < 2.0 * 1e-6 / 0.25, "{gap}");
}

#[test]
fn a_ring_of_t_junctions_is_opened() {
    for scale in [1e-6, 1.0, 1e6] {
        check_tiles(&pinwheel(), scale);
    }
    assert!(tiled(&pinwheel(), 1.0).mesh.hanging.len() > 10);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn sides_agree_at_the_t_junctions_of_random_tiles(seed in any::<u64>(), count in 2_usize..16, power in -6_i32..7) {
        check_tiles(&tiles(seed, count), 10_f32.powi(power));
    }
}
