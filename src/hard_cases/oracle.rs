//! Brute force in double precision: means over many points.

use crate::math::polygon::form_factor;
use glam::DVec3;

/// Points along each edge of a rectangle.
const POINTS: usize = 256;

/// Mean form factor from the points of a rectangle, its front where its corners run counter-clockwise, to a polygon. The
/// midpoint rule errs by less than 1e-5 where the two are no nearer to each other than a tenth of an edge.
pub fn mean_form_factor([a, b, c, d]: [DVec3; 4], to: &[DVec3]) -> f64 {
    let normal = (b - a).cross(d - a).normalize();
    let at = |i: usize| (i as f64 + 0.5) / POINTS as f64;
    let points = (0..POINTS * POINTS).map(|i| {
        let (u, v) = (at(i % POINTS), at(i / POINTS));
        a.lerp(b, u).lerp(d.lerp(c, u), v)
    });
    points.map(|point| form_factor(point, normal, to)).sum::<f64>() / (POINTS * POINTS) as f64
}
