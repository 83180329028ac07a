//! Polygon sides cut into patches, which shoot light, and elements, which receive it.

mod grid;
mod hanging;
mod locate;
mod outline;
mod point_tree;
mod region;
mod smooth;
mod subdivide;
mod vertices;

pub use grid::{Grid, Shape};
pub use hanging::Hanging;
pub use locate::Location;
pub use region::{Region, Sampler};
pub use subdivide::{element_size_for, estimated_elements, subdivide};

use crate::math::rgb::{Rgb, Rgb64};
use crate::tracer::SurfacePoint;
use glam::{Vec3, Vec3A};
use std::ops::Range;

/// The mesh of every side that light can reach. Elements of one patch, and patches of one side, are contiguous.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// For polygon `p`, `2 p` is its front and `2 p + 1` its back; `None` where nothing can reach that side.
    pub sides: Vec<Option<Side>>,
    pub patches: Vec<Patch>,
    pub elements: Vec<Element>,
    /// Corner positions of elements, m. Elements share a vertex where light is smooth across it: same material,
    /// same side, no crease.
    pub vertices: Vec<Vec3>,
    /// Vertices on edges of other elements, each after those that it hangs on.
    pub hanging: Vec<Hanging>,
    /// Σ exposed area of the elements that count at each vertex, m²: those round it and, in part, those round the vertices
    /// that hang on it. 0 for one that hangs itself.
    vertex_areas: Vec<f32>,
}

/// One meshed side of a polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    pub patches: Range<u32>,
    pub elements: Range<u32>,
    pub grid: Grid,
    /// The whole side, with its corners counter-clockwise seen from where it shines.
    pub shape: Shape,
}

/// A planar convex piece of a surface with one radiosity while it shoots.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    corners: [Vec3; 4],
    corner_count: u8,
    /// Unit normal on the side where the patch shines.
    pub normal: Vec3A,
    pub center: Vec3A,
    /// Exposed area, m²: that of its elements.
    pub area: f64,
    /// Indices into [`Mesh::elements`].
    pub elements: Range<u32>,
    /// Index into the scene's polygons.
    pub polygon: u32,
    /// Whether this is the front of the polygon.
    pub is_front: bool,
    /// Index into the scene's materials.
    pub material: u32,
}

impl Patch {
    /// Three or four corners, counter-clockwise seen from the side where the patch shines.
    pub fn corners(&self) -> &[Vec3] {
        &self.corners[..self.corner_count as usize]
    }

    /// A point of the patch, where a ray starts or ends.
    pub fn surface_point(&self, point: Vec3A) -> SurfacePoint {
        SurfacePoint { point, polygon: self.polygon }
    }

    /// The region that the patch covers.
    pub fn region(&self) -> Region {
        Region::new(self.corners.map(Vec3A::from), self.corner_count as usize)
    }
}

/// The smallest piece, with one irradiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    corners: [u32; 4],
    corner_count: u8,
    /// Index into [`Mesh::patches`].
    pub patch: u32,
    pub center: Vec3A,
    /// Exposed area, m²: what light can reach. Where a block stands on a floor, the floor below it is no part of it.
    pub area: f64,
    /// Share of the element that is exposed, in [0, 1].
    pub exposed: f32,
}

impl Element {
    /// Three or four indices into [`Mesh::vertices`], counter-clockwise seen from the side where it shines.
    pub fn corners(&self) -> &[u32] {
        &self.corners[..self.corner_count as usize]
    }
}

impl Mesh {
    /// The region that an element covers.
    pub fn region(&self, element: &Element) -> Region {
        let corner = |i: usize| Vec3A::from(self.vertices[element.corners[i] as usize]);
        Region::new([corner(0), corner(1), corner(2), corner(3)], element.corner_count as usize)
    }

    /// States how much of each element is exposed, in [0, 1] and in the order of the elements.
    pub fn expose(&mut self, shares: &[f32]) {
        for (element, &share) in self.elements.iter_mut().zip(shares) {
            element.area *= f64::from(share) / f64::from(element.exposed);
            element.exposed = share;
        }
        for patch in &mut self.patches {
            let elements = &self.elements[patch.elements.start as usize..patch.elements.end as usize];
            patch.area = elements.iter().map(|element| element.area).sum();
        }
        self.weigh_vertices();
    }

    /// Mean over the elements of each patch, by exposed area; 0 where nothing is exposed. `values` has one entry an element.
    pub fn patch_means(&self, values: &[Rgb64]) -> Vec<Rgb64> {
        let mean = |patch: &Patch| {
            let range = patch.elements.start as usize..patch.elements.end as usize;
            let sum: Rgb64 = range.map(|index| values[index] * self.elements[index].area).sum();
            if patch.area > 0.0 { sum / patch.area } else { Rgb64::ZERO }
        };
        self.patches.iter().map(mean).collect()
    }

    /// Mean over the elements of one patch, by exposed area; 0 where nothing is exposed. `values` has one entry an element.
    pub fn patch_mean(&self, patch: &Patch, values: &[Rgb]) -> Rgb64 {
        let range = patch.elements.start as usize..patch.elements.end as usize;
        let sum: Rgb64 = range.map(|index| self.elements[index].area * values[index].as_dvec3()).sum();
        if patch.area > 0.0 { sum / patch.area } else { Rgb64::ZERO }
    }

    /// The meshed side of a polygon; `None` where light cannot reach it.
    pub fn side(&self, polygon: u32, is_front: bool) -> Option<&Side> {
        self.sides[side_index(polygon, is_front)].as_ref()
    }

    /// Total exposed area, m².
    pub fn area(&self) -> f64 {
        self.patches.iter().map(|patch| patch.area).sum()
    }
}

/// Index of a side in [`Mesh::sides`].
pub fn side_index(polygon: u32, is_front: bool) -> usize {
    2 * polygon as usize + usize::from(!is_front)
}

/// How finely surfaces are cut.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MeshSettings {
    /// Longest edge of an element (of a triangle, the second longest), m. `None`: the size at which the mesh has about [`MeshSettings::DEFAULT_ELEMENTS`].
    pub element_size: Option<f32>,
    /// Elements along the edge of a patch, at most. Receivers need more detail than shooters: a shadow's edge is seen
    /// where it falls, while the light that a patch sends on is blurred by distance (Cohen, Greenberg, Immel, Brock 1986).
    /// With 1, every element is a patch.
    pub elements_per_patch_edge: u32,
}

impl Default for MeshSettings {
    fn default() -> Self {
        Self { element_size: None, elements_per_patch_edge: 4 }
    }
}

impl MeshSettings {
    /// Few enough that two cores shoot more than a hundred times a second, fine enough for a soft shadow.
    pub const DEFAULT_ELEMENTS: f64 = 8000.0;
    /// More elements than this are refused: their light alone would take gigabytes.
    pub const MAX_ELEMENTS: f64 = 8e6;
    pub const MAX_ELEMENTS_PER_PATCH_EDGE: u32 = 16;
}
