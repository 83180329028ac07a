//! The views in groups, and whose work each of them shows.

use crate::choice::Choice;
use crate::solution::{CameraImage, CameraView};
use crate::viewport::View;
use crate::worker::Snapshot;

/// Views that belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewGroup {
    Radiosity,
    PhotonMap,
    Rays,
    Occlusion,
    Truth,
}

impl ViewGroup {
    /// The group of a view.
    pub fn of(view: View) -> Self {
        match view {
            View::Photons | View::KdTree => Self::PhotonMap,
            View::Camera(CameraView::PhotonIrradiance | CameraView::PhotonRadiance | CameraView::Caustics) => {
                Self::PhotonMap
            }
            View::Camera(
                CameraView::RayTraced
                | CameraView::RadiositySpecular
                | CameraView::RadiosityDirect
                | CameraView::FinalGather,
            ) => Self::Rays,
            View::Camera(CameraView::Reference | CameraView::Error(_)) => Self::Truth,
            View::OcclusionVertices
            | View::Camera(
                CameraView::AmbientOcclusion
                | CameraView::Diffuse
                | CameraView::DiffuseAmbient
                | CameraView::AmbientMinusIndirect,
            ) => Self::Occlusion,
            View::Patches | View::Smooth | View::Unshot | View::Absorbed | View::Bounces | View::FormFactors => {
                Self::Radiosity
            }
        }
    }

    /// Its views, in the order in which people are shown them.
    pub fn views(self) -> impl Iterator<Item = View> {
        View::ALL.iter().copied().filter(move |view| Self::of(*view) == self)
    }

    /// The view to begin with.
    pub fn first(self) -> View {
        match self {
            Self::Radiosity => View::Smooth,
            Self::PhotonMap => View::Photons,
            Self::Rays => View::Camera(CameraView::RayTraced),
            Self::Occlusion => View::Camera(CameraView::AmbientOcclusion),
            Self::Truth => View::Camera(CameraView::Reference),
        }
    }
}

impl Choice for ViewGroup {
    const ALL: &'static [Self] = &[Self::Radiosity, Self::PhotonMap, Self::Rays, Self::Occlusion, Self::Truth];
    const KIND: &'static str = "group of views";

    fn name(self) -> &'static str {
        match self {
            Self::Radiosity => "radiosity",
            Self::PhotonMap => "photon-map",
            Self::Rays => "ray-tracing",
            Self::Occlusion => "occlusion",
            Self::Truth => "truth",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Radiosity => "Radiosity",
            Self::PhotonMap => "Photon map",
            Self::Rays => "Tracing",
            Self::Occlusion => "Occlusion",
            Self::Truth => "Truth",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Radiosity => "Light on every element, the same from everywhere",
            Self::PhotonMap => "Photons where they landed, and what is read off them",
            Self::Rays => "Pictures from the camera by rays, with mirrors and glass",
            Self::Occlusion => "Even light from everywhere, as far as nothing stands near: a guess at indirect light",
            Self::Truth => "All light there is, without a bias: what the other methods are held against",
        }
    }
}

/// The picture from a camera that a view shows, if it is one and it is there.
pub fn image(view: View, snapshot: &Snapshot) -> Option<&CameraImage> {
    let View::Camera(view) = view else { return None };
    snapshot.image.as_deref().filter(|image| image.view == view)
}
