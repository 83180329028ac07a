//! T-junctions: vertices that lie on an edge of another element.
//!
//! Where two sides of one surface meet and are cut differently, or where a corner of one lies in the middle of an edge of
//! the other, each would have means of its own elements at its own vertices, and brightness would crack along the edge.
//! So a vertex of the finer side hangs on the edge of the coarser one: the elements round it count at the ends of that
//! edge, in proportion to how near each is, and its value is interpolated between theirs (Baum, Mann, Smith, Winget
//! 1991; Cohen, Wallace 1993). The two sides then agree at every vertex of the finer one, and all along the edge if it
//! has all vertices of the coarser one.
//!
//! If it has not, the only function that is linear between the vertices of both sides is straight from one common vertex
//! to the next, however far: it would wipe out every shadow that crosses the edge. There the sides differ between two
//! vertices of the finer one by at most a quarter of the change of slope at the coarser one's vertex between them, times
//! their distance: second order in the size of elements, as the error of linear interpolation is itself.

use super::Mesh;
use super::outline::{LooseEdge, loose_edges};
use super::point_tree::PointTree;
use super::vertices::Surface;
use crate::cancel::{Cancel, Cancelled};
use crate::math::bounds::Bounds;
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// A vertex is on an edge if it is nearer than this, in units of the mesh's largest coordinate: what flat quads may be
/// out of plane by, which also is what six decimals leave of a scene of a few metres.
const ON_EDGE: f64 = 16.0 * f32::EPSILON as f64;
/// It also is nearer than this share of the edge's length, so that no element is smaller than the tolerance.
const ON_SHORT_EDGE: f64 = 1.0 / 64.0;

/// A vertex whose value is interpolated between two others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hanging {
    /// Index into [`Mesh::vertices`].
    pub vertex: u32,
    /// The ends of the edge on which it lies.
    pub ends: [u32; 2],
    /// Where it lies on the way from the first end to the second, in [0, 1].
    pub at: f32,
}

/// All hanging vertices, each after those that it hangs on. `surfaces` has that of every vertex.
///
/// # Errors
/// If cancelled.
pub(super) fn hanging_vertices(mesh: &Mesh, surfaces: &[Surface], cancel: &Cancel) -> Result<Vec<Hanging>, Cancelled> {
    let edges = loose_edges(mesh);
    let ground = Ground { positions: &mesh.vertices, surfaces, edges: &edges, tolerance: tolerance(&mesh.vertices) };
    let touches = ground.touches(cancel)?;
    let same_as = ground.welded(&touches);
    let mut hanging = in_order(&ground.hosted(&touches, &same_as));
    let welded = same_as.iter().enumerate().filter(|&(vertex, &other)| other != vertex as u32);
    hanging.extend(welded.map(|(vertex, &other)| Hanging { vertex: vertex as u32, ends: [other; 2], at: 0.0 }));
    Ok(hanging)
}

/// How near to an edge a vertex on it is, m.
fn tolerance(positions: &[Vec3]) -> f64 {
    ON_EDGE * f64::from(Bounds::of(positions.iter().copied()).magnitude())
}

/// What is looked at while vertices on edges are looked for.
struct Ground<'a> {
    positions: &'a [Vec3],
    surfaces: &'a [Surface],
    edges: &'a [LooseEdge],
    /// m
    tolerance: f64,
}

/// A vertex on an edge.
#[derive(Clone, Copy, Debug)]
struct Touch {
    vertex: u32,
    /// Index of the edge.
    edge: u32,
    /// Exactly 0 or 1 where the vertex is too near to an end to be told from it.
    at: f64,
}

impl Ground<'_> {
    fn position(&self, vertex: u32) -> DVec3 {
        self.positions[vertex as usize].as_dvec3()
    }

    /// The vector along an edge, m.
    fn along(&self, edge: &LooseEdge) -> DVec3 {
        self.position(edge.ends[1]) - self.position(edge.ends[0])
    }

    /// All vertices of loose edges that lie on others of a smooth surface, in the order of edges.
    fn touches(&self, cancel: &Cancel) -> Result<Vec<Touch>, Cancelled> {
        let mut vertices: Vec<u32> = self.edges.iter().flat_map(|edge| edge.ends).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let tree = PointTree::new(self.positions, vertices);
        let touches_of = |index| if cancel.is_requested() { Err(Cancelled) } else { Ok(self.touches_of(index, &tree)) };
        let touches: Vec<Vec<Touch>> =
            (0..self.edges.len()).into_par_iter().map(touches_of).collect::<Result<_, _>>()?;
        Ok(touches.into_iter().flatten().collect())
    }

    fn touches_of(&self, index: usize, tree: &PointTree) -> Vec<Touch> {
        let edge = &self.edges[index];
        let (start, along) = (self.position(edge.ends[0]), self.along(edge));
        let length = along.length();
        let tolerance = self.tolerance.min(ON_SHORT_EDGE * length);
        let mut touches = Vec::new();
        if tolerance == 0.0 {
            return touches;
        }
        let ends = edge.ends.map(|end| self.positions[end as usize]);
        // Rounded up, since it is added to coordinates that are rounded themselves.
        let margin = Vec3::splat(2.0 * tolerance as f32);
        let region = Bounds { min: ends[0].min(ends[1]) - margin, max: ends[0].max(ends[1]) + margin };
        tree.visit(&region, &mut |vertex| {
            if !self.surfaces[vertex as usize].is_smooth_with(&edge.surface) || edge.ends.contains(&vertex) {
                return;
            }
            let to = self.position(vertex) - start;
            let distance = to.dot(along) / length;
            let is_on_line = (to - along * (distance / length)).length() <= tolerance;
            let is_between = distance >= -tolerance && distance <= length + tolerance;
            if !is_on_line || !is_between {
                return;
            }
            let at = match distance {
                _ if distance <= tolerance => 0.0,
                _ if distance >= length - tolerance => 1.0,
                _ => distance / length,
            };
            touches.push(Touch { vertex, edge: index as u32, at });
        });
        touches
    }

    /// For each vertex the first one in the same place and on the same surface, which is itself almost everywhere.
    fn welded(&self, touches: &[Touch]) -> Vec<u32> {
        let pair = |touch: &Touch| {
            let end = self.edges[touch.edge as usize].ends[touch.at as usize];
            (touch.vertex.max(end), touch.vertex.min(end))
        };
        let mut pairs: Vec<(u32, u32)> =
            touches.iter().filter(|touch| touch.at == 0.0 || touch.at == 1.0).map(pair).collect();
        pairs.sort_unstable();
        let mut same_as: Vec<u32> = (0..self.positions.len() as u32).collect();
        for (later, earlier) in pairs {
            // Final, since all pairs of earlier vertices have come.
            let first = same_as[earlier as usize];
            if self.surfaces[first as usize].is_smooth_with(&self.surfaces[later as usize]) {
                same_as[later as usize] = same_as[later as usize].min(first);
            }
        }
        same_as
    }

    /// The vertices that lie inside edges which lead them, by index, each with the leading one of its edges.
    fn hosted(&self, touches: &[Touch], same_as: &[u32]) -> Vec<Hanging> {
        let same = |vertex: u32| same_as[vertex as usize];
        let mut edges_at: Vec<(u32, u32)> =
            (0u32..).zip(self.edges).flat_map(|(index, edge)| edge.ends.map(|end| (same(end), index))).collect();
        edges_at.par_sort_unstable();
        let mut hosted = Vec::new();
        for touch in touches.iter().filter(|touch| touch.at > 0.0 && touch.at < 1.0) {
            let (vertex, edge) = (same(touch.vertex), &self.edges[touch.edge as usize]);
            let ends = edge.ends.map(same);
            let first = edges_at.partition_point(|&(at, _)| at < vertex);
            let own = edges_at[first..].iter().take_while(|&&(at, _)| at == vertex);
            let leads = |&(_, own): &(u32, u32)| {
                let own = &self.edges[own as usize];
                edge.rank < own.rank || !self.are_parallel(edge, own)
            };
            if !ends.contains(&vertex) && own.clone().all(leads) {
                hosted.push((edge.rank, Hanging { vertex, ends, at: touch.at as f32 }));
            }
        }
        hosted.sort_by_key(|&(rank, hanging)| (hanging.vertex, rank));
        hosted.dedup_by_key(|(_, hanging)| hanging.vertex);
        hosted.into_iter().map(|(_, hanging)| hanging).collect()
    }

    /// Whether two edges have one direction, as far as ends that may be off by the tolerance tell.
    fn are_parallel(&self, a: &LooseEdge, b: &LooseEdge) -> bool {
        let (a, b) = (self.along(a), self.along(b));
        let (length_a, length_b) = (a.length(), b.length());
        let tolerance = self.tolerance.min(ON_SHORT_EDGE * length_a.min(length_b));
        a.cross(b).length() <= 2.0 * tolerance * (length_a + length_b)
    }
}

/// Sorts hanging vertices, given by index, so that each comes after those that it hangs on. Edges of one line cannot
/// hang on each other in a ring, since ranks fall; four corners round a pinwheel of rectangles can. The one that closes a
/// ring is left out.
fn in_order(hosted: &[Hanging]) -> Vec<Hanging> {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        Waiting,
        Done,
    }
    let find = |vertex: u32| hosted.binary_search_by_key(&vertex, |hanging| hanging.vertex).ok();
    let mut states = vec![State::New; hosted.len()];
    let mut ordered = Vec::with_capacity(hosted.len());
    for first in 0..hosted.len() {
        let mut path = if states[first] == State::New { vec![first] } else { Vec::new() };
        while let Some(&last) = path.last() {
            states[last] = State::Waiting;
            let mut before = hosted[last].ends.into_iter().filter_map(find);
            if let Some(next) = before.clone().find(|&index| states[index] == State::New) {
                path.push(next);
                continue;
            }
            if before.all(|index| states[index] == State::Done) {
                ordered.push(hosted[last]);
            }
            states[last] = State::Done;
            path.pop();
        }
    }
    ordered
}
