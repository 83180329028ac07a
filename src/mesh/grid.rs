//! A triangle or quad cut into a regular grid: which cell a point is in, and where a cell's corners are.
//!
//! Everything is computed from the shape's corners in double precision and rounded once, so that two polygons that
//! share an edge and cut it alike get the same points along it.

use glam::{DVec2, DVec3};

/// A triangle whose height is less than this share of an element is cut as a strip.
const SLIVER: f64 = 1.0 / 64.0;

/// How a side is divided: `patches` along each edge, and `elements` along each edge of a patch. A triangle uses the
/// first number of each for all its edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    pub patches: [u32; 2],
    pub elements: [u32; 2],
}

impl Grid {
    /// The grid in which no edge of an element (of a triangle, all but the longest) is longer than `element_size`,
    /// and no patch has more than `elements_per_patch` elements along an edge. A triangle that is much narrower than an
    /// element has about as many elements as a strip of its length, although these are longer.
    pub fn fit(shape: &Shape, element_size: f64, elements_per_patch: u32) -> Self {
        let cells = shape.edge_lengths().map(|length| {
            let cells = length / element_size;
            let cells = if shape.is_sliver(element_size) { cells.sqrt() } else { cells };
            cells.ceil().max(1.0) as u32
        });
        let patches = cells.map(|count| count.div_ceil(elements_per_patch));
        Self { patches, elements: [cells[0].div_ceil(patches[0]), cells[1].div_ceil(patches[1])] }
    }
}

/// Three or four corners of a planar convex polygon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    Triangle([DVec3; 3]),
    Quad([DVec3; 4]),
}

impl Shape {
    /// # Panics
    /// If there are fewer than three or more than four corners.
    pub fn new(corners: &[DVec3]) -> Self {
        match *corners {
            [a, b, c] => Self::Triangle([a, b, c]),
            [a, b, c, d] => Self::Quad([a, b, c, d]),
            _ => panic!("a shape has three or four corners"),
        }
    }

    pub fn corners(&self) -> &[DVec3] {
        match self {
            Self::Triangle(corners) => corners,
            Self::Quad(corners) => corners,
        }
    }

    /// The longest edge along each direction of the grid. Of a triangle it is the second longest, so that half a square
    /// is cut as finely as the square would be.
    fn edge_lengths(&self) -> [f64; 2] {
        match *self {
            Self::Triangle([a, b, c]) => {
                let mut lengths = [(b - a).length(), (c - b).length(), (a - c).length()];
                lengths.sort_by(f64::total_cmp);
                [lengths[1]; 2]
            }
            Self::Quad([a, b, c, d]) => {
                [(b - a).length().max((c - d).length()), (d - a).length().max((c - b).length())]
            }
        }
    }

    /// Whether it is a triangle whose height over its longest edge is nothing beside an element. Cut into n² cells alike, it
    /// would have as many elements as a wide one.
    fn is_sliver(&self, element_size: f64) -> bool {
        let Self::Triangle([a, b, c]) = *self else { return false };
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        (b - a).cross(c - a).length() < SLIVER * element_size * longest
    }

    /// How many cells a division into `count` has.
    pub fn cells(&self, count: [u32; 2]) -> u32 {
        match self {
            Self::Triangle(_) => count[0] * count[0],
            Self::Quad(_) => count[0] * count[1],
        }
    }

    /// Cell number `index` of the division into `count`, of the same kind and winding as the whole.
    pub fn cell(&self, count: [u32; 2], index: u32) -> Self {
        match self {
            Self::Triangle(_) => {
                let n = f64::from(count[0]);
                Self::Triangle(triangle_cell(count[0], index).map(|at| self.point(at / n)))
            }
            Self::Quad(_) => {
                let low = DVec2::new(f64::from(index % count[0]), f64::from(index / count[0]));
                let size = DVec2::new(f64::from(count[0]), f64::from(count[1]));
                let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
                Self::Quad(corners.map(|corner| self.point((low + corner) / size)))
            }
        }
    }

    /// The cells of the division into `count` along an edge, from the corner with the edge's number to the next corner.
    /// Each has its own edge of that number there.
    pub fn edge_cells(&self, count: [u32; 2], edge: usize) -> impl Iterator<Item = u32> + use<> {
        let ([across, up], is_triangle) = (count, matches!(self, Self::Triangle(_)));
        let length = if is_triangle || edge.is_multiple_of(2) { across } else { up };
        let row_of_triangle = move |row: u32| row * (2 * across - row);
        (0..length).map(move |i| match (is_triangle, edge) {
            (true, 0) => 2 * i,
            (true, 1) => row_of_triangle(i) + 2 * (across - 1 - i),
            (true, _) => row_of_triangle(across - 1 - i),
            (false, 0) => i,
            (false, 1) => i * across + across - 1,
            (false, 2) => up * across - 1 - i,
            (false, _) => (up - 1 - i) * across,
        })
    }

    /// The cell of the division into `count` that holds the point with these coordinates.
    pub fn cell_at(&self, count: [u32; 2], at: DVec2) -> u32 {
        match self {
            Self::Triangle(_) => triangle_cell_at(count[0], at),
            Self::Quad(_) => {
                let column = cell_number(at.x * f64::from(count[0]), count[0]);
                let row = cell_number(at.y * f64::from(count[1]), count[1]);
                row * count[0] + column
            }
        }
    }

    /// The point with the given coordinates: of a quad, bilinear in [0, 1]²; of a triangle, the barycentric weights of
    /// its second and third corner.
    pub fn point(&self, at: DVec2) -> DVec3 {
        match *self {
            Self::Triangle([a, b, c]) => a + at.x * (b - a) + at.y * (c - a),
            Self::Quad([a, b, c, d]) => a.lerp(b, at.x).lerp(d.lerp(c, at.x), at.y),
        }
    }

    /// The coordinates of a point in the shape's plane: the inverse of [`Shape::point`].
    pub fn coordinates(&self, point: DVec3) -> DVec2 {
        match *self {
            Self::Triangle([a, b, c]) => {
                let (along, across, to) = (b - a, c - a, point - a);
                let normal = along.cross(across);
                let scale = 1.0 / normal.length_squared();
                DVec2::new(to.cross(across).dot(normal), along.cross(to).dot(normal)) * scale
            }
            Self::Quad(corners) => bilinear_coordinates(corners, point),
        }
    }

    /// The coordinates inside the shape that are nearest to a point's own, coordinate by coordinate.
    pub fn nearest_coordinates(&self, point: DVec3) -> DVec2 {
        let at = self.coordinates(point).clamp(DVec2::ZERO, DVec2::ONE);
        match self {
            Self::Triangle(_) => at / (at.x + at.y).max(1.0),
            Self::Quad(_) => at,
        }
    }

    /// Weights of the corners at the given coordinates; the fourth is 0 for a triangle. They sum to 1.
    pub fn weights(&self, at: DVec2) -> [f64; 4] {
        match self {
            Self::Triangle(_) => [1.0 - at.x - at.y, at.x, at.y, 0.0],
            Self::Quad(_) => {
                let rest = DVec2::ONE - at;
                [rest.x * rest.y, at.x * rest.y, at.x * at.y, rest.x * at.y]
            }
        }
    }
}

/// Newton's method: the bilinear map of a convex quad has one solution there, and is nearly linear, so that a few steps
/// reach rounding. Of a parallelogram it is linear, and the first one does.
fn bilinear_coordinates([a, b, c, d]: [DVec3; 4], point: DVec3) -> DVec2 {
    let (along, across, twist) = (b - a, d - a, a - b + c - d);
    let mut at = DVec2::splat(0.5);
    for _ in 0..8 {
        let error = a + at.x * along + at.y * across + at.x * at.y * twist - point;
        let (du, dv) = (along + at.y * twist, across + at.x * twist);
        let normal = du.cross(dv);
        let scale = 1.0 / normal.length_squared();
        let step = DVec2::new(error.cross(dv).dot(normal), du.cross(error).dot(normal)) * scale;
        at -= step;
        if step.abs().max_element() < f64::EPSILON {
            break;
        }
    }
    at
}

/// A cell of a triangle cut into n² alike: row `j` holds n − j upright ones and between them those upside down.
/// Corners are in units of cells.
fn triangle_cell(n: u32, index: u32) -> [DVec2; 3] {
    let mut row = 0;
    while (row + 1) * (2 * n - row - 1) <= index {
        row += 1;
    }
    let in_row = index - row * (2 * n - row);
    let low = DVec2::new(f64::from(in_row / 2), f64::from(row));
    if in_row.is_multiple_of(2) {
        [low, low + DVec2::X, low + DVec2::Y]
    } else {
        [low + DVec2::ONE, low + DVec2::Y, low + DVec2::X]
    }
}

fn triangle_cell_at(n: u32, at: DVec2) -> u32 {
    let scaled = at.clamp(DVec2::ZERO, DVec2::ONE) * f64::from(n);
    let row = cell_number(scaled.y, n);
    let column = cell_number(scaled.x, n - row);
    let upside_down = scaled.x - f64::from(column) + scaled.y - f64::from(row) > 1.0 && column + row + 1 < n;
    row * (2 * n - row) + 2 * column + u32::from(upside_down)
}

/// The whole part of a coordinate, kept inside the grid.
fn cell_number(coordinate: f64, count: u32) -> u32 {
    (coordinate.max(0.0) as u32).min(count - 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::polygon::vector_area;

    fn shapes() -> [Shape; 2] {
        let corners = [DVec3::ZERO, DVec3::new(3.0, 0.0, 1.0), DVec3::new(2.5, 2.0, 0.5), DVec3::new(-0.5, 1.0, -0.5)];
        let flat = corners.map(|corner| DVec3::new(corner.x, corner.y, corner.x / 3.0));
        [Shape::new(&flat[..3]), Shape::new(&flat)]
    }

    #[test]
    fn cells_tile_the_shape_and_keep_its_winding() {
        for shape in shapes() {
            let whole = vector_area(shape.corners());
            let count = [5, 3];
            let cells = (0..shape.cells(count)).map(|i| vector_area(shape.cell(count, i).corners()));
            let sum = cells.fold(DVec3::ZERO, |sum, area| {
                assert!(area.dot(whole) > 0.0);
                sum + area
            });
            assert!((sum - whole).length() < 1e-14);
        }
    }

    #[test]
    fn the_middle_of_every_cell_is_found_in_it() {
        for shape in shapes() {
            for count in [[1, 1], [4, 4], [7, 2]] {
                for index in 0..shape.cells(count) {
                    let cell = shape.cell(count, index);
                    let middle = cell.corners().iter().sum::<DVec3>() / cell.corners().len() as f64;
                    assert_eq!(shape.cell_at(count, shape.coordinates(middle)), index);
                }
            }
        }
    }

    #[test]
    fn the_cells_along_an_edge_follow_it_with_their_own() {
        for shape in shapes() {
            let corners = shape.corners();
            for count in [[1, 1], [4, 4], [7, 2]] {
                for edge in 0..corners.len() {
                    let next = (edge + 1) % corners.len();
                    let mut at = corners[edge];
                    for index in shape.edge_cells(count, edge) {
                        let cell = shape.cell(count, index);
                        assert!(cell.corners()[edge].distance(at) < 1e-14);
                        at = cell.corners()[next];
                    }
                    assert!(at.distance(corners[next]) < 1e-14);
                }
            }
        }
    }

    #[test]
    fn coordinates_invert_points() {
        for shape in shapes() {
            for at in [DVec2::new(0.1, 0.7), DVec2::new(0.0, 1.0), DVec2::new(0.4, 0.25)] {
                assert!((shape.coordinates(shape.point(at)) - at).length() < 1e-14);
                let weights = shape.weights(at);
                let blend: DVec3 = shape.corners().iter().zip(weights).map(|(corner, weight)| *corner * weight).sum();
                assert!((blend - shape.point(at)).length() < 1e-14);
            }
        }
    }

    #[test]
    fn a_sliver_has_as_many_elements_as_a_strip() {
        // 40 elements long; a triangle of that height is cut into 40² and one a thousandth of an element high into 7².
        let triangle = |height: f64| Shape::new(&[DVec3::ZERO, 2.0 * DVec3::X, DVec3::new(0.0, height, 0.0)]);
        let cells = |height| {
            let shape = triangle(height);
            let grid = Grid::fit(&shape, 0.05, 1);
            shape.cells(grid.patches)
        };
        assert_eq!([2.0, 5e-5, 1e-12].map(cells), [1600, 49, 49]);
    }

    #[test]
    fn a_fitted_grid_has_no_edge_above_the_target() {
        for shape in shapes() {
            let grid = Grid::fit(&shape, 0.3, 4);
            assert!(grid.elements.iter().all(|&count| count <= 4));
            let patch = shape.cell(grid.patches, 0);
            let element = patch.cell(grid.elements, 0);
            assert!(element.edge_lengths().iter().all(|&length| length <= 0.3 + 1e-12));
        }
    }
}
