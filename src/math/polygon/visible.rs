//! Form factors with what stands between, exact from each point: shadows are cut out of the polygon. As slow as it is
//! simple, it is what faster ways to see are measured against.

use super::gauss::GAUSS_3;
use super::{clip_above, point, vector_area};
use glam::DVec3;

/// A cell is halved at least and at most this often: a small shadow must not slip between the first points.
const MIN_DEPTH: u32 = 2;
const MAX_DEPTH: u32 = 9;

/// [`form_factor`](super::form_factor) from a point to that part of a convex polygon which is not behind one of the
/// occluders, planar convex polygons whose side does not matter.
pub fn visible_form_factor(point: DVec3, normal: DVec3, corners: &[DVec3], occluders: &[Vec<DVec3>]) -> f64 {
    let front = vector_area(corners);
    if front.dot(point - corners[0]) <= 0.0 {
        return 0.0;
    }
    let mut lit = vec![cut(corners, point, normal)];
    for occluder in occluders {
        // What is behind the polygon hides nothing of it.
        let before: Vec<DVec3> =
            cut(occluder, corners[0], front).iter().map(|corner| corner + corners[0] - point).collect();
        if let Some(shadow) = shadow(&before) {
            lit = lit.into_iter().flat_map(|part| outside(part, &shadow)).collect();
        }
    }
    let parts = lit.iter().filter(|part| part.len() >= 3);
    parts.map(|part| point::contour_sum(normal, part)).sum::<f64>().clamp(0.0, 1.0)
}

/// Form factor from a triangle or convex quad to what is seen of a convex polygon from each of its points. The integral
/// over the points is refined where that changes it, until it should be off by less than `tolerance`.
pub fn occluded_area_form_factor(from: &[DVec3], to: &[DVec3], occluders: &[Vec<DVec3>], tolerance: f64) -> f64 {
    let [a, b, c, d] = [from[0], from[1], from[2], from[from.len() - 1]];
    let (along, across, twist) = (b - a, d - a, a - b + c - d);
    let vector_area = vector_area(from);
    let normal = vector_area.normalize_or_zero();
    // The bilinear map of the unit square, and its density.
    let seen = |u: f64, v: f64| {
        let (du, dv) = (along + v * twist, across + u * twist);
        let density = du.cross(dv).dot(normal);
        density * visible_form_factor(a + u * along + v * dv, normal, to, occluders)
    };
    let area = vector_area.length();
    let whole = Cell { low: [0.0; 2], size: 1.0 };
    refine(&seen, whole, whole.integral(&seen), tolerance * area, 0) / area
}

/// A square part of the unit square.
#[derive(Clone, Copy)]
struct Cell {
    low: [f64; 2],
    size: f64,
}

impl Cell {
    fn integral(&self, f: &impl Fn(f64, f64) -> f64) -> f64 {
        let at = |x: f64, axis: usize| self.low[axis] + x * self.size;
        let products = GAUSS_3.iter().flat_map(|v| GAUSS_3.iter().map(move |u| (u, v)));
        let sum: f64 = products.map(|(u, v)| u.1 * v.1 * f(at(u.0, 0), at(v.0, 1))).sum();
        sum * self.size * self.size
    }

    fn quarters(&self) -> [Self; 4] {
        let size = 0.5 * self.size;
        [(0.0, 0.0), (size, 0.0), (0.0, size), (size, size)]
            .map(|(u, v)| Self { low: [self.low[0] + u, self.low[1] + v], size })
    }
}

/// The integral over a cell of which `coarse` is an estimate.
fn refine(f: &impl Fn(f64, f64) -> f64, cell: Cell, coarse: f64, tolerance: f64, depth: u32) -> f64 {
    let quarters = cell.quarters().map(|quarter| (quarter, quarter.integral(f)));
    let fine = quarters.iter().map(|(_, integral)| integral).sum::<f64>();
    if depth == MAX_DEPTH || (depth >= MIN_DEPTH && (fine - coarse).abs() <= tolerance) {
        return fine;
    }
    // Errors of cells at the edge of a shadow are of either sign: half of the tolerance for a quarter of the area is
    // enough.
    quarters.iter().map(|&(quarter, integral)| refine(f, quarter, integral, 0.5 * tolerance, depth + 1)).sum()
}

/// The part of a polygon on the positive side of a plane, relative to a point of the plane; empty if there is none.
fn cut(corners: &[DVec3], point: DVec3, normal: DVec3) -> Vec<DVec3> {
    if corners.len() < 3 {
        return Vec::new();
    }
    let mut clipped = vec![DVec3::ZERO; 2 * corners.len()];
    let count = clip_above(point, normal, corners, &mut clipped);
    clipped.truncate(count);
    clipped
}

/// Normals of the planes through the eye at the origin and each edge of a polygon, towards its inside; `None` if it is
/// seen edge-on or has no area.
fn shadow(corners: &[DVec3]) -> Option<Vec<DVec3>> {
    if corners.len() < 3 {
        return None;
    }
    let side = vector_area(corners).dot(corners[0]);
    let ends = corners.iter().cycle().skip(1);
    let planes = corners.iter().zip(ends).map(|(start, end)| side.signum() * start.cross(*end));
    (side != 0.0).then(|| planes.collect())
}

/// The convex parts of a convex polygon outside of a shadow.
fn outside(polygon: Vec<DVec3>, shadow: &[DVec3]) -> Vec<Vec<DVec3>> {
    let mut parts = Vec::new();
    let mut rest = polygon.clone();
    for &plane in shadow {
        parts.push(cut(&rest, DVec3::ZERO, -plane));
        rest = cut(&rest, DVec3::ZERO, plane);
        if rest.len() < 3 {
            // Nothing of it is in the shadow: leave it whole.
            return vec![polygon];
        }
    }
    parts.retain(|part| part.len() >= 3);
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polygon::{area_form_factor, form_factor};

    /// A square of this half side at height `height` that faces down.
    fn square(half: f64, height: f64) -> Vec<DVec3> {
        [(-half, -half), (-half, half), (half, half), (half, -half)].map(|(x, y)| DVec3::new(x, y, height)).into()
    }

    #[test]
    fn a_shadow_takes_away_what_the_occluder_covers() {
        let light = square(1.0, 1.0);
        let seen = |occluders: &[Vec<DVec3>]| visible_form_factor(DVec3::ZERO, DVec3::Z, &light, occluders);
        let whole = form_factor(DVec3::ZERO, DVec3::Z, &light);
        assert_eq!(seen(&[]), whole);
        // At half the height an occluder of half the size hides a square of the same outline.
        for half in [0.1, 0.25, 0.4] {
            let occluder = square(half, 0.5);
            let hidden = form_factor(DVec3::ZERO, DVec3::Z, &occluder);
            let turned: Vec<DVec3> = occluder.iter().rev().copied().collect();
            assert!((seen(std::slice::from_ref(&occluder)) - (whole - hidden)).abs() < 1e-14);
            assert!((seen(&[turned]) - (whole - hidden)).abs() < 1e-14);
            // Twice the same, and one behind the other, hide no more.
            assert!((seen(&[occluder.clone(), occluder, square(half, 0.6)]) - (whole - hidden)).abs() < 1e-14);
        }
        assert_eq!(seen(&[square(0.5, 0.5)]), 0.0);
        assert_eq!(seen(&[square(5.0, 1.1)]), whole);
        assert_eq!(seen(&[square(5.0, -0.1)]), whole);
    }

    #[test]
    fn an_occluder_through_the_polygon_hides_by_what_is_before_it() {
        // A wall from the eye's height up through the light at x = 0.2 hides what is beyond.
        let light = square(1.0, 1.0);
        let wall: Vec<DVec3> =
            [(-9.0, -1.0), (9.0, -1.0), (9.0, 3.0), (-9.0, 3.0)].map(|(y, z)| DVec3::new(0.2, y, z)).into();
        let left: Vec<DVec3> = light.iter().map(|corner| corner.min(DVec3::new(0.2, 9.0, 9.0))).collect();
        let got = visible_form_factor(DVec3::ZERO, DVec3::Z, &light, &[wall]);
        assert!((got - form_factor(DVec3::ZERO, DVec3::Z, &left)).abs() < 1e-14);
    }

    #[test]
    fn without_occluders_the_mean_over_points_is_that_of_the_contours() {
        let floor: Vec<DVec3> = square(0.5, 0.0).iter().rev().copied().collect();
        for (from, to) in [
            (floor.clone(), square(0.5, 0.5)),
            (floor[..3].to_vec(), square(0.5, 1.0)),
            (
                floor.clone(),
                [(-0.5, 0.0), (0.5, 0.0), (0.5, 1.0), (-0.5, 1.0)].map(|(y, z)| DVec3::new(-0.5, y, z)).into(),
            ),
        ] {
            let got = occluded_area_form_factor(&from, &to, &[], 1e-7);
            assert!((got - area_form_factor(&from, &to)).abs() < 1e-6, "{got}");
        }
    }

    #[test]
    fn a_screen_with_a_hole_passes_what_goes_through_the_hole() {
        // Four strips round a square hole between two squares: all that arrives has come through the hole. Seen from
        // the floor the hole is a polygon, and seen from the light as well, so no light that passes it is counted
        // twice.
        let (floor, light) = (square(0.5, 0.0).into_iter().rev().collect::<Vec<_>>(), square(5.0, 1.0));
        let strip = |low: [f64; 2], high: [f64; 2]| -> Vec<DVec3> {
            [(low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1])]
                .map(|(x, y)| DVec3::new(x, y, 0.2))
                .into()
        };
        let far = 50.0;
        let screen = [
            strip([-far, -far], [-0.1, far]),
            strip([0.1, -far], [far, far]),
            strip([-0.1, -far], [0.1, -0.1]),
            strip([-0.1, 0.1], [0.1, far]),
        ];
        // All lines from the floor through the hole end on the light: at height 1 they are within 0.5 + 5 · 0.6 of the
        // axis.
        let got = occluded_area_form_factor(&floor, &light, &screen, 1e-6);
        let through = area_form_factor(&floor, &square(0.1, 0.2));
        assert!((got - through).abs() < 1e-5, "{got} for {through}");
    }
}
