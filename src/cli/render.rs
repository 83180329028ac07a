//! `lightwell render`: a picture without a window.

use super::run_options::{RunOptions, Solved};
use super::solve::report;
use super::{CliError, picture, values};
use crate::camera::Camera;
use crate::choice::{self, Choice};
use crate::scene::Viewpoint;
use crate::viewport::{AdapterChoice, Exposure, Frame, Gpu, Light, ToneCurve, View, render_picture};
use crate::world::World;
use glam::Vec3;
use serde_json::json;
use std::io::Write;
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    run: RunOptions,
    /// The picture's file, .png or .exr
    #[arg(short, long, value_name = "FILE", value_parser = values::picture_path)]
    output: PathBuf,
    /// What to show: patches, smooth or unshot
    #[arg(long, default_value = View::default().name(), value_parser = choice::parse::<View>)]
    view: View,
    /// Outline the elements
    #[arg(long)]
    wireframe: bool,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "640x480", value_parser = values::size)]
    size: [u32; 2],
    /// Samples a pixel, in steps of four
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=4096))]
    samples: u32,
    /// Where the camera stands [default: chosen for the scene]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    eye: Option<Vec3>,
    /// What the camera looks at
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    target: Option<Vec3>,
    /// Which way is up
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    up: Option<Vec3>,
    /// Vertical angle of view
    #[arg(long, value_name = "DEG", value_parser = values::field_of_view)]
    fov: Option<f32>,
    /// Exposure in stops: radiance times 2^EV [default: automatic]
    #[arg(long, value_name = "EV", allow_hyphen_values = true, value_parser = values::stops)]
    exposure: Option<f32>,
    /// From radiance to the screen: filmic or linear
    #[arg(long, default_value = ToneCurve::default().name(), value_parser = choice::parse::<ToneCurve>)]
    tone: ToneCurve,
    /// The graphics adapter: `system` for the best one, `software`, or a part of its name
    #[arg(long, value_name = "software|NAME", default_value = "system")]
    adapter: AdapterChoice,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

pub fn run(options: &Options) -> Result<(), CliError> {
    // Whether there is something to draw with is told before the time is spent.
    let gpu = Gpu::new(&options.adapter)?;
    let solved = options.run.solve()?;
    let Solved { world, settings, solution } = &solved;
    let exposure = options.exposure.map_or(Exposure::Automatic, Exposure::Manual);
    let frame = Frame {
        camera: Camera::new(&options.viewpoint(world), &world.bounds),
        size: options.size,
        view: options.view,
        bounce: 0,
        ambient: false,
        wireframe: options.wireframe,
        show_shooter: false,
        exposure_ev: exposure.ev(world, solution),
        tone: options.tone,
    };
    let picture = render_picture(&gpu, world, &Light::from(solution.clone()), &frame, options.samples)?;
    picture::save(&options.output, &picture, &picture::facts(world, solution, settings, &frame))?;
    if options.json {
        let mut report = report(&solved);
        report["picture"] = json!({
            "file": options.output,
            "size": options.size,
            "view": options.view.name(),
            "exposure": frame.exposure_ev,
        });
        writeln!(std::io::stdout(), "{report}")?;
    }
    Ok(())
}

impl Options {
    /// The scene's viewpoint, as far as no option says otherwise.
    fn viewpoint(&self, world: &World) -> Viewpoint {
        let scene = world.viewpoint;
        Viewpoint {
            eye: self.eye.unwrap_or(scene.eye),
            target: self.target.unwrap_or(scene.target),
            up: self.up.unwrap_or(scene.up),
            vertical_fov: self.fov.unwrap_or(scene.vertical_fov),
        }
    }
}
