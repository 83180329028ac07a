//! The truth at points: irradiance, and how sure it is.

use super::PathTracer;
use crate::cancel::Cancel;
use crate::math::random::{PaddedPoint, hash};
use crate::math::rgb::Rgb64;
use crate::math::stats::Moments;
use crate::methods::cost::Cost;
use crate::methods::transport::{Media, Surface, Transport};
use crate::solution::PathMatcher;
use crate::tracer::SPACE;
use glam::Vec3A;
use rayon::prelude::*;
use std::sync::Arc;

/// Marks this use of (seed, index) among the others.
const PASS: u64 = 0x7365_6e73_6f72;

/// Where light is measured.
#[derive(Clone, Copy, Debug)]
pub struct Sensor {
    surface: Surface,
    /// The glass that it is in.
    media: Media,
}

impl Sensor {
    /// On the side of a surface that a unit `normal` faces, or in the air.
    pub fn new(transport: &Transport, point: Vec3A, normal: Vec3A) -> Self {
        let surface = transport.surface_at(point, normal).unwrap_or_else(|| in_the_air(point, normal));
        // What arrives at the polygon, and not at the smooth surface that it stands for.
        let surface = Surface { normal: surface.facing, ..surface };
        Self { surface, media: transport.media_beside(surface.surface_point(), surface.facing) }
    }
}

/// A light meter: there is no polygon of this index, nor a material, and none is asked for where irradiance is found.
fn in_the_air(point: Vec3A, normal: Vec3A) -> Surface {
    Surface { polygon: SPACE, is_front: true, distance: 0.0, point, facing: normal, normal, material: u32::MAX }
}

/// Irradiance at sensors by path tracing, in the making: plain state and a step.
///
/// Paths of a point are low-discrepancy, so that their spread says too much about the error of their mean. Therefore they
/// make [`Sensors::REPLICATES`] independent estimates, whose spread is that of one of them.
pub struct Sensors {
    tracer: PathTracer,
    sensors: Vec<Sensor>,
    /// For each sensor the sums of E over the paths of each replicate, W/m².
    sums: Vec<[Rgb64; Sensors::REPLICATES]>,
    /// Paths of each replicate of each sensor so far.
    paths: u64,
    seed: u64,
    cost: Cost,
}

impl Sensors {
    /// Independent estimates of each sensor.
    pub const REPLICATES: usize = 32;

    pub fn new(transport: Arc<Transport>, sensors: Vec<Sensor>, seed: u64) -> Self {
        let sums = vec![[Rgb64::ZERO; Self::REPLICATES]; sensors.len()];
        let tracer = PathTracer::new(transport, PathMatcher::default());
        Self { tracer, sensors, sums, paths: 0, seed, cost: Cost::default() }
    }

    /// So many paths more for each replicate of each sensor, all of them or none; false if stopped.
    pub fn step(&mut self, paths: u64, cancel: &Cancel) -> bool {
        let of_sensor = |(index, sensor): (usize, &Sensor)| {
            let (mut sums, mut cost) = ([Rgb64::ZERO; Self::REPLICATES], Cost::default());
            for (replicate, sum) in sums.iter_mut().enumerate() {
                if cancel.is_requested() {
                    return None;
                }
                let seed = hash(self.seed, PASS, (index * Self::REPLICATES + replicate) as u64);
                for path in self.paths..self.paths + paths {
                    let point = PaddedPoint::new(seed, path);
                    *sum += self.tracer.irradiance(&sensor.surface, sensor.media, &point, &mut cost).as_dvec3();
                }
            }
            Some((sums, cost))
        };
        let found: Option<Vec<_>> = self.sensors.par_iter().enumerate().map(of_sensor).collect();
        let Some(found) = found else { return false };
        for (sums, (new, cost)) in self.sums.iter_mut().zip(found) {
            for (sum, new) in sums.iter_mut().zip(new) {
                *sum += new;
            }
            self.cost.add(&cost);
        }
        self.paths += paths;
        true
    }

    /// Paths of each sensor so far.
    pub fn paths(&self) -> u64 {
        self.paths * Self::REPLICATES as u64
    }

    /// All that was found so far: paths of each replicate, and for each sensor the sums of E over the paths of each, W/m².
    pub fn found(&self) -> (u64, &[[Rgb64; Self::REPLICATES]]) {
        (self.paths, &self.sums)
    }

    /// Goes on from what was found before; false, and nothing changes, where that is not about as many sensors.
    pub fn go_on_from(&mut self, paths: u64, sums: Vec<[Rgb64; Self::REPLICATES]>) -> bool {
        let fits = sums.len() == self.sensors.len();
        if fits {
            (self.paths, self.sums) = (paths, sums);
        }
        fits
    }

    pub fn rays(&self) -> u64 {
        self.cost.rays
    }

    /// For each sensor and channel the estimates of all replicates, W/m². Their standard error is that of their mean.
    pub fn irradiance(&self) -> Vec<[Moments; 3]> {
        let of_sensor = |sums: &[Rgb64; Self::REPLICATES]| {
            let mut channels = [Moments::default(); 3];
            for sum in sums {
                let mean = *sum / self.paths.max(1) as f64;
                for (channel, value) in channels.iter_mut().zip(mean.to_array()) {
                    channel.add(value);
                }
            }
            channels
        };
        self.sums.iter().map(of_sensor).collect()
    }
}
