//! Where something is measured: points and normals, as text.

use super::super::CliError;
use crate::accuracy;
use crate::world::World;
use glam::Vec3;
use std::io::Read;
use std::path::Path;

/// A point and a unit normal.
pub type Sensor = (Vec3, Vec3);

/// Points spread by area.
pub fn spread(world: &World, count: u32, seed: u64) -> Vec<Sensor> {
    accuracy::spread(world, count as usize, seed).iter().map(|at| (at.point.into(), at.normal.into())).collect()
}

/// The points of a file, or of standard input.
pub fn read(path: &Path) -> Result<Vec<Sensor>, CliError> {
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
