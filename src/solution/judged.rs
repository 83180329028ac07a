//! Whose pictures are held against the reference.

use super::CameraView;
use crate::choice::Choice;

/// A view whose light is held against the reference, pixel by pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Judged {
    /// Radiosity, one value an element; specular surfaces are traced.
    Patches,
    #[default]
    RadiositySpecular,
    RadiosityDirect,
    PhotonRadiance,
    RayTraced,
    FinalGather,
    DiffuseAmbient,
}

impl Judged {
    /// The view from a camera that shows this light. That of patches shows it blended between them.
    pub fn view(self) -> CameraView {
        match self {
            Self::Patches | Self::RadiositySpecular => CameraView::RadiositySpecular,
            Self::RadiosityDirect => CameraView::RadiosityDirect,
            Self::PhotonRadiance => CameraView::PhotonRadiance,
            Self::RayTraced => CameraView::RayTraced,
            Self::FinalGather => CameraView::FinalGather,
            Self::DiffuseAmbient => CameraView::DiffuseAmbient,
        }
    }
}

impl Choice for Judged {
    const ALL: &'static [Self] = &[
        Self::Patches,
        Self::RadiositySpecular,
        Self::RadiosityDirect,
        Self::PhotonRadiance,
        Self::RayTraced,
        Self::FinalGather,
        Self::DiffuseAmbient,
    ];
    const KIND: &'static str = "error";

    fn name(self) -> &'static str {
        match self {
            Self::Patches => "error-of-patches",
            Self::RadiositySpecular => "error-of-radiosity-specular",
            Self::RadiosityDirect => "error-of-radiosity-direct",
            Self::PhotonRadiance => "error-of-photon-radiance",
            Self::RayTraced => "error-of-ray-traced",
            Self::FinalGather => "error-of-final-gather",
            Self::DiffuseAmbient => "error-of-diffuse-ao",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Patches => "Patches",
            _ => self.view().label(),
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Patches => "Radiosity as it was computed, one value an element",
            _ => self.view().meaning(),
        }
    }
}
