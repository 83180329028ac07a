//! A view into a scene whose author left none.

use super::surface::{Place, Surfaces};
use crate::math::bounds::Bounds;
use crate::mesh::side_index;
use crate::scene::Viewpoint;
use crate::tracer::{Ray, Tracer};
use glam::{Quat, Vec3, Vec3A};
use std::f32::consts::TAU;

/// Angle of view from outside, degrees: that of a short telephoto lens, which keeps walls nearly parallel.
const OUTSIDE_FOV: f32 = 40.0;
/// Room around the scene, as a factor of its size.
const MARGIN: f32 = 1.06;
/// Angle of view inside a room, degrees: wide.
const INSIDE_FOV: f32 = 70.0;
/// At least this share of an outside view must see the lit side of something at first sight.
const OPEN_SHARE: f32 = 0.3;
/// Looks in one direction are a grid of this many rays across.
const GRID: usize = 16;
/// Places inside that are tried, and directions from each.
const INSIDE_PLACES: usize = 48;
const INSIDE_DIRECTIONS: usize = 8;

/// The view from outside in which most rays pass the middle of the scene before they meet something: into a room that
/// is open to one side, or down on a floor.
pub fn most_open(bounds: &Bounds, tracer: &Tracer) -> Viewpoint {
    let openness = |view: &Viewpoint| {
        let middle = view.eye.distance(view.target);
        rays(view).filter(|ray| tracer.closest(ray).is_some_and(|hit| hit.distance > middle)).count()
    };
    let judged = outside_views(bounds).map(|view| (openness(&view), view));
    // The first of several that are equally open: from the front.
    let best = judged.reduce(|best, next| if next.0 > best.0 { next } else { best });
    best.map_or_else(|| outside(bounds, Vec3::Z), |best| best.1)
}

/// The best view: from outside where the scene is open to that side, else from within. `is_reached` tells for each
/// side whether it is drawn; `rooms` are places that light reaches.
pub fn choose(
    bounds: &Bounds,
    surfaces: &Surfaces,
    tracer: &Tracer,
    is_reached: &[bool],
    rooms: &[Place],
) -> Viewpoint {
    let judge = Judge { surfaces, tracer, is_reached };
    let judged = outside_views(bounds).map(|view| (judge.open_share(&view), view));
    // The first of several that are equally good: from the front.
    let best = judged.reduce(|best, next| if next.0 > best.0 + 0.05 { next } else { best });
    match best {
        Some((share, view)) if share >= OPEN_SHARE || rooms.is_empty() => view,
        _ => inside(bounds, &judge, rooms),
    }
}

/// Views from all sides, the front first: level ones, and some from above.
fn outside_views(bounds: &Bounds) -> impl Iterator<Item = Viewpoint> {
    let tilted = |degrees: f32| Quat::from_rotation_y(degrees.to_radians()) * Vec3::new(0.0, 0.35, 1.0);
    let level = [Vec3::Z, Vec3::X, Vec3::NEG_X, Vec3::NEG_Z];
    let directions = level.into_iter().chain([30.0, -30.0, 150.0, 210.0].map(tilted));
    directions.map(|direction| outside(bounds, direction))
}

/// From this direction, as near as shows every corner of the box in a square picture.
fn outside(bounds: &Bounds, direction: Vec3) -> Viewpoint {
    let target = if bounds.is_empty() { Vec3::ZERO } else { bounds.center() };
    let backward = direction.normalize();
    let right = Vec3::Y.cross(backward).normalize();
    let up = backward.cross(right);
    let half = 0.5 * bounds.extent();
    let slope = (0.5 * OUTSIDE_FOV).to_radians().tan() / MARGIN;
    let corners = (0..8).map(|i| half * Vec3::new(sign(i & 1), sign(i & 2), sign(i & 4)));
    let needed = corners.map(|corner| corner.dot(backward) + corner.dot(right).abs().max(corner.dot(up).abs()) / slope);
    let distance = needed.fold(0.0, f32::max);
    let distance = if distance > 0.0 { distance } else { 1.0 };
    Viewpoint { eye: target + distance * backward, target, up: Vec3::Y, vertical_fov: OUTSIDE_FOV }
}

fn sign(bit: usize) -> f32 {
    if bit == 0 { -1.0 } else { 1.0 }
}

/// The widest view from the middle of the way between two places that light reaches one after the other.
fn inside(bounds: &Bounds, judge: &Judge, rooms: &[Place]) -> Viewpoint {
    let step = (rooms.len() / INSIDE_PLACES).max(1);
    let eyes = rooms.windows(2).step_by(step).map(|pair| pair[0].point.midpoint(pair[1].point));
    let views = eyes.flat_map(|eye| {
        (0..INSIDE_DIRECTIONS).map(move |i| {
            let turn = Quat::from_rotation_y(TAU * i as f32 / INSIDE_DIRECTIONS as f32);
            let eye = Vec3::from(eye);
            Viewpoint {
                eye,
                target: eye + bounds.radius() * (turn * Vec3::NEG_Z),
                up: Vec3::Y,
                vertical_fov: INSIDE_FOV,
            }
        })
    });
    let judged = views.map(|view| (judge.depth(&view, bounds.radius()), view));
    judged
        .reduce(|best, next| if next.0 > best.0 { next } else { best })
        .map_or_else(|| outside(bounds, Vec3::Z), |best| best.1)
}

/// Looks at the scene through a few rays.
struct Judge<'a> {
    surfaces: &'a Surfaces,
    tracer: &'a Tracer,
    is_reached: &'a [bool],
}

impl Judge<'_> {
    /// The share of rays through a square picture that meet the lit side of a surface at once.
    fn open_share(&self, view: &Viewpoint) -> f32 {
        let lit = rays(view).filter(|ray| {
            self.tracer.closest(ray).is_some_and(|hit| self.is_reached[side_index(hit.polygon, hit.is_front)])
        });
        lit.count() as f32 / (GRID * GRID) as f32
    }

    /// Mean distance seen, up to `limit` for each ray and 0 for one that sees nothing lit. Surfaces that are seen at a
    /// grazing angle count less: a view along a wall shows little.
    fn depth(&self, view: &Viewpoint, limit: f32) -> f32 {
        let seen = rays(view).map(|ray| match self.tracer.closest(&ray) {
            Some(hit) if self.is_reached[side_index(hit.polygon, hit.is_front)] => {
                let cosine = ray.direction.dot(self.surfaces.normal(side_index(hit.polygon, true))).abs();
                hit.distance.min(limit) * cosine.sqrt()
            }
            _ => 0.0,
        });
        seen.sum()
    }
}

/// Rays through the middles of the cells of a square picture.
fn rays(view: &Viewpoint) -> impl Iterator<Item = Ray> + use<> {
    let forward = (view.target - view.eye).normalize();
    let right = forward.any_orthogonal_vector().normalize();
    let right = forward.cross(view.up).try_normalize().unwrap_or(right);
    let up = right.cross(forward);
    let (eye, half) = (Vec3A::from(view.eye), (0.5 * view.vertical_fov).to_radians().tan());
    (0..GRID * GRID).map(move |i| {
        let at = |k: usize| half * (2.0 * (k as f32 + 0.5) / GRID as f32 - 1.0);
        let direction = forward + at(i % GRID) * right + at(i / GRID) * up;
        Ray::new(eye, direction.normalize().into())
    })
}
