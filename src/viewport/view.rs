//! What a picture shows, and from where.

use super::ToneCurve;
use crate::camera::Camera;
use std::fmt;
use std::str::FromStr;

/// Which quantity is drawn, and how it varies over an element.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum View {
    /// Radiance B/π, one value an element.
    Patches,
    /// Radiance B/π, averaged to vertices and interpolated between them (Gouraud 1971).
    #[default]
    Smooth,
    /// ΔB/π: the radiance that is still to be shot.
    Unshot,
}

impl View {
    pub const ALL: [Self; 3] = [Self::Patches, Self::Smooth, Self::Unshot];

    /// For people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Patches => "Patches",
            Self::Smooth => "Smooth",
            Self::Unshot => "Unshot light",
        }
    }

    /// For command lines and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Patches => "patches",
            Self::Smooth => "smooth",
            Self::Unshot => "unshot",
        }
    }
}

impl fmt::Display for View {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for View {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|view| view.name() == text);
        found.ok_or_else(|| format!("no view is called `{text}` (there are {})", Self::ALL.map(Self::name).join(", ")))
    }
}

/// Everything that a picture of a world and its light depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    pub camera: Camera,
    /// Width and height, pixels.
    pub size: [u32; 2],
    pub view: View,
    /// Whether the outlines of elements are drawn.
    pub wireframe: bool,
    /// Whether the patch that shot last is outlined.
    pub show_shooter: bool,
    /// In stops; see [`super::Exposure`].
    pub exposure_ev: f32,
    pub tone: ToneCurve,
}
