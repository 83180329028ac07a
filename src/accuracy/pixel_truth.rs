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
    /// Pixels that these stand for, themselves included.
    all: u64,
    /// For each pixel and channel the estimates of L, W/(m²·sr).
    radiance: Vec<[Moments; 3]>,
    floor: f64,
}

impl PixelTruth {
    /// Of `count` pixels, at most, of a picture of `size` before its first step. Another `set` is of other pixels: those that a
    /// picture was chosen by are no fair judges of it.
    pub fn new(world: &Arc<World>, camera: Camera, size: [u32; 2], count: usize, set: u32) -> Self {
        let transport = Arc::new(Transport::new(world.clone(), Switches::default()));
        let places: Arc<[[u32; 2]]> = spread_pixels(&transport, &camera, size, count, set).into();
        let sources = Sources { transport, radiosity: None, photons: None };
        let replicate = |index| {
            let image = ImageSettings { samples: ImageSettings::MAX_SAMPLES, ..ImageSettings::default() };
            let settings = Settings { seed: hash(SEED, set.into(), index), image, ..Settings::default() };
            Pixels::new(&sources, CameraView::Reference, camera, size, places.clone(), &settings)
                .expect("path tracing needs no other light")
        };
        let replicates = (0..REPLICATES).map(replicate).collect();
        // Where there are fewer than were looked for, they are all that show anything.
        let all = if places.len() < count { places.len() as u64 } else { u64::from(size[0]) * u64::from(size[1]) };
        Self { places, replicates, all, radiance: Vec::new(), floor: f64::INFINITY }
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
        self.floor = Error::of_noise(&self.radiance).map_or(f64::INFINITY, |error| error.floor);
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

    /// The same of a whole picture, row by row from the top left, all of whose pixels are meant.
    pub fn error_of_picture(&self, radiance: &[Rgb], width: u32) -> Option<Error> {
        Error::of_some(&self.of_places(radiance, width), &self.radiance, self.all).filter(|_| self.floor.is_finite())
    }

    /// The pixels of a whole picture that are known here.
    pub fn of_places(&self, radiance: &[Rgb], width: u32) -> Vec<Rgb> {
        self.places.iter().map(|[x, y]| radiance[(y * width + x) as usize]).collect()
    }

    /// Of two independent pictures of the same light: the mean square of what they are off by in common, which is the bias, and
    /// of what each is off by for itself, which is noise. As shares of the squared mean; `None` where nothing is known or there
    /// is no light.
    pub fn parts(&self, one: &[Rgb], other: &[Rgb]) -> Option<Parts> {
        let (mut common, mut apart, mut sum) = (0.0, 0.0, 0.0);
        for ((one, other), truth) in one.iter().zip(other).zip(&self.radiance) {
            for (channel, truth) in truth.iter().enumerate() {
                let [one, other] = [one, other].map(|radiance| f64::from(radiance[channel]));
                let [off, other_off] = [one, other].map(|radiance| radiance - truth.mean());
                // Both are held against the same noise of the truth.
                common += off * other_off - truth.standard_error().powi(2);
                apart += (one - other).powi(2) / 2.0;
                sum += truth.mean();
            }
        }
        let count = 3.0 * self.radiance.len() as f64;
        let square_of_mean = (sum / count).powi(2);
        let parts = Parts { bias: common / count / square_of_mean, noise: apart / count / square_of_mean };
        (self.floor.is_finite() && square_of_mean > 0.0).then_some(parts)
    }
}

/// Mean squares of what a picture is off by. That of the bias is an estimate and may come out below 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parts {
    pub bias: f64,
    pub noise: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshSettings;
    use crate::scene::Scene;

    const SIZE: [u32; 2] = [48, 36];

    /// The furnace's walls send 1 W/m² and reflect a half: L = 2/π everywhere.
    fn furnace() -> PixelTruth {
        let scene = Scene::open("furnace").expect("a built-in scene");
        let world = Arc::new(World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world"));
        let mut truth = PixelTruth::new(&world, Camera::new(&world.viewpoint, &world.bounds), SIZE, 400, 0);
        (0..4).for_each(|_| assert!(truth.refine(&Cancel::default())));
        truth
    }

    /// Light that is off by `bias` everywhere, and by `noise` one way or the other, as shares.
    fn light(truth: &PixelTruth, bias: f32, noise: f32, seed: u64) -> Vec<Rgb> {
        let off = |i| if hash(seed, i, 0) & 1 == 0 { noise } else { -noise };
        let exact = std::f32::consts::FRAC_2_PI;
        (0..truth.places().len() as u64).map(|i| Rgb::splat(exact * (1.0 + bias + off(i)))).collect()
    }

    #[test]
    fn what_two_pictures_have_in_common_is_bias() {
        let truth = furnace();
        let parts =
            |bias, noise| truth.parts(&light(&truth, bias, noise, 1), &light(&truth, bias, noise, 2)).expect("light");
        // The product of two signs has a deviation of 1, over 400 pixels of 1/20; beside it the noise of the truth.
        let sure = truth.floor().powi(2) + 0.3 * truth.floor();
        let biased = parts(0.1, 0.3);
        assert!((biased.bias - 0.01).abs() < 4.0 * (0.09 + 0.06 + sure) / 20.0, "{biased:?}");
        // Half of the pairs differ, by twice the noise.
        assert!((biased.noise - 0.09).abs() < 4.0 * 0.09 / 20.0, "{biased:?}");
        let exact = parts(0.0, 0.0);
        assert!(exact.noise == 0.0 && exact.bias.abs() < 4.0 * truth.floor().powi(2) / 20.0, "{exact:?}");
    }

    #[test]
    fn the_whole_picture_is_less_sure_than_the_pixels_that_were_looked_at() {
        let truth = furnace();
        let pixels = SIZE[0] * SIZE[1];
        let exact = std::f32::consts::FRAC_2_PI;
        let picture: Vec<Rgb> = (0..pixels)
            .map(|i| Rgb::splat(exact * if hash(3, i.into(), 0).is_multiple_of(16) { 2.0 } else { 1.0 }))
            .collect();
        let some = truth.of_places(&picture, SIZE[0]);
        let (of_pixels, of_picture) = (truth.error(&some), truth.error_of_picture(&picture, SIZE[0]));
        let (of_pixels, of_picture) = (of_pixels.expect("light"), of_picture.expect("light"));
        assert_eq!(of_pixels.rms, of_picture.rms);
        assert!(of_picture.uncertainty > 2.0 * of_pixels.uncertainty, "{of_pixels:?} {of_picture:?}");
        assert!((of_picture.rms - 0.25).abs() < 4.0 * of_picture.uncertainty, "{of_picture:?}");
    }
}
