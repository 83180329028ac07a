//! Where ways to compute light are tried: one scene, cut as finely as each of them asks for, its truth, and what is known of runs
//! on it.

use super::memory::Memory;
use crate::accuracy::{Cache, CacheError, Reference};
use crate::cancel::Cancel;
use crate::mesh::MeshSettings;
use crate::world::{World, WorldError};
use std::sync::Arc;
use std::time::Instant;

/// A scene and what is known about it.
pub struct Bench {
    /// The worlds that were asked for, the first one as the scene was opened.
    worlds: Vec<(MeshSettings, Arc<World>)>,
    pub reference: Reference,
    pub memory: Memory,
    cache: Option<Cache>,
}

impl Bench {
    /// `world` is the scene with this mesh. Goes on from what the cache knows of it.
    pub fn open(world: Arc<World>, mesh: MeshSettings, cache: Option<Cache>) -> Self {
        let reference = Reference::open(world.clone(), cache.as_ref());
        let memory = cache.as_ref().map(|cache| Memory::load(cache, reference.key())).unwrap_or_default();
        Self { worlds: vec![(mesh, world)], reference, memory, cache }
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
        &self.worlds[0].1
    }

    /// The scene with this mesh, which is kept.
    ///
    /// # Errors
    /// If it cannot be cut so, or was cancelled.
    pub fn remeshed(&mut self, mesh: &MeshSettings, cancel: &Cancel) -> Result<Arc<World>, WorldError> {
        if let Some((_, world)) = self.worlds.iter().find(|(settings, _)| settings == mesh) {
            return Ok(world.clone());
        }
        let world = Arc::new(self.world().remeshed(mesh, cancel)?);
        self.worlds.push((*mesh, world.clone()));
        Ok(world)
    }

    /// Makes the truth better known until time is up, or there is no light.
    pub fn refine_until(&mut self, end: Instant, cancel: &Cancel) {
        while Instant::now() < end && !self.reference.truth().is_dark() && self.reference.refine(cancel) {}
    }
}
