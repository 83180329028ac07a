//! What ambient occlusion on the mesh hands out: how much of an even light from everywhere arrives at each vertex.

use std::sync::Arc;
use std::time::Duration;

/// Ambient occlusion at the vertices of a mesh, at one moment.
#[derive(Clone, Debug, Default)]
pub struct VertexShares {
    /// Share of the ambient light that arrives at each vertex, in [0, 1]; empty before each vertex has one.
    pub shares: Arc<Vec<f32>>,
    /// Rounds over all vertices that are done.
    pub rounds: u32,
    /// Batches of vertices in all rounds.
    pub batches: u64,
    pub rays: u64,
    /// Time spent in steps, filled in by whoever runs the method.
    pub elapsed: Duration,
    /// Whether all rounds are done that are wanted.
    pub is_complete: bool,
}
