//! Lines among photons: the planes of their tree, the way of one of them, and the disc of an estimate.

use super::look::of_flux;
use crate::math::rgb::Rgb;
use crate::solution::{Gathered, PhotonTrail, Split};
use crate::viewport::Light;
use crate::viewport::buffers::Units;
use crate::viewport::colour_map::colour;
use crate::viewport::gpu_types::{LineRecord, colour_bytes};
use glam::Vec3;
use std::f32::consts::TAU;

/// Widths, pixels.
const TREE_WIDTH: f32 = 1.5;
const WAY_WIDTH: f32 = 2.5;
/// Sides of the polygon that is drawn for a disc.
const DISC_SIDES: u32 = 64;
const DISC: Rgb = Rgb::new(1.0, 0.8, 0.1);
/// How far down the map of colours the deepest planes are: what is darker is lost before dark surfaces.
const FADE: f32 = 0.7;
/// Length of the last piece of a way into the void, in radii of the scene.
const ESCAPE: f32 = 1.0;

fn line(units: &Units, ends: [Vec3; 2], width: f32, colour: Rgb) -> LineRecord {
    let [start, end] = ends.map(|end| units.unit_from_world(end).to_array());
    LineRecord { start, width, end, colour: colour_bytes(colour) }
}

/// A closed line through some points.
fn outline<'a>(
    units: &'a Units,
    corners: &'a [Vec3],
    width: f32,
    colour: Rgb,
) -> impl Iterator<Item = LineRecord> + 'a {
    (0..corners.len()).map(move |i| line(units, [corners[i], corners[(i + 1) % corners.len()]], width, colour))
}

/// The outlines of the planes that divide cells of at most this depth, coloured by it.
pub fn of_tree(splits: &[Split], depth: u8, units: &Units) -> Vec<LineRecord> {
    let shown = splits.iter().filter(|split| split.depth <= depth);
    shown
        .flat_map(|split| outline(units, &corners(split), TREE_WIDTH, of_depth(split.depth, depth)).collect::<Vec<_>>())
        .collect()
}

/// The colour of planes that divide cells of a depth, where the deepest have another: the root is the brightest.
pub fn of_depth(depth: u8, deepest: u8) -> Rgb {
    colour(1.0 - FADE * f32::from(depth) / f32::from(deepest.max(1)))
}

/// Where the plane cuts its cell.
fn corners(split: &Split) -> [Vec3; 4] {
    let axis = usize::from(split.axis);
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    [(false, false), (true, false), (true, true), (false, true)].map(|(high_u, high_v)| {
        let mut corner = split.min;
        corner[axis] = split.at;
        corner[u] = if high_u { split.max[u] } else { split.min[u] };
        corner[v] = if high_v { split.max[v] } else { split.min[v] };
        corner
    })
}

/// The way of the picked photon, and the disc of the estimate at the picked point.
pub fn of_picked(light: &Light, units: &Units) -> Vec<LineRecord> {
    let disc = light.gathered.iter().flat_map(|gathered| of_disc(gathered, units));
    let trail = light.trail.iter().flat_map(|trail| of_trail(trail, units));
    disc.chain(trail).collect()
}

fn of_disc(gathered: &Gathered, units: &Units) -> Vec<LineRecord> {
    let (u, v) = gathered.normal.any_orthonormal_pair();
    let corner = |i: u32| {
        let (sin, cos) = (TAU * i as f32 / DISC_SIDES as f32).sin_cos();
        gathered.point + gathered.radius * (cos * u + sin * v)
    };
    let corners: Vec<Vec3> = (0..DISC_SIDES).map(corner).collect();
    let normal = [gathered.point, gathered.point + 0.5 * gathered.radius * gathered.normal];
    outline(units, &corners, WAY_WIDTH, DISC).chain([line(units, normal, WAY_WIDTH, DISC)]).collect()
}

/// Pieces in the hue of the flux that flies along them.
fn of_trail(trail: &PhotonTrail, units: &Units) -> Vec<LineRecord> {
    let brightest = trail.places.first().map_or(0.0, |place| place.flux.max_element());
    let piece = |ends, flux| line(units, ends, WAY_WIDTH, of_flux(flux, brightest));
    let pieces = trail.places.windows(2).map(|pair| piece([pair[0].point, pair[1].point], pair[1].flux));
    let escape = trail
        .places
        .last()
        .zip(trail.escape)
        .map(|(last, direction)| piece([last.point, last.point + ESCAPE * units.radius() * direction], last.flux));
    pieces.chain(escape).collect()
}
