//! Which element a point of a surface lies on.

use super::Mesh;
use crate::math::rgb::Rgb;
use glam::Vec3A;

/// A point on the mesh: its element, and how much each corner of it counts there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Location {
    /// Index into [`Mesh::elements`].
    pub element: u32,
    /// Weights of the element's corners; they sum to 1.
    pub weights: [f32; 4],
}

impl Mesh {
    /// The place of a point that lies on a side of a polygon, or `None` where that side is not meshed. Points a little
    /// outside are taken to the nearest element.
    pub fn locate(&self, polygon: u32, is_front: bool, point: Vec3A) -> Option<Location> {
        let side = self.side(polygon, is_front)?;
        let point = point.as_dvec3();
        let patch = side.shape.cell_at(side.grid.patches, side.shape.coordinates(point));
        let patch_shape = side.shape.cell(side.grid.patches, patch);
        let element = patch_shape.cell_at(side.grid.elements, patch_shape.coordinates(point));
        let element_shape = patch_shape.cell(side.grid.elements, element);
        let inside = element_shape.nearest_coordinates(point);
        let elements_per_patch = side.shape.cells(side.grid.elements);
        Some(Location {
            element: side.elements.start + patch * elements_per_patch + element,
            weights: element_shape.weights(inside).map(|weight| weight as f32),
        })
    }

    /// The value at a location, interpolated between values of vertices.
    pub fn interpolate(&self, location: &Location, vertex_values: &[Rgb]) -> Rgb {
        let corners = self.elements[location.element as usize].corners();
        corners.iter().zip(location.weights).map(|(&corner, weight)| vertex_values[corner as usize] * weight).sum()
    }
}
