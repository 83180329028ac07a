//! Which element a point of a surface lies on.

use super::{Mesh, Shape};
use crate::math::rgb::Rgb;
use glam::{DVec3, Vec3A};

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
        let (element, shape) = self.element_and_shape(polygon, is_front, point.as_dvec3())?;
        let inside = shape.nearest_coordinates(point.as_dvec3());
        Some(Location { element, weights: shape.weights(inside).map(|weight| weight as f32) })
    }

    /// The element of the same place alone, which is found faster.
    pub fn element_at(&self, polygon: u32, is_front: bool, point: Vec3A) -> Option<u32> {
        self.element_and_shape(polygon, is_front, point.as_dvec3()).map(|(element, _)| element)
    }

    fn element_and_shape(&self, polygon: u32, is_front: bool, point: DVec3) -> Option<(u32, Shape)> {
        let side = self.side(polygon, is_front)?;
        let patch = side.shape.cell_at(side.grid.patches, side.shape.coordinates(point));
        let patch_shape = side.shape.cell(side.grid.patches, patch);
        let element = patch_shape.cell_at(side.grid.elements, patch_shape.coordinates(point));
        let elements_per_patch = side.shape.cells(side.grid.elements);
        let index = side.elements.start + patch * elements_per_patch + element;
        Some((index, patch_shape.cell(side.grid.elements, element)))
    }

    /// The value at a location, interpolated between values of vertices.
    pub fn interpolate(&self, location: &Location, vertex_values: &[Rgb]) -> Rgb {
        let corners = self.elements[location.element as usize].corners();
        corners.iter().zip(location.weights).map(|(&corner, weight)| vertex_values[corner as usize] * weight).sum()
    }
}
