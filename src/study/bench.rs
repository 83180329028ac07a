//! Where ways to compute light are tried: one scene, cut as finely as each of them asks for, and its truth.

use crate::accuracy::{Found, Reference, Truth};
use crate::cancel::Cancel;
use crate::mesh::MeshSettings;
use crate::world::{World, WorldError};
use std::sync::Arc;
use std::time::Instant;

/// A scene and the truth about it.
pub struct Bench {
    /// The worlds that were asked for, the first one with the mesh that is automatic.
    worlds: Vec<(MeshSettings, Arc<World>)>,
    pub reference: Reference,
}

impl Bench {
    /// `world` is the scene with this mesh.
    pub fn new(world: Arc<World>, mesh: MeshSettings, reference: Reference) -> Self {
        Self { worlds: vec![(mesh, world)], reference }
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

    /// Makes the truth better known until it is good enough for these, or time is up.
    pub fn refine_for<'a>(&mut self, found: impl Fn() -> Vec<&'a Found>, end: Instant, cancel: &Cancel) {
        let is_enough = |truth: &Truth| {
            let errors: Vec<_> = found().into_iter().filter_map(|found| truth.error(found)).collect();
            truth.is_dark() || !errors.is_empty() && errors.iter().all(|error| truth.is_enough_for(error))
        };
        while Instant::now() < end && !is_enough(self.reference.truth()) && self.reference.refine(cancel) {}
    }
}
