//! What photons bring to each element of the mesh: the map that gathering rays end in.
//!
//! Photons near a gathering ray's end are taken together by elements, not by distance: thousands of such rays meet an element,
//! so that a lookup that costs no search pays (the idea of Christensen 1999, who keeps irradiance at photons). An element
//! knows how much of it is exposed, and photons never cross its edges: its mean irradiance has no bias, not even in corners.

use crate::math::rgb::{Rgb, Rgb64};
use crate::methods::photon_map::PhotonMaps;
use crate::methods::transport::Surface;
use crate::solution::{Path, PathMatcher, Photon, Scattering};
use rayon::prelude::*;
use std::sync::{Arc, OnceLock};

/// Numbers of specular events from which on paths are no longer told apart by a filter, and left out.
const TOLD_APART: usize = 8;
/// The element of a photon on a surface that is not meshed.
const NOWHERE: u32 = u32::MAX;

/// Photons summed over elements: all of them, those that make caustics, and for a filter those whose way goes on over so
/// many specular surfaces to the place that gathers, and so many to the eye.
pub struct ArrivalMaps {
    maps: Arc<PhotonMaps>,
    /// For each photon the element on which it landed.
    elements: Vec<u32>,
    all: OnceLock<Vec<Rgb>>,
    caustic: OnceLock<Vec<Rgb>>,
    filtered: [[OnceLock<Vec<Rgb>>; TOLD_APART]; TOLD_APART],
}

impl ArrivalMaps {
    pub fn new(maps: Arc<PhotonMaps>) -> Self {
        let mesh = &maps.transport().world.mesh;
        let element = |photon: &Photon| {
            let element = mesh.element_at(photon.side / 2, photon.side.is_multiple_of(2), photon.position.into());
            element.unwrap_or(NOWHERE)
        };
        let elements = maps.photons().par_iter().map(element).collect();
        let (all, caustic) = (OnceLock::new(), OnceLock::new());
        Self { maps, elements, all, caustic, filtered: Default::default() }
    }

    /// E, W/m², at a place, by photons that go on from there over `events` specular surfaces to a diffuse one, which sends
    /// them to the eye along `to_eye`. Surfaces that are not meshed are not known to be lit.
    pub fn irradiance(&self, matcher: &PathMatcher, surface: &Surface, events: usize, to_eye: Path) -> Rgb {
        if matcher.passes_all() {
            return self.at(self.all.get_or_init(|| self.sum(|_| true)), surface);
        }
        let kept = self.filtered.get(events).and_then(|row| row.get(to_eye.len()));
        kept.map_or(Rgb::ZERO, |kept| {
            let passes = |photon: &Photon| {
                let landed = photon.path.then(Scattering::Diffuse);
                let from_light = (0..events).fold(landed, |path, _| path.then(Scattering::Specular));
                matcher.passes(from_light, Some(Scattering::Diffuse), to_eye)
            };
            self.at(kept.get_or_init(|| self.sum(passes)), surface)
        })
    }

    /// E, W/m², at a place by the photons of caustics alone.
    pub fn caustic_irradiance(&self, surface: &Surface) -> Rgb {
        self.at(self.caustic.get_or_init(|| self.sum(|photon| photon.path.is_caustic())), surface)
    }

    fn at(&self, irradiance: &[Rgb], surface: &Surface) -> Rgb {
        let element = self.maps.transport().world.mesh.element_at(surface.polygon, surface.is_front, surface.point);
        element.map_or(Rgb::ZERO, |element| irradiance[element as usize])
    }

    /// E of each element by photons that pass, W/m². On one thread: those that wait for it must not be given other work.
    fn sum(&self, passes: impl Fn(&Photon) -> bool) -> Vec<Rgb> {
        let mesh = &self.maps.transport().world.mesh;
        let mut flux = vec![Rgb64::ZERO; mesh.elements.len()];
        for (photon, &element) in self.maps.photons().iter().zip(&self.elements) {
            if element != NOWHERE && passes(photon) {
                flux[element as usize] += (self.maps.scale(photon) * photon.flux).as_dvec3();
            }
        }
        let density = flux.iter().zip(&mesh.elements);
        let density =
            density.map(|(flux, element)| if element.area > 0.0 { *flux / element.area } else { Rgb64::ZERO });
        density.map(|density| density.as_vec3()).collect()
    }
}
