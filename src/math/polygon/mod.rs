//! Integrals over planar polygons, in double precision: areas and form factors.
//!
//! [`form_factor`] is that of a point, [`area_form_factor`] the one between two areas, both in closed form; [`Plate`]s
//! are made ready for many pairs. What [`visible_form_factor`] counts is in sight. [`known`] has the form factors of a
//! few shapes, to test by.

mod contour;
mod gauss;
pub mod known;
mod plate;
mod point;
mod visible;

pub use contour::area_form_factor;
pub use known::parallel_rectangles;
pub use plate::Plate;
pub use point::{MAX_CORNERS, form_factor};
pub use visible::{occluded_area_form_factor, visible_form_factor};

use glam::DVec3;

/// Area times unit normal; corners run counter-clockwise round the normal (Newell's method, kept near the origin by
/// measuring from the first corner).
pub fn vector_area(corners: &[DVec3]) -> DVec3 {
    let first = corners[0];
    corners.windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first)).sum::<DVec3>() * 0.5
}

/// Whether these unit normals point at each other as those of parallel plates, between which there may be next to nothing, do.
pub fn are_opposed(one: DVec3, other: DVec3) -> bool {
    one.dot(other) < -0.5
}

/// How far points with these coordinates, in single precision, are off along a unit normal, m, at most: heights of less may be
/// rounding. It is 0 along an axis in whose direction all coordinates are 0.
pub fn rounding_along(normal: DVec3, corners: impl IntoIterator<Item = DVec3>) -> f64 {
    // Each corner of two polygons, the normal itself, and the difference of two corners.
    const ROUNDINGS: f64 = 4.0;
    let largest = corners.into_iter().fold(DVec3::ZERO, |largest, corner| largest.max(corner.abs()));
    ROUNDINGS * f64::from(f32::EPSILON) * normal.abs().dot(largest)
}

/// Copies the part of a convex polygon on the positive side of the plane through `point` into `clipped`, relative to
/// `point`, and returns its number of corners (Sutherland, Hodgman 1974). One plane adds at most one corner; where all
/// corners are in the plane but for rounding there may be up to twice as many.
fn clip_above(point: DVec3, normal: DVec3, corners: &[DVec3], clipped: &mut [DVec3]) -> usize {
    let mut count = 0;
    let mut from = corners[corners.len() - 1] - point;
    let mut from_height = normal.dot(from);
    for &corner in corners {
        let to = corner - point;
        let to_height = normal.dot(to);
        if (from_height < 0.0) != (to_height < 0.0) {
            clipped[count] = from + (to - from) * (from_height / (from_height - to_height));
            count += 1;
        }
        if to_height >= 0.0 {
            clipped[count] = to;
            count += 1;
        }
        (from, from_height) = (to, to_height);
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vector_area_keeps_its_digits_far_from_the_origin() {
        let square = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let far = square.map(|corner| corner + DVec3::splat(1e8));
        assert!((vector_area(&far) - DVec3::NEG_Z).length() < 1e-7);
    }
}
