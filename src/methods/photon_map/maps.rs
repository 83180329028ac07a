//! Photons made ready to be asked for the irradiance at a point.

use super::density::{Estimate, Sum};
use super::ground::Ground;
use super::horizon::Horizon;
use super::nearest::Nearest;
use super::tree::{Entry, Found, Tree};
use crate::math::rgb::Rgb;
use crate::methods::Kernel;
use crate::methods::transport::{Surface, Transport};
use crate::solution::{Gathered, Path, Photon, Split};
use glam::Vec3A;
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

/// Planes of the tree are handed out down to here.
const SPLIT_DEPTH: u8 = 12;

/// Tags of photons hold their group above what kind of light they are.
const KIND_BITS: u32 = 2;

/// What kind of light a photon is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Direct = 0,
    Indirect = 1,
    Caustic = 2,
}

impl Kind {
    fn of(path: Path) -> Self {
        if path.is_empty() {
            Self::Direct
        } else if path.is_caustic() {
            Self::Caustic
        } else {
            Self::Indirect
        }
    }
}

/// Which photons count.
#[derive(Clone, Copy, Debug)]
pub enum Which<'a> {
    All,
    /// Straight from the light.
    Direct,
    /// From a diffuse surface, perhaps by way of others.
    Indirect,
    /// From the light over specular surfaces alone.
    Caustics,
    Filtered(&'a PhotonFilter),
}

impl Which<'_> {
    /// A bit for each kind.
    fn kinds(self) -> u32 {
        match self {
            Self::All | Self::Filtered(_) => 0b111,
            Self::Direct => 1 << Kind::Direct as u32,
            Self::Indirect => 1 << Kind::Indirect as u32,
            Self::Caustics => 1 << Kind::Caustic as u32,
        }
    }
}

/// The photons whose light takes a path that is wanted.
#[derive(Clone, Debug)]
pub struct PhotonFilter {
    /// Of each path of the maps that it was made for.
    passes: Vec<bool>,
}

/// What a search needs of memory; to be kept from one to the next.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    nearest: Nearest,
    horizon: Horizon,
}

/// How photons are gathered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gathering {
    /// The most photons that an estimate uses; `None` for all within the radius.
    pub nearest: Option<usize>,
    pub kernel: Kernel,
    /// m
    pub max_radius: f32,
}

/// The photons of a map. What an estimate needs of them is in the order of the tree, so that neighbours are found together.
pub(super) struct Map {
    tree: Tree,
    /// By slot, W.
    flux: Vec<Rgb>,
    /// By slot: an index into [`Trees::paths`].
    path: Vec<u32>,
    emitted: Emitted,
    /// A bit for each kind of light that it may hold.
    kinds: u32,
}

/// The photons that a map is made of, as they left the emitters.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Emitted {
    /// So far.
    pub count: u64,
    /// What flux is to be multiplied by while some photons are still to come.
    pub scale: f32,
}

impl Map {
    /// Of photons with these indices; `path_of` tells the path of each photon.
    fn new(photons: &Kept, indices: &[u32], path_of: &[u32], ground: &Ground, emitted: Emitted, kinds: u32) -> Self {
        let entry = |&index: &u32| {
            let photon = photons.get(index);
            let tag = ground.group(photon.side) << KIND_BITS | Kind::of(photon.path) as u32;
            Entry { position: photon.position, index, tag }
        };
        let tree = Tree::new(indices.par_iter().map(entry).collect());
        Self {
            flux: tree.indices().par_iter().map(|&index| photons.get(index).flux).collect(),
            path: tree.indices().par_iter().map(|&index| path_of[index as usize]).collect(),
            tree,
            emitted,
            kinds,
        }
    }
}

/// All photons of a pass that are kept.
#[derive(Clone, Default)]
pub(super) struct Kept {
    /// Where they landed on diffuse surfaces.
    pub landed: Arc<Vec<Photon>>,
    /// Where they arrived at surfaces without a diffuse lobe. Their indices follow on those of the others.
    pub arrived: Arc<Vec<Photon>>,
}

impl Kept {
    fn get(&self, index: u32) -> &Photon {
        let index = index as usize;
        self.landed.get(index).unwrap_or_else(|| &self.arrived[index - self.landed.len()])
    }

    fn iter(&self) -> impl Iterator<Item = &Photon> {
        self.landed.iter().chain(self.arrived.iter())
    }

    pub fn len(&self) -> usize {
        self.landed.len() + self.arrived.len()
    }
}

/// The trees of both maps.
pub(super) struct Trees {
    transport: Arc<Transport>,
    ground: Arc<Ground>,
    photons: Kept,
    global: Map,
    caustic: Map,
    /// The different paths of photons.
    paths: Vec<Path>,
    has_caustic_map: bool,
    /// Of the global map.
    splits: Arc<Vec<Split>>,
    is_complete: bool,
}

/// What photons are put into trees.
pub(super) struct Stock {
    pub photons: Kept,
    /// Whether those of caustics are from a map of their own.
    pub has_caustic_map: bool,
    /// For each map.
    pub emitted: [Emitted; 2],
    pub is_complete: bool,
}

impl Trees {
    pub fn new(transport: Arc<Transport>, ground: Arc<Ground>, stock: Stock) -> Self {
        let Stock { photons, has_caustic_map, emitted, is_complete } = stock;
        let (mut paths, mut places) = (Vec::new(), HashMap::new());
        let path_of = photons.iter().map(|photon| {
            *places.entry(photon.path).or_insert_with(|| {
                paths.push(photon.path);
                paths.len() as u32 - 1
            })
        });
        let path_of: Vec<u32> = path_of.collect();
        let belongs_to_caustics = |index: &u32| has_caustic_map && photons.get(*index).path.is_caustic();
        let (caustic, global): (Vec<u32>, Vec<u32>) = (0..photons.len() as u32).partition(belongs_to_caustics);
        let map = |indices: &[u32], emitted, kinds| Map::new(&photons, indices, &path_of, &ground, emitted, kinds);
        let (all, of_caustics) = (Which::All.kinds(), Which::Caustics.kinds());
        let global = map(&global, emitted[0], if has_caustic_map { all & !of_caustics } else { all });
        let caustic = map(&caustic, emitted[1], of_caustics);
        let splits = Arc::new(global.tree.splits(SPLIT_DEPTH + 1));
        Self { transport, ground, photons, global, caustic, paths, has_caustic_map, splits, is_complete }
    }

    /// Where the surface ends within `radius`, m.
    fn look_round(&self, at: &Surface, radius: f32, horizon: &mut Horizon) {
        horizon.begin(self.ground.inside(at), at.facing);
        self.ground.segments(self.ground.group(at.side()), at.point, radius, |segment| horizon.add(segment, radius));
    }
}

/// The photons of a pass in trees. A surface is asked by where a ray met it; see [`Transport::meet`].
pub struct PhotonMaps {
    pub(super) trees: Arc<Trees>,
    pub(super) gathering: Gathering,
}

impl PhotonMaps {
    /// All photons, as in [`crate::solution::PhotonSolution::photons`].
    pub fn photons(&self) -> &Arc<Vec<Photon>> {
        &self.trees.photons.landed
    }

    /// How many photons are kept, those on surfaces without a diffuse lobe included.
    pub fn kept(&self) -> usize {
        self.trees.photons.len()
    }

    /// Whether all photons of the pass are there. If not, those that are stand for all.
    pub fn is_complete(&self) -> bool {
        self.trees.is_complete
    }

    /// The farthest at which an estimate looks for photons, m.
    pub fn max_radius(&self) -> f32 {
        self.gathering.max_radius
    }

    /// The transport whose photons these are.
    pub fn transport(&self) -> &Arc<Transport> {
        &self.trees.transport
    }

    /// How the tree of the global map divides it, down to a depth that can be drawn.
    pub fn splits(&self) -> &Arc<Vec<Split>> {
        &self.trees.splits
    }

    /// The photons whose path passes. It is good for these maps only.
    pub fn filter(&self, passes: impl Fn(Path) -> bool) -> PhotonFilter {
        PhotonFilter { passes: self.trees.paths.iter().map(|&path| passes(path)).collect() }
    }

    /// What the flux of a photon is to be multiplied by while some are still to come: those that are there stand for all.
    pub fn scale(&self, photon: &Photon) -> f32 {
        self.emitted(photon).scale
    }

    /// Which of `batches` a photon belongs to, if those of its map are divided into equal ones in the order in which they
    /// were emitted: all landings of a photon are in one batch, and batches know nothing of each other.
    pub fn batch(&self, photon: &Photon, batches: usize) -> usize {
        let place = u64::from(photon.emission) * batches as u64 / self.emitted(photon).count.max(1);
        (place as usize).min(batches - 1)
    }

    fn emitted(&self, photon: &Photon) -> Emitted {
        let is_caustic = self.trees.has_caustic_map && photon.path.is_caustic();
        if is_caustic { self.trees.caustic.emitted } else { self.trees.global.emitted }
    }

    /// Irradiance at a surface, on the side that was met.
    pub fn irradiance(&self, at: &Surface, which: Which, scratch: &mut Scratch) -> Estimate {
        let global = self.sum(&self.trees.global, at, which, scratch, &mut |_| {});
        let caustic = self.sum(&self.trees.caustic, at, which, scratch, &mut |_| {});
        global.with(&caustic).estimate()
    }

    /// What the estimate of the irradiance at a surface is made of.
    pub fn gathered(&self, at: &Surface) -> Gathered {
        let mut scratch = Scratch::default();
        let (mut used, mut rejected) = (Vec::new(), Vec::new());
        let is_drawn = |photon: &u32| (*photon as usize) < self.trees.photons.landed.len();
        let mut sum = Sum::default();
        for map in [&self.trees.global, &self.trees.caustic] {
            let mut own = Vec::new();
            let part = self.sum(map, at, Which::All, &mut scratch, &mut |slot| own.push(map.tree.index(slot)));
            own.sort_unstable();
            // What is on the rim does not count, but belongs.
            let within = part.radius().powi(2) * (1.0 - 4.0 * f32::EPSILON);
            map.tree.search(at.point, within, |found, bound| {
                let photon = map.tree.index(found.slot);
                if own.binary_search(&photon).is_err() {
                    rejected.push(photon);
                }
                bound
            });
            used.append(&mut own);
            sum = sum.with(&part);
        }
        used.retain(is_drawn);
        rejected.retain(is_drawn);
        rejected.sort_unstable();
        let Estimate { irradiance, photons, radius, inside, relative_error, .. } = sum.estimate();
        Gathered {
            point: at.point.into(),
            normal: at.facing.into(),
            irradiance,
            radius,
            inside,
            relative_error,
            photons,
            used,
            rejected,
        }
    }

    /// Photons of a map, weighted and summed; the slot of each is told to `used`.
    fn sum(&self, map: &Map, at: &Surface, which: Which, scratch: &mut Scratch, used: &mut impl FnMut(u32)) -> Sum {
        let Gathering { nearest: limit, kernel, max_radius } = self.gathering;
        let kinds = which.kinds() & map.kinds;
        if map.tree.is_empty() || kinds == 0 {
            let mut sum = Sum::new(max_radius, 1.0);
            if kinds != 0 {
                sum.doubt(self.mean_flux(map));
            }
            return sum;
        }
        let Scratch { nearest, horizon } = scratch;
        let trees = &*self.trees;
        let ground = &*trees.ground;
        let group = ground.group(at.side());
        let passes = |found: &Found| match which {
            Which::Filtered(filter) => filter.passes[map.path[found.slot as usize] as usize],
            _ => true,
        };
        trees.look_round(at, max_radius, horizon);
        let is_flat = !ground.is_curved(group);
        let (is_open, horizon) = (horizon.is_open(), &*horizon);
        let counts = |found: &Found| {
            found.tag >> KIND_BITS == group
                && kinds >> (found.tag & 0b11) & 1 == 1
                && passes(found)
                && (is_flat || bends_little(ground, at, trees.photons.get(map.tree.index(found.slot))))
                && (is_open || horizon.sees(map.tree.position(found.slot)))
        };
        nearest.begin(limit.unwrap_or(usize::MAX));
        map.tree.search(at.point, max_radius * max_radius, |found, bound| {
            if counts(&found) { nearest.add(&found, bound) } else { bound }
        });
        // The farthest of k is the rim. Of those within the rim there are k − 1, which makes the estimate unbiased; all k
        // would be k / (k − 1) too many.
        let rim = nearest.end();
        let radius = rim.map_or(max_radius, f32::sqrt);
        let mut sum = Sum::new(radius, horizon.inside(kernel, radius));
        let points = nearest.points();
        let within = points.len() - usize::from(rim.is_some());
        for (square_distance, slot) in points.take(within) {
            sum.add(map.flux[slot as usize], square_distance, kernel);
            used(slot);
        }
        sum.doubt(self.mean_flux(map));
        sum.scale(map.emitted.scale);
        sum
    }

    /// Of the photons of a map as they left the emitters, W.
    fn mean_flux(&self, map: &Map) -> Rgb {
        let count = f64::from(map.emitted.scale) * map.emitted.count as f64;
        if count > 0.0 { (self.trees.transport.emitters().flux() / count).as_vec3() } else { Rgb::ZERO }
    }
}

/// Whether a photon landed on a surface that faces about the same way and is not far off the plane of another place of it.
fn bends_little(ground: &Ground, at: &Surface, photon: &Photon) -> bool {
    /// Cosine of the largest angle between the two: 60°.
    const FACING: f32 = 0.5;
    /// Sine of the largest elevation: half that angle, on a round body.
    const ELEVATION: f32 = 0.5;
    let way = Vec3A::from(photon.position) - at.point;
    let height = way.dot(at.facing);
    ground.facing(photon.side).dot(at.facing) >= FACING
        && height * height <= ELEVATION * ELEVATION * way.length_squared()
}
