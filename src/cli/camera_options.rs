//! What every command that writes pictures takes.

use super::{CliError, values};
use crate::camera::Camera;
use crate::choice::{self, Choice};
use crate::scene::Viewpoint;
use crate::solution::Solution;
use crate::viewport::{AdapterChoice, Exposure, Gpu, ToneCurve, check_size};
use crate::worker::check_picture;
use crate::world::World;
use clap::Args;
use glam::Vec3;

/// From where the scene is seen, and how its radiance becomes colours.
#[derive(Args, Debug)]
#[command(next_help_heading = "Camera")]
pub struct CameraOptions {
    /// Width and height in pixels; a diagram fits in
    #[arg(long, value_name = "WxH", default_value = "640x480", value_parser = values::size)]
    pub size: [u32; 2],
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
    pub tone: ToneCurve,
    /// The graphics adapter: `system` for the best one, `software`, or a part of its name
    #[arg(long, value_name = "software|NAME", default_value = "system")]
    adapter: AdapterChoice,
}

impl CameraOptions {
    /// At the scene's viewpoint, as far as no option says otherwise.
    pub fn camera(&self, world: &World) -> Camera {
        let scene = world.viewpoint;
        let viewpoint = Viewpoint {
            eye: self.eye.unwrap_or(scene.eye),
            target: self.target.unwrap_or(scene.target),
            up: self.up.unwrap_or(scene.up),
            vertical_fov: self.fov.unwrap_or(scene.vertical_fov),
        };
        Camera::new(&viewpoint, &world.bounds)
    }

    /// What pictures are drawn with. Whether there is such a thing, and room for them, is told before the time is spent.
    pub fn gpu(&self) -> Result<Gpu, CliError> {
        check_picture(self.size)?;
        let gpu = Gpu::new(&self.adapter)?;
        check_size(&gpu, self.size)?;
        Ok(gpu)
    }

    /// In stops.
    pub fn exposure_ev(&self, world: &World, solution: Option<&Solution>) -> f32 {
        self.exposure.map_or(Exposure::Automatic, Exposure::Manual).ev(world, solution)
    }
}
