//! Measuring by each method.

use super::super::CliError;
use super::super::tracing::Tracing;
use super::Options;
use super::measured::{Measured, Quality};
use super::points::Sensor;
use crate::cancel::Cancel;
use crate::math::rgb::Rgb;
use crate::math::stats::Moments;
use crate::methods::Settings;
use crate::methods::ambient_occlusion::shares;
use crate::methods::path_trace::{self, Sensors};
use crate::methods::photon_map::{Estimate, ProgressivePoints, Scratch, Which};
use crate::methods::radiosity::irradiance_in_space;
use crate::methods::transport::{Surface, Transport};
use crate::solution::SurfaceProbe;
use crate::world::World;
use glam::Vec3;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Rays at a point where nothing is said: with them a share of a half has a standard error of 1/64.
const OCCLUSION_RAYS: u32 = 1024;

/// Paths from a point where nothing is said, in [`Sensors::REPLICATES`] independent sets of a power of two, as suits them.
const PATHS: u32 = 4096;

/// On a surface the solution is read off; in the air it is gathered from all patches, as a light meter would.
pub fn by_radiosity(options: &Options, world: Arc<World>, sensors: &[Sensor]) -> Result<Vec<Measured>, CliError> {
    let solved = options.run.solve_in(world, options.run.settings())?;
    let probe = SurfaceProbe::new(&solved.world, &solved.solution);
    let measure = |&(point, normal): &Sensor| {
        let on_surface = probe.irradiance(point.into(), normal.into());
        let irradiance = on_surface.unwrap_or_else(|| {
            irradiance_in_space(&solved.world, &solved.solution, point.into(), normal.into(), solved.settings.seed)
        });
        Measured { sensor: (point, normal), value: irradiance, quality: Quality::Unknown }
    };
    Ok(sensors.iter().map(measure).collect())
}

/// Photons are on surfaces only, so points must be, too.
pub fn by_photons(options: &Options, world: Arc<World>, sensors: &[Sensor]) -> Result<Vec<Measured>, CliError> {
    let settings = Settings { photons: options.photons.settings(), ..options.run.settings() };
    let mut tracing = Tracing::new(world, settings, options.run.time());
    let photons = tracing.photons()?.method();
    let find = |point: Vec3, normal: Vec3| photons.surface(point.into(), normal.into());
    let surfaces = surfaces(sensors, find, "photons land nowhere else")?;
    if settings.photons.is_progressive {
        let mut points = ProgressivePoints::new(surfaces);
        tracing.trace(|photons| points.add(&photons.method().maps(), Which::All))?;
        let means = sensors.iter().zip(points.irradiance());
        return Ok(means.map(|(&sensor, channels)| mean_over_passes(sensor, channels)).collect());
    }
    tracing.trace(|_| ())?;
    let maps = tracing.photons()?.method().maps();
    let mut scratch = Scratch::default();
    let measure = |(&sensor, surface): (&Sensor, &Surface)| {
        let Estimate { irradiance, photons, radius, relative_error, .. } =
            maps.irradiance(surface, Which::All, &mut scratch);
        Measured { sensor, value: irradiance, quality: Quality::Estimate { relative_error, radius, photons } }
    };
    Ok(sensors.iter().zip(&surfaces).map(measure).collect())
}

/// On surfaces and in the air: as many paths as are asked for, or as the time allows.
pub fn by_paths(options: &Options, world: Arc<World>, sensors: &[Sensor]) -> Result<Vec<Measured>, CliError> {
    let settings = options.run.settings();
    let transport = Arc::new(Transport::new(world, settings.effects));
    let meters =
        sensors.iter().map(|&(point, normal)| path_trace::Sensor::new(&transport, point.into(), normal.into()));
    let mut meters = Sensors::new(transport.clone(), meters.collect(), settings.seed);
    let time = options.run.time();
    let wanted = options.samples.or(time.is_none().then_some(PATHS)).map_or(u64::MAX, u64::from);
    let (start, time) = (Instant::now(), time.unwrap_or(Duration::MAX));
    while meters.paths() < wanted && (meters.paths() == 0 || start.elapsed() < time) {
        meters.step(1, &Cancel::default());
    }
    let measure = |(&sensor, channels): (&Sensor, [Moments; 3])| Measured {
        sensor,
        value: mean(&channels),
        quality: Quality::Paths {
            standard_error: channels.each_ref().map(Moments::standard_error),
            paths: meters.paths(),
        },
    };
    Ok(sensors.iter().zip(meters.irradiance()).map(measure).collect())
}

/// The share of ambient light is that of a surface, so points must be on one. No emitter is needed.
pub fn by_occlusion(options: &Options, world: Arc<World>, sensors: &[Sensor]) -> Result<Vec<Measured>, CliError> {
    let settings = Settings { occlusion: options.occlusion.settings(OCCLUSION_RAYS), ..options.run.settings() };
    let transport = Arc::new(Transport::new(world, settings.effects));
    let find = |point: Vec3, normal: Vec3| transport.surface_at(point.into(), normal.into());
    let surfaces = surfaces(sensors, find, "ambient light is asked of surfaces alone")?;
    let measure = |(&sensor, shares): (&Sensor, Moments)| Measured {
        sensor,
        value: Rgb::splat(shares.mean() as f32),
        quality: Quality::Share { standard_error: shares.standard_error(), rays: shares.count() },
    };
    let shares = shares(&transport, &settings.occlusion, &surfaces, settings.seed);
    Ok(sensors.iter().zip(shares).map(measure).collect())
}

/// The surface at each point; `reason` says why there must be one.
fn surfaces(
    sensors: &[Sensor],
    find: impl Fn(Vec3, Vec3) -> Option<Surface>,
    reason: &'static str,
) -> Result<Vec<Surface>, CliError> {
    let surface =
        |&(point, normal): &Sensor| find(point, normal).ok_or(CliError::InTheAir { point: point.to_array(), reason });
    sensors.iter().map(surface).collect()
}

fn mean_over_passes(sensor: Sensor, channels: &[Moments; 3]) -> Measured {
    let standard_error = channels.each_ref().map(Moments::standard_error);
    Measured { sensor, value: mean(channels), quality: Quality::Mean { standard_error, passes: channels[0].count() } }
}

fn mean(channels: &[Moments; 3]) -> Rgb {
    Rgb::from_array(channels.each_ref().map(|channel| channel.mean() as f32))
}
