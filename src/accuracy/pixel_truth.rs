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
    set: u32,
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
            let settings = Settings { seed: seed_of(set, index), image, ..Settings::default() };
            Pixels::new(&sources, CameraView::Reference, camera, size, places.clone(), &settings)
                .expect("path tracing needs no other light")
        };
        let replicates = (0..REPLICATES).map(replicate).collect();
        // Where there are fewer than were looked for, they are all that show anything.
        let all = if places.len() < count { places.len() as u64 } else { u64::from(size[0]) * u64::from(size[1]) };
        Self { places, set, replicates, all, radiance: Vec::new(), floor: f64::INFINITY }
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

    /// The seed of each replicate. As many samples by the same seeds fall on the same places of each pixel, so that noise at
    /// edges cancels in differences (common random numbers).
    pub fn seeds(&self) -> impl Iterator<Item = u64> {
        (0..REPLICATES).map(|index| seed_of(self.set, index))
    }

    /// Bias and noise of `pilots`, which show the same pixels by the same seeds, held against the estimates of the truth pair
    /// by pair; `None` where nothing is known or there is no light.
    ///
    /// With D the differences of R independent pairs, (ΣD)² − ΣD² over R (R − 1) is an unbiased estimate of the squared bias
    /// of a pixel and channel, whatever the noise of both. How far it can be trusted follows from how it scatters over pixels.
    pub fn parts(&self, pilots: &[Pixels]) -> Option<ErrorParts> {
        let of_truth: Vec<Vec<Rgb>> = self.replicates.iter().map(Pixels::radiance).collect();
        let of_pilots: Vec<Vec<Rgb>> = pilots.iter().map(Pixels::radiance).collect();
        let samples = f64::from(pilots.iter().map(Pixels::samples).min()?);
        let (mut bias, mut noise) = (Moments::default(), 0.0);
        for pixel in 0..self.places.len() {
            let mut square = 0.0;
            for channel in 0..3 {
                let (mut differences, mut values) = (Moments::default(), Moments::default());
                for (pilot, truth) in of_pilots.iter().zip(&of_truth) {
                    let [value, truth] = [pilot, truth].map(|radiance| f64::from(radiance[pixel][channel]));
                    differences.add(value - truth);
                    values.add(value);
                }
                square += differences.mean().powi(2) - differences.standard_error().powi(2);
                noise += samples * values.variance();
            }
            bias.add(square / 3.0);
        }
        let square_of_mean = self.mean().powi(2);
        (self.floor.is_finite() && square_of_mean > 0.0).then(|| ErrorParts {
            bias: bias.mean() / square_of_mean,
            bias_deviation: bias.standard_error() / square_of_mean,
            noise: noise / (3.0 * self.places.len() as f64) / square_of_mean,
        })
    }

    /// The same of path tracing that the truth itself is made by: all of it is noise.
    pub fn own_parts(&self) -> Option<ErrorParts> {
        self.parts(&self.replicates).map(|parts| ErrorParts { bias: 0.0, bias_deviation: 0.0, ..parts })
    }

    /// Mean of L over pixels and channels, W/(m²·sr).
    fn mean(&self) -> f64 {
        let sum: f64 = self.radiance.iter().flatten().map(Moments::mean).sum();
        sum / (3.0 * self.radiance.len().max(1) as f64)
    }
}

fn seed_of(set: u32, index: u64) -> u64 {
    hash(SEED, set.into(), index)
}

/// Mean squares of what a picture is off by, as shares of the squared mean light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ErrorParts {
    /// Squared bias, which no number of samples takes away. An estimate: it may come out below 0.
    pub bias: f64,
    /// Standard error of `bias`.
    pub bias_deviation: f64,
    /// Variance of one sample a pixel; of n samples it is n times smaller.
    pub noise: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshSettings;
    use crate::scene::Scene;

    const SIZE: [u32; 2] = [48, 36];

    /// As many samples of the same pixels by the same seeds.
    fn pilots(truth: &PixelTruth, view: CameraView) -> Vec<Pixels> {
        let (sources, camera) = (sources(), camera());
        let pixels = |seed| {
            let settings = Settings { seed, ..Settings::default() };
            Pixels::new(&sources, view, camera, SIZE, truth.places().clone(), &settings).expect("pixels")
        };
        let mut pilots: Vec<Pixels> = truth.seeds().map(pixels).collect();
        for pilot in &mut pilots {
            (0..truth.samples()).for_each(|_| assert!(pilot.step(&Cancel::default())));
        }
        pilots
    }

    fn world() -> Arc<World> {
        let scene = Scene::open("furnace").expect("a built-in scene");
        Arc::new(World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world"))
    }

    fn camera() -> Camera {
        let world = world();
        Camera::new(&world.viewpoint, &world.bounds)
    }

    fn sources() -> Sources {
        let transport = Arc::new(Transport::new(world(), Switches::default()));
        Sources { transport, radiosity: None, photons: None }
    }

    /// The furnace's walls send 1 W/m² and reflect a half: L = 2/π everywhere.
    fn furnace() -> PixelTruth {
        let mut truth = PixelTruth::new(&world(), camera(), SIZE, 400, 0);
        (0..4).for_each(|_| assert!(truth.refine(&Cancel::default())));
        truth
    }

    /// Direct light alone leaves 3/2 of the 4/2 that the furnace sends: a quarter is missing everywhere.
    #[test]
    fn a_bias_is_found_behind_noise_that_is_larger() {
        let truth = furnace();
        let parts = truth.parts(&pilots(&truth, CameraView::RayTraced)).expect("light");
        assert!((parts.bias - 0.0625).abs() < 5.0 * parts.bias_deviation, "{parts:?}");
        assert!((1e-6..0.01).contains(&parts.bias_deviation) && parts.noise > 0.0, "{parts:?}");
    }

    #[test]
    fn the_same_light_has_no_bias_and_its_noise_is_told() {
        let truth = furnace();
        let parts = truth.parts(&pilots(&truth, CameraView::Reference)).expect("light");
        // Pilots that go the very ways of the truth differ by nothing.
        assert!(parts.bias.abs() < 1e-12 && parts.bias_deviation < 1e-12, "{parts:?}");
        let own = truth.own_parts().expect("light");
        assert_eq!((own.bias, own.noise), (0.0, parts.noise));
        // Noise of n samples in each of R estimates leaves the floor √(noise / (n R)).
        let floor = (own.noise / (16.0 * f64::from(truth.samples()))).sqrt();
        assert!((floor / truth.floor() - 1.0).abs() < 1e-6, "{floor} {}", truth.floor());
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
