//! The hemicube (Cohen, Greenberg 1985): what is seen from a point, drawn onto half a cube, cell by cell.
//!
//! The sum of the delta form factors of the cells in which an item is seen is the form factor from the point to that
//! item, with all that stands between. Its three assumptions are named by Baum, Rushmeier, Winget (1989): the point
//! stands for its whole patch (proximity), so does its view (visibility), and what is smaller than a cell is hit or
//! missed (aliasing).

mod scan;

use crate::math::warp::frame;
use crate::solution::ItemBuffer;
use glam::{DMat3, Vec3, Vec3A};
use rayon::prelude::*;
use scan::{Band, Seen};
use std::f64::consts::PI;

/// A planar convex polygon to be drawn.
#[derive(Clone, Copy, Debug)]
pub struct Item {
    /// A triangle has its last corner twice.
    corners: [Vec3; 4],
    id: u32,
}

impl Item {
    /// Three or four corners, counter-clockwise seen from the front. Any number of items may have the same `id`; that
    /// of [`ItemBuffer::NOTHING`] only hides what is behind it.
    pub fn new(corners: &[Vec3], id: u32) -> Self {
        Self { corners: [corners[0], corners[1], corners[2], corners[corners.len() - 1]], id }
    }
}

/// Half a cube of half side 1 round a point, and what is seen through each of its cells. Made once and drawn often:
/// nothing is allocated after the first time.
pub struct Hemicube {
    /// Cells along the edge of the top.
    resolution: usize,
    /// Of the top and of one side, row by row; all five faces sum to 1.
    deltas: [Vec<f64>; 2],
    faces: [Face; 5],
    seen: Vec<Option<Seen>>,
}

struct Face {
    items: Vec<u32>,
    /// One over the distance along the face's axis; 0 where nothing is seen.
    nearness: Vec<f32>,
}

impl Hemicube {
    /// A hemicube with this many cells along the edge of its top: an even number, at least 2.
    pub fn new(resolution: u32) -> Self {
        let resolution = resolution as usize;
        let mut deltas = midpoint_deltas(resolution);
        let sum = sum_over_faces(&deltas);
        deltas.iter_mut().flatten().for_each(|delta| *delta /= sum);
        let face = |cells: usize| Face { items: vec![ItemBuffer::NOTHING; cells], nearness: vec![0.0; cells] };
        let side = resolution * resolution / 2;
        let faces = [face(2 * side), face(side), face(side), face(side), face(side)];
        Self { resolution, deltas, faces, seen: Vec::new() }
    }

    /// Draws what is seen from `center` on the side of the unit `normal`, in place of what was drawn before.
    ///
    /// `center` should be lifted off its own surface by more than the rounding of its coordinates: then neither that
    /// surface nor others in its plane are above the foot of the hemicube. An item that is seen from behind leaves its
    /// cells without an id and hides what is behind it. An item with two sides is two items, one of each winding; of
    /// the two the one that faces the centre is seen.
    ///
    /// The result is the same on any number of threads.
    pub fn draw(&mut self, center: Vec3A, normal: Vec3A, items: &[Item]) {
        let center = center.as_dvec3();
        let local_from_world = DMat3::from_cols_array(&frame(normal).to_cols_array().map(f64::from)).transpose();
        let see = |item: &Item| {
            Seen::new(item.corners.map(|corner| local_from_world * (corner.as_dvec3() - center)), item.id)
        };
        items.par_iter().map(see).collect_into_vec(&mut self.seen);
        bands(self.resolution, &mut self.faces).into_par_iter().for_each(|mut band| band.draw(&self.seen));
    }

    /// Adds the form factor of each item to `sums`, at the item's id, and returns the share in which nothing is seen.
    /// All of it together is 1.
    pub fn add_form_factors(&self, sums: &mut [f64]) -> f64 {
        let mut empty = 0.0;
        for (face, items) in self.faces.iter().enumerate() {
            for (&id, &delta) in items.items.iter().zip(self.face_deltas(face)) {
                let sum = if id == ItemBuffer::NOTHING { &mut empty } else { &mut sums[id as usize] };
                *sum += delta;
            }
        }
        empty
    }

    /// The picture of the five faces.
    pub fn item_buffer(&self) -> ItemBuffer {
        ItemBuffer { resolution: self.resolution as u32, faces: self.faces.each_ref().map(|face| face.items.clone()) }
    }

    fn face_deltas(&self, face: usize) -> &[f64] {
        &self.deltas[usize::from(face > 0)]
    }
}

/// The delta form factors of the top, dA / (π (x² + y² + 1)²), and of a side, z dA / (π (y² + z² + 1)²), at the middles
/// of their cells. All five faces sum to 1 + 0.542 / resolution².
fn midpoint_deltas(resolution: usize) -> [Vec<f64>; 2] {
    let size = 2.0 / resolution as f64;
    let middle = |cell: usize| (cell as f64 + 0.5) * size;
    let delta = |across: f64, up: f64, cosine: f64| {
        let square = across * across + up * up + 1.0;
        cosine * size * size / (PI * square * square)
    };
    let cells = |rows: usize| (0..rows * resolution).map(move |cell| (cell % resolution, cell / resolution));
    let top = cells(resolution).map(|(x, y)| delta(middle(x) - 1.0, middle(y) - 1.0, 1.0));
    let side = cells(resolution / 2).map(|(across, z)| delta(middle(across) - 1.0, middle(z), middle(z)));
    [top.collect(), side.collect()]
}

fn sum_over_faces([top, side]: &[Vec<f64>; 2]) -> f64 {
    top.iter().sum::<f64>() + 4.0 * side.iter().sum::<f64>()
}

/// The faces, cleared and cut into bands of the same size: two of the top, then one of each side.
fn bands(resolution: usize, faces: &mut [Face; 5]) -> [Band<'_>; 6] {
    for face in &mut *faces {
        face.items.fill(ItemBuffer::NOTHING);
        face.nearness.fill(0.0);
    }
    let [top, east, north, west, south] = faces;
    let half = resolution * resolution / 2;
    let (low_items, high_items) = top.items.split_at_mut(half);
    let (low_nearness, high_nearness) = top.nearness.split_at_mut(half);
    let band = |face, bottom, items, nearness| Band { resolution, face, bottom, items, nearness };
    let side = |number, face| {
        let Face { items, nearness }: &mut Face = face;
        band(number, 0.0, items.as_mut_slice(), nearness.as_mut_slice())
    };
    [
        band(0, -1.0, low_items, low_nearness),
        band(0, 0.0, high_items, high_nearness),
        side(1, east),
        side(2, north),
        side(3, west),
        side(4, south),
    ]
}

#[cfg(test)]
mod tests;
