//! The random numbers of one sample of one pixel.

use crate::math::random::{PaddedPoint, Stream, hash, sobol2};
use glam::Vec2;

/// Points of one low-discrepancy sequence; the next ones belong to another.
const SEQUENCE: u64 = 1 << 16;

/// What is well spread over the samples of a pixel: each use has points of its own.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// The place in the pixel.
    Pixel,
    /// The point of an emitter that the first diffuse surface is lit from.
    Light,
    /// The direction of a diffuse ray.
    Gather,
    /// The direction of a diffuse ray that looks for emitters alone.
    DirectCosine,
    /// The point of an emitter that the first glossy surface reflects.
    Gloss,
}

/// Random numbers from (seed, pixel, sample) alone. Points of each [`Use`] are low-discrepancy over all samples of a pixel,
/// so that its noise falls faster than with independent ones.
pub struct Draws {
    pixel: u64,
    sample: u64,
    /// For all that is not worth spreading.
    pub stream: Stream,
}

impl Draws {
    pub fn new(seed: u64, pixel: u64, sample: u32) -> Self {
        let pixel = hash(seed, PASS, pixel);
        Self { pixel, sample: sample.into(), stream: Stream::new(pixel, PASS, sample.into()) }
    }

    /// A random number of the pixel.
    pub fn pixel(&self) -> u64 {
        self.pixel
    }

    pub fn sample(&self) -> u64 {
        self.sample
    }

    /// Point `i` of `count` that each sample takes for this use, in [0, 1)².
    pub fn spread(&self, what: Use, i: u32, count: u32) -> Vec2 {
        let index = self.sample * u64::from(count) + u64::from(i);
        let seed = hash(self.pixel, what as u64, index / SEQUENCE) as u32;
        sobol2((index % SEQUENCE) as u32, 0, seed)
    }

    /// A number and a point for item `i` of `count` that each sample takes for a use; independent ones where that is none.
    pub fn numbers(&mut self, what: Option<Use>, i: u32, count: u32) -> (f32, Vec2) {
        match what {
            Some(what) => (self.spread1(what, i, count), self.spread(what, i, count)),
            None => (self.stream.uniform(), self.stream.uniform2()),
        }
    }

    /// Path `i` of `count` that each sample takes.
    pub fn path(&self, i: u32, count: u32) -> PaddedPoint {
        PaddedPoint::new(self.pixel, self.sample * u64::from(count) + u64::from(i))
    }

    /// The same as one number, with other points.
    pub fn spread1(&self, what: Use, i: u32, count: u32) -> f32 {
        let index = self.sample * u64::from(count) + u64::from(i);
        let seed = hash(self.pixel, what as u64, index / SEQUENCE) as u32;
        sobol2((index % SEQUENCE) as u32, 1, seed).x
    }

    /// The path that each sample takes of set `set`: sets have nothing to do with each other, so that their difference tells
    /// the noise of their mean.
    pub fn path_of_set(&self, set: u64) -> PaddedPoint {
        PaddedPoint::new(hash(self.pixel, SETS, set), self.sample)
    }
}

/// Marks this use of (seed, index) among the others.
const PASS: u64 = 0x0069_6d61_6765;
/// Marks paths in sets.
const SETS: u64 = 0x7365_7473;
