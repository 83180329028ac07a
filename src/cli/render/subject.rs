//! What a picture is of, and which options that takes.

use super::Options;
use crate::choice::Choice;
use crate::cli::picture;
use crate::methods::{ImageSettings, Solver};
use crate::solution::CameraView;
use crate::viewport::View;
use crate::viewport::diagram::Diagram;
use crate::worker;

/// What a picture is of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Subject {
    View(View),
    Diagram(Diagram),
}

impl Subject {
    pub fn name(self) -> &'static str {
        match self {
            Self::View(view) => view.name(),
            Self::Diagram(diagram) => diagram.name(),
        }
    }

    fn all() -> impl Iterator<Item = Self> {
        View::ALL.iter().copied().map(Self::View).chain(Diagram::ALL.iter().copied().map(Self::Diagram))
    }

    pub fn parse(text: &str) -> Result<Self, String> {
        Self::all().find(|subject| subject.name() == text).ok_or_else(|| {
            let names: Vec<_> = Self::all().map(Self::name).collect();
            format!("no view is called `{text}` (there are {})", names.join(", "))
        })
    }

    /// Whose work it shows.
    fn worker_subject(self) -> worker::Subject {
        match self {
            Self::View(view) => picture::subject(view),
            Self::Diagram(_) => worker::Subject::Radiosity,
        }
    }

    /// The picture from a camera that it is, if it is one.
    fn camera_view(self) -> Option<CameraView> {
        match self {
            Self::View(View::Camera(view)) => Some(view),
            _ => None,
        }
    }

    /// Whether it shows photons or is read off them.
    fn is_of_photons(self) -> bool {
        match self {
            Self::View(view) => view.shows_photons() || self.camera_view().is_some_and(CameraView::needs_photons),
            Self::Diagram(_) => false,
        }
    }

    /// Whether it is ambient occlusion on the mesh.
    fn is_of_vertices(self) -> bool {
        self == Self::View(View::OcclusionVertices)
    }

    /// Whether ambient occlusion is a part of it.
    fn is_occluded(self) -> bool {
        matches!(self, Self::View(view) if view.is_occluded())
    }

    /// Whether radiosity is computed for it.
    pub fn is_radiosity(self) -> bool {
        let has_own_light = self.is_of_photons() || self.is_of_vertices();
        !has_own_light && self.camera_view().is_none_or(CameraView::needs_radiosity)
    }

    /// Whether it is found by shadow rays to the emitters.
    pub fn samples_emitters(self) -> bool {
        self.camera_view().is_some_and(CameraView::samples_emitters)
    }

    /// Whether it can be of some paths of light only.
    fn has_paths(self) -> bool {
        !self.is_radiosity() && !self.is_of_vertices() && self.camera_view().is_none_or(CameraView::has_paths)
    }
}

impl Options {
    /// Why these options do not lead to the picture, if they do not.
    pub(super) fn objection(&self) -> Option<String> {
        let effects = || {
            let name = format!("the view `{}`", self.view().name());
            self.run.effects.objection(self.view().worker_subject(), &self.settings(), &name)
        };
        self.what_is_needed().map(str::to_owned).or_else(|| self.what_is_strange()).or_else(effects)
    }

    fn what_is_needed(&self) -> Option<&'static str> {
        let solver = self.run.settings().solver;
        match self.view() {
            Subject::View(View::FormFactors) | Subject::Diagram(Diagram::ItemBuffer)
                if self.patch.is_none() && self.pick.is_none() =>
            {
                Some("this view is of one patch: --patch N or --pick X,Y says which")
            }
            Subject::View(View::Bounces) if solver != Solver::Jacobi => {
                Some("light is kept bounce by bounce by --solver jacobi alone")
            }
            Subject::Diagram(Diagram::Matrix) if !solver.needs_matrix() => {
                Some("a matrix is kept by --solver jacobi|gauss-seidel|southwell alone")
            }
            _ => None,
        }
    }

    /// Options that the view does not use, or not so.
    fn what_is_strange(&self) -> Option<String> {
        let view = self.view();
        let unused = |option: &str| Some(format!("{option} is not for the view `{}`", view.name()));
        if view.is_radiosity() {
            if let Some(objection) = self.run.objection_by_radiosity().filter(|_| !view.samples_emitters()) {
                return Some(objection);
            }
        } else if let Some(option) = self.run.stop_of_radiosity() {
            return unused(option);
        }
        if let Some(option) = self.photons.given().filter(|_| !view.is_of_photons()) {
            return unused(option);
        }
        if self.image.gather_rays.is_some() && !view.camera_view().is_some_and(CameraView::gathers) {
            return unused("--gather-rays");
        }
        if let Some(option) = self.occlusion.given().filter(|_| !view.is_occluded()) {
            return unused(option);
        }
        if self.image.paths.is_some() && !view.has_paths() {
            return unused("--paths");
        }
        if let Some(rays) = self.run.light_rays.filter(|_| !view.is_radiosity() || view.samples_emitters()) {
            if !view.samples_emitters() {
                return unused("--light-rays");
            }
            if rays > ImageSettings::MAX_LIGHT_RAYS {
                return Some(format!("this view takes up to {} --light-rays", ImageSettings::MAX_LIGHT_RAYS));
            }
        }
        let has_passes = view.is_of_photons() && view.camera_view().is_some();
        if has_passes && self.samples.is_some() && self.photons.settings().is_progressive {
            return Some("each of the --passes gives one sample a pixel: --samples is of no use with it".to_owned());
        }
        None
    }
}
