//! Light estimated from the photons near by.

use super::eye_path::{DiffuseLight, Seen, Tools};
use crate::effects::{Effect, Effects};
use crate::math::rgb::Rgb;
use crate::methods::photon_map::{Estimate, PhotonFilter, PhotonMaps, Which};
use crate::methods::transport::Bsdf;
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
    /// What the maps hold of the simulated effects.
    pub fn new(maps: Arc<PhotonMaps>, shown: Shown, is_caustic: bool, matcher: &PathMatcher, effects: Effects) -> Self {
        let shows_direct = effects.contains(Effect::DirectLight);
        let specular = |events| (0..events).fold(Path::LIGHT, |path, _| path.then(Scattering::Specular));
        let filter = |events| {
            let passes = |path: Path| matcher.passes(path, Some(Scattering::Diffuse), specular(events));
            let counts = |path: Path| (path.is_caustic() || !is_caustic) && (shows_direct || !path.is_empty());
            maps.filter(|path| counts(path) && passes(path))
        };
        let all_count = matcher.passes_all() && (shows_direct || is_caustic);
        let filters = (!all_count).then(|| (0..TOLD_APART).map(filter).collect());
        Self { filters, maps, shown, is_caustic }
    }
}

impl DiffuseLight for PhotonLight {
    fn leaving(&self, seen: &Seen<'_>, tools: &mut Tools<'_>) -> Rgb {
        let which = match &self.filters {
            Some(filters) => match filters.get(seen.to_eye.len()) {
                Some(filter) => Which::Filtered(filter),
                None => return Rgb::ZERO,
            },
            None if self.is_caustic => Which::Caustics,
            None => Which::All,
        };
        let Estimate { irradiance, variance, .. } = self.maps.irradiance(seen.surface, which, tools.scratch);
        let reflectance = match self.shown {
            Shown::Irradiance => Rgb::ONE,
            Shown::Radiance => seen.bsdf.diffuse(),
        };
        if let Some(batches) = &mut tools.batches {
            batches.add_density(reflectance / PI, variance);
        }
        reflectance * irradiance / PI
    }

    fn is_shown_on(&self, bsdf: &Bsdf) -> bool {
        // What is seen in mirrors and through glass is shown, and not what arrives at them.
        bsdf.diffuse() != Rgb::ZERO || self.shown == Shown::Irradiance && !bsdf.is_specular()
    }
}
