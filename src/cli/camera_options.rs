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
use glam::DVec3;

/// From where the scene is seen, and how its radiance becomes colours.
#[derive(Args, Debug)]
#[command(next_help_heading = "Camera")]
pub struct CameraOptions {
    /// Width and height in pixels; a diagram fits in
    #[arg(long, value_name = "WxH", default_value = "640x480", value_parser = values::size)]
    pub size: [u32; 2],
    /// Where the camera stands, in the coordinates of the file [default: chosen for the scene]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    eye: Option<DVec3>,
    /// What the camera looks at, in the coordinates of the file
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    target: Option<DVec3>,
    /// Which way is up
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = values::vector)]
    up: Option<DVec3>,
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
        let chosen = world.viewpoint;
        let place = |point: DVec3| world.scene.scene_from_file(point);
        let viewpoint = Viewpoint {
            eye: self.eye.map_or(chosen.eye, place),
            target: self.target.map_or(chosen.target, place),
            up: self.up.map_or(chosen.up, |up| up.as_vec3()),
            vertical_fov: self.fov.unwrap_or(chosen.vertical_fov),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cancel::Cancel;
    use crate::mesh::MeshSettings;
    use crate::scene::Scene;
    use clap::Parser;
    use glam::Vec3;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        camera: CameraOptions,
    }

    #[test]
    fn places_are_those_of_the_file() {
        let scene = Scene::open("furnace").expect("a built-in scene");
        let scene = Scene { origin: DVec3::new(3000.0, 0.0, -4096.0), ..scene };
        let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
        let line =
            Line::parse_from(["", "--eye", "3000.5,0.25,-4095.25", "--target", "3000,0.25,-4095.25", "--up", "0,2,0"]);
        let viewpoint = line.camera.camera(&world).viewpoint();
        let near = |a: Vec3, b: [f32; 3]| a.distance(Vec3::from_array(b)) < 1e-6;
        assert!(near(viewpoint.eye, [0.5, 0.25, 0.75]) && near(viewpoint.target, [0.0, 0.25, 0.75]), "{viewpoint:?}");
    }
}
