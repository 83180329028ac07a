//! What a picture shows, and from where.

use super::{PhotonLook, ToneCurve};
use crate::camera::Camera;
use crate::choice::Choice;
use crate::solution::{
    CameraImage, CameraView, Gathered, Judged, PathFilter, PhotonSolution, PhotonTrail, Picked, Solution, VertexShares,
};
use std::sync::Arc;

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
    /// (1 − ρ) E / π: what stays in the surface, as the radiance that it would have.
    Absorbed,
    /// B/π after [`Frame::bounce`] bounces, as in [`View::Smooth`].
    Bounces,
    /// The form factor from the picked patch to every patch, in false colours.
    FormFactors,
    /// Where photons landed, in front of dark surfaces.
    Photons,
    /// The same, and the planes that divide them for looking them up.
    KdTree,
    /// The share of an even light from everywhere that arrives at each vertex, interpolated between them.
    OcclusionVertices,
    /// A picture that was made from the camera, pixel by pixel.
    Camera(CameraView),
}

const NO_PHOTONS: &str = "This picture is read off photons, and there are none yet: press Run";

impl View {
    /// What is missing for this view and how to get it; `None` where it can be drawn. What cannot be drawn is shown in
    /// plain grey.
    pub fn missing(self, light: &Light) -> Option<&'static str> {
        let photons = light.photons.as_deref();
        let has_photons = photons.is_some_and(|photons| !photons.photons.is_empty());
        let waits_for_photons = photons.is_some_and(|photons| photons.photons.is_empty() && !photons.is_complete);
        match self {
            Self::Photons | Self::KdTree if has_photons => None,
            Self::Photons | Self::KdTree if photons.is_some() && !waits_for_photons => {
                Some("No photon has landed: they are kept where a surface has a diffuse part")
            }
            Self::Photons | Self::KdTree => Some("There are no photons yet: press Run"),
            Self::OcclusionVertices if light.shares().is_some() => None,
            Self::OcclusionVertices => Some("No ray has looked for open sky yet: press Run"),
            // What shines itself may be seen already.
            Self::Camera(view) if view.needs_photons() && waits_for_photons => Some(NO_PHOTONS),
            Self::Camera(view) if light.image_of(view).is_some() => light.image_of(view).and_then(nothing_to_compare),
            Self::Camera(view) if view.needs_photons() && !has_photons => Some(NO_PHOTONS),
            Self::Camera(view) if view.needs_radiosity() && light.solution.is_none() => {
                Some("This picture is read off a radiosity solution, and there is none yet: press Run")
            }
            Self::Camera(_) => Some("The picture from this camera is not there yet"),
            Self::FormFactors if light.picked.is_none() => Some("Click a patch to see the form factors from it"),
            Self::FormFactors => None,
            Self::Bounces if light.solution.as_ref().is_none_or(|solution| solution.bounces.is_empty()) => {
                Some("Only the Jacobi solver keeps the light of every bounce: choose it and run")
            }
            _ => light.solution.is_none().then_some("There is no radiosity solution yet: press Run"),
        }
    }

    /// Whether colours stand for numbers. Exposure and tone curve do not change them.
    pub fn is_false_colour(self) -> bool {
        match self {
            Self::FormFactors | Self::OcclusionVertices => true,
            Self::Camera(view) => !view.is_light(),
            _ => self.shows_photons(),
        }
    }

    /// Whether it shows how two kinds of light compare.
    pub fn is_comparison(self) -> bool {
        matches!(self, Self::Camera(view) if view.is_comparison())
    }

    /// What the view shows of which an error is asked: itself where it is one, else the light that it shows or is closest to.
    pub fn judged(self) -> Judged {
        match self {
            Self::Patches => Judged::Patches,
            Self::Smooth | Self::Unshot | Self::Absorbed | Self::Bounces | Self::FormFactors => {
                Judged::RadiositySpecular
            }
            Self::Photons | Self::KdTree => Judged::PhotonRadiance,
            Self::OcclusionVertices => Judged::DiffuseAmbient,
            Self::Camera(view) => match view {
                CameraView::Error(judged) => judged,
                CameraView::PhotonIrradiance | CameraView::PhotonRadiance | CameraView::Caustics => {
                    Judged::PhotonRadiance
                }
                CameraView::RayTraced => Judged::RayTraced,
                CameraView::RadiositySpecular => Judged::RadiositySpecular,
                CameraView::RadiosityDirect | CameraView::Reference => Judged::RadiosityDirect,
                CameraView::FinalGather => Judged::FinalGather,
                CameraView::AmbientOcclusion
                | CameraView::Diffuse
                | CameraView::DiffuseAmbient
                | CameraView::AmbientMinusIndirect => Judged::DiffuseAmbient,
            },
        }
    }

    /// Whether ambient occlusion is a part of it.
    pub fn is_occluded(self) -> bool {
        match self {
            Self::OcclusionVertices => true,
            Self::Camera(view) => view.is_occluded(),
            _ => false,
        }
    }

    /// Whether single photons are drawn.
    pub fn shows_photons(self) -> bool {
        matches!(self, Self::Photons | Self::KdTree)
    }
}

/// Why a picture that compares two kinds of light shows none.
fn nothing_to_compare(image: &Arc<CameraImage>) -> Option<&'static str> {
    let reason = match image.view {
        CameraView::AmbientMinusIndirect => {
            "No light comes here from one surface to another, or no ambient light arrives: there is nothing to compare"
        }
        _ => "No light arrives at what is seen here: there is nothing to compare",
    };
    (image.view.is_comparison() && image.comparison.is_none()).then_some(reason)
}

impl Choice for View {
    const ALL: &'static [Self] = &[
        Self::Patches,
        Self::Smooth,
        Self::Unshot,
        Self::Absorbed,
        Self::Bounces,
        Self::FormFactors,
        Self::Photons,
        Self::KdTree,
        Self::Camera(CameraView::PhotonIrradiance),
        Self::Camera(CameraView::PhotonRadiance),
        Self::Camera(CameraView::Caustics),
        Self::Camera(CameraView::RayTraced),
        Self::Camera(CameraView::RadiositySpecular),
        Self::Camera(CameraView::RadiosityDirect),
        Self::Camera(CameraView::FinalGather),
        Self::Camera(CameraView::Reference),
        Self::Camera(CameraView::AmbientOcclusion),
        Self::Camera(CameraView::Diffuse),
        Self::Camera(CameraView::DiffuseAmbient),
        Self::Camera(CameraView::AmbientMinusIndirect),
        Self::OcclusionVertices,
        Self::Camera(CameraView::Error(Judged::Patches)),
        Self::Camera(CameraView::Error(Judged::RadiositySpecular)),
        Self::Camera(CameraView::Error(Judged::RadiosityDirect)),
        Self::Camera(CameraView::Error(Judged::PhotonRadiance)),
        Self::Camera(CameraView::Error(Judged::RayTraced)),
        Self::Camera(CameraView::Error(Judged::FinalGather)),
        Self::Camera(CameraView::Error(Judged::DiffuseAmbient)),
    ];
    const KIND: &'static str = "view";

    fn name(self) -> &'static str {
        match self {
            Self::Patches => "patches",
            Self::Smooth => "smooth",
            Self::Unshot => "unshot",
            Self::Absorbed => "absorbed",
            Self::Bounces => "bounces",
            Self::FormFactors => "form-factors",
            Self::Photons => "photons",
            Self::KdTree => "kd-tree",
            Self::OcclusionVertices => "ambient-occlusion-vertices",
            Self::Camera(view) => view.name(),
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Patches => "Patches",
            Self::Smooth => "Smooth",
            Self::Unshot => "Unshot",
            Self::Absorbed => "Absorbed",
            Self::Bounces => "Bounces",
            Self::FormFactors => "Form factors",
            Self::Photons => "Photons",
            Self::KdTree => "kd-tree",
            Self::OcclusionVertices => "AO on vertices",
            Self::Camera(view) => view.label(),
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Patches => "One colour an element: what the solver computed",
            Self::Smooth => "Light blended between elements that lie on one surface",
            Self::Unshot => "Light that has arrived and was not passed on yet",
            Self::Absorbed => "Light that stays in the surface, as bright as if it were sent on",
            Self::Bounces => "Light after a number of bounces: the partial sums of Neumann's series",
            Self::FormFactors => "Which share of its light a picked patch sends to every other, in false colours",
            Self::Photons => "Where photons landed, each a point",
            Self::KdTree => "The planes that divide the photons so that the nearest ones are found fast",
            Self::OcclusionVertices => {
                "Share of an even light from everywhere that arrives, on the mesh: the same from all sides"
            }
            Self::Camera(view) => view.meaning(),
        }
    }
}

/// What is known of the light in a world. What a view needs of it may be missing: see [`View::missing`].
#[derive(Clone, Debug, Default)]
pub struct Light {
    /// Radiosity, element by element.
    pub solution: Option<Arc<Solution>>,
    /// What the picked patch sees.
    pub picked: Option<Arc<Picked>>,
    pub photons: Option<Arc<PhotonSolution>>,
    /// How much ambient light arrives at each vertex.
    pub occlusion: Option<Arc<VertexShares>>,
    /// The picture from a camera that was made last.
    pub image: Option<Arc<CameraImage>>,
    /// The way of the picked photon.
    pub trail: Option<Arc<PhotonTrail>>,
    /// What the estimate at the picked point is made of.
    pub gathered: Option<Arc<Gathered>>,
}

impl Light {
    /// The share of ambient light at each vertex, where it is known.
    pub(super) fn shares(&self) -> Option<&[f32]> {
        self.occlusion.as_ref().map(|occlusion| occlusion.shares.as_slice()).filter(|shares| !shares.is_empty())
    }

    /// The picture from a camera, if it is of this view.
    pub fn image_of(&self, view: CameraView) -> Option<&Arc<CameraImage>> {
        self.image.as_ref().filter(|image| image.view == view)
    }
}

impl From<Solution> for Light {
    fn from(solution: Solution) -> Self {
        Self { solution: Some(Arc::new(solution)), ..Self::default() }
    }
}

/// Everything that a picture of a world and its light depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    pub camera: Camera,
    /// Width and height, pixels.
    pub size: [u32; 2],
    pub view: View,
    /// How many bounces of light [`View::Bounces`] shows, at most all that there are.
    pub bounce: usize,
    /// Whether [`View::Patches`] and [`View::Smooth`] add what the unshot light will bring on average, ρ ·
    /// [`Solution::ambient`] (Cohen, Chen, Wallace, Greenberg 1988).
    pub ambient: bool,
    /// Whether the outlines of elements are drawn.
    pub wireframe: bool,
    /// Whether the patch that shot last is outlined. A picked patch is outlined instead of it, in every view.
    pub show_shooter: bool,
    /// How single photons are drawn.
    pub photons: PhotonLook,
    /// Which photons are drawn, by the path of light that they would make if the eye saw them land.
    pub filter: PathFilter,
    /// In stops; see [`super::Exposure`].
    pub exposure_ev: f32,
    pub tone: ToneCurve,
}

impl Frame {
    /// The patch that is outlined, if any.
    pub(super) fn outlined(&self, light: &Light) -> Option<u32> {
        if self.view.shows_photons() {
            return None;
        }
        let picked = light.picked.as_ref().map(|picked| picked.patch);
        let shooter = || light.solution.as_ref().and_then(|solution| solution.shooter);
        let is_of_shots = !matches!(self.view, View::FormFactors | View::OcclusionVertices);
        picked.or_else(|| shooter().filter(|_| self.show_shooter && is_of_shots))
    }
}
