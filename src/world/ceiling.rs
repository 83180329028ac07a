//! A place for the ceiling light of scenes that have none.

use super::triangles;
use crate::scene::Scene;
use crate::tracer::{Ray, Tracer};
use glam::Vec3A;

/// Slabs above each other through which a free place is looked for.
const SLABS: usize = 8;

/// The scene with a ceiling light, if it has no emitter: under the top of the scene, or, where that is inside of a roof
/// with a thickness, under the roof.
pub fn with_ceiling_light(scene: &Scene) -> Scene {
    let tracer = Tracer::new(&triangles(scene));
    let mut lit = scene.with_ceiling_light();
    for _ in 0..SLABS {
        let Some(underside) = underside_of_solid(&tracer, newest_center(&lit)).filter(|_| !scene.has_emitter()) else {
            break;
        };
        lit = scene.with_ceiling_light_under(underside);
    }
    lit
}

/// The centre of the polygon that was added last.
fn newest_center(scene: &Scene) -> Vec3A {
    let corners = scene.polygons.last().map_or(&[][..], |polygon| polygon.corners());
    corners.iter().map(|&corner| Vec3A::from(scene.positions[corner as usize])).sum::<Vec3A>() / corners.len() as f32
}

/// The height at which the solid round a point ends below it, m; `None` if the point is in the open. In a solid one sees
/// only backs.
fn underside_of_solid(tracer: &Tracer, point: Vec3A) -> Option<f32> {
    let look = |direction: Vec3A| tracer.closest(&Ray::new(point, direction)).filter(|hit| !hit.is_front);
    look(Vec3A::Y)?;
    look(Vec3A::NEG_Y).map(|hit| point.y - hit.distance)
}
