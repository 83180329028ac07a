//! Cuts the sides of a scene's polygons into patches and these into elements.

use super::grid::{Grid, Shape};
use super::hanging::hanging_vertices;
use super::vertices::{Surface, Vertices};
use super::{Element, Mesh, Patch, Side, side_index};
use crate::cancel::{Cancel, Cancelled};
use crate::math::polygon::vector_area;
use crate::scene::{Polygon, Scene};
use glam::{DVec3, Vec3A};

/// The element size, m, at which the mesh has about as many elements as wanted, or the nearest to it: there is at least
/// one for each side.
pub fn element_size_for(scene: &Scene, is_meshed: &[bool], per_patch_edge: u32, area: f64, wanted: f64) -> f64 {
    let mut size = (area / wanted).sqrt();
    // Triangles and the rounding up to whole cells make more elements than the area alone says; a few corrections settle.
    for _ in 0..4 {
        let ratio = estimated_elements(scene, is_meshed, per_patch_edge, size) / wanted;
        if ratio > 1.05 {
            size *= ratio.sqrt();
        }
    }
    size
}

/// How many elements the mesh would have, with at most `per_patch_edge` along the edge of a patch; costs next to
/// nothing.
pub fn estimated_elements(scene: &Scene, is_meshed: &[bool], per_patch_edge: u32, element_size: f64) -> f64 {
    sides(scene, is_meshed)
        .map(|(polygon, is_front)| {
            let shape = side_shape(scene, polygon, is_front);
            let grid = Grid::fit(&shape, element_size, per_patch_edge);
            let cells = |count: [u32; 2]| match shape {
                Shape::Triangle(_) => f64::from(count[0]).powi(2),
                Shape::Quad(_) => f64::from(count[0]) * f64::from(count[1]),
            };
            cells(grid.patches) * cells(grid.elements)
        })
        .sum()
}

/// Cuts every side for which `is_meshed`, indexed as [`Mesh::sides`], is true. Lengths are in metres.
///
/// # Errors
/// If cancelled.
pub fn subdivide(
    scene: &Scene,
    is_meshed: &[bool],
    per_patch_edge: u32,
    element_size: f64,
    cancel: &Cancel,
) -> Result<Mesh, Cancelled> {
    let mut builder =
        Builder { vertices: Vertices::default(), mesh: Mesh::default(), per_patch_edge, element_size, cancel };
    builder.mesh.sides = vec![None; is_meshed.len()];
    for (index, is_front) in sides(scene, is_meshed) {
        let shape = side_shape(scene, index, is_front);
        builder.add_side(shape, index as u32, is_front, scene.polygons[index].material)?;
    }
    let Builder { mut mesh, vertices, .. } = builder;
    mesh.vertices = vertices.positions;
    mesh.hanging = hanging_vertices(&mesh, &vertices.surfaces, cancel)?;
    mesh.weigh_vertices();
    Ok(mesh)
}

/// (polygon, is front) of every side to be meshed.
fn sides<'a>(scene: &'a Scene, is_meshed: &'a [bool]) -> impl Iterator<Item = (usize, bool)> + 'a {
    let all = (0..scene.polygons.len()).flat_map(|polygon| [(polygon, true), (polygon, false)]);
    all.filter(|&(polygon, is_front)| is_meshed[side_index(polygon as u32, is_front)])
}

/// The corners of a side, counter-clockwise seen from where it shines.
fn side_shape(scene: &Scene, polygon: usize, is_front: bool) -> Shape {
    let corner = |polygon: &Polygon, i: usize| scene.positions[polygon.corners()[i] as usize].as_dvec3();
    let polygon = &scene.polygons[polygon];
    let mut corners: Vec<DVec3> = (0..polygon.corners().len()).map(|i| corner(polygon, i)).collect();
    if !is_front {
        corners.reverse();
    }
    Shape::new(&corners)
}

struct Builder<'a> {
    vertices: Vertices,
    mesh: Mesh,
    /// Elements along the edge of a patch, at most.
    per_patch_edge: u32,
    /// Longest edge of an element, m.
    element_size: f64,
    cancel: &'a Cancel,
}

impl Builder<'_> {
    fn add_side(&mut self, shape: Shape, polygon: u32, is_front: bool, material: u32) -> Result<(), Cancelled> {
        let grid = Grid::fit(&shape, self.element_size, self.per_patch_edge);
        let normal = vector_area(shape.corners()).normalize().as_vec3a();
        let surface = Surface { normal, material };
        let patches_start = self.mesh.patches.len() as u32;
        let elements_start = self.mesh.elements.len() as u32;
        for index in 0..shape.cells(grid.patches) {
            if self.cancel.is_requested() {
                return Err(Cancelled);
            }
            let patch_shape = shape.cell(grid.patches, index);
            let first = self.mesh.elements.len() as u32;
            let patch = self.mesh.patches.len() as u32;
            for index in 0..patch_shape.cells(grid.elements) {
                let element = self.element(&patch_shape.cell(grid.elements, index), patch, surface);
                self.mesh.elements.push(element);
            }
            let corners = padded(patch_shape.corners()).map(|corner| corner.as_vec3());
            self.mesh.patches.push(Patch {
                corners,
                corner_count: patch_shape.corners().len() as u8,
                normal,
                center: center(patch_shape.corners()),
                area: vector_area(patch_shape.corners()).length(),
                elements: first..self.mesh.elements.len() as u32,
                polygon,
                is_front,
                material,
            });
        }
        let side = Side {
            patches: patches_start..self.mesh.patches.len() as u32,
            elements: elements_start..self.mesh.elements.len() as u32,
            grid,
            shape,
        };
        self.mesh.sides[side_index(polygon, is_front)] = Some(side);
        Ok(())
    }

    fn element(&mut self, shape: &Shape, patch: u32, surface: Surface) -> Element {
        let corners = shape.corners();
        Element {
            corners: padded(corners).map(|corner| self.vertices.share(corner.as_vec3(), surface)),
            corner_count: corners.len() as u8,
            patch,
            center: center(corners),
            area: vector_area(corners).length(),
            exposed: 1.0,
        }
    }
}

/// Four corners, the last one repeated where there are three.
fn padded(corners: &[DVec3]) -> [DVec3; 4] {
    [corners[0], corners[1], corners[2], *corners.last().expect("a shape has corners")]
}

fn center(corners: &[DVec3]) -> Vec3A {
    (corners.iter().sum::<DVec3>() / corners.len() as f64).as_vec3a()
}
