//! Values of elements carried over to vertices, for pictures without facets (Gouraud 1971).

use super::{Element, Mesh};
use crate::math::rgb::Rgb;
use glam::Vec3;

impl Mesh {
    /// Mean of the elements round each vertex, by exposed area. Vertices are shared only where light is smooth, so nothing
    /// is averaged across a crease or between materials; what is covered does not count. `values` has one entry an element; `vertex_values` is
    /// overwritten with one a vertex.
    pub fn smooth(&self, values: &[Rgb], vertex_values: &mut Vec<Rgb>) {
        vertex_values.clear();
        vertex_values.resize(self.vertices.len(), Rgb::ZERO);
        for (element, &value) in self.elements.iter().zip(values) {
            let weighted = value * element.area as f32;
            for &corner in element.corners() {
                vertex_values[corner as usize] += weighted;
            }
        }
        for (value, area) in vertex_values.iter_mut().zip(&self.vertex_areas) {
            if *area > 0.0 {
                *value /= *area;
            }
        }
    }
}

/// Σ exposed area of the elements round each of `vertices`, m².
pub(super) fn vertex_areas(elements: &[Element], vertices: &[Vec3]) -> Vec<f32> {
    let mut areas = vec![0.0; vertices.len()];
    for element in elements {
        for &corner in element.corners() {
            areas[corner as usize] += element.area as f32;
        }
    }
    areas
}
