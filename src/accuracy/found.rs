//! What a method finds at the points where the truth is known.

use super::points::ProbePoint;
use crate::math::rgb::Rgb;
use crate::math::stats::Moments;
use crate::methods::image::Reading;
use crate::methods::photon_map::{Estimate, PhotonMaps, Scratch, Which};
use crate::methods::radiosity::irradiance_in_space;
use crate::methods::transport::{Surface, Transport};
use crate::solution::{Solution, SurfaceProbe};
use crate::world::World;
use rayon::prelude::*;

/// Irradiance at points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// E, W/m².
    pub irradiance: Vec<Rgb>,
    /// Mean of the squared standard errors over points and channels, (W/m²)², where the method tells them.
    pub variance: Option<f64>,
}

impl Found {
    /// The means over independent samples of each point and channel. One alone does not tell how it scatters.
    pub fn of_samples(channels: &[[Moments; 3]]) -> Self {
        let mean = |channels: &[Moments; 3]| Rgb::from_array(channels.each_ref().map(|channel| channel.mean() as f32));
        let squares: f64 = channels.iter().flatten().map(|channel| channel.standard_error().powi(2)).sum();
        let tells = channels.iter().flatten().all(|channel| channel.count() > 1);
        let variance = tells.then(|| squares / count(channels.len()));
        Self { irradiance: channels.iter().map(mean).collect(), variance }
    }

    /// What a view shows.
    pub fn of_readings(readings: &[Reading]) -> Self {
        let irradiance = |reading: &Reading| Rgb::from_array(reading.irradiance.map(|value| value as f32));
        let squares: f64 = readings.iter().flat_map(|reading| reading.standard_error).map(|error| error * error).sum();
        let variance = squares.is_finite().then(|| squares / count(readings.len()));
        Self { irradiance: readings.iter().map(irradiance).collect(), variance }
    }
}

/// Of numbers at so many points, to divide by.
fn count(points: usize) -> f64 {
    3.0 * points.max(1) as f64
}

/// The surfaces that points were spread over, in their order.
///
/// # Panics
/// If a point lies on no surface: those of [`super::spread`] all do.
pub fn surfaces(transport: &Transport, points: &[ProbePoint]) -> Vec<Surface> {
    let surface = |at: &ProbePoint| transport.surface_at(at.point, at.normal);
    points.iter().map(|at| surface(at).expect("points are spread where a surface is met")).collect()
}

/// Read off a radiosity solution; where a point lies on no element, gathered from all patches.
pub fn by_radiosity(world: &World, solution: &Solution, points: &[ProbePoint], seed: u64) -> Found {
    let probe = SurfaceProbe::new(world, solution);
    let measure = |at: &ProbePoint| {
        let on_surface = probe.irradiance(at.point, at.normal);
        on_surface.unwrap_or_else(|| irradiance_in_space(world, solution, at.point, at.normal, seed))
    };
    Found { irradiance: points.par_iter().map(measure).collect(), variance: None }
}

/// Estimated from the photons of one pass.
pub fn by_photons(maps: &PhotonMaps, points: &[ProbePoint]) -> Found {
    let measure = |scratch: &mut Scratch, surface: &Surface| maps.irradiance(surface, Which::All, scratch);
    let surfaces = surfaces(maps.transport(), points);
    let estimates: Vec<Estimate> = surfaces.par_iter().map_init(Scratch::default, measure).collect();
    let square = |estimate: &Estimate| {
        let deviation = estimate.irradiance * estimate.relative_error;
        if deviation.is_finite() { f64::from(deviation.length_squared()) } else { 0.0 }
    };
    let squares: f64 = estimates.iter().map(square).sum();
    Found {
        irradiance: estimates.iter().map(|found| found.irradiance).collect(),
        variance: Some(squares / count(points.len())),
    }
}
