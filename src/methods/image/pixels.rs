//! Some pixels of a picture, for those who want to know how it will be before it is made.

use super::eye_path::Look;
use super::shutter::Shutter;
use super::{Sources, media_round};
use crate::camera::Camera;
use crate::cancel::Cancel;
use crate::math::random::sobol2;
use crate::math::rgb::Rgb;
use crate::math::stats::Moments;
use crate::methods::Settings;
use crate::methods::cost::Cost;
use crate::methods::photon_map::Scratch;
use crate::methods::transport::Transport;
use crate::solution::CameraView;
use rayon::prelude::*;
use std::collections::HashSet;
use std::sync::Arc;

/// Of each pixel, along the width and along the height.
const RAYS_ACROSS: u32 = 4;

/// Single pixels of a picture, exposed sample by sample: plain state and a step. Each has the value that it has in the whole
/// picture with as many samples, to the rounding of sums.
pub struct Pixels {
    eye: Arc<dyn Look>,
    shutter: Shutter,
    /// Column and row, from the top left.
    places: Arc<[[u32; 2]]>,
    /// L of the samples of each pixel, W/(m²·sr), background as 0.
    channels: Vec<[Moments; 3]>,
    samples: u32,
    cost: Cost,
}

impl Pixels {
    /// Pixels of a picture of `size` before their first sample; `None` where the view needs light that `sources` do not have.
    pub fn new(
        sources: &Sources,
        view: CameraView,
        camera: Camera,
        size: [u32; 2],
        places: Arc<[[u32; 2]]>,
        settings: &Settings,
    ) -> Option<Self> {
        let eye = sources.look(view, settings)?;
        let shutter = Shutter::new(&camera, media_round(&*eye, &camera), size, settings.seed);
        let channels = vec![[Moments::default(); 3]; places.len()];
        Some(Self { eye, shutter, places, channels, samples: 0, cost: Cost::default() })
    }

    /// One sample more of each, or of none if stopped.
    pub fn step(&mut self, cancel: &Cancel) -> bool {
        let expose = |scratch: &mut Scratch, place: &[u32; 2]| {
            let mut cost = Cost::default();
            (!cancel.is_requested()).then(|| {
                let sight = self.shutter.sample(*place, 1, self.samples, &*self.eye, scratch, &mut cost);
                (sight.radiance, cost)
            })
        };
        let found: Option<Vec<(Rgb, Cost)>> = self.places.par_iter().map_init(Scratch::default, expose).collect();
        let Some(found) = found else { return false };
        for (channels, (radiance, cost)) in self.channels.iter_mut().zip(found) {
            for (moments, value) in channels.iter_mut().zip(radiance.to_array()) {
                moments.add(value.into());
            }
            self.cost.add(&cost);
        }
        self.samples += 1;
        true
    }

    pub fn samples(&self) -> u32 {
        self.samples
    }

    pub fn rays(&self) -> u64 {
        self.cost.rays
    }

    /// L so far, W/(m²·sr).
    pub fn radiance(&self) -> Vec<Rgb> {
        let mean = |channels: &[Moments; 3]| Rgb::from_array(channels.each_ref().map(|channel| channel.mean() as f32));
        self.channels.iter().map(mean).collect()
    }
}

/// At most so many pixels, spread over a picture, that show surfaces and nothing else, none of which emits: there is no light
/// to be found where one is seen. Where no others are seen, those that emit. Always the same of a picture.
pub fn spread_pixels(transport: &Transport, camera: &Camera, size: [u32; 2], count: usize) -> Vec<[u32; 2]> {
    let eye_rays = camera.rays(size);
    let shows = |[x, y]: [u32; 2], may_emit: bool| {
        (0..RAYS_ACROSS * RAYS_ACROSS).all(|i| {
            let inside = [i % RAYS_ACROSS, i / RAYS_ACROSS].map(|i| (i as f32 + 0.5) / RAYS_ACROSS as f32);
            let surface = transport.meet(&eye_rays.through([x as f32 + inside[0], y as f32 + inside[1]]));
            surface.is_some_and(|surface| may_emit || transport.emission(&surface) == Rgb::ZERO)
        })
    };
    let place = |i| {
        let at = sobol2(i, 0, 0);
        [at.x * size[0] as f32, at.y * size[1] as f32].map(|pixel| pixel as u32)
    };
    // Of small pictures each pixel comes up again and again.
    let tries = 4 * u32::try_from(count).unwrap_or(u32::MAX / 4);
    let mut seen = HashSet::new();
    let pixels: Vec<[u32; 2]> = (0..tries).map(place).filter(|&place| seen.insert(place)).collect();
    let those =
        |may_emit| pixels.iter().copied().filter(|&pixel| shows(pixel, may_emit)).take(count).collect::<Vec<_>>();
    let dull = those(false);
    if dull.is_empty() { those(true) } else { dull }
}
