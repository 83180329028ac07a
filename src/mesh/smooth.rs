//! Values of elements carried over to vertices, for pictures without facets (Gouraud 1971).

use super::Mesh;
use crate::math::rgb::Rgb;
use std::ops::{AddAssign, Mul};

impl Mesh {
    /// Mean of the elements round each vertex, by exposed area. Vertices are shared only where light is smooth, so nothing
    /// is averaged across a crease or between materials; what is covered does not count. A vertex that hangs on an edge
    /// hands its elements on to the ends of the edge and takes the value between theirs, so that what is interpolated
    /// between the corners of elements is continuous across T-junctions too. `values` has one entry an element;
    /// `vertex_values` is overwritten with one a vertex.
    pub fn smooth(&self, values: &[Rgb], vertex_values: &mut Vec<Rgb>) {
        vertex_values.clear();
        vertex_values.resize(self.vertices.len(), Rgb::ZERO);
        self.gather(values, vertex_values);
        for (value, area) in vertex_values.iter_mut().zip(&self.vertex_areas) {
            if *area > 0.0 {
                *value /= *area;
            }
        }
        for hanging in &self.hanging {
            let [from, to] = hanging.ends.map(|end| vertex_values[end as usize]);
            vertex_values[hanging.vertex as usize] = from + hanging.at * (to - from);
        }
    }

    /// Sets the areas that count at each vertex.
    pub(super) fn weigh_vertices(&mut self) {
        let mut areas = vec![0.0; self.vertices.len()];
        self.gather(&vec![1.0; self.elements.len()], &mut areas);
        self.vertex_areas = areas;
    }

    /// Adds value times area of the elements that count at each vertex to `sums`. Areas are summed by the same
    /// operations, so that a mean over equal values is that value but for the rounding of products.
    fn gather<T>(&self, values: &[T], sums: &mut [T])
    where
        T: Copy + Default + AddAssign + Mul<f32, Output = T>,
    {
        for (element, &value) in self.elements.iter().zip(values) {
            let weighted = value * element.area as f32;
            for &corner in element.corners() {
                sums[corner as usize] += weighted;
            }
        }
        for hanging in self.hanging.iter().rev() {
            let sum = std::mem::take(&mut sums[hanging.vertex as usize]);
            let [from, to] = hanging.ends.map(|end| end as usize);
            sums[from] += sum * (1.0 - hanging.at);
            sums[to] += sum * hanging.at;
        }
    }
}
