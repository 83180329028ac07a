//! Ambient occlusion at the vertices of the mesh: it belongs to the scene, not to a camera, and is drawn from everywhere.
//!
//! A vertex looks from the corners of the elements round it, each drawn in a little towards the middle of its element, so
//! that no ray starts in the plane of the next wall. Where something stands on the surface, a corner moves on to where
//! light can be; what is covered as a whole takes no part. In a round every vertex gets the same number of rays, shared out
//! to its corners, and each corner asks again along a pattern of low discrepancy from round to round.

use super::{AmbientOcclusion, Pattern};
use crate::cancel::{Cancel, Cancelled};
use crate::math::random::hash;
use crate::mesh::Mesh;
use crate::methods::transport::{Surface, Transport};
use crate::methods::{OcclusionSettings, Settings, Step};
use crate::solution::VertexShares;
use crate::world::is_covered;
use glam::Vec3A;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

/// Rays of a batch, at least: enough for all cores, few enough for thirty batches a second.
const RAYS_PER_BATCH: u32 = 1 << 17;
/// Where a corner may look from, as shares of the way to the middle of its element; the first place where light can be.
/// The nearest one is off the edges by more than the rounding of coordinates, if an element is as small as a thousandth of
/// these, and by less than anyone sees.
const WAY: [f32; 5] = [1.0 / 256.0, 0.125, 0.25, 0.5, 1.0];
/// Marks this use of (seed, index) among the others.
const PASS: u64 = 0x0076_6572_7478;

/// Ambient occlusion on the mesh as state and a step.
pub struct VertexOcclusion {
    transport: Arc<Transport>,
    settings: Settings,
    /// Index into `corners` of the first one of each vertex, and their number.
    starts: Vec<u32>,
    corners: Vec<Corner>,
    /// By the rays that a corner has, which depend on how many corners a vertex looks from.
    looks: BTreeMap<u32, Look>,
    /// Of the shares in all rounds, for each vertex.
    sums: Vec<f64>,
    rounds: u32,
    /// Vertices of the round under way that are done.
    done: usize,
    batches: u64,
    rays: u64,
}

/// A corner of an element, at a vertex.
#[derive(Clone, Copy)]
struct Corner {
    /// Index into [`Mesh::elements`].
    element: u32,
    /// From where it looks; `None` if something stands on all of its way.
    way: Option<u8>,
}

/// With so many rays.
struct Look {
    occlusion: AmbientOcclusion,
    pattern: Pattern,
}

/// What a vertex got in one round.
struct Glance {
    share: f64,
    rays: u64,
}

impl VertexOcclusion {
    pub fn new(transport: Arc<Transport>, settings: &Settings) -> Self {
        let (starts, corners) = corners(&transport.world.mesh);
        let most = starts.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0);
        Self {
            looks: looks(&transport, settings, most),
            sums: vec![0.0; starts.len() - 1],
            starts,
            corners,
            settings: *settings,
            rounds: 0,
            done: 0,
            batches: 0,
            rays: 0,
            transport,
        }
    }

    /// One batch of vertices, all of it or nothing.
    pub fn step(&mut self, cancel: &Cancel) -> Step {
        if self.is_complete() {
            return Step::Converged;
        }
        let batch = (RAYS_PER_BATCH / self.settings.occlusion.rays.max(1)).max(1) as usize;
        let vertices = self.done..(self.done + batch).min(self.sums.len());
        if self.rounds == 0 {
            let Ok(placed) = self.placed(vertices.clone(), cancel) else { return Step::Cancelled };
            let corners = self.corners_of(vertices.clone());
            self.corners[corners].copy_from_slice(&placed);
        }
        let Ok(glances) = self.glances(vertices.clone(), cancel) else { return Step::Cancelled };
        for (sum, Glance { share, rays }) in self.sums[vertices.clone()].iter_mut().zip(glances) {
            *sum += share;
            self.rays += rays;
        }
        self.done = vertices.end;
        self.batches += 1;
        if self.done == self.sums.len() {
            self.rounds += 1;
            self.done = 0;
        }
        Step::Advanced
    }

    /// Rounds over all vertices that are done.
    pub fn rounds(&self) -> u32 {
        self.rounds
    }

    /// Takes settings over that only ask for more rounds, or fewer, and goes on; false, and nothing changes, for others.
    pub fn configure(&mut self, settings: &Settings) -> bool {
        let is_same = settings.occlusion == self.settings.occlusion && settings.seed == self.settings.seed;
        if is_same {
            self.settings = *settings;
        }
        is_same
    }

    /// Copies out what is known so far. Its `elapsed` is zero: whoever steps the method holds the clock.
    pub fn solution(&self) -> VertexShares {
        VertexShares {
            shares: Arc::new(if self.rounds > 0 { self.shares() } else { Vec::new() }),
            rounds: self.rounds,
            batches: self.batches,
            rays: self.rays,
            elapsed: Duration::ZERO,
            is_complete: self.is_complete(),
        }
    }

    fn is_complete(&self) -> bool {
        self.rounds >= self.settings.image.samples || self.sums.is_empty()
    }

    /// Means over rounds. A vertex that hangs on an edge has the value between its ends, as everywhere in pictures of the
    /// mesh (see [`crate::mesh::Hanging`]).
    fn shares(&self) -> Vec<f32> {
        let rounds = |vertex: usize| f64::from(self.rounds) + if vertex < self.done { 1.0 } else { 0.0 };
        let mut shares: Vec<f32> =
            self.sums.iter().enumerate().map(|(vertex, sum)| (sum / rounds(vertex)) as f32).collect();
        for hanging in &self.transport.world.mesh.hanging {
            let [from, to] = hanging.ends.map(|end| shares[end as usize]);
            shares[hanging.vertex as usize] = from + hanging.at * (to - from);
        }
        shares
    }

    fn corners_of(&self, vertices: Range<usize>) -> Range<usize> {
        self.starts[vertices.start] as usize..self.starts[vertices.end] as usize
    }

    /// The corners of some vertices, each with the place that it looks from.
    fn placed(&self, vertices: Range<usize>, cancel: &Cancel) -> Result<Vec<Corner>, Cancelled> {
        let placed = |vertex: usize, corner: &Corner| {
            let is_exposed = |way: &u8| self.is_exposed(&self.surface(vertex, corner.element, *way));
            Corner { way: (0..WAY.len() as u8).find(is_exposed), ..*corner }
        };
        let of_vertex = |vertex| {
            let corners = &self.corners[self.corners_of(vertex..vertex + 1)];
            let placed = corners.iter().map(|corner| placed(vertex, corner)).collect();
            if cancel.is_requested() { Err(Cancelled) } else { Ok(placed) }
        };
        let placed: Result<Vec<Vec<Corner>>, Cancelled> = vertices.into_par_iter().map(of_vertex).collect();
        Ok(placed?.concat())
    }

    /// Whether nothing stands on the surface at this place.
    fn is_exposed(&self, surface: &Surface) -> bool {
        let world = &self.transport.world;
        !is_covered(&world.mesh, &world.tracer, surface.surface_point(), surface.facing)
    }

    /// The place on the way from a vertex to the middle of an element.
    fn surface(&self, vertex: usize, element: u32, way: u8) -> Surface {
        let mesh = &self.transport.world.mesh;
        let element = &mesh.elements[element as usize];
        let patch = &mesh.patches[element.patch as usize];
        let corner = Vec3A::from(mesh.vertices[vertex]);
        let point = corner.lerp(element.center, WAY[usize::from(way)]);
        self.transport.surface_on(patch.polygon, patch.is_front, point)
    }

    /// One round of rays from some vertices.
    fn glances(&self, vertices: Range<usize>, cancel: &Cancel) -> Result<Vec<Glance>, Cancelled> {
        let glance = |vertex| if cancel.is_requested() { Err(Cancelled) } else { Ok(self.glance(vertex)) };
        vertices.into_par_iter().map(glance).collect()
    }

    /// Whatever is covered as a whole is dark, and nobody sees it.
    fn glance(&self, vertex: usize) -> Glance {
        let corners = self.corners_of(vertex..vertex + 1);
        let places = self.corners[corners.clone()].iter().zip(corners);
        let places: Vec<(u8, u32, usize)> =
            places.filter_map(|(corner, index)| Some((corner.way?, corner.element, index))).collect();
        let rays = rays_of_corner(&self.settings.occlusion, places.len().max(1) as u32);
        let Some(Look { occlusion, pattern }) = self.looks.get(&rays).filter(|_| !places.is_empty()) else {
            return Glance { share: 0.0, rays: 0 };
        };
        let share = |&(way, element, index): &(u8, u32, usize)| {
            let asker = hash(self.settings.seed, PASS, index as u64);
            let surface = self.surface(vertex, element, way);
            f64::from(occlusion.visibility_by(pattern, &surface, asker, self.rounds.into()).share)
        };
        let sum: f64 = places.iter().map(share).sum();
        Glance { share: sum / places.len() as f64, rays: u64::from(rays) * places.len() as u64 }
    }
}

/// Those of a corner, of a vertex that looks from so many.
fn rays_of_corner(settings: &OcclusionSettings, corners: u32) -> u32 {
    settings.rays.div_ceil(corners)
}

/// Looks for vertices of up to so many corners.
fn looks(transport: &Arc<Transport>, settings: &Settings, most_corners: u32) -> BTreeMap<u32, Look> {
    let mut looks = BTreeMap::new();
    for corners in 1..=most_corners {
        let rays = rays_of_corner(&settings.occlusion, corners);
        looks.entry(rays).or_insert_with(|| Look {
            occlusion: AmbientOcclusion::new(transport.clone(), &OcclusionSettings { rays, ..settings.occlusion }),
            pattern: Pattern::new(rays, settings.seed),
        });
    }
    looks
}

/// The corners of elements at each vertex that does not hang, and where those of a vertex begin.
fn corners(mesh: &Mesh) -> (Vec<u32>, Vec<Corner>) {
    let mut hangs = vec![false; mesh.vertices.len()];
    for hanging in &mesh.hanging {
        hangs[hanging.vertex as usize] = true;
    }
    let all = || {
        let elements = mesh.elements.iter().zip(0_u32..);
        let corners =
            elements.flat_map(|(element, index)| element.corners().iter().map(move |&vertex| (vertex, index)));
        corners.map(|(vertex, element)| (vertex as usize, element)).filter(|&(vertex, _)| !hangs[vertex])
    };
    let mut starts = vec![0; mesh.vertices.len() + 1];
    all().for_each(|(vertex, _)| starts[vertex + 1] += 1);
    for vertex in 0..mesh.vertices.len() {
        starts[vertex + 1] += starts[vertex];
    }
    let mut next = starts.clone();
    let mut corners = vec![Corner { element: 0, way: None }; starts[mesh.vertices.len()] as usize];
    for (vertex, element) in all() {
        corners[next[vertex] as usize] = Corner { element, way: None };
        next[vertex] += 1;
    }
    (starts, corners)
}
