//! The edges of elements along the outlines of sides that no other element shares.
//!
//! Inside a side's grid every edge belongs to two elements, and so it does where two sides are cut alike along a common
//! edge. Where they are not, and at creases, borders of materials and open ends, edges are *loose*: only on these can a
//! vertex of another element lie, and only their own ends can lie on others.

use super::vertices::Surface;
use super::{Mesh, Side};
use rayon::prelude::*;

/// An edge of an element that belongs to no other.
#[derive(Clone, Copy, Debug)]
pub(super) struct LooseEdge {
    /// Indices into [`Mesh::vertices`].
    pub ends: [u32; 2],
    pub surface: Surface,
    pub rank: Rank,
}

/// Which of two edges on one line leads: the one that is cut more coarsely has the lower rank. All edges along one edge
/// of a side have the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Rank {
    /// −1024 log₂ of the length, m, in whole numbers: lengths that only rounding tells apart are the same.
    shortness: i32,
    /// Running number of the edge of a side.
    outline: u32,
}

/// All loose edges, side by side and in order along each.
pub(super) fn loose_edges(mesh: &Mesh) -> Vec<LooseEdge> {
    let mut edges = Vec::new();
    let mut outline = 0;
    for side in mesh.sides.iter().flatten() {
        for edge in 0..side.shape.corners().len() {
            add_edges(mesh, side, edge, outline, &mut edges);
            outline += 1;
        }
    }
    let key = |edge: &LooseEdge| {
        let [from, to] = edge.ends;
        (from.min(to), from.max(to))
    };
    let mut by_key: Vec<_> = edges.iter().enumerate().map(|(index, edge)| (key(edge), index as u32)).collect();
    by_key.par_sort_unstable();
    let alone = by_key.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1);
    let mut loose: Vec<u32> = alone.map(|same| same[0].1).collect();
    loose.par_sort_unstable();
    loose.iter().map(|&index| edges[index as usize]).collect()
}

/// Adds the edges of elements along one edge of a side.
fn add_edges(mesh: &Mesh, side: &Side, edge: usize, outline: u32, edges: &mut Vec<LooseEdge>) {
    let corners = side.shape.corners();
    let patch = &mesh.patches[side.patches.start as usize];
    let surface = Surface { normal: patch.normal, material: patch.material };
    let per_patch = side.shape.cells(side.grid.elements);
    let next = (edge + 1) % corners.len();
    let first = edges.len();
    for patch_cell in side.shape.edge_cells(side.grid.patches, edge) {
        for element_cell in side.shape.edge_cells(side.grid.elements, edge) {
            let element = &mesh.elements[(side.elements.start + patch_cell * per_patch + element_cell) as usize];
            let ends = [element.corners[edge], element.corners[next]];
            edges.push(LooseEdge { ends, surface, rank: Rank { shortness: 0, outline } });
        }
    }
    let length = corners[edge].distance(corners[next]) / (edges.len() - first) as f64;
    let shortness = (-1024.0 * length.log2()).round() as i32;
    edges[first..].iter_mut().for_each(|edge| edge.rank.shortness = shortness);
}
