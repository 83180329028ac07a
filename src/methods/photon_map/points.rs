//! Irradiance at a few points, pass by pass.

use super::{PhotonMaps, Scratch, Which};
use crate::math::stats::Moments;
use crate::methods::transport::Surface;
use rayon::prelude::*;

/// The mean over the passes of progressive photon mapping at points of surfaces. Each pass is less biased than the one
/// before and as good a guess of the noise: the spread between them is the error of their mean.
#[derive(Clone, Debug)]
pub struct ProgressivePoints {
    surfaces: Vec<Surface>,
    channels: Vec<[Moments; 3]>,
}

impl ProgressivePoints {
    /// Points, each on the side of a surface on which a ray met it.
    pub fn new(surfaces: Vec<Surface>) -> Self {
        Self { channels: vec![[Moments::default(); 3]; surfaces.len()], surfaces }
    }

    /// Takes in a pass whose photons are all there, each once.
    pub fn add(&mut self, maps: &PhotonMaps, which: Which) {
        self.channels.par_iter_mut().zip(&self.surfaces).for_each_init(
            Scratch::default,
            |scratch, (channels, surface)| {
                let irradiance = maps.irradiance(surface, which, scratch).irradiance;
                for (moments, value) in channels.iter_mut().zip(irradiance.to_array()) {
                    moments.add(value.into());
                }
            },
        );
    }

    /// For each point and channel the moments of E, W/m², over the passes: their mean and its standard error.
    pub fn irradiance(&self) -> &[[Moments; 3]] {
        &self.channels
    }
}
