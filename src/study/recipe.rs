//! A way to compute irradiance, with all its settings.

use super::knob::{Knob, Setting};
use crate::choice::Choice;
use crate::methods::{FormFactorMethod, Settings};
use crate::solution::CameraView;

/// How irradiance is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Way {
    Radiosity,
    PhotonMap,
    /// Direct light by rays, the rest read off radiosity.
    RadiosityDirect,
    FinalGather,
    /// Direct light by rays, and ambient light where it is not occluded in place of the rest.
    DiffuseAo,
    /// Path tracing.
    Reference,
}

impl Way {
    /// The view whose pictures are made in this way, if it is one of those that are read at points.
    pub fn view(self) -> Option<CameraView> {
        match self {
            Self::RadiosityDirect => Some(CameraView::RadiosityDirect),
            Self::FinalGather => Some(CameraView::FinalGather),
            Self::DiffuseAo => Some(CameraView::DiffuseAmbient),
            Self::Radiosity | Self::PhotonMap | Self::Reference => None,
        }
    }

    /// The view from a camera that shows light found in this way.
    pub fn picture(self) -> CameraView {
        match self {
            Self::Radiosity => CameraView::RadiositySpecular,
            Self::PhotonMap => CameraView::PhotonRadiance,
            Self::RadiosityDirect => CameraView::RadiosityDirect,
            Self::FinalGather => CameraView::FinalGather,
            Self::DiffuseAo => CameraView::DiffuseAmbient,
            Self::Reference => CameraView::Reference,
        }
    }

    /// Whether it knows light everywhere once it is done; the others are asked point by point.
    pub fn is_everywhere(self) -> bool {
        matches!(self, Self::Radiosity | Self::PhotonMap)
    }
}

impl Choice for Way {
    const ALL: &'static [Self] =
        &[Self::Radiosity, Self::PhotonMap, Self::RadiosityDirect, Self::FinalGather, Self::DiffuseAo, Self::Reference];
    const KIND: &'static str = "method";

    fn name(self) -> &'static str {
        match self {
            Self::Radiosity => "radiosity",
            Self::PhotonMap => "photon-map",
            Self::RadiosityDirect => CameraView::RadiosityDirect.name(),
            Self::FinalGather => CameraView::FinalGather.name(),
            Self::DiffuseAo => CameraView::DiffuseAmbient.name(),
            Self::Reference => CameraView::Reference.name(),
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Radiosity => "Radiosity",
            Self::PhotonMap => "Photon map",
            Self::RadiosityDirect => CameraView::RadiosityDirect.label(),
            Self::FinalGather => CameraView::FinalGather.label(),
            Self::DiffuseAo => CameraView::DiffuseAmbient.label(),
            Self::Reference => "Path tracing",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Radiosity => "Light between diffuse patches, as a system of linear equations",
            Self::PhotonMap => "Light as photons that fly from the emitters and are kept where they land",
            Self::RadiosityDirect => CameraView::RadiosityDirect.meaning(),
            Self::FinalGather => CameraView::FinalGather.meaning(),
            Self::DiffuseAo => CameraView::DiffuseAmbient.meaning(),
            Self::Reference => CameraView::Reference.meaning(),
        }
    }
}

/// A way and the settings that it takes; those of other ways play no part.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Recipe {
    pub way: Way,
    pub settings: Settings,
}

impl Recipe {
    /// What can be turned to trade time for accuracy, and how it is set.
    pub fn knobs(&self) -> Vec<(Knob, Setting)> {
        let Settings { mesh, solver, form_factor, unshot_limit, photons, image, occlusion, .. } = self.settings;
        let number = |value: u32| Setting::Number(value.into());
        let element = mesh.element_size.map_or(Setting::Automatic, |size| Setting::Number(size.into()));
        let of_photons = [(Knob::Photons, number(photons.count)), (Knob::Nearest, number(photons.nearest))];
        match self.way {
            Way::Radiosity => vec![
                (Knob::Element, element),
                (Knob::FormFactor, Setting::Name(form_factor.name())),
                self.form_factor_knob(),
                (Knob::Solver, Setting::Name(solver.name())),
                (Knob::Unshot, Setting::Number(100.0 * unshot_limit)),
            ],
            Way::PhotonMap => {
                let radius = photons.max_radius.map_or(Setting::Automatic, |radius| Setting::Number(radius.into()));
                let passes = if photons.is_progressive { photons.passes } else { 1 };
                of_photons.into_iter().chain([(Knob::Radius, radius), (Knob::Passes, number(passes))]).collect()
            }
            Way::RadiosityDirect => vec![
                (Knob::Element, element),
                (Knob::Unshot, Setting::Number(100.0 * unshot_limit)),
                (Knob::LampRays, number(image.light_rays)),
                (Knob::Samples, number(image.samples)),
            ],
            Way::FinalGather => vec![
                (Knob::Photons, number(photons.count)),
                (Knob::GatherRays, number(image.gather_rays)),
                (Knob::LampRays, number(image.light_rays)),
                (Knob::Samples, number(image.samples)),
            ],
            Way::DiffuseAo => vec![
                (Knob::AoRays, number(occlusion.rays)),
                (Knob::LampRays, number(image.light_rays)),
                (Knob::Samples, number(image.samples)),
            ],
            Way::Reference => vec![(Knob::Samples, number(image.samples))],
        }
    }

    /// Whether a knob is set as the program sets it by itself.
    pub fn is_default(&self, knob: Knob) -> bool {
        let default = Self { settings: Settings::default(), ..*self };
        let setting = |recipe: &Self| recipe.knobs().into_iter().find(|(other, _)| *other == knob);
        setting(self) == setting(&default)
    }

    /// What makes form factors better.
    fn form_factor_knob(&self) -> (Knob, Setting) {
        let Settings { form_factor, shadow_rays, light_rays, hemicube_resolution, .. } = self.settings;
        match form_factor {
            FormFactorMethod::Rays => (Knob::FluxRays, Setting::Number(light_rays.into())),
            FormFactorMethod::Hemicube => (Knob::Hemicube, Setting::Number(hemicube_resolution.into())),
            FormFactorMethod::Centroid | FormFactorMethod::Disc | FormFactorMethod::Polygon => {
                (Knob::ShadowRays, Setting::Number(shadow_rays.into()))
            }
        }
    }

    /// The options of `lightwell probe` that compute light like this.
    pub fn options(&self) -> String {
        format!("--method {}{}", self.way.name(), self.options_beside_way())
    }

    /// The options of `lightwell render` that make a picture of light like this.
    pub fn options_of_picture(&self) -> String {
        format!("--view {}{}", self.way.picture().name(), self.options_beside_way())
    }

    fn options_beside_way(&self) -> String {
        let mut options = String::new();
        let is_single = |knob: Knob, setting: &Setting| knob == Knob::Passes && *setting == Setting::Number(1.0);
        for (knob, setting) in self.knobs() {
            if setting != Setting::Automatic && !is_single(knob, &setting) {
                options += &format!(" {} {setting}", knob.option());
            }
        }
        options + &self.other_options()
    }

    /// Those that are no knobs here, where they are not as the program sets them by itself.
    fn other_options(&self) -> String {
        let (own, default) = (&self.settings, Settings::default());
        let mut options = String::new();
        let has_photons = matches!(self.way, Way::PhotonMap | Way::FinalGather);
        if has_photons && own.photons.caustic_count != default.photons.caustic_count {
            options += &format!(" --caustic-photons {}", own.photons.caustic_count);
        }
        if self.way == Way::RadiosityDirect && own.solver != default.solver {
            options += &format!(" --solver {}", own.solver.name());
        }
        let has_patches = matches!(self.way, Way::Radiosity | Way::RadiosityDirect);
        if has_patches && own.mesh.elements_per_patch_edge != default.mesh.elements_per_patch_edge {
            options += &format!(" --patch-edge {}", own.mesh.elements_per_patch_edge);
        }
        options
    }

    /// These settings with those that the recipe is about, for light that is everywhere.
    pub fn applied_to(&self, settings: &Settings) -> Settings {
        let own = self.settings;
        match self.way {
            Way::PhotonMap => Settings { photons: own.photons, ..*settings },
            _ => {
                let Settings { photons, image, occlusion, .. } = *settings;
                Settings { photons, image, occlusion, ..own }
            }
        }
    }

    /// The way, and with which solver if that is not the one that the program takes by itself.
    pub fn way_in_words(&self) -> String {
        let solver = self.settings.solver;
        match self.way {
            Way::Radiosity | Way::RadiosityDirect if solver != Settings::default().solver => {
                format!("{} ({})", self.way.name(), solver.name())
            }
            way => way.name().to_owned(),
        }
    }

    /// What it is called, in a few words: what is not as in other recipes is said by the caller.
    pub fn label(&self) -> String {
        let told = self.knobs().into_iter().filter(|(_, setting)| *setting != Setting::Automatic);
        let told: Vec<String> = told.map(|(knob, setting)| knob.amount(&setting)).collect();
        format!("{}: {}", self.way.label(), told.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshSettings;
    use crate::methods::PhotonSettings;

    #[test]
    fn options_say_all_that_matters_and_nothing_else() {
        let settings = Settings {
            mesh: MeshSettings { element_size: Some(0.05), ..MeshSettings::default() },
            ..Settings::default()
        };
        let options = Recipe { way: Way::Radiosity, settings }.options();
        assert_eq!(
            options,
            "--method radiosity --element 0.05 --form-factor polygon --shadow-rays 64 --solver progressive --converge 0.1"
        );
        let photons = Recipe { way: Way::PhotonMap, settings }.options();
        assert_eq!(photons, "--method photon-map --photons 200000 --nearest 100");
        let few = PhotonSettings { caustic_count: 5, ..settings.photons };
        let caustic = Recipe { way: Way::PhotonMap, settings: Settings { photons: few, ..settings } }.options();
        assert_eq!(caustic, "--method photon-map --photons 200000 --nearest 100 --caustic-photons 5");
    }
}
