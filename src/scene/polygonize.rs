//! Faces of any size cut into triangles and planar convex quads, with their winding kept.
//!
//! All measures are relative, so a scene scaled by 1e-6 or 1e6 is cut in the same way. A face is judged by the coordinates
//! that its file states, in double precision; what becomes of it when they are rounded to single precision is looked at last.

use earcut::Earcut;
use glam::DVec3;

/// How far the corners of a quad may be apart along its normal, in units of its largest coordinate.
///
/// A quad is sampled on the bilinear surface through its corners and traced as two triangles. Between the two lies at
/// most half of this distance, and rounding adds at most 1 ε: 9 ε, less than the 16 ε within which the tracer decides in double
/// precision what touches. It also is what rounding to single precision, or to six decimals in a scene of a few metres, does
/// to a flat quad. Anything more is cut into two triangles.
const PLANARITY: f64 = 16.0 * f32::EPSILON as f64;

/// Corners lie on one line where twice the area between them is at most this many times their longest edge times what a
/// coordinate was rounded by. Differences of two coordinates are off by √3 of it as vectors, cross products of two such by
/// 2 √3 times the longest edge for each.
const ON_A_LINE: f64 = 8.0;

/// Smallest sine of a corner of a quad that is kept: below it three corners count as lying on a line.
const SMALLEST_CORNER: f64 = 1e-3;

/// A diagonal that leaves a piece of less than this share of a quad cuts it only if the other one leaves even less.
const SMALLEST_PIECE: f64 = 1e-6;

/// What a face looked like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    Planar,
    /// Its corners are apart along its normal by this share of its size.
    Warped(f64),
    /// Its outline crosses itself.
    Crossed,
    /// It has an area, but none in single precision: its edges fall together, and leave no gap.
    Collapsed,
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

/// Cuts a face and hands each piece, as three or four places in its list of corners, to `emit`. What its coordinates, m, were
/// rounded by in double precision is `rounding`, m.
///
/// A triangle, and a quad that is planar and convex, stay whole. Another quad is cut along its shorter diagonal, as most
/// programs that read OBJ files do (tinyobjloader; of two equal ones, along that from the second corner), or along the one
/// that lies inside of it where it is concave. A face of more corners is triangulated by ear clipping. Its normal is Newell's
/// (Sutherland, Sproull, Schumacker 1974).
pub fn polygonize(corners: &[DVec3], rounding: f64, emit: &mut impl FnMut(&[usize])) -> Shape {
    let Some(face) = Face::new(corners, rounding) else { return Shape::Degenerate };
    let shape = face.shape();
    let pieces = match corners.len() {
        3 => vec![[0, 1, 2]],
        4 if shape == Shape::Planar && face.is_convex_quad() => {
            let is_emitted = face.emit_rounded(&[0, 1, 2, 3], emit);
            return if is_emitted { shape } else { Shape::Collapsed };
        }
        4 => face.cut_quad(),
        _ => face.clip_ears(),
    };
    let (mut covered, mut is_emitted) = (0.0, false);
    for piece in pieces {
        covered += face.signed_area(piece).abs();
        if has_area(&piece.map(|corner| face.points[corner]), rounding) {
            is_emitted |= face.emit_rounded(&piece, emit);
        }
    }
    // Triangles that overlap or face backwards cover more than the outline encloses.
    if (covered - face.area).abs() > 1e-3 * face.area {
        Shape::Crossed
    } else if is_emitted {
        shape
    } else {
        Shape::Collapsed
    }
}

/// Whether corners are not all on one line, as far as their `rounding`, m, tells.
pub fn has_area(corners: &[DVec3], rounding: f64) -> bool {
    let longest = edges(corners).map(|(from, to)| from.distance(to)).fold(0.0, f64::max);
    double_area(corners).length() > ON_A_LINE * rounding * longest
}

/// A face with its first corner at the origin.
struct Face<'a> {
    /// In the scene's frame.
    corners: &'a [DVec3],
    points: Vec<DVec3>,
    normal: DVec3,
    area: f64,
    /// Distance of the farthest corner from the first one.
    size: f64,
    /// Largest coordinate in the scene's frame.
    largest_coordinate: f64,
}

impl<'a> Face<'a> {
    /// `None` where the face has no area.
    fn new(corners: &'a [DVec3], rounding: f64) -> Option<Self> {
        let origin = *corners.first()?;
        let points: Vec<DVec3> = corners.iter().map(|&corner| corner - origin).collect();
        has_area(&points, rounding).then(|| {
            let double_area = double_area(&points);
            Self {
                corners,
                normal: double_area.normalize(),
                area: 0.5 * double_area.length(),
                size: points.iter().map(|p| p.length()).fold(0.0, f64::max),
                largest_coordinate: corners.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max),
                points,
            }
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
        let cuts = [[[0, 1, 2], [0, 2, 3]], [[0, 1, 3], [1, 2, 3]]];
        let [first, second] = cuts.map(|[a, b]| self.signed_area(a).min(self.signed_area(b)));
        let least = SMALLEST_PIECE * self.area;
        let [from_first, from_second] = [[0, 2], [1, 3]].map(|[a, b]| self.points[a].distance_squared(self.points[b]));
        // Rounding must not decide between equal ones: a scaled copy of the quad is cut alike.
        let takes_first = if first.min(second) > least {
            from_first < (1.0 - 4.0 * f64::from(f32::EPSILON)) * from_second
        } else {
            second <= first + least
        };
        cuts[usize::from(!takes_first)].to_vec()
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

    /// Emits a piece, unless it has no area in single precision. What is a few units in the last place wide may wind the other
    /// way there, and is turned back.
    fn emit_rounded(&self, piece: &[usize], emit: &mut impl FnMut(&[usize])) -> bool {
        let stated: Vec<DVec3> = piece.iter().map(|&corner| self.points[corner]).collect();
        let rounded: Vec<DVec3> = piece.iter().map(|&corner| self.corners[corner].as_vec3().as_dvec3()).collect();
        let area = double_area(&rounded);
        if area == DVec3::ZERO {
            return false;
        }
        if area.dot(double_area(&stated)) < 0.0 {
            emit(&piece.iter().rev().copied().collect::<Vec<usize>>());
        } else {
            emit(piece);
        }
        true
    }
}

/// Twice the area of a ring, along its normal. From its first corner, so that a small ring far away keeps its digits.
fn double_area(ring: &[DVec3]) -> DVec3 {
    edges(ring).map(|(from, to)| (from - ring[0]).cross(to - ring[0])).sum()
}

/// Consecutive pairs of a ring.
fn edges(points: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> + '_ {
    points.iter().copied().zip(points.iter().copied().cycle().skip(1))
}
