//! Exactly the sides that light can reach are meshed.

use crate::obj::Obj;
use crate::{assert_meshed, build, builtin, kinds, sides};
use glam::Vec3;
use lightwell::scene::FindingKind;

/// Whether a side looks towards a point.
fn toward(point: Vec3) -> impl Fn(&crate::Side) -> bool {
    move |side| (point - side.center).dot(side.normal) > 0.0
}

#[test]
fn the_cornell_box_is_meshed_inside_and_its_blocks_outside() {
    let world = build(builtin("cornell-box"));
    let middle = Vec3::new(0.278, 0.274, 0.28);
    for wall in ["floor", "ceiling", "back_wall", "left_wall", "right_wall"] {
        assert_meshed(&world, wall, toward(middle));
    }
    // The back of the lamp touches the ceiling.
    assert_meshed(&world, "lamp", toward(middle));
    for (block, inside) in
        [("short_block", Vec3::new(0.186, 0.08, 0.169)), ("tall_block", Vec3::new(0.368, 0.16, 0.351))]
    {
        assert_meshed(&world, block, |side| !toward(inside)(side));
    }
    assert!(!world.is_closed());
}

#[test]
fn a_furnace_is_meshed_inside_whichever_way_it_is_wound() {
    let middle = Vec3::splat(0.5);
    for obj in [
        Obj::new().object("cube", "glow").room(Vec3::ZERO, Vec3::ONE),
        Obj::new().object("cube", "glow").block(Vec3::ZERO, Vec3::ONE),
    ] {
        let world = build(obj.open());
        assert_meshed(&world, "cube", toward(middle));
        assert!(world.is_closed());
    }
}

#[test]
fn of_a_box_in_a_room_only_the_outside_is_meshed() {
    let middle = Vec3::new(1.0, 0.4, 1.0);
    let (low, high) = (Vec3::new(0.7, 0.2, 0.7), Vec3::new(1.3, 0.6, 1.3));
    let obj = || Obj::new().object("box", "white");
    for obj in [obj().block(low, high), obj().room(low, high)] {
        let obj = obj.object("room", "white").room(Vec3::ZERO, Vec3::splat(2.0));
        let world = build(obj.object("lamp", "lamp").level_down([0.8, 1.2], 1.9, [0.8, 1.2]).open());
        assert_meshed(&world, "box", |side| !toward(middle)(side));
        assert_meshed(&world, "room", toward(middle));
        // Its back sees the ceiling.
        assert_meshed(&world, "lamp", |_| true);
    }
}

#[test]
fn what_is_lit_through_glass_alone_is_meshed() {
    let (low, high) = (Vec3::new(0.7, 1.0, 0.7), Vec3::new(1.3, 1.6, 1.3));
    for material in ["glass", "black"] {
        let obj = Obj::new().object("case", material).block(low, high).object("room", "white");
        let obj = obj.room(Vec3::ZERO, Vec3::splat(2.0)).object("lamp", "lamp");
        let world = build(obj.level_down([0.9, 1.1], 1.3, [0.9, 1.1]).open());
        assert_meshed(&world, "room", |side| material == "glass" && toward(Vec3::ONE)(side));
        // Its own room is lit in any case.
        assert_meshed(&world, "case", |side| material == "glass" || toward(0.5 * (low + high))(side));
    }
}

#[test]
fn a_thin_wall_between_two_lit_halves_has_both_its_sides() {
    let wall = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(y, z)| Vec3::new(1.0, y, z));
    let obj = Obj::new().object("wall", "white").face(wall);
    let obj = obj.object("room", "white").room(Vec3::ZERO, Vec3::new(2.0, 1.0, 1.0));
    let both =
        obj.object("lamp", "lamp").level_down([0.4, 0.6], 0.9, [0.4, 0.6]).level_down([1.4, 1.6], 0.9, [0.4, 0.6]);
    assert_meshed(&build(both.open()), "wall", |_| true);
}

#[test]
fn of_a_thin_wall_of_a_dark_half_one_side_is_meshed() {
    let wall = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(y, z)| Vec3::new(1.0, y, z));
    let lit = Vec3::new(0.5, 0.5, 0.5);
    let obj = Obj::new().object("wall", "white").face(wall);
    let obj = obj.object("lit", "white").room_open_to(Vec3::X, Vec3::ZERO, Vec3::ONE);
    let obj = obj.object("dark", "white").room_open_to(Vec3::NEG_X, Vec3::X, Vec3::new(2.0, 1.0, 1.0));
    let world = build(obj.object("lamp", "lamp").level_down([0.4, 0.6], 0.9, [0.4, 0.6]).open());
    assert_meshed(&world, "wall", toward(lit));
    assert_meshed(&world, "lit", toward(lit));
    assert_meshed(&world, "dark", |_| false);
}

#[test]
fn a_room_behind_a_long_bent_corridor_is_reached() {
    let plan = ["L...#.......#...", "###.#.#####.#.##", "###.#.#####.#.##", "###.#.#####.#.##", "###...#####...##"];
    let world = build(Obj::new().floor_plan(&plan).open());
    let inside: usize = sides(&world).iter().filter(|side| side.object == "rooms" && side.is_meshed).count();
    let polygons =
        world.scene.polygons.iter().filter(|polygon| world.scene.objects[polygon.object as usize] == "rooms");
    // Every front faces a corridor or a room, every back is inside a wall or outside.
    assert_eq!(inside, polygons.count());
    for (polygon, index) in world.scene.polygons.iter().zip(0..) {
        if world.scene.objects[polygon.object as usize] == "rooms" {
            assert!(world.mesh.side(index, true).is_some() && world.mesh.side(index, false).is_none());
        }
    }
    assert!(world.is_closed());
}

#[test]
fn a_sealed_room_beside_a_lit_one_stays_without_a_mesh() {
    let plan = ["L..#...", "...#.#.", "...#..."];
    let world = build(Obj::new().floor_plan(&plan).open());
    assert_meshed(&world, "rooms", |side| {
        let before = side.center + 0.1 * side.normal;
        let range = 0.0..3.0;
        range.contains(&before.x) && range.contains(&before.z) && (0.0..1.0).contains(&before.y)
    });
}

#[test]
fn without_an_emitter_what_the_eye_sees_is_meshed() {
    let (low, high) = (Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 2.0, 1.0));
    // Open to any side, the scene is looked at through that side.
    for open in [Vec3::Z, Vec3::X, Vec3::NEG_X, Vec3::NEG_Z] {
        let obj = Obj::new().object("room", "white").room_open_to(open, low, high);
        let world =
            build(obj.object("box", "white").block(Vec3::new(-0.3, 0.5, -0.3), Vec3::new(0.3, 0.9, 0.3)).open());
        assert!(kinds(&world).contains(&FindingKind::NoEmitter));
        let middle = Vec3::new(0.0, 1.0, 0.0);
        let inside = sides(&world).into_iter().filter(|side| side.object == "room" && toward(middle)(side));
        for side in inside {
            assert!(side.is_meshed, "open to {open}: {} facing {}", side.center, side.normal);
        }
        assert_meshed(&world, "box", |side| !toward(Vec3::new(0.0, 0.7, 0.0))(side));
        assert!(world.viewpoint.eye.dot(open) > 1.0, "open to {open}: {:?}", world.viewpoint);
    }
}

#[test]
fn a_bare_floor_under_a_small_lamp_is_lit() {
    // One random ray in four thousand that leaves the floor meets the lamp.
    let obj = Obj::new().object("lamp", "lamp").level_down([-0.05, 0.05], 2.0, [-0.05, 0.05]);
    let world = build(obj.object("floor", "white").level([-5.0, 5.0], 0.0, [-5.0, 5.0]).open());
    assert_meshed(&world, "floor", |side| side.normal.y > 0.0);
}

#[test]
fn a_room_is_reached_by_the_last_of_very_many_lamps() {
    let mut obj = Obj::new().object("room", "white").room(Vec3::ZERO, Vec3::ONE).object("lamp", "lamp");
    for (i, j) in (0..5000).map(|k| (k % 100, k / 100)) {
        let at = |k: i32| 0.01 * k as f32;
        obj = obj.level_down([at(i), at(i) + 0.005], 0.9, [at(j), at(j) + 0.005]);
    }
    let (low, high) = (Vec3::new(3.0, 0.0, 0.0), Vec3::new(4.0, 1.0, 1.0));
    obj = obj.level_down([3.4, 3.6], 0.9, [0.4, 0.6]).object("other", "white").room(low, high);
    assert_meshed(&build(obj.open()), "other", toward(0.5 * (low + high)));
}

#[test]
fn nothing_depends_on_the_unit_of_length() {
    let scene = |scale: f32| {
        let obj = Obj::scaled(scale).object("room", "white").room_open_to(Vec3::Z, Vec3::NEG_ONE, Vec3::ONE);
        let obj = obj.object("box", "white").block(Vec3::new(-0.5, -1.0, -0.4), Vec3::new(0.1, -0.1, 0.3));
        let obj = obj.object("mat", "white").level([0.3, 0.7], -0.999, [0.2, 0.6]);
        // One lamp in the plane of the ceiling, and one that shines up under it.
        let obj = obj.object("lamp", "lamp").level_down([-0.3, 0.3], 1.0, [-0.3, 0.3]);
        obj.object("turned", "lamp").level([0.5, 0.8], 0.99, [0.5, 0.8]).open()
    };
    let facts = |scale: f32| {
        let world = build(scene(scale));
        let meshed: Vec<bool> = world.mesh.sides.iter().map(Option::is_some).collect();
        let exposed: Vec<f32> = world.mesh.elements.iter().map(|element| element.exposed).collect();
        (meshed, world.mesh.patches.len(), exposed, kinds(&world), world.is_closed())
    };
    let expected = facts(1.0);
    assert!(expected.3.contains(&FindingKind::EmitterMoved) && expected.3.contains(&FindingKind::EmitterTurned));
    for scale in [1e-6, 1e6] {
        let got = facts(scale);
        assert_eq!((&got.0, got.1, &got.3, got.4), (&expected.0, expected.1, &expected.3, expected.4), "{scale}");
        // Points at the very edge of what stands on a surface may fall on either side of it.
        let differing = got.2.iter().zip(&expected.2).filter(|(a, b)| (**a - **b).abs() > 1.0 / 16.0).count();
        assert!(got.2.len() == expected.2.len() && differing == 0, "{scale}: {differing}");
    }
}

#[test]
fn without_an_emitter_what_is_open_to_the_sky_is_meshed_and_the_inside_of_bodies_is_not() {
    let (low, high) = (Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 2.0, 1.0));
    let (box_low, box_high) = (Vec3::new(-0.3, 0.2, -0.3), Vec3::new(0.3, 0.9, 0.3));
    let middle = 0.5 * (box_low + box_high);
    // A room that is open to one side is lit within and without, and looked at through that side. What is shut into a box
    // in it is not lit.
    let obj = Obj::new().object("room", "white").room_open_to(Vec3::Z, low, high);
    let obj = obj.object("box", "white").block(box_low, box_high);
    let world = build(obj.object("core", "white").block(0.5 * (box_low + middle), 0.5 * (box_high + middle)).open());
    assert_meshed(&world, "box", |side| !toward(middle)(side));
    assert_meshed(&world, "core", |_| false);
    assert_meshed(&world, "room", |_| true);
    assert!(world.viewpoint.eye.z > 1.0, "{:?}", world.viewpoint);
    assert_eq!(world.census.unreached(), 6);
    // Both sides of an open plane, and the outside of a body.
    let world = build(Obj::new().object("floor", "white").level([-5.0, 5.0], 0.0, [-5.0, 5.0]).open());
    assert_meshed(&world, "floor", |_| true);
    let world = build(Obj::new().object("box", "white").block(low, high).open());
    assert_meshed(&world, "box", |side| !toward(Vec3::Y)(side));
    // With an emitter, its light alone counts.
    let obj = Obj::new().object("room", "white").room(low, high).object("lamp", "lamp");
    let world = build(obj.level_down([-0.2, 0.2], 1.9, [-0.2, 0.2]).open());
    assert_meshed(&world, "room", toward(Vec3::Y));
}
