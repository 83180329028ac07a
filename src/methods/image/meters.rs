//! Irradiance at points of surfaces as a view knows it: light that its pictures multiply with the diffuse reflectance.

use super::Sources;
use super::draws::Draws;
use super::eye_path::{DiffuseLight, Seen, Tools};
use crate::cancel::Cancel;
use crate::math::rgb::Rgb;
use crate::math::stats::Moments;
use crate::methods::Settings;
use crate::methods::cost::Cost;
use crate::methods::photon_map::Scratch;
use crate::methods::transport::{Bsdf, Media, Surface};
use crate::scene::Lobes;
use crate::solution::{CameraView, Path, Scattering};
use rayon::prelude::*;
use std::f32::consts::PI;

/// Light meters on surfaces, read sample by sample: plain state and a step.
pub struct Meters {
    light: Box<dyn DiffuseLight>,
    places: Vec<(Surface, Media)>,
    /// E of the samples of each place, W/m².
    channels: Vec<[Moments; 3]>,
    samples: u32,
    seed: u64,
    cost: Cost,
}

impl Meters {
    /// Views whose light can be read at a point.
    pub const VIEWS: [CameraView; 3] =
        [CameraView::RadiosityDirect, CameraView::FinalGather, CameraView::DiffuseAmbient];

    /// Meters before their first step; `None` where the view needs light that `sources` do not have, or has none of its own.
    pub fn new(sources: &Sources, view: CameraView, surfaces: Vec<Surface>, settings: &Settings) -> Option<Self> {
        let light = sources.light(view, settings)?;
        let transport = &sources.transport;
        let place = |surface: Surface| (surface, transport.media_beside(surface.surface_point(), surface.facing));
        let places: Vec<_> = surfaces.into_iter().map(place).collect();
        let channels = vec![[Moments::default(); 3]; places.len()];
        Some(Self { light, places, channels, samples: 0, seed: settings.seed, cost: Cost::default() })
    }

    /// One sample more of each, or of none if stopped.
    pub fn step(&mut self, cancel: &Cancel) -> bool {
        let read = |scratch: &mut Scratch, (index, (surface, media)): (usize, &(Surface, Media))| {
            let mut cost = Cost::default();
            let irradiance = (!cancel.is_requested()).then(|| self.read(index, surface, *media, scratch, &mut cost))?;
            Some((irradiance, cost))
        };
        let found: Option<Vec<(Rgb, Cost)>> =
            self.places.par_iter().enumerate().map_init(Scratch::default, read).collect();
        let Some(found) = found else { return false };
        for (channels, (irradiance, cost)) in self.channels.iter_mut().zip(found) {
            for (moments, value) in channels.iter_mut().zip(irradiance.to_array()) {
                moments.add(value.into());
            }
            self.cost.add(&cost);
        }
        self.samples += 1;
        true
    }

    /// E, W/m²: π times what a white surface would send on.
    fn read(&self, index: usize, surface: &Surface, media: Media, scratch: &mut Scratch, cost: &mut Cost) -> Rgb {
        let white = Lobes { diffuse: Rgb::ONE, ..Lobes::default() };
        let bsdf = Bsdf::new(&white, surface, surface.normal, 1.0).only(Scattering::Diffuse);
        let seen = Seen { surface, bsdf: &bsdf, to_eye: Path::LIGHT, media };
        let mut draws = Draws::new(self.seed, index as u64, self.samples);
        PI * self.light.leaving(&seen, &mut Tools { draws: &mut draws, scratch, cost })
    }

    pub fn samples(&self) -> u32 {
        self.samples
    }

    pub fn rays(&self) -> u64 {
        self.cost.rays
    }

    /// For each place and channel the moments of E, W/m², over the samples. They are better spread than independent ones, so
    /// that their standard error is an upper bound; a bias of the view is in all of them.
    pub fn irradiance(&self) -> &[[Moments; 3]] {
        &self.channels
    }
}
