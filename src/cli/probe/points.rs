//! Where something is measured: points and normals, as text.

use super::super::CliError;
use crate::accuracy::ProbePoint;
use glam::Vec3A;
use std::io::Read;
use std::path::Path;

/// The points of a file, or of standard input.
pub fn read(path: &Path) -> Result<Vec<ProbePoint>, CliError> {
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
            point(line).map_err(|reason| CliError::Point { path: path.to_owned(), line: index + 1, reason })
        })
        .collect()
}

fn point(line: &str) -> Result<ProbePoint, String> {
    let numbers: Result<Vec<f32>, _> = line.split_whitespace().map(str::parse::<f32>).collect();
    let Ok(&[x, y, z, nx, ny, nz]) = numbers.as_deref() else {
        return Err("six numbers are wanted: x y z nx ny nz".to_owned());
    };
    let (point, normal) = (Vec3A::new(x, y, z), Vec3A::new(nx, ny, nz).try_normalize());
    match normal {
        Some(normal) if point.is_finite() => Ok(ProbePoint { point, normal }),
        _ => Err("the point must be finite, and its normal must have a length".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_read_or_refused() {
        let read = ProbePoint { point: Vec3A::new(1.0, 2.0, 3.0), normal: Vec3A::NEG_Z };
        assert_eq!(point(" 1 2 3  0 0 -2 "), Ok(read));
        assert!(point("1 2 3 0 0").is_err() && point("1 2 3 0 0 0").is_err() && point("1 2 x 0 0 1").is_err());
    }
}
