//! Vertices that elements share where light is smooth across them.

use glam::{Vec3, Vec3A};
use std::collections::HashMap;

/// Sides that meet at a sharper angle than this show a crease. cos 30°
const CREASE_COSINE: f32 = 0.866;

/// The surface that something is a part of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    /// Unit normal on the side where it shines.
    pub normal: Vec3A,
    /// Index into the scene's materials.
    pub material: u32,
}

impl Surface {
    /// Whether no crease or change of material separates the two.
    pub fn is_smooth_with(&self, other: &Self) -> bool {
        self.material == other.material && self.normal.dot(other.normal) >= CREASE_COSINE
    }
}

/// Vertices while the mesh is being cut.
#[derive(Default)]
pub(super) struct Vertices {
    pub positions: Vec<Vec3>,
    /// The surface that made each vertex.
    pub surfaces: Vec<Surface>,
    /// The next vertex in the same place.
    next: Vec<Option<u32>>,
    /// The newest vertex at a position, by the bits of its coordinates.
    by_position: HashMap<[u32; 3], u32>,
}

impl Vertices {
    /// The vertex of `surface` at `position`: one that is there already where the surfaces are smooth, else a new one.
    pub fn share(&mut self, position: Vec3, surface: Surface) -> u32 {
        // Adding zero makes −0 and +0 one place.
        let key = (position + Vec3::ZERO).to_array().map(f32::to_bits);
        let newest = self.by_position.get(&key).copied();
        let mut candidate = newest;
        while let Some(vertex) = candidate {
            if self.surfaces[vertex as usize].is_smooth_with(&surface) {
                return vertex;
            }
            candidate = self.next[vertex as usize];
        }
        let vertex = self.positions.len() as u32;
        self.positions.push(position);
        self.surfaces.push(surface);
        self.next.push(newest);
        self.by_position.insert(key, vertex);
        vertex
    }
}
