//! Planes of sides, and what they alone tell of who can see whom.

use super::surface::Surfaces;
use crate::math::polygon::{are_opposed, rounding_along};
use glam::{DVec3, Vec3A};

/// Where there are more pairs of sides than this to look at, two are taken to see each other: more would take longer
/// than a few thousandths of a second.
const MOST_PAIRS: usize = 1 << 17;

/// The plane of a side.
#[derive(Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit, on the side's own side.
    normal: DVec3,
    /// Distance from the origin along the normal, m.
    offset: f64,
}

impl Plane {
    pub fn new(surfaces: &Surfaces, side: usize) -> Self {
        let normal = surfaces.normal(side).as_dvec3();
        let corners = surfaces.corners_of(side / 2);
        let sum: f64 = corners.iter().map(|corner| corner.as_dvec3().dot(normal)).sum();
        Self { normal, offset: sum / corners.len() as f64 }
    }

    /// m
    pub fn height(&self, point: Vec3A) -> f64 {
        point.as_dvec3().dot(self.normal) - self.offset
    }

    /// Equal where planes are.
    pub fn key(&self) -> [u64; 4] {
        [self.normal.x, self.normal.y, self.normal.z, self.offset].map(|number| (number + 0.0).to_bits())
    }

    /// Whether a corner is before the plane by more than `tolerance`, m.
    fn faces(&self, corners: &[Vec3A], tolerance: f64) -> bool {
        corners.iter().any(|&corner| self.height(corner) > tolerance)
    }
}

/// False if no side of the first ones faces a side of the others that faces it, by more than `tolerance`, m. True if one may
/// see another: what stands between is not looked for, and of too many pairs not all are.
pub fn may_see(surfaces: &Surfaces, from: &[usize], to: &[usize], tolerance: f64) -> bool {
    any_faces(surfaces, from, to, |_, _| tolerance)
}

/// The same, but sides that face each other like parallel plates may do so across the smallest gap.
pub fn may_see_across_gaps(surfaces: &Surfaces, from: &[usize], to: &[usize], tolerance: f64) -> bool {
    any_faces(surfaces, from, to, |this, other| {
        let planes = [this, other].map(|side| Plane::new(surfaces, side));
        if !are_opposed(planes[0].normal, planes[1].normal) {
            return tolerance;
        }
        let corners = [this, other].map(|side| surfaces.corners_of(side / 2)).concat();
        rounding_along(planes[0].normal, corners.into_iter().map(|corner| corner.as_dvec3()))
    })
}

fn any_faces(surfaces: &Surfaces, from: &[usize], to: &[usize], tolerance: impl Fn(usize, usize) -> f64) -> bool {
    let mut pairs = 0;
    from.iter().any(|&this| {
        let plane = Plane::new(surfaces, this);
        to.iter().any(|&other| {
            let facing = Plane::new(surfaces, other);
            let tolerance = tolerance(this, other);
            pairs += 1;
            pairs > MOST_PAIRS
                || plane.faces(surfaces.corners_of(other / 2), tolerance)
                    && facing.faces(surfaces.corners_of(this / 2), tolerance)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    /// Two tiles of one floor: no side of one faces the other.
    #[test]
    fn of_more_pairs_than_there_is_time_for_two_are_taken_to_see_each_other() {
        let obj = "v 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv 2 0 0\nv 2 0 1\nf 1 2 3 4\nf 4 3 6 5\n";
        let scene = Scene::from_text("floor", obj, "").expect("a scene");
        let surfaces = Surfaces::new(&scene);
        let rows = 1 << 6;
        let [from, to] = [(0, rows), (2, MOST_PAIRS / rows)].map(|(side, count): (usize, usize)| vec![side; count]);
        assert!(!may_see(&surfaces, &from, &to, 0.0), "all pairs are looked at");
        assert!(may_see(&surfaces, &from, &[&to[..], &[2]].concat(), 0.0), "and no pair more");
    }
}
