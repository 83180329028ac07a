//! How much a hit takes away of the ambient light, by its distance.

use crate::choice::Choice;
use std::fmt;

/// How ambient occlusion is computed.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct OcclusionSettings {
    /// Rays from the place that a sample of a pixel sees.
    pub rays: u32,
    pub range: Range,
    pub falloff: Falloff,
}

impl OcclusionSettings {
    pub const MAX_RAYS: u32 = 65_536;
}

impl Default for OcclusionSettings {
    fn default() -> Self {
        Self { rays: 16, range: Range::default(), falloff: Falloff::default() }
    }
}

/// How far away something can be and still take light away.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Range {
    /// Half the radius of the scene.
    #[default]
    Automatic,
    /// m
    Metres(f32),
    /// In a closed room, nothing but darkness is left then.
    Unlimited,
}

impl Range {
    /// What is automatic, as a share of the scene's radius.
    pub const AUTOMATIC_SHARE: f32 = 0.5;

    /// In a scene of this radius, m.
    pub fn metres(self, radius: f32) -> f32 {
        match self {
            Self::Automatic => Self::AUTOMATIC_SHARE * radius,
            Self::Metres(metres) => metres,
            Self::Unlimited => f32::INFINITY,
        }
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Automatic => write!(f, "{} of the scene's radius", Self::AUTOMATIC_SHARE),
            Self::Metres(metres) => write!(f, "{metres} m"),
            Self::Unlimited => f.write_str("unlimited"),
        }
    }
}

/// How occlusion fades with the distance t of what stands in the way, for a range D.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Falloff {
    /// 1 up to D, 0 beyond.
    None,
    /// 1 − t/D up to D, 0 beyond.
    #[default]
    Linear,
    /// 1 / (1 + (t/D)²).
    Quadratic,
    /// exp(−t/D).
    Exponential,
}

impl Falloff {
    /// The share of its light that a ray loses which meets something at distance `t`, m, in [0, 1].
    pub fn occlusion(self, t: f32, range: f32) -> f32 {
        // At no range, nothing is near enough; at an unlimited one, everything is.
        let x = if range > 0.0 { t / range } else { f32::INFINITY };
        match self {
            Self::None if x < 1.0 => 1.0,
            Self::None => 0.0,
            Self::Linear => (1.0 - x).max(0.0),
            Self::Quadratic => 1.0 / (1.0 + x * x),
            Self::Exponential => (-x).exp(),
        }
    }

    /// Whether any hit within reach takes all light away, so that it does not matter where it is.
    pub fn is_all_or_nothing(self, range: f32) -> bool {
        self == Self::None || range.is_infinite()
    }

    /// Beyond this distance nothing is lost, m.
    pub fn reach(self, range: f32) -> f32 {
        match self {
            Self::None | Self::Linear => range,
            Self::Quadratic | Self::Exponential => f32::INFINITY,
        }
    }
}

impl Choice for Falloff {
    const ALL: &'static [Self] = &[Self::None, Self::Linear, Self::Quadratic, Self::Exponential];
    const KIND: &'static str = "fall-off";

    fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Linear => "linear",
            Self::Quadratic => "quadratic",
            Self::Exponential => "exponential",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::None => "None",
            Self::Linear => "Linear",
            Self::Quadratic => "Quadratic",
            Self::Exponential => "Exponential",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::None => "Whatever is nearer than the distance takes all light of its direction, and nothing beyond",
            Self::Linear => "Takes less the farther away it is, down to nothing at the distance",
            Self::Quadratic => "Takes half at the distance, and falls with the square of it far away",
            Self::Exponential => "Takes a third (1/e) at the distance, and soon nothing beyond",
        }
    }
}
