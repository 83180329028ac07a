//! Pictures as files, with what is needed to make them again.

use super::CliError;
pub use super::facts::{diagram_facts, facts, subject};
pub use super::quality::{QualityReport, TargetMet, TargetsMet};
use crate::viewport::Picture;
use exr::image::write::WritableImage;
use exr::image::{Image, SpecificChannels};
use exr::math::Vec2;
use exr::meta::attribute::{AttributeValue, Text};
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// The formats that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// 8 bits as on the screen, with text chunks.
    Png,
    /// Linear radiance, W/(m²·sr), or linear colours, in 32-bit floats, with text attributes.
    Exr,
}

impl Format {
    /// The format that a file's ending asks for.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "png" => Some(Self::Png),
            "exr" => Some(Self::Exr),
            _ => None,
        }
    }
}

/// Writes a picture in the format of its ending. The file appears when it is whole: a failure leaves what was there.
///
/// # Errors
/// If the ending is unknown or the file cannot be written.
pub fn save(path: &Path, picture: &Picture, facts: &[(String, String)]) -> Result<(), CliError> {
    let format = Format::of(path).ok_or_else(|| CliError::PictureFormat { path: path.to_owned() })?;
    let bytes = match format {
        Format::Png => png(picture, facts).map_err(Into::into),
        Format::Exr => exr(picture, facts).map_err(Into::into),
    };
    let bytes = bytes.map_err(|source| CliError::Encode { path: path.to_owned(), source })?;
    let unfinished = unfinished_name(path);
    let written = write(&unfinished, &bytes).and_then(|()| std::fs::rename(&unfinished, path));
    written.map_err(|source| {
        // Only what this call made; that it may not be there is no further trouble.
        let _ = std::fs::remove_file(&unfinished);
        CliError::Write { path: path.to_owned(), source }
    })
}

/// A hidden neighbour of the file, so that renaming does not cross file systems.
fn unfinished_name(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{}", std::process::id()))
}

fn write(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    file.write_all(bytes)?;
    file.into_inner()?.sync_all()
}

fn png(picture: &Picture, facts: &[(String, String)]) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, picture.size[0], picture.size[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    for (key, value) in facts {
        // Plain chunks hold Latin-1 only.
        if value.is_ascii() {
            encoder.add_text_chunk(key.clone(), value.clone())?;
        } else {
            encoder.add_itxt_chunk(key.clone(), value.clone())?;
        }
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(picture.srgb.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

fn exr(picture: &Picture, facts: &[(String, String)]) -> Result<Vec<u8>, exr::error::Error> {
    let [width, height] = picture.size.map(|pixels| pixels as usize);
    let channels = SpecificChannels::rgba(|at: Vec2<usize>| {
        let [red, green, blue, alpha] = picture.linear[at.y() * width + at.x()];
        (red, green, blue, alpha)
    });
    let mut image = Image::from_channels((width, height), channels);
    for (key, value) in facts {
        image.attributes.other.insert(utf8(key), AttributeValue::Text(utf8(value)));
    }
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

/// In UTF-8, which is what OpenEXR itself reads; its readers refuse a file with anything else.
fn utf8(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}
