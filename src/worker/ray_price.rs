//! What a ray costs in a world on this machine.

use crate::math::random::Stream;
use crate::math::warp::{cosine_hemisphere, frame};
use crate::scene::Polygon;
use crate::tracer::Ray;
use crate::world::World;
use glam::Vec3A;
use rayon::prelude::*;
use std::time::Instant;

/// Some milliseconds where rays are slow.
const RAYS: u64 = 4096;
/// The first time, threads wake up and caches fill.
const ROUNDS: usize = 3;
/// Marks this use of (seed, pass) among the others.
const PASS: u64 = 0x7072_6963_6500;

/// About what a ray takes by itself if all threads trace, s: by timing some thousand rays from the middles of polygons to what
/// they meet first. Whoever traces a ray for some purpose has to choose it, too, and to make something of it; and one that
/// only asks whether anything is in the way takes less.
pub fn seconds_per_ray(world: &World) -> f64 {
    let polygons = &world.scene.polygons;
    if polygons.is_empty() {
        return 0.0;
    }
    let middle = |polygon: &Polygon| {
        let corners = polygon.corners();
        let sum: Vec3A = corners.iter().map(|&corner| Vec3A::from(world.scene.positions[corner as usize])).sum();
        sum / corners.len() as f32
    };
    let meets = |index: u64| {
        let mut stream = Stream::new(0, PASS, index);
        let origin = middle(&polygons[stream.bits() as usize % polygons.len()]);
        let towards = (Vec3A::from(world.bounds.center()) - origin).normalize_or(Vec3A::Y);
        let direction = frame(towards) * cosine_hemisphere(stream.uniform2());
        world.tracer.closest(&Ray::new(world.tracer.lift(origin, towards), direction)).is_some()
    };
    let round = |_| {
        let start = Instant::now();
        std::hint::black_box((0..RAYS).into_par_iter().filter(|&index| meets(index)).count());
        start.elapsed().as_secs_f64() / RAYS as f64
    };
    (0..ROUNDS).map(round).fold(f64::INFINITY, f64::min)
}
