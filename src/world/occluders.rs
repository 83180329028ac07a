//! Whether anything can stand between two points that light reaches.
//!
//! In an empty convex room, between bare walls or on a plane, every ray between two surfaces that face each other is
//! free, and tracing it is a waste. Let K be the space in front of the planes of all sides that light reaches. If their
//! polygons are all in K, then so is every line between two points of theirs, since K is convex; none of these polygons
//! crosses a line, since each lies in one of the planes that bound K; and what light does not reach crosses none if it is
//! behind one of them.
//!
//! That is of light that goes from one surface that it reaches to another. A picture also asks whether an emitter lights what
//! light does not reach, such as a lawn before the house that the lamp is in: where it faces one, only a ray can tell.

use super::planes::{Plane, may_see};
use super::surface::Surfaces;
use std::collections::HashSet;

/// Where there are more pairs of a plane and a corner than this, something is taken to stand somewhere: looking at all
/// of them would take longer than a few thousandths of a second.
const MOST_PAIRS: usize = 1 << 21;

/// False if nothing crosses a line between two points of sides that light reaches by more than `tolerance`, m, and no
/// emitting side faces one that light does not reach. True if something may: nothing is traced, so that it costs next to
/// nothing.
pub fn may_exist(surfaces: &Surfaces, emitters: &[usize], is_reached: &[bool], tolerance: f64) -> bool {
    let dark: Vec<usize> = (0..is_reached.len()).filter(|&side| !is_reached[side]).collect();
    if may_see(surfaces, emitters, &dark, tolerance) {
        return true;
    }
    let corners = surfaces.corners().count();
    let reached = (0..is_reached.len()).filter(|&side| is_reached[side]);
    // A wall of many polygons has one plane.
    let (mut planes, mut known) = (Vec::new(), HashSet::new());
    for side in reached {
        let plane = Plane::new(surfaces, side);
        if known.insert(plane.key()) {
            planes.push(plane);
        }
        if planes.len() * corners > MOST_PAIRS {
            return true;
        }
    }
    let is_out_of_the_way = |polygon: usize| {
        let mut heights = planes.iter().map(|plane| {
            let heights = surfaces.corners_of(polygon).iter().map(|&corner| plane.height(corner));
            heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)))
        });
        if is_reached[2 * polygon] || is_reached[2 * polygon + 1] {
            heights.all(|(lowest, _)| lowest >= -tolerance)
        } else {
            heights.any(|(_, highest)| highest <= tolerance)
        }
    };
    !(0..surfaces.len()).all(is_out_of_the_way)
}
