//! Photons as records of the graphics device.

use super::{PhotonColour, SPLATS};
use crate::math::polygon::vector_area;
use crate::math::rgb::Rgb;
use crate::solution::{Path, PathFilter, PathMatcher, Photon, PhotonSolution, Scattering};
use crate::viewport::buffers::Units;
use crate::viewport::gpu_types::{PhotonRecord, colour_bytes, direction_bytes};
use crate::viewport::records::Records;
use crate::viewport::{Gpu, Light};
use crate::world::World;
use glam::{DVec3, Vec3};
use std::collections::HashMap;
use std::sync::Arc;

/// As many photons are drawn at most: what one dispatch of threads can do.
const MOST: usize = 65_535 * SPLATS;

/// Linear colours of marks.
const USED: Rgb = Rgb::new(0.1, 0.9, 0.2);
const REJECTED: Rgb = Rgb::new(1.0, 0.05, 0.05);
const DIFFUSE_PLACE: Rgb = Rgb::ONE;
const SPECULAR_PLACE: Rgb = Rgb::new(0.1, 0.7, 1.0);
const LAST_PLACE: Rgb = Rgb::new(1.0, 0.05, 0.05);

/// All photons that pass a filter.
pub struct Cloud {
    records: Records<PhotonRecord>,
    /// What `records` are of.
    shown: Option<Shown>,
    /// Of each side, see [`direction_bytes`].
    normals: Vec<u32>,
    units: Units,
}

struct Shown {
    solution: Arc<PhotonSolution>,
    colour: PhotonColour,
    filter: PathFilter,
    /// Largest channel of the flux of any of the photons, W.
    brightest: f32,
    /// One photon of so many is uploaded.
    stride: usize,
}

impl Cloud {
    /// Without a photon.
    pub fn new(gpu: &Gpu, world: &World, units: Units) -> Self {
        let scene = &world.scene;
        let normals = scene.polygons.iter().flat_map(|polygon| {
            let corners: Vec<DVec3> =
                polygon.corners().iter().map(|&corner| scene.positions[corner as usize].as_dvec3()).collect();
            let normal = vector_area(&corners).normalize_or_zero().as_vec3();
            [direction_bytes(normal), direction_bytes(-normal)]
        });
        Self { records: Records::new(gpu), shown: None, normals: normals.collect(), units }
    }

    pub fn records(&self) -> &Records<PhotonRecord> {
        &self.records
    }

    /// Uploads photons unless they are what was uploaded last; where these have only become more, the new ones alone.
    pub fn upload(&mut self, gpu: &Gpu, solution: &Arc<PhotonSolution>, colour: PhotonColour, filter: &PathFilter) {
        let photons = &solution.photons;
        let mut first_new = 0;
        let mut brightest = brightest(photons);
        // Some of too many show as well where they are dense.
        let stride = photons.len().div_ceil(MOST.min(Records::<PhotonRecord>::limit(gpu))).max(1);
        if let Some(shown) = self.shown.as_ref().filter(|shown| shown.colour == colour && shown.filter == *filter) {
            if Arc::ptr_eq(&shown.solution.photons, photons) {
                return;
            }
            if shown.stride == stride && shown.is_continued_by(solution, brightest) {
                first_new = shown.solution.photons.len();
                brightest = shown.brightest;
            }
        }
        if first_new == 0 {
            self.records.clear();
        }
        let mut passing = Passing::new(filter);
        let new = photons[first_new..].iter().step_by(stride).filter(|photon| passing.holds(photon));
        let (normals, units) = (&self.normals, &self.units);
        self.records.extend(gpu, new.map(|photon| record(photon, colour.of(photon, brightest), normals, units)));
        self.shown = Some(Shown { solution: Arc::clone(solution), colour, filter: *filter, brightest, stride });
    }
}

impl Shown {
    /// Whether a solution has the photons shown and others after them, none of which is brighter.
    fn is_continued_by(&self, solution: &PhotonSolution, brightest: f32) -> bool {
        let (old, new) = (&self.solution.photons, &solution.photons);
        // Photons of a pass come in batches, so the first and the last one tell.
        let is_same = |index: usize| old[index] == new[index];
        self.solution.passes == solution.passes
            && brightest <= self.brightest
            && !old.is_empty()
            && old.len() <= new.len()
            && is_same(0)
            && is_same(old.len() - 1)
    }
}

/// Which photons pass a filter if the eye sees them land. There are far fewer paths than photons.
pub struct Passing {
    matcher: Option<PathMatcher>,
    known: HashMap<Path, bool>,
}

impl Passing {
    pub fn new(filter: &PathFilter) -> Self {
        Self { matcher: (!filter.passes_all()).then(|| filter.matcher()), known: HashMap::new() }
    }

    pub fn holds(&mut self, photon: &Photon) -> bool {
        let Some(matcher) = &self.matcher else { return true };
        let passes = || matcher.passes(photon.path, Some(Scattering::Diffuse), Path::LIGHT);
        *self.known.entry(photon.path).or_insert_with(passes)
    }
}

fn brightest(photons: &[Photon]) -> f32 {
    photons.iter().fold(0.0, |brightest, photon| photon.flux.max_element().max(brightest))
}

fn record(photon: &Photon, colour: Rgb, normals: &[u32], units: &Units) -> PhotonRecord {
    let [x, y, z] = units.unit_from_world(photon.position).to_array();
    PhotonRecord {
        x,
        y,
        z,
        colour: colour_bytes(colour),
        normal: normals[photon.side as usize],
        direction: direction_bytes(photon.direction),
    }
}

/// Marks at the places of the picked photon's trail, and on the photons that the estimate at the picked point used or
/// rejected.
pub fn marks(light: &Light, units: &Units) -> Vec<PhotonRecord> {
    let mark = |point: Vec3, colour: Rgb| {
        let [x, y, z] = units.unit_from_world(point).to_array();
        PhotonRecord { x, y, z, colour: colour_bytes(colour), normal: 0, direction: 0 }
    };
    let mut marks = Vec::new();
    if let (Some(gathered), Some(solution)) = (&light.gathered, &light.photons) {
        for (indices, colour) in [(&gathered.rejected, REJECTED), (&gathered.used, USED)] {
            let photons = indices.iter().filter_map(|&index| solution.photons.get(index as usize));
            marks.extend(photons.map(|photon| mark(photon.position, colour)));
        }
    }
    if let Some(trail) = &light.trail {
        marks.extend(trail.places.iter().map(|place| {
            mark(
                place.point,
                match place.scattering {
                    Some(Scattering::Diffuse) => DIFFUSE_PLACE,
                    Some(Scattering::Specular) => SPECULAR_PLACE,
                    None => LAST_PLACE,
                },
            )
        }));
    }
    marks
}
