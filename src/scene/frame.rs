//! The frame that a scene is computed in: where its origin lies in the file, and which faces lie too far away for it.
//!
//! A file is read in double precision and computed with in single precision, which holds a coordinate to a share ε of its
//! size. So the origin is put where the detail is, and a few faces that lie so far from all others that no frame holds both
//! are left out. Users never see the frame: [`Scene::file_from_scene`] and [`Scene::scene_from_file`] stand at every door.

use super::Scene;
use super::doctor::{Finding, FindingKind};
use glam::{DVec3, Vec3};

/// Lengths below this share of the largest coordinate are lost: hits are known to 32 ε of it.
const RESOLUTION: f64 = 32.0 * f32::EPSILON as f64;

/// A scene whose middle is farther from the origin than this many times its extent gets an origin of its own. Up to there,
/// hits are known to 32 ε · 16 = 6e-5 of the extent: less than what counts as touching.
const FARTHEST: f64 = 16.0;

/// Faces beyond an empty gap of more than this many times the extent of what most faces fill are left out. In a frame that
/// holds both, lengths below 32 ε · 1024 = 1/256 of that extent would be lost.
const WIDEST_GAP: f64 = 1.0 / (256.0 * RESOLUTION);

/// Box round a face, in the coordinates of the file, m.
#[derive(Clone, Copy, Debug)]
pub struct FaceBounds {
    low: DVec3,
    high: DVec3,
}

impl FaceBounds {
    const EMPTY: Self = Self { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY };

    pub fn of(corners: impl Iterator<Item = DVec3>) -> Self {
        corners.fold(Self::EMPTY, |all, corner| Self { low: all.low.min(corner), high: all.high.max(corner) })
    }

    fn union(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// Its longest edge, m.
    fn size(&self) -> f64 {
        (self.high - self.low).max_element()
    }

    fn center(&self) -> DVec3 {
        0.5 * (self.low + self.high)
    }

    /// Largest coordinate from an origin, m.
    fn reach(&self, origin: DVec3) -> f64 {
        (self.low - origin).abs().max((self.high - origin).abs()).max_element()
    }
}

/// Where a scene is computed, and at what price.
#[derive(Debug)]
pub struct Frame {
    /// Its origin in the coordinates of the file, m.
    pub origin: DVec3,
    /// For each face whether it is left out.
    pub is_stray: Vec<bool>,
    /// What was moved, left out or lost.
    pub findings: Vec<Finding>,
}

impl Frame {
    /// The frame for faces, of which `name` tells what findings call them by.
    pub fn of(faces: &[FaceBounds], name: impl Fn(usize) -> String) -> Self {
        let all: Vec<usize> = (0..faces.len()).collect();
        let mut kept = all.clone();
        let mut gap = f64::INFINITY;
        while let Some(bulk) = bulk(faces, &kept) {
            (kept, gap) = (bulk.faces, bulk.gap);
        }
        let mut is_stray = vec![true; faces.len()];
        kept.iter().for_each(|&face| is_stray[face] = false);
        let mut findings = Vec::new();
        if kept.len() < all.len() {
            let size = bounds(faces, &kept).size();
            findings.push(left_out(&is_stray, gap, size, &name));
        }
        let origin = origin(faces, &kept);
        if origin != DVec3::ZERO {
            findings.push(moved(origin));
        }
        findings.extend(blurred(faces, &kept, origin, &name));
        Self { origin, is_stray, findings }
    }
}

fn left_out(is_stray: &[bool], gap: f64, size: f64, name: &impl Fn(usize) -> String) -> Finding {
    let mut strays = (0..is_stray.len()).filter(|&face| is_stray[face]);
    let first = strays.next().map_or_else(String::new, name);
    let more = strays.count();
    let subject = if more == 0 { first } else { format!("{first} and {more} more") };
    let problem = format!(
        "at least {gap:.2e} m of empty space lie between it and most of the scene, which is {size:.2e} m across: single \
         precision cannot hold the detail of both"
    );
    let remedy = format!("left out; to keep it, place it within {:.2e} m of the rest", WIDEST_GAP * size);
    Finding::warning(FindingKind::FaceTooFar, subject, problem, remedy)
}

fn moved(DVec3 { x, y, z }: DVec3) -> Finding {
    Finding::note(
        FindingKind::SceneMoved,
        "the scene",
        "it is so far from the origin that single precision would lose its detail",
        format!(
            "computed with {x} {y} {z} as the origin; coordinates that are given or printed stay those of the file"
        ),
    )
}

/// Where more than half of the faces are smaller than what single precision holds.
fn blurred(faces: &[FaceBounds], kept: &[usize], origin: DVec3, name: &impl Fn(usize) -> String) -> Option<Finding> {
    let farthest = kept.iter().copied().max_by(|&a, &b| faces[a].reach(origin).total_cmp(&faces[b].reach(origin)))?;
    let reach = faces[farthest].reach(origin);
    let size = median(kept.iter().map(|&face| faces[face].size()));
    (size < RESOLUTION * reach).then(|| {
        let problem = format!(
            "it reaches {reach:.2e} m from the origin, where single precision loses lengths below {:.2e} m, and more than \
             half of its faces are smaller",
            RESOLUTION * reach
        );
        let remedy = format!("kept, but their light is wrong; make it smaller: {} reaches farthest", name(farthest));
        Finding::warning(FindingKind::DetailLost, "the scene", problem, remedy)
    })
}

/// More than half of some faces, and the narrowest of the gaps around them, m.
struct Bulk {
    faces: Vec<usize>,
    gap: f64,
}

/// The faces among `kept` that most of them belong to, where all others lie beyond empty gaps, across an axis, that are too wide
/// for one frame. Faces that surround others, as a floor or a sky does, are beyond no gap.
fn bulk(faces: &[FaceBounds], kept: &[usize]) -> Option<Bulk> {
    // More than half of the faces are at least as large as the median one together.
    let least = WIDEST_GAP * median(kept.iter().map(|&face| faces[face].size()));
    if bounds(faces, kept).size() <= least {
        return None;
    }
    let mut inside = kept.to_vec();
    let mut gap = f64::INFINITY;
    while let Some(cut) = widest_gap(faces, &inside) {
        gap = gap.min(cut.width);
        let (below, above): (Vec<usize>, Vec<usize>) =
            inside.iter().partition(|&&face| faces[face].high[cut.axis] <= cut.begin);
        inside = if below.len() > above.len() { below } else { above };
        if gap <= least || 2 * inside.len() <= kept.len() {
            return None;
        }
        let size = bounds(faces, &inside).size();
        if size > 0.0 && gap > WIDEST_GAP * size {
            return Some(Bulk { faces: inside, gap });
        }
    }
    None
}

/// Empty space between faces across an axis.
struct Gap {
    axis: usize,
    /// The coordinate at which it begins, m.
    begin: f64,
    /// m
    width: f64,
}

fn widest_gap(faces: &[FaceBounds], inside: &[usize]) -> Option<Gap> {
    let mut widest: Option<Gap> = None;
    for axis in 0..3 {
        let mut spans: Vec<[f64; 2]> =
            inside.iter().map(|&face| [faces[face].low[axis], faces[face].high[axis]]).collect();
        spans.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        let mut begin = f64::INFINITY;
        for [low, high] in spans {
            if low > begin && widest.as_ref().is_none_or(|gap| low - begin > gap.width) {
                widest = Some(Gap { axis, begin, width: low - begin });
            }
            begin = if begin.is_finite() { begin.max(high) } else { high };
        }
    }
    widest
}

/// Where the origin should be: at 0, or at the middle of the faces where they are far from 0, or at the middle one of them
/// where 0 is so far from it that most faces would be lost. It is rounded to a power of two above the scene's extent, so that
/// a file that was moved by a multiple of it gives the very same coordinates as before.
fn origin(faces: &[FaceBounds], kept: &[usize]) -> DVec3 {
    let all = bounds(faces, kept);
    let rounded = |point: DVec3, size: f64| {
        let step = 2.0 * size.log2().ceil().exp2();
        (point / step).round() * step
    };
    if all.size() > 0.0 && all.center().abs().max_element() > FARTHEST * all.size() {
        return rounded(all.center(), all.size());
    }
    let size = median(kept.iter().map(|&face| faces[face].size()));
    let middle = DVec3::from_array([0, 1, 2].map(|axis| median(kept.iter().map(|&face| faces[face].center()[axis]))));
    if size > 0.0 && size < RESOLUTION * middle.abs().max_element() {
        return rounded(middle, size);
    }
    DVec3::ZERO
}

fn bounds(faces: &[FaceBounds], of: &[usize]) -> FaceBounds {
    of.iter().map(|&face| faces[face]).fold(FaceBounds::EMPTY, FaceBounds::union)
}

/// The upper one of the two middle values where their count is even; 0 of none.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    let middle = values.len() / 2;
    if values.is_empty() { 0.0 } else { *values.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

impl Scene {
    /// A point of the scene in the coordinates of its file, m. The scene's own coordinates count as the shortest decimal
    /// numbers that single precision rounds to them: as they are written in files.
    pub fn file_from_scene(&self, point: Vec3) -> DVec3 {
        let decimal = |coordinate: f32| coordinate.to_string().parse().unwrap_or(f64::from(coordinate));
        self.origin + DVec3::from_array(point.to_array().map(decimal))
    }

    /// A point in the coordinates of the file as a point of the scene, m.
    pub fn scene_from_file(&self, point: DVec3) -> Vec3 {
        (point - self.origin).as_vec3()
    }
}
