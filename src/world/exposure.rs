//! How much of each element light can reach.
//!
//! Where a block stands on a floor, some elements of the floor are under it, and some only in part. The covered part
//! belongs to no surface that anyone sees; if it took part in means, the floor would be dark along the foot of the block
//! and light would creep under it.

use crate::cancel::{Cancel, Cancelled};
use crate::mesh::{Element, Mesh};
use crate::tracer::{Ray, SurfacePoint, Tracer};
use glam::{Vec2, Vec3A};
use rayon::prelude::*;

/// An element whose first five points do not agree is looked at through a grid of this many points across.
const GRID: u32 = 8;
/// Where the first points lie, as a share of the way from a corner to the centre.
const INSET: f32 = 0.02;

/// Whether a point of a surface with this unit normal is where light cannot be: straight ahead is a side that nothing
/// reaches. From a point that light reaches, no such side can be seen.
pub fn is_covered(mesh: &Mesh, tracer: &Tracer, point: SurfacePoint, normal: Vec3A) -> bool {
    let ahead = tracer.closest(&Ray::leaving(point, normal));
    ahead.is_some_and(|hit| mesh.side(hit.polygon, hit.is_front).is_none())
}

/// The exposed share of every element, in [0, 1].
///
/// # Errors
/// If cancelled.
pub fn shares(mesh: &Mesh, tracer: &Tracer, cancel: &Cancel) -> Result<Vec<f32>, Cancelled> {
    if mesh.sides.iter().all(Option::is_some) {
        return Ok(vec![1.0; mesh.elements.len()]);
    }
    let unless_cancelled =
        |element| if cancel.is_requested() { Err(Cancelled) } else { Ok(share(mesh, tracer, element)) };
    mesh.elements.par_iter().map(unless_cancelled).collect()
}

fn share(mesh: &Mesh, tracer: &Tracer, element: &Element) -> f32 {
    let patch = &mesh.patches[element.patch as usize];
    let region = mesh.region(element);
    let corners = region.corners();
    let is_exposed = |point: Vec3A| !is_covered(mesh, tracer, patch.surface_point(point), patch.normal);
    let inset = corners.iter().map(|corner| corner.lerp(element.center, INSET));
    let first = inset.chain([element.center]).filter(|&point| is_exposed(point)).count();
    if first == 0 || first == corners.len() + 1 {
        return if first == 0 { 0.0 } else { 1.0 };
    }
    let at = |i: u32| (i as f32 + 0.5) / GRID as f32;
    let cells = (0..GRID).flat_map(|i| (0..GRID).map(move |j| Vec2::new(at(i), at(j))));
    cells.filter(|&cell| is_exposed(region.point(cell))).count() as f32 / (GRID * GRID) as f32
}
