//! Faces of any size cut into triangles and planar convex quads, with their winding kept.
//!
//! All measures are relative, so a scene scaled by 1e-6 or 1e6 is cut in the same way.

use earcut::Earcut;
use glam::{DVec3, Vec3};

/// How far the corners of a quad may be apart along its normal, in units of its largest coordinate.
///
/// A quad is sampled on the bilinear surface through its corners and traced as two triangles. Between the two lies at
/// most half of this distance: 8 ε, well inside the 32 ε by which ray origins are moved off a surface, so no
/// sample of the quad is hidden behind its own triangles. It also is what rounding to single precision, or to
/// six decimals in a scene of a few metres, does to a flat quad. Anything more is cut into two triangles.
const PLANARITY: f64 = 16.0 * f32::EPSILON as f64;

/// A piece whose area is below this share of its longest edge squared has no usable normal.
const DEGENERATE: f64 = 1.0 / (1 << 20) as f64;

/// Smallest sine of a corner of a quad that is kept: below it three corners count as lying on a line.
const SMALLEST_CORNER: f64 = 1e-3;

/// What a face looked like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    Planar,
    /// Its corners are apart along its normal by this share of its size.
    Warped(f64),
    /// Its outline crosses itself.
    Crossed,
    /// It has no area; nothing was made of it.
    Degenerate,
}

/// The places in a face's list of corners without those that repeat the one before, in the sense of a ring.
pub fn without_repeated_corners(corners: &[u32]) -> Vec<usize> {
    let mut ring: Vec<usize> = (0..corners.len()).collect();
    ring.dedup_by_key(|place| corners[*place]);
    while ring.len() > 1 && corners[ring[0]] == corners[ring[ring.len() - 1]] {
        ring.pop();
    }
    ring
}

/// Cuts a face and hands each piece, as three or four places in its list of corners, to `emit`.
///
/// A triangle, and a quad that is planar and convex, stay whole. Another quad is cut along the diagonal that leaves
/// the larger smallest piece. A face of more corners is triangulated by ear clipping. Its normal is Newell's
/// (Sutherland, Sproull, Schumacker 1974).
pub fn polygonize(positions: &[Vec3], corners: &[u32], emit: &mut impl FnMut(&[usize])) -> Shape {
    let Some(face) = Face::new(positions, corners) else { return Shape::Degenerate };
    let shape = face.shape();
    let triangles = match corners.len() {
        3 => vec![[0, 1, 2]],
        4 if shape == Shape::Planar && face.is_convex_quad() => {
            emit(&[0, 1, 2, 3]);
            return shape;
        }
        4 => face.cut_quad(),
        _ => face.clip_ears(),
    };
    let mut covered = 0.0;
    for triangle in triangles {
        covered += face.signed_area(triangle).abs();
        if !face.is_sliver(triangle) {
            emit(&triangle);
        }
    }
    // Triangles that overlap or face backwards cover more than the outline encloses.
    if (covered - face.area).abs() > 1e-3 * face.area { Shape::Crossed } else { shape }
}

/// A face with its first corner at the origin. Differences of single-precision coordinates are exact in double precision
/// (unless they differ by a factor of 2²⁹), so nothing about it is rounded yet.
struct Face {
    points: Vec<DVec3>,
    normal: DVec3,
    area: f64,
    /// Distance of the farthest corner from the first one.
    size: f64,
    /// Largest coordinate in the scene's frame.
    largest_coordinate: f64,
}

impl Face {
    /// `None` where the face has no area.
    fn new(positions: &[Vec3], corners: &[u32]) -> Option<Self> {
        let mut points: Vec<DVec3> = corners.iter().map(|&corner| positions[corner as usize].as_dvec3()).collect();
        let largest_coordinate = points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let origin = *points.first()?;
        points.iter_mut().for_each(|point| *point -= origin);
        let double_area: DVec3 = edges(&points).map(|(from, to)| from.cross(to)).sum();
        (double_area.length() > DEGENERATE * longest_edge_squared(&points)).then(|| Self {
            normal: double_area.normalize(),
            area: 0.5 * double_area.length(),
            size: points.iter().map(|p| p.length()).fold(0.0, f64::max),
            largest_coordinate,
            points,
        })
    }

    fn shape(&self) -> Shape {
        let heights = self.points.iter().map(|p| p.dot(self.normal));
        let (low, high) = heights.fold((0.0, 0.0), |(low, high): (f64, f64), h| (low.min(h), high.max(h)));
        let is_planar = high - low <= PLANARITY * self.largest_coordinate;
        if is_planar { Shape::Planar } else { Shape::Warped((high - low) / self.size) }
    }

    fn is_convex_quad(&self) -> bool {
        (0..4).all(|corner| {
            let point = self.points[corner];
            let (incoming, outgoing) = (point - self.points[(corner + 3) % 4], self.points[(corner + 1) % 4] - point);
            let sine = incoming.normalize().cross(outgoing.normalize()).dot(self.normal);
            sine >= SMALLEST_CORNER
        })
    }

    fn cut_quad(&self) -> Vec<[usize; 3]> {
        let cuts = [[[0, 1, 2], [0, 2, 3]], [[1, 2, 3], [1, 3, 0]]];
        let [first, second] = cuts.map(|[a, b]| self.signed_area(a).min(self.signed_area(b)));
        // Where both diagonals are as good, rounding must not decide: a scaled copy of the quad is cut alike.
        let best = if second > first + 1e-6 * self.area { cuts[1] } else { cuts[0] };
        best.to_vec()
    }

    /// Triangulates the face as it is seen along the axis nearest to its normal. This rounds nothing, so corners in the
    /// middle of a straight edge stay exactly there, and none is left out.
    fn clip_ears(&self) -> Vec<[usize; 3]> {
        let axis = self.normal.abs().max_position();
        let (x, y) = ((axis + 1) % 3, (axis + 2) % 3);
        let (x, y) = if self.normal[axis] > 0.0 { (x, y) } else { (y, x) };
        let mut corners: Vec<u32> = Vec::new();
        Earcut::new().earcut(self.points.iter().map(|p| [p[x], p[y]]), &[], &mut corners);
        corners.chunks_exact(3).map(|t| [t[0] as usize, t[1] as usize, t[2] as usize]).collect()
    }

    /// Area seen against the face's normal; negative where the triangle winds the other way.
    fn signed_area(&self, [a, b, c]: [usize; 3]) -> f64 {
        let (a, b, c) = (self.points[a], self.points[b], self.points[c]);
        0.5 * (b - a).cross(c - a).dot(self.normal)
    }

    fn is_sliver(&self, [a, b, c]: [usize; 3]) -> bool {
        let corners = [self.points[a], self.points[b], self.points[c]];
        let double_area = (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
        double_area <= DEGENERATE * longest_edge_squared(&corners)
    }
}

/// Consecutive pairs of a ring.
fn edges(points: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
    points.iter().copied().zip(points.iter().copied().cycle().skip(1))
}

fn longest_edge_squared(points: &[DVec3]) -> f64 {
    edges(points).map(|(from, to)| from.distance_squared(to)).fold(0.0, f64::max)
}
