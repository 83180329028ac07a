//! The tree in which photons are looked up: a left-balanced kd-tree (Bentley 1975; Jensen 2001) whose leaves are blocks of
//! photons that lie next to each other in memory.

use crate::math::bounds::Bounds;
use crate::solution::Split;
use glam::{Vec3, Vec3A};
use rayon::prelude::*;

/// Photons in a block: enough that most of a search runs over memory from front to back.
const LANES: usize = 16;
/// Below this many photons a part of the tree is built by one thread.
const ALONE: usize = 1 << 13;
/// Of blocks that are not full: they match nothing.
const NOTHING: u32 = u32::MAX;

/// A point to be put into a tree.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    pub position: Vec3,
    /// Which photon it is.
    pub index: u32,
    /// What a search can tell photons apart by before it looks at anything else.
    pub tag: u32,
}

/// Positions and tags of the photons of a leaf.
#[derive(Clone, Copy, Debug)]
struct Block {
    x: [f32; LANES],
    y: [f32; LANES],
    z: [f32; LANES],
    tag: [u32; LANES],
}

impl Block {
    const EMPTY: Self =
        Self { x: [f32::INFINITY; LANES], y: [f32::INFINITY; LANES], z: [f32::INFINITY; LANES], tag: [NOTHING; LANES] };

    /// Of each lane, m²: a loop that the compiler turns into vectors.
    fn square_distances(&self, at: Vec3A) -> [f32; LANES] {
        let mut squares = [0.0; LANES];
        for (lane, square) in squares.iter_mut().enumerate() {
            let (x, y, z) = (self.x[lane] - at.x, self.y[lane] - at.y, self.z[lane] - at.z);
            *square = x * x + y * y + z * z;
        }
        squares
    }
}

/// A plane across an axis. Photons before it are in the first part, those behind in the second, and those on it in either.
#[derive(Clone, Copy, Debug, Default)]
struct Plane {
    at: f32,
    axis: u32,
}

/// Points in nested boxes. Nothing points anywhere: a part of the tree with `n` blocks has the first blocks of them in its
/// first part, so many that only the last level is not full, and that from the left.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// Of node `i`, whose parts are `2 i` and `2 i + 1`; the root is 1.
    planes: Vec<Plane>,
    blocks: Vec<Block>,
    /// The photon in each lane of each block, one after another.
    indices: Vec<u32>,
    bounds: Option<Bounds>,
}

/// A point that a search came upon.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// m²
    pub square_distance: f32,
    /// Where it is in the tree.
    pub slot: u32,
    pub tag: u32,
}

/// A part of the tree that a search still has to look at.
#[derive(Clone, Copy, Default)]
struct Task {
    node: u32,
    first_block: u32,
    blocks: u32,
    /// Least square distance of the part's cell, m².
    square_distance: f32,
    /// How far the cell is on each axis, m.
    offset: Vec3A,
}

/// Levels of a tree of 2³² photons.
const DEEPEST: usize = 32;

impl Tree {
    /// Builds the tree on all cores; it does not depend on their number.
    pub fn new(mut entries: Vec<Entry>) -> Self {
        if entries.is_empty() {
            return Self::default();
        }
        let bounds = Bounds::of(entries.iter().map(|entry| entry.position));
        let blocks = entries.len().div_ceil(LANES);
        let levels = divide(&mut entries, blocks);
        let mut planes = vec![Plane::default(); blocks.max(2)];
        place(&levels, 1, &mut planes);
        let fill = |lanes: &[Entry]| {
            let mut block = Block::EMPTY;
            for (lane, entry) in lanes.iter().enumerate() {
                [block.x[lane], block.y[lane], block.z[lane]] = entry.position.to_array();
                block.tag[lane] = entry.tag;
            }
            block
        };
        Self {
            planes,
            blocks: entries.par_chunks(LANES).map(fill).collect(),
            indices: entries.par_iter().map(|entry| entry.index).collect(),
            bounds: Some(bounds),
        }
    }

    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// The photon at a slot.
    pub fn index(&self, slot: u32) -> u32 {
        self.indices[slot as usize]
    }

    /// The photons in the order of their slots.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// Where the photon at a slot is, m.
    pub fn position(&self, slot: u32) -> Vec3A {
        let (block, lane) = (&self.blocks[slot as usize / LANES], slot as usize % LANES);
        Vec3A::new(block.x[lane], block.y[lane], block.z[lane])
    }

    /// Calls `visit` with every point that is nearer than the square root of `bound`, m², the near parts of the tree first.
    /// It returns the bound from then on.
    pub fn search(&self, at: Vec3A, mut bound: f32, mut visit: impl FnMut(Found, f32) -> f32) {
        if self.is_empty() {
            return;
        }
        let mut tasks = [Task::default(); DEEPEST];
        let mut waiting = 1;
        tasks[0] = Task { node: 1, blocks: self.blocks.len() as u32, ..Task::default() };
        while waiting > 0 {
            waiting -= 1;
            let mut task = tasks[waiting];
            if task.square_distance >= bound {
                continue;
            }
            while task.blocks > 1 {
                let Plane { at: plane, axis } = self.planes[task.node as usize];
                let axis = axis as usize;
                let distance = at[axis] - plane;
                let first = first_part(task.blocks);
                let [mut near, mut far] = [
                    Task { node: 2 * task.node, blocks: first, ..task },
                    Task {
                        node: 2 * task.node + 1,
                        first_block: task.first_block + first,
                        blocks: task.blocks - first,
                        ..task
                    },
                ];
                if distance > 0.0 {
                    std::mem::swap(&mut near, &mut far);
                }
                let old = far.offset[axis];
                far.offset[axis] = distance;
                far.square_distance += distance * distance - old * old;
                if far.square_distance < bound {
                    tasks[waiting] = far;
                    waiting += 1;
                }
                task = near;
            }
            let block = &self.blocks[task.first_block as usize];
            for (lane, square_distance) in block.square_distances(at).into_iter().enumerate() {
                if square_distance < bound {
                    let slot = task.first_block * LANES as u32 + lane as u32;
                    bound = visit(Found { square_distance, slot, tag: block.tag[lane] }, bound);
                }
            }
        }
    }

    /// The planes down to a depth below `depth`, level by level.
    pub fn splits(&self, depth: u8) -> Vec<Split> {
        let mut splits = Vec::new();
        let Some(bounds) = self.bounds else { return splits };
        let mut level = vec![(1_usize, self.blocks.len() as u32, bounds)];
        for depth in 0..depth {
            let mut next = Vec::new();
            for (node, blocks, Bounds { min, max }) in level {
                if blocks < 2 {
                    continue;
                }
                let Plane { at, axis } = self.planes[node];
                splits.push(Split { depth, axis: axis as u8, at, min, max });
                let (mut low, mut high) = (max, min);
                low[axis as usize] = at;
                high[axis as usize] = at;
                let first = first_part(blocks);
                next.push((2 * node, first, Bounds { min, max: low }));
                next.push((2 * node + 1, blocks - first, Bounds { min: high, max }));
            }
            level = next;
        }
        splits
    }
}

/// Of `blocks`, at least 2, how many are in the first part.
fn first_part(blocks: u32) -> u32 {
    // The largest power of two below their number: what the full levels hold.
    let full = 1 << (31 - (blocks - 1).leading_zeros());
    full.min(blocks - full / 2)
}

/// The planes of a part of the tree.
enum Levels {
    Leaf,
    Node(Plane, Box<[Levels; 2]>),
}

/// Sorts entries into their blocks, and returns the planes between them.
fn divide(entries: &mut [Entry], blocks: usize) -> Levels {
    if blocks < 2 {
        return Levels::Leaf;
    }
    let axis = Bounds::of(entries.iter().map(|entry| entry.position)).extent().max_position();
    let first = first_part(blocks as u32) as usize;
    let middle = first * LANES;
    let order = |a: &Entry, b: &Entry| a.position[axis].total_cmp(&b.position[axis]).then(a.index.cmp(&b.index));
    let (_, median, _) = entries.select_nth_unstable_by(middle, order);
    let plane = Plane { at: median.position[axis], axis: axis as u32 };
    let is_small = entries.len() < ALONE;
    let (low, high) = entries.split_at_mut(middle);
    let (low, high) = if is_small {
        (divide(low, first), divide(high, blocks - first))
    } else {
        rayon::join(|| divide(low, first), || divide(high, blocks - first))
    };
    Levels::Node(plane, Box::new([low, high]))
}

/// Writes planes to their places.
fn place(levels: &Levels, node: usize, planes: &mut [Plane]) {
    if let Levels::Node(plane, parts) = levels {
        planes[node] = *plane;
        place(&parts[0], 2 * node, planes);
        place(&parts[1], 2 * node + 1, planes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::Stream;

    fn entries(count: u32) -> Vec<Entry> {
        let mut stream = Stream::new(5, 0, count.into());
        let entry = |index| {
            let (across, up) = (stream.uniform2(), stream.uniform());
            // Many points share coordinates, as on a floor.
            let height = if index % 3 == 0 { 0.0 } else { up };
            Entry { position: Vec3::new(across.x, height, (8.0 * across.y).floor()), index, tag: index % 5 }
        };
        (0..count).map(entry).collect()
    }

    #[test]
    fn a_search_finds_just_what_is_near_in_trees_of_any_size() {
        let mut stream = Stream::new(6, 0, 0);
        for count in (0..70).chain([1000, 20_000]) {
            let entries = entries(count);
            let tree = Tree::new(entries.clone());
            for bound in [0.01, 0.3, f32::INFINITY] {
                let at = Vec3A::new(stream.uniform(), stream.uniform(), 8.0 * stream.uniform());
                let mut found = Vec::new();
                tree.search(at, bound, |point, bound| {
                    found.push((tree.index(point.slot), point.tag));
                    bound
                });
                found.sort_unstable();
                let near = entries.iter().filter(|entry| Vec3A::from(entry.position).distance_squared(at) < bound);
                assert_eq!(found, near.map(|entry| (entry.index, entry.tag)).collect::<Vec<_>>(), "{count} {bound}");
            }
        }
    }

    #[test]
    fn a_bound_that_shrinks_leaves_the_nearest() {
        let entries = entries(5000);
        let tree = Tree::new(entries.clone());
        for at in [Vec3A::new(0.5, 0.0, 3.0), Vec3A::new(-1.0, 0.5, 4.5)] {
            let (mut nearest, mut looked_at) = (None, 0);
            tree.search(at, f32::INFINITY, |point, _| {
                looked_at += 1;
                nearest = Some(tree.index(point.slot));
                point.square_distance
            });
            let distance = |index: u32| Vec3A::from(entries[index as usize].position).distance_squared(at);
            let least = entries.iter().map(|entry| distance(entry.index)).fold(f32::INFINITY, f32::min);
            assert_eq!(nearest.map(distance), Some(least));
            assert!(looked_at < 100, "{looked_at} points were nearer than those before them");
        }
    }

    #[test]
    fn splits_halve_their_cells_and_hold_the_points_apart() {
        let tree = Tree::new(entries(10_000));
        let splits = tree.splits(4);
        assert_eq!(splits.iter().map(|split| split.depth).max(), Some(3));
        assert_eq!(splits.len(), 15);
        for split in &splits {
            let axis = split.axis as usize;
            assert!(split.min[axis] <= split.at && split.at <= split.max[axis], "{split:?}");
        }
        assert!(Tree::default().splits(4).is_empty());
    }

    #[test]
    fn the_first_part_is_full() {
        let parts: Vec<u32> = (2..=9).map(first_part).collect();
        assert_eq!(parts, [1, 2, 2, 3, 4, 4, 4, 5]);
    }
}
