//! What commands take that compute ambient occlusion.

use super::values;
use crate::choice::parse;
use crate::methods::{Falloff, OcclusionSettings, Range};
use clap::Args;

/// How ambient occlusion is computed. Defaults are those of the window.
#[derive(Args, Debug)]
#[command(next_help_heading = "Ambient occlusion")]
pub struct OcclusionOptions {
    /// Rays that look for what stands near: of a sample, or of a point that is probed [default: 16, or 1024 at a point]
    #[arg(long, value_name = "N", value_parser = values::count::<{ OcclusionSettings::MAX_RAYS }>)]
    ao_rays: Option<u32>,
    /// How far away something takes light away, in the scene's units, or `unlimited` [default: half the scene's radius]
    #[arg(long, value_name = "D|unlimited", value_parser = range)]
    ao_distance: Option<Range>,
    /// How occlusion fades with distance: none, linear, quadratic or exponential [default: linear]
    #[arg(long, value_name = "FALLOFF", value_parser = parse::<Falloff>)]
    ao_falloff: Option<Falloff>,
}

impl OcclusionOptions {
    pub fn settings(&self, default_rays: u32) -> OcclusionSettings {
        let default = OcclusionSettings::default();
        OcclusionSettings {
            rays: self.ao_rays.unwrap_or(default_rays),
            range: self.ao_distance.unwrap_or(default.range),
            falloff: self.ao_falloff.unwrap_or(default.falloff),
        }
    }

    /// The name of an option that was given, if any was.
    pub fn given(&self) -> Option<&'static str> {
        let given = [
            (self.ao_rays.is_some(), "--ao-rays"),
            (self.ao_distance.is_some(), "--ao-distance"),
            (self.ao_falloff.is_some(), "--ao-falloff"),
        ];
        given.into_iter().find(|(is_given, _)| *is_given).map(|(_, name)| name)
    }
}

/// `0.5` or `unlimited`
fn range(text: &str) -> Result<Range, String> {
    if text == "unlimited" {
        return Ok(Range::Unlimited);
    }
    values::positive(text)
        .map(|metres| Range::Metres(metres as f32))
        .map_err(|reason| format!("{reason}, or `unlimited`"))
}
