//! Whether something can stand between two points that light reaches.

use crate::obj::Obj;
use crate::{build_with, builtin};
use glam::{Quat, Vec3};
use lightwell::cancel::Cancel;
use lightwell::mesh::MeshSettings;
use lightwell::world::World;

/// A glowing room 1 m wide whose floor is two rectangles that meet in the middle, `raised` there.
fn room_with_a_fold(raised: f32, scale: f32, shift: Vec3, turn: Quat) -> World {
    let (low, high) = (Vec3::ZERO, Vec3::ONE);
    let corner = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let left = [corner(0.0, 0.0, 0.0), corner(0.0, 0.0, 1.0), corner(0.5, raised, 1.0), corner(0.5, raised, 0.0)];
    let right = [corner(0.5, raised, 0.0), corner(0.5, raised, 1.0), corner(1.0, 0.0, 1.0), corner(1.0, 0.0, 0.0)];
    let ceiling = [corner(0.0, 1.0, 0.0), corner(1.0, 1.0, 0.0), corner(1.0, 1.0, 1.0), corner(0.0, 1.0, 1.0)];
    let west = [low, corner(0.0, 1.0, 0.0), corner(0.0, 1.0, 1.0), corner(0.0, 0.0, 1.0)];
    let east = [corner(1.0, 0.0, 0.0), corner(1.0, 0.0, 1.0), high, corner(1.0, 1.0, 0.0)];
    let faces = [left, right, ceiling, west, east];
    let placed = |corners: [Vec3; 4]| corners.map(|corner| turn * corner + shift);
    let obj = faces.into_iter().fold(Obj::scaled(scale).object("room", "glow"), |obj, face| obj.face(placed(face)));
    build_with(obj.open(), 0.25 * scale)
}

#[test]
fn of_the_built_in_scenes_only_the_furnace_has_none() {
    // The measured red wall of the empty box is bent into the room by its own skewness, and its lamp hangs a hair off the
    // ceiling.
    for (name, has_occluders) in
        [("furnace", false), ("empty-box", true), ("cornell-box", true), ("two-rooms", true), ("gallery", true)]
    {
        let world = World::build(builtin(name), &MeshSettings::default(), &Cancel::default()).expect("a world");
        assert_eq!(world.has_occluders, has_occluders, "{name}");
        let settings = MeshSettings { elements_per_patch_edge: 1, ..MeshSettings::default() };
        let remeshed = world.remeshed(&settings, &Cancel::default()).expect("a world");
        assert_eq!(remeshed.has_occluders, has_occluders, "{name} cut differently");
    }
}

#[test]
fn a_room_has_some_where_it_is_folded_inwards_at_any_scale_and_place() {
    let turns = [Quat::IDENTITY, Quat::from_euler(glam::EulerRot::XYZ, 0.3, 0.7, 1.1)];
    for scale in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        for turn in turns {
            for (raised, has_occluders) in [(-0.1, false), (-1e-3, false), (0.0, false), (1e-3, true), (0.1, true)] {
                for shift in [Vec3::ZERO, Vec3::new(3.0, -2.0, 1.0)] {
                    let world = room_with_a_fold(raised, scale, shift, turn);
                    assert_eq!(world.has_occluders, has_occluders, "raised by {raised}, scaled by {scale}, at {shift}");
                }
            }
        }
    }
}

#[test]
fn what_stands_in_a_room_or_before_its_lamp_is_one_and_what_is_under_it_is_none() {
    let room = || {
        let walls = Obj::new().object("walls", "white").room_open_to(Vec3::NEG_Y, Vec3::ZERO, Vec3::ONE);
        walls.object("floor", "glow").level([0.0, 1.0], 0.0, [0.0, 1.0])
    };
    let table = room().object("table", "white").level([0.3, 0.7], 0.4, [0.3, 0.7]);
    let shell = room().object("shell", "white").block(Vec3::splat(-0.2), Vec3::splat(1.2));
    let cellar = room().object("cellar", "white").block(Vec3::new(0.1, -0.5, 0.1), Vec3::new(0.9, -0.2, 0.9));
    let lamp = room().object("lamp", "lamp").level_down([0.3, 0.7], 1.0, [0.3, 0.7]);
    for (what, obj, has_occluders) in [
        ("nothing", room(), false),
        ("a table", table, true),
        // The floor shines at its ceiling, which only the room's own ceiling keeps dark.
        ("a shell", shell, true),
        ("a cellar", cellar, false),
        ("a lamp", lamp, true),
    ] {
        assert_eq!(build_with(obj.open(), 0.25).has_occluders, has_occluders, "{what}");
    }
}

#[test]
fn there_is_none_on_a_plane_and_between_two_plates_without_a_third() {
    let floor =
        || Obj::new().object("floor", "glow").level([0.0, 1.0], 0.0, [0.0, 1.0]).level([1.0, 3.0], 0.0, [0.0, 2.0]);
    let roofed = || floor().object("roof", "white").level_down([0.0, 3.0], 1.0, [0.0, 2.0]);
    let parted = roofed().object("plate", "white").level([0.5, 0.6], 0.5, [0.5, 0.6]);
    for (obj, has_occluders) in [(floor(), false), (roofed(), false), (parted, true)] {
        assert_eq!(build_with(obj.open(), 0.25).has_occluders, has_occluders);
    }
}
