//! The world that is made of a scene: which sides are meshed, how emitters are mended, where the camera stands.

mod elements;
mod emitters;
mod exposure;
mod junctions;
mod obj;
mod occluders;
mod probe;
#[path = "../common/shapes.rs"]
mod shapes;
mod sides;
mod slivers;
mod viewpoints;

use glam::{Vec3, Vec3A};
use lightwell::cancel::Cancel;
use lightwell::mesh::MeshSettings;
use lightwell::scene::{FindingKind, Scene};
use lightwell::world::World;

/// A world with a mesh of the default fineness.
fn build(scene: Scene) -> World {
    World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world")
}

/// A world with elements of this size.
fn build_with(scene: Scene, element_size: f32) -> World {
    let settings = MeshSettings { element_size: Some(element_size), ..MeshSettings::default() };
    World::build(scene, &settings, &Cancel::default()).expect("a world")
}

fn builtin(name: &str) -> Scene {
    Scene::open(name).expect("a built-in scene")
}

/// Kinds of what was found, in order.
fn kinds(world: &World) -> Vec<FindingKind> {
    world.scene.findings.iter().map(|finding| finding.kind).collect()
}

/// A side of a polygon.
struct Side {
    object: String,
    center: Vec3,
    /// On the side's own side.
    normal: Vec3,
    is_meshed: bool,
}

/// Every side of every polygon.
fn sides(world: &World) -> Vec<Side> {
    let scene = &world.scene;
    let side = |(index, is_front): (usize, bool)| {
        let polygon = &scene.polygons[index];
        let corners: Vec<Vec3> = polygon.corners().iter().map(|&corner| scene.positions[corner as usize]).collect();
        let front = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        Side {
            object: scene.objects[polygon.object as usize].clone(),
            center: corners.iter().sum::<Vec3>() / corners.len() as f32,
            normal: if is_front { front } else { -front },
            is_meshed: world.mesh.side(index as u32, is_front).is_some(),
        }
    };
    (0..scene.polygons.len()).flat_map(|index| [(index, true), (index, false)]).map(side).collect()
}

/// Asserts that of the objects with this name exactly those sides are meshed that should be.
fn assert_meshed(world: &World, object: &str, should_be: impl Fn(&Side) -> bool) {
    let sides: Vec<Side> = sides(world).into_iter().filter(|side| side.object == object).collect();
    assert!(!sides.is_empty(), "there is no {object}");
    for side in sides {
        assert_eq!(side.is_meshed, should_be(&side), "{object} at {} facing {}", side.center, side.normal);
    }
}

/// Index of the element that holds a point of a surface with this normal.
fn element_at(world: &World, point: Vec3, normal: Vec3) -> usize {
    let point = Vec3A::from(point);
    let origin = point + Vec3A::from(normal) * 1e-3 * world.bounds.radius();
    let ray = lightwell::tracer::Ray::new(origin, -Vec3A::from(normal));
    let hit = world.tracer.closest(&ray).expect("a surface");
    world.mesh.locate(hit.polygon, hit.is_front, point).expect("a meshed side").element as usize
}
