//! What every command that traces photons takes.

use super::values;
use crate::choice::{Choice, parse};
use crate::methods::{Kernel, PhotonSettings};
use clap::Args;

/// How many photons there are, and how light is read off them. Defaults are those of the window.
#[derive(Args, Debug)]
#[command(next_help_heading = "Photons")]
pub struct PhotonOptions {
    /// Photons of the global map that a pass emits [default: 200000]
    #[arg(long, value_name = "N", value_parser = values::count::<{ PhotonSettings::MAX_COUNT }>)]
    photons: Option<u32>,
    /// Photons that a pass emits for the caustic map, where the scene has specular surfaces [default: 200000]
    #[arg(long, value_name = "N", value_parser = values::count::<{ PhotonSettings::MAX_COUNT }>)]
    caustic_photons: Option<u32>,
    /// The most photons that an estimate uses; with more passes than one, those that the first radius is chosen for
    /// [default: 100]
    #[arg(long, value_name = "K", value_parser = values::count::<{ PhotonSettings::MAX_NEAREST }>)]
    nearest: Option<u32>,
    /// The farthest at which an estimate looks for photons, in the scene's units [default: by the scene]
    #[arg(long, value_name = "R", value_parser = values::positive)]
    max_radius: Option<f64>,
    /// How much a photon counts by its distance: constant, cone or epanechnikov [default: constant]
    #[arg(long, value_name = "KERNEL", value_parser = parse::<Kernel>)]
    kernel: Option<Kernel>,
    /// Passes of photons; more than one are progressive, each with photons of its own and a smaller radius [default: 1]
    #[arg(long, value_name = "N", value_parser = values::count::<{ PhotonSettings::MAX_PASSES }>)]
    passes: Option<u32>,
}

impl PhotonOptions {
    pub fn settings(&self) -> PhotonSettings {
        let default = PhotonSettings::default();
        let passes = self.passes.unwrap_or(1);
        PhotonSettings {
            count: self.photons.unwrap_or(default.count),
            caustic_count: self.caustic_photons.unwrap_or(default.caustic_count),
            nearest: self.nearest.unwrap_or(default.nearest),
            max_radius: self.max_radius.map(|radius| radius as f32),
            kernel: self.kernel.unwrap_or(default.kernel),
            is_progressive: passes > 1,
            passes,
        }
    }

    /// The name of an option that was given, if any was.
    pub fn given(&self) -> Option<&'static str> {
        let given = [
            (self.photons.is_some(), "--photons"),
            (self.caustic_photons.is_some(), "--caustic-photons"),
            (self.nearest.is_some(), "--nearest"),
            (self.max_radius.is_some(), "--max-radius"),
            (self.kernel.is_some(), "--kernel"),
            (self.passes.is_some(), "--passes"),
        ];
        given.into_iter().find(|(is_given, _)| *is_given).map(|(_, name)| name)
    }
}

/// How light is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightMethod {
    #[default]
    Radiosity,
    PhotonMap,
}

impl Choice for LightMethod {
    const ALL: &'static [Self] = &[Self::Radiosity, Self::PhotonMap];
    const KIND: &'static str = "method";

    fn name(self) -> &'static str {
        match self {
            Self::Radiosity => "radiosity",
            Self::PhotonMap => "photon-map",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Radiosity => "Radiosity",
            Self::PhotonMap => "Photon map",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Radiosity => "Light between diffuse patches, as a system of linear equations",
            Self::PhotonMap => "Light as photons that fly from the emitters and are kept where they land",
        }
    }
}
