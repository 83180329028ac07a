//! What a picture shows, and from where.

use super::ToneCurve;
use crate::camera::Camera;
use crate::choice::Choice;
use crate::solution::{Picked, Solution};
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
}

impl View {
    /// What is missing for this view and how to get it; `None` where it can be drawn. What cannot be drawn is shown in
    /// plain grey.
    pub fn missing(self, solution: &Solution, picked: Option<&Picked>) -> Option<&'static str> {
        match self {
            Self::Bounces if solution.bounces.is_empty() => {
                Some("Only the Jacobi solver keeps the light of every bounce: choose it and run")
            }
            Self::FormFactors if picked.is_none() => Some("Click a patch to see the form factors from it"),
            _ => None,
        }
    }

    /// Whether colours stand for numbers. Exposure and tone curve do not change them.
    pub fn is_false_colour(self) -> bool {
        self == Self::FormFactors
    }
}

impl Choice for View {
    const ALL: &'static [Self] =
        &[Self::Patches, Self::Smooth, Self::Unshot, Self::Absorbed, Self::Bounces, Self::FormFactors];
    const KIND: &'static str = "view";

    fn name(self) -> &'static str {
        match self {
            Self::Patches => "patches",
            Self::Smooth => "smooth",
            Self::Unshot => "unshot",
            Self::Absorbed => "absorbed",
            Self::Bounces => "bounces",
            Self::FormFactors => "form-factors",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Patches => "Patches",
            Self::Smooth => "Smooth",
            Self::Unshot => "Unshot light",
            Self::Absorbed => "Absorbed",
            Self::Bounces => "Bounces",
            Self::FormFactors => "Form factors",
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
        }
    }
}

/// The light of a world, and what its picked patch sees.
#[derive(Clone, Debug)]
pub struct Light {
    pub solution: Arc<Solution>,
    pub picked: Option<Arc<Picked>>,
}

impl From<Solution> for Light {
    fn from(solution: Solution) -> Self {
        Self { solution: Arc::new(solution), picked: None }
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
    /// In stops; see [`super::Exposure`].
    pub exposure_ev: f32,
    pub tone: ToneCurve,
}

impl Frame {
    /// The patch that is outlined, if any.
    pub(super) fn outlined(&self, light: &Light) -> Option<u32> {
        let picked = light.picked.as_ref().map(|picked| picked.patch);
        picked.or_else(|| light.solution.shooter.filter(|_| self.show_shooter && self.view != View::FormFactors))
    }
}
