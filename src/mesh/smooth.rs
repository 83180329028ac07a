//! Values of elements carried over to vertices, for pictures without facets (Gouraud 1971).

use super::Mesh;
use crate::math::rgb::Rgb;
use std::ops::{AddAssign, Mul};

impl Mesh {
    /// Mean of the elements round each vertex, by exposed area. Vertices are shared only where light is smooth, so nothing
    /// is averaged across a crease or between materials; what is covered does not count. A vertex that hangs on an edge
    /// hands its elements on to the ends of the edge and takes the value between theirs, so that what is interpolated
    /// between the corners of elements does not crack at T-junctions (see [`super::Hanging`]). `values` has one entry an element;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{Element, Hanging};
    use glam::{Vec3, Vec3A};

    /// An element 2 m wide above an element of 0.5 m and one of 1.5 m, with a vertex between these on the edge of the first.
    fn junction() -> Mesh {
        let positions = [(0, 2), (4, 2), (0, 1), (4, 1), (1, 1), (0, 0), (1, 0), (4, 0)];
        let element =
            |corners, area| Element { corners, corner_count: 4, patch: 0, center: Vec3A::ZERO, area, exposed: 1.0 };
        let mut mesh = Mesh {
            elements: vec![element([2, 3, 1, 0], 2.0), element([5, 6, 4, 2], 0.5), element([6, 7, 3, 4], 1.5)],
            vertices: positions.map(|(x, y)| Vec3::new(0.5 * x as f32, y as f32, 0.0)).to_vec(),
            hanging: vec![Hanging { vertex: 4, ends: [2, 3], at: 0.25 }],
            ..Mesh::default()
        };
        mesh.weigh_vertices();
        mesh
    }

    #[test]
    fn the_elements_round_a_hanging_vertex_count_at_the_ends_of_its_edge() {
        let (mesh, values) = (junction(), [1.0, 2.0, 4.0].map(Rgb::splat));
        let mut smoothed = Vec::new();
        mesh.smooth(&values, &mut smoothed);
        // At the left end 2 m² of 1, 0.5 m² of 2, and three quarters of what is round the vertex: 0.5 m² of 2 and 1.5 m² of 4.
        let left = (2.0 + 1.0 + 0.75 * 7.0) / (2.0 + 0.5 + 0.75 * 2.0);
        let right = (2.0 + 6.0 + 0.25 * 7.0) / (2.0 + 1.5 + 0.25 * 2.0);
        assert_eq!([smoothed[2].x, smoothed[3].x], [left, right]);
        assert_eq!(smoothed[4].x, 0.75 * left + 0.25 * right);
    }

    #[test]
    fn smoothing_keeps_the_light() {
        let (mesh, values) = (junction(), [1.0, 2.0, 4.0].map(Rgb::splat));
        let mut smoothed = Vec::new();
        mesh.smooth(&values, &mut smoothed);
        let at_vertices: f32 = smoothed.iter().zip(&mesh.vertex_areas).map(|(value, area)| value.x * area).sum();
        let of_elements: f64 =
            mesh.elements.iter().zip(values).map(|(element, value)| 4.0 * element.area * f64::from(value.x)).sum();
        assert!((f64::from(at_vertices) / of_elements - 1.0).abs() < 1e-6);
    }
}
