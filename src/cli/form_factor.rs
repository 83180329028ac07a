//! `lightwell formfactor`: the form factor between two polygons by every method, with its error and its time.

use super::CliError;
use super::values;
use crate::choice::{Choice, parse};
use crate::math::polygon::vector_area;
use crate::methods::radiosity::form_factor::hemicube::Hemicube;
use crate::methods::radiosity::form_factor::pair::{Effort, Pair};
use crate::methods::{FormFactorMethod, Settings};
use glam::DVec3;
use serde_json::json;
use std::hint::black_box;
use std::io::Write;
use std::time::{Duration, Instant};

/// A method is repeated for so long, so that even some nanoseconds can be told.
const TIMING: Duration = Duration::from_millis(20);
/// Corners may be off their plane, and a polygon must be wide, by this share of its longest diagonal.
const FLATNESS: f64 = 1e-5;
const LEAST_WIDTH: f64 = 1e-9;

const NOTES: &str = "\
The error is the form factor less the reference. Without occluders that is the contour integral of both polygons,
good to some 1e-13; with occluders it is the mean over the points of the first polygon of the closed form of what
each sees of the second, good to about 1e-6.

centroid  cosθ cosθ' A' / (π r²), from centre to centre. Slides may print 2π: with that, a closed room would lose
          half of its light at every bounce. Above 1 where the polygons are near.
disc      cosθ cosθ' A' / (π r² + A'). Both see all or nothing, along the line between the centres.
polygon   Lambert's closed form, integrated over the first polygon; with occluders at three or four points of it, each
          times the share of visibility rays that arrive.
rays      Share of cosine-distributed rays from the first polygon that land on the second.
hemicube  What the centre of the first polygon sees, through the cells of half a cube. Solvers fall back to the closed
          form where that is too near.";

#[derive(clap::Args, Debug)]
#[command(after_help = NOTES)]
pub struct Options {
    /// The polygon that sends: three or four corners x,y,z, counter-clockwise seen from its front
    #[arg(long, value_name = "CORNERS", value_parser = polygon, allow_hyphen_values = true)]
    from: Polygon,
    /// The polygon that receives
    #[arg(long, value_name = "CORNERS", value_parser = polygon, allow_hyphen_values = true)]
    to: Polygon,
    /// A polygon that may stand between them, seen from either side; may be given more than once
    #[arg(long, value_name = "CORNERS", value_parser = polygon, allow_hyphen_values = true)]
    occluder: Vec<Polygon>,
    /// all, centroid, disc, polygon, rays or hemicube
    #[arg(long, default_value = "all", value_parser = methods)]
    method: Methods,
    /// Cells along the edge of the hemicube's top face
    #[arg(long, value_name = "N", default_value_t = Settings::default().hemicube_resolution,
          value_parser = values::hemicube_resolution)]
    resolution: u32,
    /// Rays of the method that counts them
    #[arg(long, value_name = "N", default_value_t = 65_536,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(Settings::MAX_LIGHT_RAYS)))]
    rays: u32,
    /// Every random number comes from this
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

/// Corners of a planar convex polygon.
#[derive(Clone, Debug)]
struct Polygon(Vec<DVec3>);

#[derive(Clone, Copy, Debug)]
struct Methods(&'static [FormFactorMethod]);

/// What a method says of the pair.
struct Answer {
    method: FormFactorMethod,
    form_factor: f64,
    error: f64,
    microseconds: f64,
}

pub fn run(options: &Options) -> Result<(), CliError> {
    let occluders: Vec<_> = options.occluder.iter().map(|occluder| occluder.0.clone()).collect();
    let pair = Pair::new(&options.from.0, &options.to.0, &occluders);
    let reference = pair.reference();
    let answers: Vec<Answer> = options.method.0.iter().map(|&method| ask(&pair, method, reference, options)).collect();
    print(&answers, reference, options)?;
    Ok(())
}

/// The time is that of the form factor alone, without what is made once for many: the tracer and the hemicube's memory.
fn ask(pair: &Pair, method: FormFactorMethod, reference: f64, options: &Options) -> Answer {
    let effort = Effort { rays: options.rays, shadow_rays: Settings::default().shadow_rays, seed: options.seed };
    let mut hemicube = Hemicube::new(options.resolution);
    let form_factor = pair.form_factor(method, &effort, &mut hemicube);
    let (start, mut rounds) = (Instant::now(), 0);
    while rounds == 0 || start.elapsed() < TIMING {
        black_box(pair.form_factor(method, &effort, &mut hemicube));
        rounds += 1;
    }
    let microseconds = start.elapsed().as_secs_f64() * 1e6 / f64::from(rounds);
    Answer { method, form_factor, error: form_factor - reference, microseconds }
}

fn print(answers: &[Answer], reference: f64, options: &Options) -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    if options.json {
        let methods: Vec<_> = answers
            .iter()
            .map(|answer| {
                json!({
                    "method": answer.method.name(), "form_factor": answer.form_factor,
                    "error": answer.error, "microseconds": answer.microseconds,
                })
            })
            .collect();
        return writeln!(out, "{}", json!({ "methods": methods }));
    }
    writeln!(out, "{:<10} {:>14} {:>11} {:>12}", "method", "form factor", "error", "µs")?;
    for Answer { method, form_factor, error, microseconds } in answers {
        writeln!(out, "{:<10} {form_factor:>14.9} {error:>+11.1e} {microseconds:>12.2}", method.name())?;
    }
    let by = if options.occluder.is_empty() { "by contours" } else { "mean of what each point sees" };
    writeln!(out, "{:<10} {reference:>14.9} {by}", "reference")
}

fn methods(text: &str) -> Result<Methods, String> {
    if text == "all" {
        return Ok(Methods(FormFactorMethod::ALL));
    }
    let method = parse::<FormFactorMethod>(text)?;
    let found = FormFactorMethod::ALL.iter().position(|&known| known == method);
    Ok(Methods(found.map_or(&[], |index| &FormFactorMethod::ALL[index..=index])))
}

/// `x,y,z x,y,z x,y,z` or one corner more.
fn polygon(text: &str) -> Result<Polygon, String> {
    let corners = text.split_whitespace().map(corner).collect::<Result<Vec<DVec3>, String>>()?;
    if !(3..=4).contains(&corners.len()) {
        return Err("three or four corners are wanted, as in \"0,0,0 1,0,0 0,1,0\"".to_owned());
    }
    let size = corners.iter().flat_map(|a| corners.iter().map(|b| a.distance(*b))).fold(0.0, f64::max);
    let normal = vector_area(&corners).normalize_or_zero();
    let count = corners.len();
    let turns = (0..count).map(|i| {
        let (before, at, after) = (corners[i], corners[(i + 1) % count], corners[(i + 2) % count]);
        (at - before).cross(after - at).dot(normal)
    });
    if vector_area(&corners).length() <= LEAST_WIDTH * size * size {
        return Err("the corners lie on a line".to_owned());
    }
    if corners.iter().any(|corner| (*corner - corners[0]).dot(normal).abs() > FLATNESS * size) {
        return Err("the corners do not lie in one plane".to_owned());
    }
    if turns.into_iter().any(|turn| turn < 0.0) {
        return Err("the polygon is not convex".to_owned());
    }
    Ok(Polygon(corners))
}

/// Three numbers that single precision can hold.
fn corner(text: &str) -> Result<DVec3, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(str::parse::<f64>).collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if [x, y, z].iter().all(|number| (*number as f32).is_finite()) => Ok(DVec3::new(x, y, z)),
        _ => Err(format!("`{text}` is not a corner: three numbers are wanted, as in 0,1.5,-2")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_are_read_or_refused() {
        assert_eq!(polygon("0,0,0  1,0,0 1e0,1,-0").unwrap().0.len(), 3);
        assert_eq!(polygon("0,0,0 1,0,0 1,1,0 0,1,0").unwrap().0[2], DVec3::new(1.0, 1.0, 0.0));
        for (text, reason) in [
            ("", "three or four"),
            ("0,0,0 1,0,0", "three or four"),
            ("0,0,0 1,0,0 1,1,0 0,1,0 0,0.5,0", "three or four"),
            ("0,0,0 1,0,0 1,1", "three numbers"),
            ("0,0,0 1,0,0 1,1,nan", "three numbers"),
            ("0,0,0 1,0,0 1,1,1e40", "three numbers"),
            ("0,0,0 1,0,0 2,0,0", "on a line"),
            ("0,0,0 0,0,0 0,0,0", "on a line"),
            ("0,0,0 1,1,0 1,0,0 0,1,0", "on a line"),
            ("0,0,0 1,0,0 1,1,0 0,1,0.1", "one plane"),
            ("0,0,0 1,0,0 0.2,0.2,0 0,1,0", "convex"),
        ] {
            let message = polygon(text).unwrap_err();
            assert!(message.contains(reason), "{text}: {message}");
        }
    }
}
