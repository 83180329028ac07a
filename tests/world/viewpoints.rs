//! Where the camera stands in a scene whose author says nothing of it.

use crate::obj::Obj;
use crate::shapes::{Triangles, cube, placed, sphere};
use crate::{build, builtin, kinds};
use glam::{Vec3, Vec3A};
use lightwell::scene::BUILTINS;
use lightwell::tracer::Ray;
use lightwell::world::World;

/// A room that is open to the front, with a lamp right under its ceiling: the shape of the Cornell boxes that are passed
/// around as OBJ files.
fn box_with(things: impl Fn(Obj) -> Obj) -> World {
    let (low, high) = (Vec3::new(-1.0, 0.0, -1.04), Vec3::new(1.0, 1.99, 0.99));
    let obj = things(Obj::new()).object("room", "white").room_open_to(Vec3::Z, low, high);
    build(obj.object("light", "lamp").level_down([-0.24, 0.23], 1.98, [-0.22, 0.16]).open())
}

fn ball(radius: f32, center: Vec3) -> Triangles {
    placed(&sphere(3), radius, center / radius)
}

/// What the middle of the picture shows: whether it is a meshed side, and how far away.
fn first_sight(world: &World) -> (bool, f32) {
    let view = world.viewpoint;
    let ray = Ray::new(view.eye.into(), Vec3A::from(view.target - view.eye).normalize());
    let hit = world.tracer.closest(&ray).expect("the scene is in sight");
    (world.mesh.side(hit.polygon, hit.is_front).is_some(), hit.distance)
}

#[test]
fn an_open_box_is_looked_into_from_the_front() {
    let blocks = |obj: Obj| {
        let obj = obj.object("short", "white").block(Vec3::new(0.0, 0.0, 0.1), Vec3::new(0.6, 0.6, 0.7));
        obj.object("tall", "white").block(Vec3::new(-0.7, 0.0, -0.6), Vec3::new(-0.1, 1.2, 0.0))
    };
    let balls = |obj: Obj| {
        let obj = obj.object("left", "white").triangles(&ball(0.4, Vec3::new(-0.45, 0.41, -0.3)));
        obj.object("right", "white").triangles(&ball(0.4, Vec3::new(0.45, 0.41, 0.3)))
    };
    let ball_and_block = |obj: Obj| {
        let block = placed(&cube(2), 0.3, Vec3::new(-1.0, 1.8, -1.0));
        let obj = obj.object("short", "white").triangles(&block);
        obj.object("ball", "white").triangles(&ball(0.3, Vec3::new(0.5, 0.31, 0.3)))
    };
    for world in [box_with(|obj| obj), box_with(blocks), box_with(balls), box_with(ball_and_block)] {
        assert_eq!(kinds(&world), []);
        let view = world.viewpoint;
        assert!(view.eye.z > world.bounds.max.z && view.target == world.bounds.center(), "{view:?}");
        assert!((view.eye - view.target).normalize().z > 0.99, "from the front: {view:?}");
        assert!(first_sight(&world).0);
    }
}

#[test]
fn a_box_that_is_open_elsewhere_is_looked_into_from_there() {
    for open in [Vec3::X, Vec3::NEG_X, Vec3::NEG_Z] {
        let obj = Obj::new().object("room", "white").room_open_to(open, Vec3::NEG_ONE, Vec3::ONE);
        let world = build(obj.object("light", "lamp").level_down([-0.2, 0.2], 0.98, [-0.2, 0.2]).open());
        assert!(world.viewpoint.eye.dot(open) > 1.0, "open to {open}: {:?}", world.viewpoint);
        assert!(first_sight(&world).0);
    }
}

#[test]
fn a_closed_room_is_looked_at_from_within() {
    let plan = ["L...", "....", "###.", "L..."];
    for obj in [Obj::new().object("cube", "glow").room(Vec3::ZERO, Vec3::ONE), Obj::new().floor_plan(&plan)] {
        let world = build(obj.open());
        let eye = world.viewpoint.eye;
        assert!(eye.cmpgt(world.bounds.min).all() && eye.cmplt(world.bounds.max).all(), "{eye}");
        let (is_meshed, distance) = first_sight(&world);
        assert!(is_meshed && distance > 0.25, "{distance}");
    }
}

#[test]
fn built_in_scenes_keep_the_view_that_they_state() {
    for scene in BUILTINS {
        let world = build(builtin(scene.name));
        assert_eq!(Some(world.viewpoint), scene.viewpoint, "{}", scene.name);
        assert!(first_sight(&world).0, "{}", scene.name);
    }
}
