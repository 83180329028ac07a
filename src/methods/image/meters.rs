//! Irradiance at points of surfaces as a view knows it: light that its pictures multiply with the diffuse reflectance.

use super::Sources;
use super::draws::Draws;
use super::eye_path::{DiffuseLight, Seen, Tools};
use super::photon_batches::{PhotonBatches, PhotonNoise};
use crate::cancel::Cancel;
use crate::math::rgb::{Rgb, Rgb64};
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
    /// Of the radiance of each place; empty where the light is not read off photons.
    photon_noise: Vec<PhotonNoise>,
    samples: u32,
    seed: u64,
    cost: Cost,
}

impl Meters {
    /// Views whose light can be read at a point.
    pub const VIEWS: [CameraView; 4] =
        [CameraView::RadiosityDirect, CameraView::FinalGather, CameraView::Caustics, CameraView::DiffuseAmbient];

    /// Meters before their first step; `None` where the view needs light that `sources` do not have, or has none of its own.
    pub fn new(sources: &Sources, view: CameraView, surfaces: Vec<Surface>, settings: &Settings) -> Option<Self> {
        let light = sources.light(view, settings)?;
        let transport = &sources.transport;
        // What arrives at the polygon, and not at the smooth surface that it stands for.
        let place = |surface: Surface| {
            let surface = Surface { normal: surface.facing, ..surface };
            (surface, transport.media_beside(surface.surface_point(), surface.facing))
        };
        let places: Vec<_> = surfaces.into_iter().map(place).collect();
        let channels = vec![[Moments::default(); 3]; places.len()];
        let photon_noise = vec![PhotonNoise::default(); if view.needs_photons() { places.len() } else { 0 }];
        Some(Self { light, places, channels, photon_noise, samples: 0, seed: settings.seed, cost: Cost::default() })
    }

    /// One sample more of each, or of none if stopped.
    pub fn step(&mut self, cancel: &Cancel) -> bool {
        let has_batches = !self.photon_noise.is_empty();
        let read = |scratch: &mut Scratch, (index, (surface, media)): (usize, &(Surface, Media))| {
            if cancel.is_requested() {
                return None;
            }
            let (mut cost, mut batches) = (Cost::default(), has_batches.then(PhotonBatches::default));
            let mut draws = Draws::new(self.seed, index as u64, self.samples);
            let tools = Tools { draws: &mut draws, scratch, cost: &mut cost, batches: batches.as_mut() };
            let irradiance = self.read(surface, *media, tools);
            Some((irradiance, cost, batches))
        };
        let found: Option<Vec<(Rgb, Cost, Option<PhotonBatches>)>> =
            self.places.par_iter().enumerate().map_init(Scratch::default, read).collect();
        let Some(found) = found else { return false };
        for (index, (irradiance, cost, batches)) in found.into_iter().enumerate() {
            let channels = &mut self.channels[index];
            for (moments, value) in channels.iter_mut().zip(irradiance.to_array()) {
                moments.add(value.into());
            }
            self.cost.add(&cost);
            if let Some(batches) = batches {
                self.photon_noise[index].add(&batches);
            }
        }
        self.samples += 1;
        true
    }

    /// E, W/m²: π times what a white surface would send on.
    fn read(&self, surface: &Surface, media: Media, mut tools: Tools<'_>) -> Rgb {
        let white = Lobes { diffuse: Rgb::ONE, ..Lobes::default() };
        let bsdf = Bsdf::new(&white, surface, surface.normal, 1.0).only(Scattering::Diffuse);
        let seen = Seen { surface, bsdf: &bsdf, to_eye: Path::LIGHT, media };
        PI * self.light.leaving(&seen, &mut tools)
    }

    pub fn samples(&self) -> u32 {
        self.samples
    }

    pub fn rays(&self) -> u64 {
        self.cost.rays
    }

    /// What is known of each place.
    pub fn readings(&self) -> Vec<Reading> {
        let of_place = |(index, channels): (usize, &[Moments; 3])| {
            let photons = self.photon_noise.get(index).map_or(Rgb64::ZERO, PhotonNoise::variance);
            // E = π L.
            let photons = f64::from(PI).powi(2) * photons;
            let error = |channel: usize| match channels[channel].count() {
                0 | 1 => f64::INFINITY,
                _ => (channels[channel].standard_error().powi(2) + photons[channel]).sqrt(),
            };
            Reading { irradiance: channels.each_ref().map(Moments::mean), standard_error: [0, 1, 2].map(error) }
        };
        self.channels.iter().enumerate().map(of_place).collect()
    }
}

/// Irradiance at a place, by channel, W/m².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    pub irradiance: [f64; 3],
    /// Of noise, at most: of the spread over samples, which are better spread than independent ones, and of the photons,
    /// which all samples share. Infinite after a single sample. A bias of the view is not in it, nor is what is wrong with a
    /// radiosity solution that it reads.
    pub standard_error: [f64; 3],
}
