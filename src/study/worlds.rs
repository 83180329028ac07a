//! One scene, cut as finely as each way to compute light asks for.

use crate::cancel::Cancel;
use crate::mesh::MeshSettings;
use crate::world::{World, WorldError};
use std::sync::Arc;

/// The worlds that were asked for, the first one as the scene was opened.
pub struct Worlds(Vec<(MeshSettings, Arc<World>)>);

impl Worlds {
    /// `world` is the scene with this mesh.
    pub fn new(world: Arc<World>, mesh: MeshSettings) -> Self {
        Self(vec![(mesh, world)])
    }

    /// The scene as it was opened.
    pub fn first(&self) -> &Arc<World> {
        &self.0[0].1
    }

    /// The scene with this mesh, which is kept.
    ///
    /// # Errors
    /// If it cannot be cut so, or was cancelled.
    pub fn remeshed(&mut self, mesh: &MeshSettings, cancel: &Cancel) -> Result<Arc<World>, WorldError> {
        if let Some((_, world)) = self.0.iter().find(|(settings, _)| settings == mesh) {
            return Ok(world.clone());
        }
        let world = Arc::new(self.first().remeshed(mesh, cancel)?);
        self.0.push((*mesh, world.clone()));
        Ok(world)
    }
}
