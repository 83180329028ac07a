//! `lightwell probe`: the irradiance at points, or the share of ambient light that arrives there.

use super::occlusion_options::OcclusionOptions;
use super::photon_options::{LightMethod, PhotonOptions};
use super::run_options::RunOptions;
use super::solve::check_method;
use super::tracing::Tracing;
use super::{CliError, refuse};
use crate::choice::{Choice, parse};
use crate::math::rgb::Rgb;
use crate::math::stats::Moments;
use crate::methods::Settings;
use crate::methods::ambient_occlusion::shares;
use crate::methods::photon_map::{Estimate, ProgressivePoints, Scratch, Which};
use crate::methods::radiosity::irradiance_in_space;
use crate::methods::transport::{Surface, Transport};
use crate::solution::{CameraView, SurfaceProbe};
use crate::worker::Subject;
use glam::Vec3;
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    run: RunOptions,
    /// What is computed: light by radiosity or photon-map, or ambient-occlusion
    #[arg(long, value_name = "METHOD", default_value = Method::default().name(), value_parser = parse::<Method>)]
    method: Method,
    #[command(flatten)]
    photons: PhotonOptions,
    #[command(flatten)]
    occlusion: OcclusionOptions,
    /// Lines of `x y z nx ny nz`; `-` for standard input
    #[arg(long, value_name = "FILE|-")]
    points: PathBuf,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

/// What is computed at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    Light(LightMethod),
    AmbientOcclusion,
}

impl Default for Method {
    fn default() -> Self {
        Self::Light(LightMethod::default())
    }
}

impl Choice for Method {
    const ALL: &'static [Self] =
        &[Self::Light(LightMethod::Radiosity), Self::Light(LightMethod::PhotonMap), Self::AmbientOcclusion];
    const KIND: &'static str = LightMethod::KIND;

    fn name(self) -> &'static str {
        match self {
            Self::Light(method) => method.name(),
            Self::AmbientOcclusion => CameraView::AmbientOcclusion.name(),
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Light(method) => method.label(),
            Self::AmbientOcclusion => CameraView::AmbientOcclusion.label(),
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Light(method) => method.meaning(),
            Self::AmbientOcclusion => CameraView::AmbientOcclusion.meaning(),
        }
    }
}

/// Rays at a point where nothing is said: with them a share of a half has a standard error of 1/64.
const OCCLUSION_RAYS: u32 = 1024;

/// A point and a unit normal.
type Sensor = (Vec3, Vec3);

/// What was found at a point, and how good it is.
struct Measured {
    sensor: Sensor,
    /// The irradiance, W/m², or the share of ambient light that arrives.
    value: Rgb,
    quality: Quality,
}

enum Quality {
    /// Of radiosity, which does not tell.
    Unknown,
    /// Of an estimate from the photons within a radius, m.
    Estimate { relative_error: f32, radius: f32, photons: u32 },
    /// Of a mean over passes: its standard error, W/m², by channel.
    Mean { standard_error: [f64; 3], passes: u64 },
    /// Of a share: its standard error, the same in all channels.
    Share { standard_error: f64, rays: u64 },
}

pub fn run(options: &Options) -> Result<(), CliError> {
    options.check();
    let sensors = read(&options.points)?;
    let measured = match options.method {
        Method::Light(LightMethod::Radiosity) => by_radiosity(options, &sensors)?,
        Method::Light(LightMethod::PhotonMap) => by_photons(options, &sensors)?,
        Method::AmbientOcclusion => by_occlusion(options, &sensors)?,
    };
    print(&measured, options.json)
}

impl Options {
    /// Ends the program, as any other wrong command line does, where an option is about another method.
    fn check(&self) {
        let (run, name) = (&self.run, self.method.name());
        let stranger = match self.method {
            Method::Light(method) => {
                check_method(method, run, &self.photons);
                self.occlusion.given()
            }
            Method::AmbientOcclusion => {
                let rays = run.light_rays.map(|_| "--light-rays");
                let time = run.time().map(|_| "--time");
                self.photons.given().or(run.stop_of_radiosity()).or(rays).or(time)
            }
        };
        if let Some(option) = stranger {
            refuse(&format!("{option} is not for --method {name}"));
        }
        let subject = Subject::Camera(CameraView::AmbientOcclusion);
        if self.method == Method::AmbientOcclusion
            && let Some(objection) = run.effects.objection(subject, &run.settings(), &format!("--method {name}"))
        {
            refuse(&objection);
        }
    }
}

/// On a surface the solution is read off; in the air it is gathered from all patches, as a light meter would.
fn by_radiosity(options: &Options, sensors: &[Sensor]) -> Result<Vec<Measured>, CliError> {
    let solved = options.run.solve()?;
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
fn by_photons(options: &Options, sensors: &[Sensor]) -> Result<Vec<Measured>, CliError> {
    let settings = Settings { photons: options.photons.settings(), ..options.run.settings() };
    let mut tracing = Tracing::new(options.run.open()?, settings, options.run.time());
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

/// The share of ambient light is that of a surface, so points must be on one. No emitter is needed.
fn by_occlusion(options: &Options, sensors: &[Sensor]) -> Result<Vec<Measured>, CliError> {
    let settings = Settings { occlusion: options.occlusion.settings(OCCLUSION_RAYS), ..options.run.settings() };
    let transport = Arc::new(Transport::new(options.run.open()?, settings.effects));
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
    let [r, g, b] = channels.each_ref().map(|channel| channel.mean() as f32);
    let standard_error = channels.each_ref().map(Moments::standard_error);
    Measured {
        sensor,
        value: Rgb::new(r, g, b),
        quality: Quality::Mean { standard_error, passes: channels[0].count() },
    }
}

fn print(measured: &[Measured], as_json: bool) -> Result<(), CliError> {
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    if as_json {
        let points: Vec<Value> = measured.iter().map(Measured::json).collect();
        writeln!(out, "{}", json!({ "points": points }))?;
    } else {
        let columns = measured.first().map_or("", |first| first.quality.columns());
        writeln!(out, "x,y,z,nx,ny,nz,r,g,b{columns}")?;
        for Measured { sensor: (point, normal), value, quality } in measured {
            let numbers = [*point, *normal, *value].map(|v| format!("{},{},{}", v.x, v.y, v.z));
            writeln!(out, "{}{}", numbers.join(","), quality.values())?;
        }
    }
    out.flush()?;
    Ok(())
}

impl Measured {
    fn json(&self) -> Value {
        let (point, normal) = self.sensor;
        let mut object = json!({ "point": point.to_array(), "normal": normal.to_array() });
        let what = if let Quality::Share { .. } = self.quality { "share" } else { "irradiance" };
        object[what] = json!(self.value.to_array());
        match self.quality {
            Quality::Unknown => {}
            Quality::Estimate { relative_error, radius, photons } => {
                object["relative_error"] = json!(relative_error);
                object["radius"] = json!(radius);
                object["photons"] = json!(photons);
            }
            Quality::Mean { standard_error, passes } => {
                object["standard_error"] = json!(standard_error);
                object["passes"] = json!(passes);
            }
            Quality::Share { standard_error, rays } => {
                object["standard_error"] = json!(standard_error);
                object["rays"] = json!(rays);
            }
        }
        object
    }
}

impl Quality {
    /// Names of further columns of the table.
    fn columns(&self) -> &'static str {
        match self {
            Self::Unknown => "",
            Self::Estimate { .. } => ",relative_error,radius,photons",
            Self::Mean { .. } => ",r_error,g_error,b_error,passes",
            Self::Share { .. } => ",standard_error,rays",
        }
    }

    fn values(&self) -> String {
        match self {
            Self::Unknown => String::new(),
            Self::Estimate { relative_error, radius, photons } => format!(",{relative_error},{radius},{photons}"),
            Self::Mean { standard_error: [r, g, b], passes } => format!(",{r},{g},{b},{passes}"),
            Self::Share { standard_error, rays } => format!(",{standard_error},{rays}"),
        }
    }
}

fn read(path: &Path) -> Result<Vec<Sensor>, CliError> {
    let mut text = String::new();
    let read = if path == Path::new("-") {
        std::io::stdin().read_to_string(&mut text).map(|_| ())
    } else {
        std::fs::read_to_string(path).map(|read| text = read)
    };
    read.map_err(|source| CliError::ReadPoints { path: path.to_owned(), source })?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && !line.trim().starts_with('#'));
    lines
        .map(|(index, line)| {
            sensor(line).map_err(|reason| CliError::Point { path: path.to_owned(), line: index + 1, reason })
        })
        .collect()
}

fn sensor(line: &str) -> Result<Sensor, String> {
    let numbers: Result<Vec<f32>, _> = line.split_whitespace().map(str::parse::<f32>).collect();
    let Ok(&[x, y, z, nx, ny, nz]) = numbers.as_deref() else {
        return Err("six numbers are wanted: x y z nx ny nz".to_owned());
    };
    let (point, normal) = (Vec3::new(x, y, z), Vec3::new(nx, ny, nz).try_normalize());
    match normal {
        Some(normal) if point.is_finite() => Ok((point, normal)),
        _ => Err("the point must be finite, and its normal must have a length".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sensors_are_read_or_refused() {
        assert_eq!(sensor(" 1 2 3  0 0 -2 "), Ok((Vec3::new(1.0, 2.0, 3.0), Vec3::NEG_Z)));
        assert!(sensor("1 2 3 0 0").is_err() && sensor("1 2 3 0 0 0").is_err() && sensor("1 2 x 0 0 1").is_err());
    }
}
