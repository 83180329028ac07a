//! Scan conversion of polygons onto the faces of a hemicube, with a depth test.
//!
//! In homogeneous coordinates (Olano, Greer 1997) a polygon is the cone of directions in which it is seen, and each of
//! its edges is the plane through the eye and that edge: a linear function of the direction, and so is one over the
//! depth. A cell belongs to a polygon if its middle is inside of all edges. Nothing has to be clipped: what reaches
//! below the horizon or behind the eye is outside of the cone. Clipping only narrows down which cells to look at.
//!
//! Polygons with a common edge compute the same function for it but for its sign, and zero is inside of both: there is
//! no gap between them. A middle that both cover takes the nearer, of equals the first; no cell counts twice.

use crate::solution::ItemBuffer;
use glam::DVec3;

/// By this share a polygon that is seen from behind is farther than it is, so that where two sides of a polygon are two
/// polygons, the one that faces the eye is seen. It is well above the rounding of corners in single precision.
const BEHIND: f64 = 1.0 / 65536.0;
/// Window edges are moved outwards by this share of a cell: more than their rounding.
const SLACK: f64 = 1e-6;

/// A polygon as the eye at the origin sees it, above the horizon z = 0.
pub struct Seen {
    corners: [DVec3; 4],
    /// Linear functions of the direction, none of which is negative where the polygon is seen.
    edges: [DVec3; 4],
    /// A linear function of the direction: one over the multiple of it that ends on the polygon.
    nearness: DVec3,
    id: u32,
}

impl Seen {
    /// `None` for what is below the horizon or seen edge-on.
    pub fn new(corners: [DVec3; 4], id: u32) -> Option<Self> {
        if corners.iter().all(|corner| corner.z <= 0.0) {
            return None;
        }
        let [a, b, c, d] = corners;
        let normal = (c - a).cross(d - b);
        // Six times the volume between the eye and the polygon; negative where the polygon faces the eye.
        let volume = normal.dot(a);
        let sign = -volume.signum();
        let nearness = normal / volume;
        if !nearness.is_finite() {
            return None;
        }
        let faces_away = volume > 0.0;
        Some(Self {
            corners,
            edges: [b.cross(a), c.cross(b), d.cross(c), a.cross(d)].map(|edge| sign * edge),
            nearness: if faces_away { nearness * (1.0 - BEHIND) } else { nearness },
            id: if faces_away { ItemBuffer::NOTHING } else { id },
        })
    }
}

/// A side of the hemicube, or half of its top: `resolution` cells across and half as many up.
pub struct Band<'a> {
    pub resolution: usize,
    /// 0 for the top, then the sides towards x, y, −x, −y.
    pub face: u32,
    /// Height of its lower edge: −1 for the lower half of the top, 0 for all others.
    pub bottom: f64,
    pub items: &'a mut [u32],
    pub nearness: &'a mut [f32],
}

/// First and last column, first and last row.
type Window = [usize; 4];

impl Band<'_> {
    pub fn draw(&mut self, polygons: &[Option<Seen>]) {
        for polygon in polygons.iter().flatten() {
            let corners = polygon.corners.map(|corner| turn(self.face, corner));
            if let Some(window) = self.window(corners) {
                self.fill(polygon, window);
            }
        }
    }

    fn fill(&mut self, polygon: &Seen, [left, right, low, high]: Window) {
        let size = 2.0 / self.resolution as f64;
        let edges = polygon.edges.map(|edge| turn(self.face, edge));
        let plane = turn(self.face, polygon.nearness);
        for row in low..=high {
            let up = (row as f64 + 0.5) * size + self.bottom;
            let at_row = |function: DVec3| function.y * up + function.z;
            let starts = edges.map(at_row);
            let plane_start = at_row(plane);
            let cells = row * self.resolution + left..=row * self.resolution + right;
            let row = self.items[cells.clone()].iter_mut().zip(&mut self.nearness[cells]);
            for (column, (item, nearest)) in (left..).zip(row) {
                let across = (column as f64 + 0.5) * size - 1.0;
                let inside = edges.iter().zip(starts).all(|(edge, start)| edge.x * across + start >= 0.0);
                let nearness = (plane.x * across + plane_start) as f32;
                if inside && nearness > *nearest {
                    *nearest = nearness;
                    *item = polygon.id;
                }
            }
        }
    }

    /// The cells whose middles may lie in a polygon with these corners in the face's axes.
    fn window(&self, corners: [DVec3; 4]) -> Option<Window> {
        let planes = [
            DVec3::new(1.0, 0.0, 1.0),
            DVec3::new(-1.0, 0.0, 1.0),
            DVec3::new(0.0, 1.0, -self.bottom),
            DVec3::new(0.0, -1.0, 1.0 + self.bottom),
        ];
        if planes.iter().any(|plane| corners.iter().all(|corner| plane.dot(*corner) < 0.0)) {
            return None;
        }
        if corners.iter().all(|corner| corner.z > 0.0) {
            return self.window_round(&corners);
        }
        let (mut polygon, mut count) = ([DVec3::ZERO; 8], 4);
        polygon[..4].copy_from_slice(&corners);
        for plane in planes {
            (polygon, count) = clip(&polygon[..count], plane);
        }
        self.window_round(&polygon[..count])
    }

    /// The cells whose middles may lie between the projections of these points, cut to the band.
    fn window_round(&self, points: &[DVec3]) -> Option<Window> {
        let cells = self.resolution as f64 / 2.0;
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for &point in points {
            let projected = point / point.z;
            (low, high) = (low.min(projected), high.max(projected));
        }
        let first = |edge: f64| (edge * cells - 0.5 - SLACK).ceil().max(0.0) as usize;
        let last = |edge: f64, count: usize| ((edge * cells - 0.5 + SLACK).floor()).min(count as f64 - 1.0);
        let (right, up) = (last(high.x + 1.0, self.resolution), last(high.y - self.bottom, self.resolution / 2));
        let (left, down) = (first(low.x + 1.0), first(low.y - self.bottom));
        (right >= left as f64 && up >= down as f64).then_some([left, right as usize, down, up as usize])
    }
}

/// A vector in a face's axes: across, up, and out of the hemicube. Seen from outside, `across` points to the right.
#[inline(always)]
fn turn(face: u32, v: DVec3) -> DVec3 {
    match face {
        0 => v,
        1 => DVec3::new(v.y, v.z, v.x),
        2 => DVec3::new(-v.x, v.z, v.y),
        3 => DVec3::new(-v.y, v.z, -v.x),
        _ => DVec3::new(v.x, v.z, -v.y),
    }
}

/// The part of a convex polygon on the positive side of a plane through the eye (Sutherland, Hodgman 1974); each of
/// four planes adds at most one corner to four.
fn clip(corners: &[DVec3], plane: DVec3) -> ([DVec3; 8], usize) {
    let (mut clipped, mut count) = ([DVec3::ZERO; 8], 0);
    let Some(&last) = corners.last() else { return (clipped, 0) };
    let mut from = last;
    for &to in corners {
        let (before, after) = (plane.dot(from), plane.dot(to));
        if (before < 0.0) != (after < 0.0) {
            clipped[count] = from + (to - from) * (before / (before - after));
            count += 1;
        }
        if after >= 0.0 {
            clipped[count] = to;
            count += 1;
        }
        from = to;
    }
    (clipped, count)
}
