//! Light estimated from the photons near by.

use super::draws::Draws;
use super::eye_path::{DiffuseLight, Seen};
use crate::math::rgb::Rgb;
use crate::methods::photon_map::{PhotonFilter, PhotonMaps, Scratch, Which};
use crate::solution::{Path, PathMatcher, Scattering};
use std::f32::consts::PI;
use std::sync::Arc;

/// Numbers of specular events to the eye from which on paths are no longer told apart by a filter, and left out.
const TOLD_APART: usize = 8;

/// What the estimate is turned into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// E / π, whatever the surface reflects.
    Irradiance,
    /// ρ E / π.
    Radiance,
}

/// The density of photons as light.
pub struct PhotonLight {
    maps: Arc<PhotonMaps>,
    shown: Shown,
    /// Whether photons of caustics alone count.
    is_caustic: bool,
    /// For each number of specular events to the eye the photons that count; `None` where all do.
    filters: Option<Vec<PhotonFilter>>,
}

impl PhotonLight {
    pub fn new(maps: Arc<PhotonMaps>, shown: Shown, is_caustic: bool, matcher: &PathMatcher) -> Self {
        let specular = |events| (0..events).fold(Path::LIGHT, |path, _| path.then(Scattering::Specular));
        let filter = |events| {
            let passes = |path: Path| matcher.passes(path, Some(Scattering::Diffuse), specular(events));
            maps.filter(|path| (path.is_caustic() || !is_caustic) && passes(path))
        };
        let filters = (!matcher.passes_all()).then(|| (0..TOLD_APART).map(filter).collect());
        Self { filters, maps, shown, is_caustic }
    }
}

impl DiffuseLight for PhotonLight {
    fn leaving(&self, seen: &Seen<'_>, _draws: &mut Draws, scratch: &mut Scratch) -> (Rgb, u64) {
        let which = match &self.filters {
            Some(filters) => match filters.get(seen.to_eye.len()) {
                Some(filter) => Which::Filtered(filter),
                None => return (Rgb::ZERO, 0),
            },
            None if self.is_caustic => Which::Caustics,
            None => Which::All,
        };
        let irradiance = self.maps.irradiance(seen.surface, which, scratch).irradiance;
        let reflected = match self.shown {
            Shown::Irradiance => irradiance,
            Shown::Radiance => seen.bsdf.diffuse() * irradiance,
        };
        (reflected / PI, 0)
    }
}
