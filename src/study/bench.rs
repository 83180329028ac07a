//! Where ways to compute light are tried: one scene, its truth, and what is known of runs on it.

use super::memory::Memory;
use super::worlds::Worlds;
use crate::accuracy::{Cache, CacheError, Reference};
use crate::cancel::Cancel;
use crate::mesh::MeshSettings;
use crate::world::World;
use std::sync::Arc;
use std::time::Instant;

/// A scene and what is known about it.
pub struct Bench {
    pub worlds: Worlds,
    pub reference: Reference,
    pub memory: Memory,
    cache: Option<Cache>,
}

impl Bench {
    /// `world` is the scene with this mesh. Goes on from what the cache knows of it.
    pub fn open(world: Arc<World>, mesh: MeshSettings, cache: Option<Cache>) -> Self {
        let reference = Reference::open(world.clone(), cache.as_ref());
        let memory = cache.as_ref().map(|cache| Memory::load(cache, reference.key())).unwrap_or_default();
        Self { worlds: Worlds::new(world, mesh), reference, memory, cache }
    }

    /// Keeps what is known now for the next time.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep(&self) -> Result<(), CacheError> {
        let Some(cache) = &self.cache else { return Ok(()) };
        self.reference.keep(cache)?;
        self.memory.store(cache, self.reference.key())
    }

    /// The scene as it was opened.
    pub fn world(&self) -> &Arc<World> {
        self.worlds.first()
    }

    /// Makes the truth better known until time is up, or there is no light.
    pub fn refine_until(&mut self, end: Instant, cancel: &Cancel) {
        while Instant::now() < end && !self.reference.truth().is_dark() && self.reference.refine(cancel) {}
    }
}
