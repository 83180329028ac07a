//! What a point of a picture shows: a patch, a point of a surface, or a photon.

use super::Frame;
use super::photons::Passing;
use crate::camera::Camera;
use crate::math::polygon::vector_area;
use crate::mesh::Location;
use crate::solution::Photon;
use crate::tracer::{Hit, Ray};
use crate::world::World;
use glam::{DVec2, DVec3, Vec3, Vec3A};

/// A photon is picked from at most this far, pixels.
const REACH: f64 = 6.0;
/// What a photon may be behind a surface that is seen before it, as a share of its distance: it lies on that surface.
const ON_SURFACE: f32 = 1e-3;

/// The patch seen at a point of a picture, in pixels from its top left corner; `None` where there is none. As in the
/// picture, sides without a mesh hide nothing.
pub fn pick_patch(world: &World, camera: &Camera, at: [f32; 2], size: [u32; 2]) -> Option<u32> {
    let seen = seen_along(world, camera.ray(at, size))?;
    Some(world.mesh.elements[seen.location.element as usize].patch)
}

/// The point of a surface seen there and the unit normal on the side that is seen, likewise.
pub fn pick_point(world: &World, camera: &Camera, at: [f32; 2], size: [u32; 2]) -> Option<(Vec3, Vec3)> {
    let Seen { hit, point, .. } = seen_along(world, camera.ray(at, size))?;
    let polygon = &world.scene.polygons[hit.polygon as usize];
    let corner = |&corner: &u32| world.scene.positions[corner as usize].as_dvec3();
    let front = vector_area(&polygon.corners().iter().map(corner).collect::<Vec<_>>()).normalize_or_zero().as_vec3();
    Some((point.into(), if hit.is_front { front } else { -front }))
}

/// The index of the photon that `frame` shows nearest to a point of it, at most six pixels away.
pub fn pick_photon(world: &World, photons: &[Photon], frame: &Frame, at: [f32; 2]) -> Option<u32> {
    let [width, height] = frame.size.map(f64::from);
    let clip_from_world = frame.camera.clip_from_world((width / height) as f32);
    let at = DVec2::from(at.map(f64::from));
    let mut passing = Passing::new(&frame.filter);
    let mut near: Vec<(f64, usize)> = Vec::new();
    for (index, photon) in photons.iter().enumerate() {
        let clip = clip_from_world * photon.position.as_dvec3().extend(1.0);
        let place = 0.5 * DVec2::new(width * (1.0 + clip.x / clip.w), height * (1.0 - clip.y / clip.w));
        let distance = place.distance(at);
        if clip.w >= clip.z && distance <= REACH && passing.holds(photon) {
            near.push((distance, index));
        }
    }
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let seen = near.into_iter().find(|&(_, index)| is_seen(world, frame.camera.eye(), &photons[index]));
    seen.map(|(_, index)| index as u32)
}

/// Whether nothing hides a photon from the eye, and the side on which it landed faces it.
fn is_seen(world: &World, eye: DVec3, photon: &Photon) -> bool {
    let way = photon.position.as_dvec3() - eye;
    let ray = Ray::new(eye.as_vec3a(), way.normalize_or_zero().as_vec3a());
    let Some(Seen { hit, point, .. }) = seen_along(world, ray) else { return false };
    let behind = way.length() as f32 - (eye.as_vec3a() - point).length();
    let is_on_front = photon.side.is_multiple_of(2);
    behind < ON_SURFACE * way.length() as f32 && (hit.polygon != photon.side / 2 || hit.is_front == is_on_front)
}

/// What a ray sees first.
struct Seen {
    hit: Hit,
    point: Vec3A,
    location: Location,
}

fn seen_along(world: &World, mut ray: Ray) -> Option<Seen> {
    loop {
        let hit = world.tracer.closest(&ray)?;
        let point = ray.origin + hit.distance * ray.direction;
        if let Some(location) = world.mesh.locate(hit.polygon, hit.is_front, point) {
            return Some(Seen { hit, point, location });
        }
        // The next origin lies behind that side by twice what a hit is known to.
        let behind = hit.distance + 2.0 * world.tracer.offset();
        ray = Ray { origin: ray.origin + behind * ray.direction, ..ray };
    }
}
