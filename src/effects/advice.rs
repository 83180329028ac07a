//! Which way to compute the light suits a scene.

use super::effect::{Effect, Effects};
use crate::world::Census;

/// A way to compute light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Approach {
    Radiosity,
    /// Or a photon map, which is computed from the same surfaces.
    RadiosityAndRays,
    CausticMap,
    AmbientOcclusion,
}

impl Approach {
    /// For people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Radiosity => "radiosity",
            Self::RadiosityAndRays => "radiosity with specular light by rays, or a photon map",
            Self::CausticMap => "a caustic map with final gathering",
            Self::AmbientOcclusion => "ambient occlusion",
        }
    }
}

/// The way that suits a scene best, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Advice {
    pub approach: Approach,
    /// One sentence.
    pub reason: String,
}

impl Advice {
    pub(super) fn new(needed: Effects, census: &Census) -> Self {
        let specular = [Effect::SpecularReflection, Effect::Gloss, Effect::Transmission];
        let (approach, reason) = if needed.contains(Effect::AmbientLight) {
            let reason = "No emitter lights anything, and how open each place is needs none.".to_owned();
            (Approach::AmbientOcclusion, reason)
        } else if needed.contains(Effect::Caustics) && census.diffuse > 0 {
            let reason = format!(
                "Specular surfaces may gather light on {} diffuse polygons, and photons find such light from the emitters' \
                 side.",
                census.diffuse
            );
            (Approach::CausticMap, reason)
        } else if specular.iter().any(|&effect| needed.contains(effect)) {
            let reason = "What specular surfaces show depends on where one stands, and elements cannot hold that.";
            (Approach::RadiosityAndRays, reason.to_owned())
        } else {
            let reason = format!(
                "All {} polygons that light reaches are diffuse, so that one solution holds for every viewpoint.",
                census.reached
            );
            (Approach::Radiosity, reason)
        };
        Self { approach, reason }
    }
}
