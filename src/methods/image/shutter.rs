//! How one sample of one pixel is taken: the same wherever that pixel is a part of.

use super::draws::{Draws, Use};
use super::eye_path::{Look, Sight, Tools};
use crate::camera::{Camera, EyeRays};
use crate::methods::cost::Cost;
use crate::methods::photon_map::Scratch;
use crate::methods::transport::Media;
use glam::Vec2;

/// Takes samples of the pixels of one picture.
pub struct Shutter {
    eye_rays: EyeRays,
    /// The glass that the eye is in.
    media: Media,
    pub size: [u32; 2],
    pub seed: u64,
}

impl Shutter {
    pub fn new(camera: &Camera, media: Media, size: [u32; 2], seed: u64) -> Self {
        Self { eye_rays: camera.rays(size), media, size, seed }
    }

    /// The same with other random numbers.
    pub fn reseeded(&self, seed: u64) -> Self {
        Self { seed, ..*self }
    }

    /// Sample `sample` of a cell of `cell` pixels: of a coarse one in its middle, of a pixel anywhere in it.
    pub fn sample(
        &self,
        at: [u32; 2],
        cell: u32,
        sample: u32,
        eye: &dyn Look,
        scratch: &mut Scratch,
        cost: &mut Cost,
    ) -> Sight {
        let [x, y] = at.map(|i| i * cell);
        let pixel = u64::from(y) * u64::from(self.size[0]) + u64::from(x);
        let mut draws = Draws::new(self.seed, pixel, sample);
        let inside = if cell == 1 { draws.spread(Use::Pixel, 0, 1) } else { Vec2::splat(0.5) };
        let place = Vec2::new(x as f32, y as f32) + inside * cell as f32;
        let mut tools = Tools { draws: &mut draws, scratch, cost, batches: None };
        eye.look(self.eye_rays.through(place.to_array()), self.media, &mut tools)
    }
}
