//! Measuring by each method.

use super::super::CliError;
use super::super::run_options::Solved;
use super::super::tracing::Tracing;
use super::Options;
use super::measured::{Measured, Quality};
use crate::accuracy::{self, ProbePoint};
use crate::cancel::Cancel;
use crate::math::rgb::Rgb;
use crate::math::stats::Moments;
use crate::methods::Settings;
use crate::methods::ambient_occlusion::shares;
use crate::methods::image::Reading;
use crate::methods::path_trace::{Sensor, Sensors};
use crate::methods::photon_map::{Estimate, ProgressivePoints, Scratch, Which};
use crate::methods::transport::{Surface, Transport};
use crate::solution::CameraView;
use crate::world::World;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Rays at a point where nothing is said: with them a share of a half has a standard error of 1/64.
const OCCLUSION_RAYS: u32 = 1024;

/// Paths from a point where nothing is said, in [`Sensors::REPLICATES`] independent sets of a power of two, as suits them.
const PATHS: u32 = 4096;

/// Samples at a point where nothing is said.
const SAMPLES: u32 = 16;

/// On a surface the solution is read off; in the air it is gathered from all patches, as a light meter would.
pub fn by_radiosity(options: &Options, world: Arc<World>, points: &[ProbePoint]) -> Result<Vec<Measured>, CliError> {
    let Solved { world, settings, solution } = options.run.solve_in(world, options.run.settings())?;
    let found = accuracy::by_radiosity(&world, &solution, points, settings.seed).irradiance;
    let measured = points.iter().zip(found);
    Ok(measured.map(|(&at, value)| Measured { at, value, quality: Quality::Unknown }).collect())
}

/// Photons are on surfaces only, so points must be, too.
pub fn by_photons(options: &Options, world: Arc<World>, points: &[ProbePoint]) -> Result<Vec<Measured>, CliError> {
    let settings = Settings { photons: options.photons.settings(), ..options.run.settings() };
    let mut tracing = Tracing::new(world.clone(), settings, options.run.time());
    let photons = tracing.photons()?.method();
    let find = |at: &ProbePoint| photons.surface(at.point, at.normal);
    let surfaces = surfaces(&world, points, find, "photons land nowhere else")?;
    if settings.photons.is_progressive {
        let mut means = ProgressivePoints::new(surfaces);
        tracing.trace(|photons| means.add(&photons.method().maps(), Which::All))?;
        let means = points.iter().zip(means.irradiance());
        return Ok(means.map(|(&at, channels)| mean_over_passes(at, channels)).collect());
    }
    tracing.trace(|_| ())?;
    let maps = tracing.photons()?.method().maps();
    let mut scratch = Scratch::default();
    let measure = |(&at, surface): (&ProbePoint, &Surface)| {
        let Estimate { irradiance, photons, radius, relative_error, .. } =
            maps.irradiance(surface, Which::All, &mut scratch);
        Measured { at, value: irradiance, quality: Quality::Estimate { relative_error, radius, photons } }
    };
    Ok(points.iter().zip(&surfaces).map(measure).collect())
}

/// On surfaces and in the air: as many paths as are asked for, or as the time allows.
pub fn by_paths(options: &Options, world: Arc<World>, points: &[ProbePoint]) -> Result<Vec<Measured>, CliError> {
    let mut meters = sensors(&options.run.settings(), world, points);
    let time = options.run.time();
    let wanted = options.samples.or(time.is_none().then_some(PATHS)).map_or(u64::MAX, u64::from);
    let (start, time) = (Instant::now(), time.unwrap_or(Duration::MAX));
    while meters.paths() < wanted && (meters.paths() == 0 || start.elapsed() < time) {
        meters.step(1, &Cancel::default());
    }
    Ok(read(&meters, points))
}

/// Path-traced meters before their first path.
pub fn sensors(settings: &Settings, world: Arc<World>, points: &[ProbePoint]) -> Sensors {
    let transport = Arc::new(Transport::new(world, settings.effects));
    let meters = points.iter().map(|at| Sensor::new(&transport, at.point, at.normal)).collect();
    Sensors::new(transport, meters, settings.seed)
}

/// What the meters at these points say.
pub fn read(meters: &Sensors, points: &[ProbePoint]) -> Vec<Measured> {
    let measure = |(&at, channels): (&ProbePoint, [Moments; 3])| Measured {
        at,
        value: mean(&channels),
        quality: Quality::Paths {
            standard_error: channels.each_ref().map(Moments::standard_error),
            paths: meters.paths(),
        },
    };
    points.iter().zip(meters.irradiance()).map(measure).collect()
}

/// The share of ambient light is that of a surface, so points must be on one. No emitter is needed.
pub fn by_occlusion(options: &Options, world: Arc<World>, points: &[ProbePoint]) -> Result<Vec<Measured>, CliError> {
    let settings = Settings { occlusion: options.occlusion.settings(OCCLUSION_RAYS), ..options.run.settings() };
    let transport = Arc::new(Transport::new(world.clone(), settings.effects));
    let find = |at: &ProbePoint| transport.surface_at(at.point, at.normal);
    let surfaces = surfaces(&world, points, find, "ambient light is asked of surfaces alone")?;
    let measure = |(&at, shares): (&ProbePoint, Moments)| Measured {
        at,
        value: Rgb::splat(shares.mean() as f32),
        quality: Quality::Share { standard_error: shares.standard_error(), rays: shares.count() },
    };
    let shares = shares(&transport, &settings.occlusion, &surfaces, settings.seed);
    Ok(points.iter().zip(shares).map(measure).collect())
}

/// As a picture of a view shows it, so points must be on surfaces: radiosity with rays to the emitters, gathering rays into a
/// photon map, or ambient light where it is not occluded, with as many samples as are asked for or as the time allows.
pub fn by_view(
    options: &Options,
    view: CameraView,
    world: Arc<World>,
    points: &[ProbePoint],
) -> Result<Vec<Measured>, CliError> {
    let settings = options.settings_of_view();
    let mut tracing = Tracing::new(world.clone(), settings, options.run.time());
    let start = Instant::now();
    let radiosity = if view.needs_radiosity() {
        Some(Arc::new(options.run.solve_in(world.clone(), settings)?.solution))
    } else {
        None
    };
    if view.needs_photons() {
        tracing.first_pass()?;
    }
    let mut meters = tracing.meters(view, radiosity, |transport| {
        surfaces(&world, points, |at| transport.surface_at(at.point, at.normal), "a view shows surfaces alone")
    })?;
    let time = options.run.time();
    let wanted = options.samples.or(time.is_none().then_some(SAMPLES)).unwrap_or(u32::MAX);
    let time = time.unwrap_or(Duration::MAX);
    while meters.samples() < wanted && (meters.samples() == 0 || start.elapsed() < time) {
        meters.step(&Cancel::default());
    }
    let samples = meters.samples().into();
    let measure = |(&at, reading): (&ProbePoint, Reading)| Measured {
        at,
        value: Rgb::from_array(reading.irradiance.map(|value| value as f32)),
        quality: Quality::Samples { standard_error: reading.standard_error, samples },
    };
    Ok(points.iter().zip(meters.readings()).map(measure).collect())
}

/// The surface at each point; `reason` says why there must be one.
fn surfaces(
    world: &World,
    points: &[ProbePoint],
    find: impl Fn(&ProbePoint) -> Option<Surface>,
    reason: &'static str,
) -> Result<Vec<Surface>, CliError> {
    let in_the_air = |at: &ProbePoint| CliError::InTheAir {
        point: world.scene.file_from_scene(at.point.into()),
        distance: world.distance_to_surface(at.point),
        reason,
    };
    let surface = |at: &ProbePoint| find(at).ok_or_else(|| in_the_air(at));
    points.iter().map(surface).collect()
}

fn mean_over_passes(at: ProbePoint, channels: &[Moments; 3]) -> Measured {
    // One pass alone does not tell how passes scatter.
    let error = |channel: &Moments| if channel.count() > 1 { channel.standard_error() } else { f64::INFINITY };
    let standard_error = channels.each_ref().map(error);
    Measured { at, value: mean(channels), quality: Quality::Mean { standard_error, passes: channels[0].count() } }
}

fn mean(channels: &[Moments; 3]) -> Rgb {
    Rgb::from_array(channels.each_ref().map(|channel| channel.mean() as f32))
}
