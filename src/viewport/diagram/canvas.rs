//! Cells fitted into a picture.

use crate::math::rgb::Rgb;
use crate::viewport::Picture;
use glam::Vec4;

/// A grid of coloured cells on its way to a picture. Each cell becomes a square of pixels, or, where there are more cells
/// than pixels, each pixel the mean of a square of cells.
pub struct Canvas {
    /// Columns and rows.
    cells: [usize; 2],
    /// Cells along the edge of the square that is averaged.
    averaged: usize,
    /// Pixels along the edge of the square that a mean becomes.
    magnified: usize,
    /// Of premultiplied colours, row by row from the top left, one a square of cells.
    sums: Vec<Vec4>,
}

impl Canvas {
    /// A transparent canvas whose picture has at most `limit` pixels along each edge, and as many as whole factors allow.
    pub fn new(cells: [usize; 2], limit: u32) -> Self {
        let (limit, longest) = (limit.max(1) as usize, cells[0].max(cells[1]).max(1));
        let averaged = longest.div_ceil(limit);
        let magnified = (limit / longest).max(1);
        let means = cells.map(|count| count.div_ceil(averaged));
        Self { cells, averaged, magnified, sums: vec![Vec4::ZERO; means[0] * means[1]] }
    }

    /// Paints a cell that was not painted before, in linear RGB.
    pub fn paint(&mut self, column: usize, row: usize, colour: Rgb) {
        let means_in_row = self.cells[0].div_ceil(self.averaged);
        self.sums[row / self.averaged * means_in_row + column / self.averaged] += colour.extend(1.0);
    }

    pub fn finish(self) -> Picture {
        let [columns, rows] = self.cells.map(|count| count.div_ceil(self.averaged));
        // The last squares of a row or a column may have fewer cells.
        let covered = |square: usize, cells: usize| (cells - square * self.averaged).min(self.averaged);
        let mean = |column: usize, row: usize| {
            let count = covered(column, self.cells[0]) * covered(row, self.cells[1]);
            self.sums[row * columns + column] / count as f32
        };
        let size = [columns, rows].map(|squares| squares * self.magnified);
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        let colours = pixels.map(|(x, y)| mean(x / self.magnified, y / self.magnified).to_array());
        Picture::of_colours(size.map(|pixels| pixels as u32), colours.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A canvas whose cells are 1, 2, 3 … in the first channel, row by row.
    fn counted(cells: [usize; 2], limit: u32) -> Picture {
        let mut canvas = Canvas::new(cells, limit);
        for row in 0..cells[1] {
            for column in 0..cells[0] {
                canvas.paint(column, row, Rgb::new((row * cells[0] + column + 1) as f32, 0.0, 0.0));
            }
        }
        canvas.finish()
    }

    fn reds(picture: &Picture) -> Vec<f32> {
        assert!(picture.linear.iter().all(|colour| colour[3] == 1.0));
        picture.linear.iter().map(|colour| colour[0]).collect()
    }

    #[test]
    fn few_cells_are_magnified_by_a_whole_factor() {
        let picture = counted([2, 1], 5);
        assert_eq!((picture.size, reds(&picture)), ([4, 2], vec![1.0, 1.0, 2.0, 2.0, 1.0, 1.0, 2.0, 2.0]));
    }

    #[test]
    fn many_cells_are_averaged_and_those_at_the_rim_too() {
        // 1 2 3 / 4 5 6 / 7 8 9 in squares of two.
        let picture = counted([3, 3], 2);
        assert_eq!((picture.size, reds(&picture)), ([2, 2], vec![3.0, 4.5, 7.5, 9.0]));
    }

    #[test]
    fn what_is_not_painted_is_transparent() {
        let mut canvas = Canvas::new([2, 1], 2);
        canvas.paint(1, 0, Rgb::ONE);
        let picture = canvas.finish();
        assert_eq!(picture.linear, [[0.0; 4], [1.0; 4]]);
        assert_eq!(picture.srgb, [[0; 4], [255; 4]]);
    }
}
