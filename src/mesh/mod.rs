//! Polygon sides cut into patches, which shoot light, and elements, which receive it.

pub mod smooth;
pub mod subdivide;

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
}

/// One meshed side of a polygon.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Side {
    pub patches: Range<u32>,
    pub elements: Range<u32>,
    pub grid: Grid,
}

/// How a side is divided: `patches` along each edge, and `elements` along each edge of a patch. A triangle uses the
/// first number of each for all its edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    pub patches: [u32; 2],
    pub elements: [u32; 2],
}

/// A planar convex piece of a surface with one radiosity while it shoots.
#[derive(Clone, Debug)]
pub struct Patch {
    corners: [Vec3; 4],
    corner_count: u8,
    /// Unit normal on the side where the patch shines.
    pub normal: Vec3A,
    pub center: Vec3A,
    /// m²
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
}

/// The smallest piece, with one irradiance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    corners: [u32; 4],
    corner_count: u8,
    /// Index into [`Mesh::patches`].
    pub patch: u32,
    pub center: Vec3A,
    /// m²
    pub area: f64,
}

impl Element {
    /// Three or four indices into [`Mesh::vertices`], counter-clockwise seen from the side where it shines.
    pub fn corners(&self) -> &[u32] {
        &self.corners[..self.corner_count as usize]
    }
}

/// How finely surfaces are cut.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MeshSettings {
    /// Longest edge of an element, m. `None`: chosen so that the whole mesh has about [`MeshSettings::DEFAULT_ELEMENTS`].
    pub element_size: Option<f32>,
}
