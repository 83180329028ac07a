//! `lightwell probe`: the irradiance at points.

use super::CliError;
use super::run_options::RunOptions;
use crate::math::rgb::Rgb;
use crate::methods::radiosity::irradiance_in_space;
use crate::solution::SurfaceProbe;
use glam::Vec3;
use serde_json::json;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    run: RunOptions,
    /// Lines of `x y z nx ny nz`; `-` for standard input
    #[arg(long, value_name = "FILE|-")]
    points: PathBuf,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

/// A point and a unit normal.
type Sensor = (Vec3, Vec3);

/// On a surface the solution is read off; in the air it is gathered from all patches, as a light meter would.
pub fn run(options: &Options) -> Result<(), CliError> {
    let sensors = read(&options.points)?;
    let solved = options.run.solve()?;
    let probe = SurfaceProbe::new(&solved.world, &solved.solution);
    let measured = sensors.iter().map(|&(point, normal)| {
        let on_surface = probe.irradiance(point.into(), normal.into());
        let irradiance = on_surface.unwrap_or_else(|| {
            irradiance_in_space(&solved.world, &solved.solution, point.into(), normal.into(), solved.settings.seed)
        });
        (point, normal, irradiance)
    });
    print(measured, options.json)
}

fn print(measured: impl Iterator<Item = (Vec3, Vec3, Rgb)>, as_json: bool) -> Result<(), CliError> {
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    if as_json {
        let points: Vec<_> = measured
            .map(|(point, normal, irradiance)| {
                json!({
                    "point": point.to_array(), "normal": normal.to_array(), "irradiance": irradiance.to_array(),
                })
            })
            .collect();
        writeln!(out, "{}", json!({ "points": points }))?;
    } else {
        writeln!(out, "x,y,z,nx,ny,nz,r,g,b")?;
        for (point, normal, irradiance) in measured {
            let numbers = [point, normal, irradiance].map(|v| format!("{},{},{}", v.x, v.y, v.z));
            writeln!(out, "{}", numbers.join(","))?;
        }
    }
    out.flush()?;
    Ok(())
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
