//! What every command takes that makes pictures from a camera, ray by ray.

use super::values;
use crate::methods::ImageSettings;
use crate::solution::PathFilter;
use clap::Args;

/// How such pictures are made. Defaults are those of the window.
#[derive(Args, Debug)]
#[command(next_help_heading = "Pictures by rays")]
pub struct ImageOptions {
    /// Diffuse rays of a sample of `final-gather` [default: 64]
    #[arg(long, value_name = "N", value_parser = values::count::<{ ImageSettings::MAX_GATHER_RAYS }>)]
    pub gather_rays: Option<u32>,
    /// Paths of light that are shown, as in LDE, LS+DE or L(S|D)*E [default: all]
    #[arg(long, value_name = "PATTERN")]
    pub paths: Option<PathFilter>,
}

impl ImageOptions {
    /// With so many shadow rays, if that is said.
    pub fn settings(&self, light_rays: Option<u32>) -> ImageSettings {
        let default = ImageSettings::default();
        ImageSettings {
            gather_rays: self.gather_rays.unwrap_or(default.gather_rays),
            light_rays: light_rays.unwrap_or(default.light_rays),
            filter: self.paths.unwrap_or_default(),
            ..default
        }
    }
}
