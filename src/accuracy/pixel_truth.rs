//! The truth about some pixels of a picture, as [`super::Reference`] is that about points of surfaces.

use super::error::Error;
use crate::camera::Camera;
use crate::cancel::Cancel;
use crate::effects::Switches;
use crate::math::random::hash;
use crate::math::rgb::Rgb;
use crate::math::stats::Moments;
use crate::methods::image::{Pixels, Sources, spread_pixels};
use crate::methods::transport::Transport;
use crate::methods::{ImageSettings, Settings};
use crate::solution::CameraView;
use crate::world::World;
use std::sync::Arc;

/// Every random number of the truth comes from this, whatever the seed of what is held against it.
const SEED: u64 = 0x0070_6978_656c;
/// Independent estimates, whose spread tells how sure their mean is.
const REPLICATES: u64 = 16;
/// Samples of a pixel, none of which has met any light in a picture that shows none.
const DARK: u32 = 512;

/// The light of pixels that are spread over a picture, path traced, in the making: plain state and a step. All effects that the
/// scene calls for are in it.
pub struct PixelTruth {
    places: Arc<[[u32; 2]]>,
    replicates: Vec<Pixels>,
    /// For each pixel and channel the estimates of L, W/(m²·sr).
    radiance: Vec<[Moments; 3]>,
    floor: f64,
}

impl PixelTruth {
    /// Of `count` pixels, at most, of a picture of `size` before its first step. A thousand tell the root of a mean square to a
    /// few percent, whatever the shape of the errors.
    pub fn new(world: &Arc<World>, camera: Camera, size: [u32; 2], count: usize) -> Self {
        let transport = Arc::new(Transport::new(world.clone(), Switches::default()));
        let places: Arc<[[u32; 2]]> = spread_pixels(&transport, &camera, size, count).into();
        let sources = Sources { transport, radiosity: None, photons: None };
        let replicate = |index| {
            let image = ImageSettings { samples: ImageSettings::MAX_SAMPLES, ..ImageSettings::default() };
            let settings = Settings { seed: hash(SEED, 0, index), image, ..Settings::default() };
            Pixels::new(&sources, CameraView::Reference, camera, size, places.clone(), &settings)
                .expect("path tracing needs no other light")
        };
        let replicates = (0..REPLICATES).map(replicate).collect();
        Self { places, replicates, radiance: Vec::new(), floor: f64::INFINITY }
    }

    /// Column and row of each, from the top left. There is none where nothing but emitters is seen, or nothing.
    pub fn places(&self) -> &Arc<[[u32; 2]]> {
        &self.places
    }

    /// One sample more of each pixel in each of the estimates. False if stopped; what was done by then counts all the same.
    pub fn refine(&mut self, cancel: &Cancel) -> bool {
        for replicate in &mut self.replicates {
            if !replicate.step(cancel) {
                return false;
            }
        }
        self.radiance = vec![[Moments::default(); 3]; self.places.len()];
        for replicate in &self.replicates {
            for (channels, mean) in self.radiance.iter_mut().zip(replicate.radiance()) {
                for (channel, value) in channels.iter_mut().zip(mean.to_array()) {
                    channel.add(value.into());
                }
            }
        }
        let nothing = vec![Rgb::ZERO; self.places.len()];
        self.floor = Error::of(&nothing, &self.radiance).map_or(f64::INFINITY, |error| error.floor);
        true
    }

    /// Samples of a pixel in each of the estimates.
    pub fn samples(&self) -> u32 {
        self.replicates.iter().map(Pixels::samples).min().unwrap_or(0)
    }

    /// The error that the truth has itself, as [`Error::floor`]. Infinite where nothing is known or there is no light.
    pub fn floor(&self) -> f64 {
        self.floor
    }

    /// Whether no light is seen: more samples would not meet any, either.
    pub fn is_dark(&self) -> bool {
        self.places.is_empty() || self.floor.is_infinite() && self.samples() * REPLICATES as u32 >= DARK
    }

    /// How far off the radiance of the pixels is, W/(m²·sr), as a share of the mean; `None` where nothing is known or there is no
    /// light.
    pub fn error(&self, radiance: &[Rgb]) -> Option<Error> {
        Error::of(radiance, &self.radiance).filter(|_| self.floor.is_finite())
    }

    /// The same of a whole picture, row by row from the top left.
    pub fn error_of_picture(&self, radiance: &[Rgb], width: u32) -> Option<Error> {
        let of_place = |[x, y]: &[u32; 2]| radiance[(y * width + x) as usize];
        self.error(&self.places.iter().map(of_place).collect::<Vec<_>>())
    }
}
