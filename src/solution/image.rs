//! What the methods hand out that look from a camera: radiance, pixel by pixel.

use super::{Comparison, Judged};
use crate::camera::Camera;
use crate::choice::Choice;
use crate::effects::Bill;
use crate::math::rgb::Rgb;
use std::time::Duration;

/// What a picture from a camera is made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CameraView {
    /// Irradiance estimated from the photons near by, shown as the radiance of a white surface.
    PhotonIrradiance,
    /// The same times the diffuse reflectance: the radiance that the surface sends on.
    PhotonRadiance,
    /// The same from the photons alone that came over specular surfaces.
    Caustics,
    /// Direct light, mirrors, gloss and glass; no diffuse interreflection.
    #[default]
    RayTraced,
    /// The radiosity solution seen directly, with specular surfaces traced (Wallace, Cohen, Greenberg 1987).
    RadiositySpecular,
    /// The same, but for light straight from the emitters, which shadow rays find (Chen, Rushmeier, Miller, Turner 1991).
    RadiosityDirect,
    /// Direct and specular rays, a caustic map, and diffuse rays that end in the photon map (Jensen 1996).
    FinalGather,
    /// The share of an even light from everywhere that arrives, in [0, 1], and nothing else.
    AmbientOcclusion,
    /// The first surface's diffuse colour in the direct light; where nothing emits, in an even light of radiance 1.
    Diffuse,
    /// The same with the ambient light, as far as it is not occluded: in place of light between surfaces.
    DiffuseAmbient,
    /// The share of ambient light that arrives, against the light that truly comes from other surfaces.
    AmbientMinusIndirect,
    /// All light there is, by path tracing (Kajiya 1986): noisy, without a bias.
    Reference,
    /// How far another view is off, against the reference.
    Error(Judged),
}

impl CameraView {
    /// The view whose light it is read off: of errors, the one that is judged.
    fn source(self) -> Self {
        match self {
            Self::Error(judged) => judged.view(),
            view => view,
        }
    }

    /// Whether it compares two kinds of light.
    pub fn is_comparison(self) -> bool {
        matches!(self, Self::AmbientMinusIndirect | Self::Error(_))
    }

    /// Samples of each pixel where `wanted` are enough for light: of the difference to a reference more are needed to see it behind
    /// the reference's noise.
    pub fn samples(self, wanted: u32) -> u32 {
        /// Noise is a quarter of what it would be.
        const OF_ERROR: u32 = 16;
        match self {
            Self::Error(_) => wanted.saturating_mul(OF_ERROR),
            _ => wanted,
        }
    }

    /// Whether diffuse rays of each sample end in the photon map.
    pub fn gathers(self) -> bool {
        self.source() == Self::FinalGather
    }

    /// Whether the picture is read off a map of photons.
    pub fn needs_photons(self) -> bool {
        matches!(self.source(), Self::PhotonIrradiance | Self::PhotonRadiance | Self::Caustics | Self::FinalGather)
    }

    /// Whether ambient occlusion is a part of it.
    pub fn is_occluded(self) -> bool {
        matches!(self.source(), Self::AmbientOcclusion | Self::DiffuseAmbient | Self::AmbientMinusIndirect)
    }

    /// Whether its values are light; if not, shares in [0, 1], or what false colours stand for.
    pub fn is_light(self) -> bool {
        self != Self::AmbientOcclusion && !self.is_comparison()
    }

    /// Whether the paths of its light can be told apart.
    pub fn has_paths(self) -> bool {
        match self {
            Self::PhotonIrradiance
            | Self::PhotonRadiance
            | Self::Caustics
            | Self::RayTraced
            | Self::FinalGather
            | Self::Reference => true,
            Self::RadiositySpecular
            | Self::RadiosityDirect
            | Self::AmbientOcclusion
            | Self::Diffuse
            | Self::DiffuseAmbient
            | Self::AmbientMinusIndirect
            | Self::Error(_) => false,
        }
    }

    /// Whether the picture is read off a radiosity solution.
    pub fn needs_radiosity(self) -> bool {
        matches!(self.source(), Self::RadiositySpecular | Self::RadiosityDirect)
    }

    /// Whether shadow rays find the light of the emitters.
    pub fn samples_emitters(self) -> bool {
        matches!(
            self.source(),
            Self::RayTraced | Self::RadiosityDirect | Self::FinalGather | Self::Diffuse | Self::DiffuseAmbient
        )
    }
}

impl Choice for CameraView {
    const ALL: &'static [Self] = &[
        Self::PhotonIrradiance,
        Self::PhotonRadiance,
        Self::Caustics,
        Self::RayTraced,
        Self::RadiositySpecular,
        Self::RadiosityDirect,
        Self::FinalGather,
        Self::Reference,
        Self::AmbientOcclusion,
        Self::Diffuse,
        Self::DiffuseAmbient,
        Self::AmbientMinusIndirect,
        Self::Error(Judged::Patches),
        Self::Error(Judged::RadiositySpecular),
        Self::Error(Judged::RadiosityDirect),
        Self::Error(Judged::PhotonRadiance),
        Self::Error(Judged::RayTraced),
        Self::Error(Judged::FinalGather),
        Self::Error(Judged::DiffuseAmbient),
    ];
    const KIND: &'static str = "view from a camera";

    fn name(self) -> &'static str {
        match self {
            Self::PhotonIrradiance => "photon-irradiance",
            Self::PhotonRadiance => "photon-radiance",
            Self::Caustics => "caustics",
            Self::RayTraced => "ray-traced",
            Self::RadiositySpecular => "radiosity-specular",
            Self::RadiosityDirect => "radiosity-direct",
            Self::FinalGather => "final-gather",
            Self::AmbientOcclusion => "ambient-occlusion",
            Self::Diffuse => "diffuse",
            Self::DiffuseAmbient => "diffuse-ao",
            Self::AmbientMinusIndirect => "ao-minus-indirect",
            Self::Reference => "reference",
            Self::Error(judged) => judged.name(),
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::PhotonIrradiance => "Photon irradiance",
            Self::PhotonRadiance => "Photon radiance",
            Self::Caustics => "Caustics",
            Self::RayTraced => "Ray-traced",
            Self::RadiositySpecular => "Radiosity + specular",
            Self::RadiosityDirect => "Radiosity + direct",
            Self::FinalGather => "Final gather",
            Self::AmbientOcclusion => "Ambient occlusion",
            Self::Diffuse => "Diffuse",
            Self::DiffuseAmbient => "Diffuse + AO",
            Self::AmbientMinusIndirect => "AO − indirect",
            Self::Reference => "Reference",
            Self::Error(_) => "Error",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::PhotonIrradiance => "Light that arrives, estimated from the photons near by",
            Self::PhotonRadiance => "The same times the diffuse reflectance: light that is sent on",
            Self::Caustics => "Light that mirrors and glass gather on diffuse surfaces",
            Self::RayTraced => "Direct light, mirrors and glass; no light between diffuse surfaces",
            Self::RadiositySpecular => "Radiosity seen directly, with mirrors, gloss and glass traced on top",
            Self::RadiosityDirect => {
                "The same with sharp shadows: light straight from emitters by rays, the rest from radiosity"
            }
            Self::FinalGather => "Direct and specular light by rays, diffuse light gathered from the photon map",
            Self::AmbientOcclusion => "Share of an even light from everywhere that arrives: no emitter is needed",
            Self::Diffuse => "Diffuse colour in direct light, or in even light where nothing emits",
            Self::DiffuseAmbient => "The same, with ambient light where it is not occluded",
            Self::AmbientMinusIndirect => {
                "Ambient occlusion against true light between surfaces, both equally bright on average: blue where it is \
                 darker, as in a white corner, whose walls reflect light to each other; red where it is brighter"
            }
            Self::Reference => "The rendering equation by path tracing: all light, noisy at first, without a bias",
            Self::Error(_) => {
                "How far the light of a view is off, in shares of the mean light: blue where it is too dark, red where it is \
                 too bright, speckled as long as the reference is noisy"
            }
        }
    }
}

/// A picture from a camera at one moment: coarse at first, then finer, then less noisy.
#[derive(Clone, Debug)]
pub struct CameraImage {
    pub view: CameraView,
    pub camera: Camera,
    /// Width and height of the picture that was asked for, pixels.
    pub size: [u32; 2],
    /// Width and height of the grid of `radiance`: `size`, or less while it is coarse. Its cells are squares of 2, 4, 8 …
    /// pixels then, and the last ones may reach past the edge.
    pub resolution: [u32; 2],
    /// L, W/(m²·sr), row by row from the top left, premultiplied with `coverage`: background counts as 0. For
    /// [`CameraView::PhotonIrradiance`] E/π; for [`CameraView::AmbientOcclusion`] the share of light that arrives; for
    /// [`CameraView::AmbientMinusIndirect`] this share and, as the second number, the indirect irradiance, W/m², weighed by
    /// how bright its colours are; for [`CameraView::Error`] see [`super::PictureError::of`].
    pub radiance: Vec<Rgb>,
    /// Share of each cell that shows a surface, in [0, 1]; the rest is background.
    pub coverage: Vec<f32>,
    /// How two kinds of light compare; `None` for views that compare nothing, and where one of them is nothing.
    pub comparison: Option<Comparison>,
    /// Samples a pixel so far; 0 while it is coarse.
    pub samples: u32,
    pub rays: u64,
    /// Of the rays, those for one effect; and those that skipping effects saved.
    pub bill: Bill,
    /// Time spent on the picture, filled in by whoever runs it.
    pub elapsed: Duration,
    pub is_complete: bool,
}

impl CameraImage {
    /// Pixels along the edge of a cell.
    pub fn cell(&self) -> u32 {
        let is_cell = |cell: &u32| [0, 1].iter().all(|&axis| self.size[axis].div_ceil(*cell) <= self.resolution[axis]);
        (0..31).map(|power| 1 << power).find(is_cell).unwrap_or(1)
    }
}
