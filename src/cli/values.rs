//! Values of options, read so strictly that a mistake is told before any work begins.

use crate::methods::Settings;
use glam::DVec3;
use std::path::PathBuf;

/// `x,y,z`
pub fn vector(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if DVec3::new(x, y, z).as_vec3().is_finite() => Ok(DVec3::new(x, y, z)),
        _ => Err("three numbers are wanted, as in 0,1.5,-2".to_owned()),
    }
}

/// `640x480`
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let sides =
        text.split_once(['x', 'X']).and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    sides.filter(|sides| sides.iter().all(|&side| side > 0)).ok_or_else(|| "a size is wanted, as in 640x480".to_owned())
}

/// `320.5,240`
pub fn pixel(text: &str) -> Result<[f32; 2], String> {
    let numbers = text.split_once(',').and_then(|(x, y)| Some([x.trim().parse().ok()?, y.trim().parse().ok()?]));
    let finite = numbers.filter(|at: &[f32; 2]| at.iter().all(|number| number.is_finite()));
    finite.ok_or_else(|| "a place in the picture is wanted, as in 320,240".to_owned())
}

/// A number above 0.
pub fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| *number > 0.0 && number.is_finite());
    number.ok_or_else(|| "a number above 0 is wanted".to_owned())
}

/// A share in percent, above 0 and at most 100.
pub fn percent(text: &str) -> Result<f64, String> {
    positive(text)
        .ok()
        .filter(|&percent| percent <= 100.0)
        .ok_or_else(|| "a number above 0 and up to 100 is wanted".to_owned())
}

/// Cells along the edge of a hemicube: an even number.
pub fn hemicube_resolution(text: &str) -> Result<u32, String> {
    let range = Settings::MIN_HEMICUBE_RESOLUTION..=Settings::MAX_HEMICUBE_RESOLUTION;
    let cells = text.parse().ok().filter(|cells: &u32| range.contains(cells) && cells.is_multiple_of(2));
    cells.ok_or_else(|| format!("an even number from {} to {} is wanted", range.start(), range.end()))
}

/// A number from 1 to `MOST`.
pub fn count<const MOST: u32>(text: &str) -> Result<u32, String> {
    let count = text.parse().ok().filter(|count| (1..=MOST).contains(count));
    count.ok_or_else(|| format!("a whole number from 1 to {MOST} is wanted"))
}

/// An angle of view in degrees.
pub fn field_of_view(text: &str) -> Result<f32, String> {
    let degrees = text.parse().ok().filter(|degrees| (1.0..=170.0).contains(degrees));
    degrees.ok_or_else(|| "an angle from 1 to 170 degrees is wanted".to_owned())
}

/// A finite number of stops.
pub fn stops(text: &str) -> Result<f32, String> {
    let stops = text.parse().ok().filter(|stops: &f32| stops.abs() <= 64.0);
    stops.ok_or_else(|| "a number of stops is wanted, as in -1.5".to_owned())
}

/// A folder that is there, or can be made in one that is.
pub fn folder(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    match parent {
        _ if path.is_dir() => Ok(path),
        _ if path.exists() => Err(format!("{} is not a folder", path.display())),
        Some(parent) if !parent.is_dir() => Err(format!("there is no folder {}", parent.display())),
        _ => Ok(path),
    }
}

/// The file of a picture: its format is known by its ending.
pub fn picture_path(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if super::picture::Format::of(&path).is_none() {
        return Err("a file name that ends in .png or .exr is wanted".to_owned());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    match folder {
        Some(folder) if !folder.is_dir() => Err(format!("there is no folder {}", folder.display())),
        _ => Ok(path),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_or_refused() {
        assert_eq!(vector("1, -2,3.5"), Ok(DVec3::new(1.0, -2.0, 3.5)));
        assert!(
            vector("1,2").is_err()
                && vector("1,2,nan").is_err()
                && vector("1,2,1e39").is_err()
                && vector("a,b,c").is_err()
        );
        assert_eq!(size("640x480"), Ok([640, 480]));
        assert!(size("640").is_err() && size("0x3").is_err() && size("-1x3").is_err());
        assert_eq!(percent("100"), Ok(100.0));
        assert!(percent("0").is_err() && percent("101").is_err() && percent("inf").is_err());
        assert_eq!((count::<5>("5"), count::<5>("1")), (Ok(5), Ok(1)));
        assert!(count::<5>("0").is_err() && count::<5>("6").is_err() && count::<5>("1.5").is_err());
        assert!(picture_path("picture.jpg").is_err() && picture_path("no/such/folder/picture.png").is_err());
        assert_eq!(picture_path("picture.EXR"), Ok(PathBuf::from("picture.EXR")));
    }
}
