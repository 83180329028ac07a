//! Where something is measured: points and normals, as text.

use super::super::{CliError, text};
use crate::accuracy::ProbePoint;
use crate::scene::Scene;
use crate::world::World;
use glam::{DVec3, Vec3A};
use std::io::Read;
use std::path::Path;

/// The points of a file, or of standard input, in the coordinates of the scene's file.
pub fn read(path: &Path, scene: &Scene) -> Result<Vec<ProbePoint>, CliError> {
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
            point(line, scene).map_err(|reason| CliError::Point { path: path.to_owned(), line: index + 1, reason })
        })
        .collect()
}

/// Says on standard error where no surface is at a point.
pub fn tell_missing(world: &World, points: &[ProbePoint]) {
    let missing = points.iter().filter(|at| world.meet_at(at.point, at.normal).is_none());
    let missing: Vec<&ProbePoint> = missing.collect();
    let Some(first) = missing.first() else { return };
    eprintln!(
        "warning: no surface is at {} of {} points, seen from where their normals point: {}, the first of them, is {:.2e} m from \
         the nearest surface; there, the irradiance in the air is printed, as of a light meter",
        missing.len(),
        points.len(),
        text(&world.scene.file_from_scene(first.point.into())),
        world.distance_to_surface(first.point),
    );
}

fn point(line: &str, scene: &Scene) -> Result<ProbePoint, String> {
    let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse::<f64>).collect();
    let Ok(&[x, y, z, nx, ny, nz]) = numbers.as_deref() else {
        return Err("six numbers are wanted: x y z nx ny nz".to_owned());
    };
    let point = Vec3A::from(scene.scene_from_file(DVec3::new(x, y, z)));
    let normal = DVec3::new(nx, ny, nz).try_normalize().map(|normal| normal.as_vec3a());
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
        let scene = Scene::open("furnace").expect("a built-in scene");
        let point = |line: &str| point(line, &scene);
        assert_eq!(point(" 1 2 3  0 0 -2 "), Ok(read));
        assert!(point("1 2 3 0 0").is_err() && point("1 2 3 0 0 0").is_err() && point("1 2 x 0 0 1").is_err());
        assert!(point("1 2 1e39 0 0 1").is_err() && point("1 2 3 0 nan 1").is_err());
    }
}
