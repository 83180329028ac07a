//! Pictures as files, with what is needed to make them again.

use super::CliError;
use crate::choice::Choice;
use crate::methods::Settings;
use crate::viewport::diagram::Diagram;
use crate::viewport::{Frame, Light, Picture, View};
use crate::world::World;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// The formats that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// 8 bits as on the screen, with text chunks.
    Png,
    /// Linear radiance, W/(m²·sr), or linear colours, in 32-bit floats.
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

/// What a picture of a view says of itself: names and values.
pub fn facts(world: &World, light: &Light, settings: &Settings, frame: &Frame) -> Vec<(String, String)> {
    let viewpoint = frame.camera.viewpoint();
    let mut facts = run_facts(world, light, settings, frame.view.name());
    let mut add = |name: &str, value: String| facts.push((name.to_owned(), value));
    add("Eye", viewpoint.eye.to_string());
    add("Target", viewpoint.target.to_string());
    add("Up", viewpoint.up.to_string());
    add("Vertical field of view", format!("{} deg", viewpoint.vertical_fov));
    match (frame.view, &light.picked) {
        (View::FormFactors, Some(picked)) => add("Picked patch", picked.patch.to_string()),
        (view, _) if view.is_false_colour() => {}
        _ => add("Exposure", format!("{} EV, {}", frame.exposure_ev, frame.tone.name())),
    }
    if frame.view == View::Bounces {
        add("Bounces", frame.bounce.to_string());
    }
    if let Some(solution) = light.solution.as_ref().filter(|_| frame.ambient)
        && matches!(frame.view, View::Patches | View::Smooth)
    {
        add("Ambient", solution.ambient.to_string());
    }
    facts
}

/// What a diagram says of itself: names and values.
pub fn diagram_facts(world: &World, light: &Light, settings: &Settings, diagram: Diagram) -> Vec<(String, String)> {
    let mut facts = run_facts(world, light, settings, diagram.name());
    if let (Diagram::ItemBuffer, Some(picked)) = (diagram, &light.picked) {
        facts.push(("Picked patch".to_owned(), picked.patch.to_string()));
        facts.push(("Hemicube".to_owned(), settings.hemicube_resolution.to_string()));
    }
    facts
}

fn run_facts(world: &World, light: &Light, settings: &Settings, view: &str) -> Vec<(String, String)> {
    let facts = [
        ("Software", concat!("Lightwell ", env!("CARGO_PKG_VERSION")).to_owned()),
        ("Scene", world.scene.name.clone()),
        ("View", view.to_owned()),
        ("Method", "radiosity".to_owned()),
        ("Solver", settings.solver.name().to_owned()),
        ("Form factors", settings.form_factor.name().to_owned()),
        ("Element size", format!("{} m", world.element_size)),
        ("Shadow rays", settings.shadow_rays.to_string()),
        ("Stop limit", settings.unshot_limit.to_string()),
        ("Seed", settings.seed.to_string()),
    ];
    let spent = light.solution.iter().flat_map(|solution| {
        let seconds = format!("{:.3}", solution.elapsed.as_secs_f64());
        [("Steps", solution.steps.to_string()), ("Seconds", seconds)]
    });
    facts.into_iter().chain(spent).map(|(name, value)| (name.to_owned(), value)).collect()
}

/// Writes a picture in the format of its ending. The file appears when it is whole: a failure leaves what was there.
///
/// # Errors
/// If the ending is unknown or the file cannot be written.
pub fn save(path: &Path, picture: &Picture, facts: &[(String, String)]) -> Result<(), CliError> {
    let format = Format::of(path).ok_or_else(|| CliError::PictureFormat { path: path.to_owned() })?;
    let bytes = match format {
        Format::Png => png(picture, facts).map_err(Into::into),
        Format::Exr => exr(picture).map_err(Into::into),
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

fn exr(picture: &Picture) -> Result<Vec<u8>, image::ImageError> {
    let [width, height] = picture.size;
    let pixels = picture.linear.as_flattened().to_vec();
    let image = image::Rgba32FImage::from_raw(width, height, pixels).expect("a picture has all its pixels");
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::OpenExr)?;
    Ok(bytes.into_inner())
}
