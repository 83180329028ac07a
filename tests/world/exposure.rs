//! Where a block stands on a floor, the floor below it takes no part.

use crate::obj::Obj;
use crate::{build_with, element_at};
use glam::{Vec2, Vec3};
use lightwell::world::World;

/// Edge of an element, m.
const SIZE: f32 = 0.0625;
/// The footprint of the block, which cuts through elements.
const LOW: Vec2 = Vec2::new(0.28, 0.32);
const HIGH: Vec2 = Vec2::new(0.73, 0.61);

/// A block on the floor of an open room of one cubic metre under a lamp.
fn room(block: Obj) -> World {
    let obj = block.object("room", "white").room_open_to(Vec3::Z, Vec3::ZERO, Vec3::ONE);
    build_with(obj.object("lamp", "lamp").level_down([0.4, 0.6], 0.9, [0.4, 0.6]).open(), SIZE)
}

fn blocks() -> [Obj; 2] {
    let (low, high) = (Vec3::new(LOW.x, 0.0, LOW.y), Vec3::new(HIGH.x, 0.3, HIGH.y));
    let obj = || Obj::new().object("box", "white");
    // With an underside, which lies in the plane of the floor, and without.
    [obj().block(low, high), obj().block_without_underside(low, high)]
}

/// Share of an element with this centre that the block leaves free.
fn free_share(center: Vec3) -> f32 {
    let center = Vec2::new(center.x, center.z);
    let covered = (center + 0.5 * SIZE).min(HIGH) - (center - 0.5 * SIZE).max(LOW);
    1.0 - (covered.max(Vec2::ZERO) / SIZE).element_product()
}

#[test]
fn elements_under_a_block_are_covered_and_those_at_its_foot_in_part() {
    for block in blocks() {
        let world = room(block);
        let mut seen = [0; 3];
        for i in 0..16 {
            for j in 0..16 {
                let center = SIZE * Vec3::new(i as f32 + 0.5, 0.0, j as f32 + 0.5);
                let element = &world.mesh.elements[element_at_floor(&world, center)];
                let expected = free_share(center);
                let full = f64::from(SIZE * SIZE);
                assert!((element.area - full * f64::from(element.exposed)).abs() < 1e-6 * full);
                if expected == 0.0 || expected == 1.0 {
                    assert_eq!(element.exposed, expected, "at {center}");
                    seen[expected as usize] += 1;
                } else {
                    // Eight points across: along each of two directions the edge is known to half their distance.
                    assert!((element.exposed - expected).abs() <= 2.0 / 16.0, "at {center}: {}", element.exposed);
                    assert!(element.exposed > 0.0 && element.exposed < 1.0);
                    seen[2] += 1;
                }
            }
        }
        assert!(seen.iter().all(|&count| count > 10), "{seen:?}");
    }
}

#[test]
fn the_exposed_area_of_a_floor_is_what_the_block_leaves_free() {
    for block in blocks() {
        let world = room(block);
        let elements = world.mesh.elements.iter().filter(|element| {
            let patch = &world.mesh.patches[element.patch as usize];
            patch.normal.y > 0.5 && element.center.y.abs() < 1e-6
        });
        let area: f64 = elements.map(|element| element.area).sum();
        let (width, depth) = (f64::from(HIGH.x - LOW.x), f64::from(HIGH.y - LOW.y));
        // All elements along an edge may be wrong by the same sixteenth of their width.
        let tolerance = 2.0 * (width + depth) * f64::from(SIZE) / 16.0;
        assert!((area - (1.0 - width * depth)).abs() < tolerance, "{area}");
        let of_patches: f64 = world.mesh.patches.iter().map(|patch| patch.area).sum();
        let of_elements: f64 = world.mesh.elements.iter().map(|element| element.area).sum();
        assert!((of_patches - of_elements).abs() < 1e-9 * of_elements && world.mesh.area() == of_patches);
    }
}

/// Index of the floor's element with this centre, under the block or not.
fn element_at_floor(world: &World, center: Vec3) -> usize {
    // The corner of the room is free, and leads to the floor's polygon.
    let corner = element_at(world, Vec3::new(0.01, 0.0, 0.01), Vec3::Y);
    let patch = &world.mesh.patches[world.mesh.elements[corner].patch as usize];
    world.mesh.locate(patch.polygon, patch.is_front, center.into()).expect("the floor is meshed").element as usize
}
