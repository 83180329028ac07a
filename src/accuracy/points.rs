//! Where accuracy is measured: points spread by area over all sides that light reaches, the same for every mesh.

use crate::math::random::{PaddedPoint, hash};
use crate::mesh::Region;
use crate::world::{World, is_covered};
use glam::{Vec2, Vec3A};

/// Marks this use of (seed, index) among the others.
const PASS: u64 = 0x7072_6f62_6573;
/// So many points are tried for each that is found: where most of what is reached is covered, there are fewer.
const TRIES: usize = 16;

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbePoint {
    pub point: Vec3A,
    /// Unit normal of the side.
    pub normal: Vec3A,
}

/// A part of a side.
struct Triangle {
    region: Region,
    normal: Vec3A,
    /// Area of it and all before it, m².
    cumulative: f64,
}

/// `count` points, or fewer where next to nothing is exposed: low-discrepancy by area, but not where something stands on the
/// surface. A scene has always the same ones, and more of them begin with the fewer.
pub fn spread(world: &World, count: usize) -> Vec<ProbePoint> {
    let triangles = triangles(world);
    let Some(area) = triangles.last().map(|last| last.cumulative).filter(|area| *area > 0.0) else {
        return Vec::new();
    };
    let is_exposed = |found: &ProbePoint| {
        let hit = world.meet_at(found.point, found.normal);
        hit.is_some_and(|hit| !is_covered(&world.mesh, &world.tracer, hit.surface_point(), found.normal))
    };
    let at = |index: usize| {
        let [which, u, v, _] = PaddedPoint::new(hash(0, PASS, 0), index as u64).four(0);
        let along = f64::from(which) * area;
        let place = triangles.partition_point(|triangle| triangle.cumulative <= along).min(triangles.len() - 1);
        let triangle = &triangles[place];
        let point = triangle.region.sampler().point(Vec2::new(u, v));
        ProbePoint { point, normal: triangle.normal }
    };
    (0..TRIES * count).map(at).filter(is_exposed).take(count).collect()
}

/// Of all sides that are meshed, in their order.
fn triangles(world: &World) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    let mut cumulative = 0.0;
    for (index, side) in world.mesh.sides.iter().enumerate() {
        let Some(side) = side else { continue };
        let normal = world.mesh.patches[side.patches.start as usize].normal;
        let corners = world.scene.polygons[index / 2].corners();
        for pair in corners[1..].windows(2) {
            let [a, b, c] =
                [corners[0], pair[0], pair[1]].map(|corner| Vec3A::from(world.scene.positions[corner as usize]));
            cumulative += 0.5 * (b - a).cross(c - a).as_dvec3().length();
            triangles.push(Triangle { region: Region::new([a, b, c, c], 3), normal, cumulative });
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cancel::Cancel;
    use crate::mesh::MeshSettings;
    use crate::scene::Scene;
    use crate::tracer::Ray;

    fn world(name: &str) -> World {
        let scene = Scene::open(name).expect("a built-in scene");
        World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world")
    }

    #[test]
    fn a_wall_gets_points_by_its_area_and_all_are_seen_from_its_lit_side() {
        let world = world("furnace");
        let points = spread(&world, 600);
        assert_eq!(points.len(), 600);
        for normal in [Vec3A::X, Vec3A::NEG_X, Vec3A::Y, Vec3A::NEG_Y, Vec3A::Z, Vec3A::NEG_Z] {
            let on_wall: Vec<_> = points.iter().filter(|at| at.normal.dot(normal) > 0.99).collect();
            // A sixth of the numbers in [0, 1): of a Sobol sequence their count is right to one or two.
            assert!(on_wall.len().abs_diff(100) <= 2, "{normal}: {}", on_wall.len());
            let inwards = on_wall.iter().all(|at| (Vec3A::splat(0.5) - at.point).dot(at.normal) > 0.49);
            assert!(inwards, "{normal}");
        }
    }

    #[test]
    fn none_lies_under_what_stands_on_a_floor() {
        let world = world("cornell-box");
        // Blocks have no bottoms: under one, the inside of its top is straight ahead.
        for at in spread(&world, 2_000) {
            let ray = Ray::new(world.tracer.lift(at.point, at.normal), at.normal);
            let ahead = world.tracer.closest(&ray);
            assert!(at.normal.y < 0.9 || ahead.is_none_or(|hit| hit.is_front), "{at:?}");
        }
    }
}
