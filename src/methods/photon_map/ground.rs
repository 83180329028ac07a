//! Which surfaces belong together: photons on one say something about light on the other.

use crate::methods::transport::{Surface, Transport};

/// The surfaces of a scene, joined where they go on smoothly.
pub struct Ground {
    /// Of each side, as in [`crate::mesh::Mesh::sides`].
    groups: Vec<u32>,
}

impl Ground {
    pub fn new(transport: &Transport) -> Self {
        Self { groups: (0..2 * transport.world.scene.polygons.len() as u32).collect() }
    }

    /// The group of a side.
    pub fn group(&self, side: u32) -> u32 {
        self.groups[side as usize]
    }

    /// The group that a surface belongs to.
    pub fn group_of(&self, surface: &Surface) -> u32 {
        self.group(surface.side())
    }
}
