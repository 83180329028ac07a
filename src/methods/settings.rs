//! Everything that a run depends on, beside the scene.

use super::ambient_occlusion::OcclusionSettings;
use crate::choice::Choice;
use crate::effects::Switches;
use crate::mesh::MeshSettings;
use crate::solution::{CameraView, PathFilter};

/// What the person asks a run for.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Settings {
    pub mesh: MeshSettings,
    pub solver: Solver,
    pub form_factor: FormFactorMethod,
    /// Whether progressive radiosity also shoots what a patch is expected to receive later.
    pub overshoot: bool,
    /// Stop when at most this share of the emitted flux is unshot.
    pub unshot_limit: f64,
    /// Visibility rays of a receiver for all the irradiance that is expected there. A shot that may bring a part of it
    /// gets that part of the rays, but at least [`Settings::MIN_SHADOW_RAYS`].
    pub shadow_rays: u32,
    /// Rays that carry the emitted flux, where form factors are counted by rays: a shot gets its part of them.
    pub light_rays: u32,
    /// Cells along the edge of a hemicube's top face.
    pub hemicube_resolution: u32,
    /// Every random number comes from this.
    pub seed: u64,
    pub photons: PhotonSettings,
    pub image: ImageSettings,
    pub occlusion: OcclusionSettings,
    /// Effects that are simulated, or left out, whatever the scene calls for. It belongs to the scene, and is not kept.
    #[serde(skip)]
    pub effects: Switches,
}

/// How light is followed as photons, and how it is read off them.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct PhotonSettings {
    /// Photons of the global map that a pass emits.
    pub count: u32,
    /// Photons that a pass emits for the caustic map, where the scene has specular surfaces.
    pub caustic_count: u32,
    /// The most photons that an estimate uses.
    pub nearest: u32,
    /// The farthest at which an estimate looks for photons, m; `None` chooses by the scene.
    pub max_radius: Option<f32>,
    pub kernel: Kernel,
    /// Whether passes go on with new photons and a smaller radius each, so that noise and bias both vanish. If not, the
    /// radius stays, and with it the bias.
    pub is_progressive: bool,
    /// Passes of a progressive run.
    pub passes: u32,
}

impl PhotonSettings {
    pub const MAX_COUNT: u32 = 50_000_000;
    pub const MAX_NEAREST: u32 = 10_000;
    pub const MAX_PASSES: u32 = 1_000_000;
}

impl Default for PhotonSettings {
    fn default() -> Self {
        Self {
            count: 200_000,
            caustic_count: 200_000,
            nearest: 100,
            max_radius: None,
            kernel: Kernel::default(),
            is_progressive: false,
            passes: 100,
        }
    }
}

/// How much a photon counts by its distance from where light is estimated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kernel {
    #[default]
    Constant,
    /// Falls in proportion to the distance (Jensen 1996).
    Cone,
    /// Falls with the square of the distance (Epanechnikov 1969): the least variance for its bias.
    Epanechnikov,
}

impl Choice for Kernel {
    const ALL: &'static [Self] = &[Self::Constant, Self::Cone, Self::Epanechnikov];
    const KIND: &'static str = "kernel";

    fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Cone => "cone",
            Self::Epanechnikov => "epanechnikov",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Constant => "Constant",
            Self::Cone => "Cone",
            Self::Epanechnikov => "Epanechnikov",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Constant => "Every photon within the radius counts alike",
            Self::Cone => "Photons count less the farther away they are, down to nothing at the radius",
            Self::Epanechnikov => "The same along a parabola: the least noise for its blur",
        }
    }
}

/// How pictures from a camera are made.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct ImageSettings {
    /// Samples a pixel.
    pub samples: u32,
    /// Diffuse rays of a sample of [`crate::solution::CameraView::FinalGather`].
    pub gather_rays: u32,
    /// Shadow rays to the emitters at each place that is seen.
    pub light_rays: u32,
    /// Which paths of light are shown.
    pub filter: PathFilter,
}

impl ImageSettings {
    pub const MAX_SAMPLES: u32 = 65_536;
    pub const MAX_GATHER_RAYS: u32 = 65_536;
    pub const MAX_LIGHT_RAYS: u32 = 4_096;

    /// Samples of each pixel of a view.
    pub fn samples_of(&self, view: CameraView) -> u32 {
        view.samples(self.samples).min(Self::MAX_SAMPLES)
    }
}

impl Default for ImageSettings {
    fn default() -> Self {
        Self { samples: 16, gather_rays: 64, light_rays: 4, filter: PathFilter::default() }
    }
}

impl Settings {
    /// The fewest visibility rays from a receiver to a shooter, unless [`Settings::shadow_rays`] is lower.
    pub const MIN_SHADOW_RAYS: u32 = 4;
    pub const MAX_SHADOW_RAYS: u32 = 1024;
    pub const MIN_LIGHT_RAYS: u32 = 1_000;
    pub const MAX_LIGHT_RAYS: u32 = 1_000_000_000;
    pub const MIN_HEMICUBE_RESOLUTION: u32 = 8;
    pub const MAX_HEMICUBE_RESOLUTION: u32 = 2048;

    /// Whether radiosity may go on with `other` instead: all but its stop rule, and what photons and cameras do, is the same.
    /// Which effects it simulates, it finds out by itself.
    pub fn is_same_radiosity(&self, other: &Self) -> bool {
        let Self { unshot_limit, photons, image, occlusion, effects, .. } = *other;
        Self { unshot_limit, photons, image, occlusion, effects, ..*self } == *other
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            mesh: MeshSettings::default(),
            solver: Solver::default(),
            form_factor: FormFactorMethod::default(),
            overshoot: false,
            unshot_limit: 1e-3,
            shadow_rays: 64,
            light_rays: 8_000_000,
            hemicube_resolution: 256,
            seed: 0,
            photons: PhotonSettings::default(),
            image: ImageSettings::default(),
            occlusion: OcclusionSettings::default(),
            effects: Switches::default(),
        }
    }
}

/// How the linear equations of radiosity are solved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// The brightest patch shoots, and its form factors are computed when it does.
    #[default]
    Progressive,
    /// The full matrix; all patches gather at once, which is one bounce of light.
    Jacobi,
    /// The full matrix; patch after patch gathers, from what is newest.
    GaussSeidel,
    /// The full matrix; the brightest patch shoots.
    Southwell,
}

impl Solver {
    /// Whether all form factors are computed and kept before the first light moves.
    pub fn needs_matrix(self) -> bool {
        self != Self::Progressive
    }

    /// What a step is called, in the singular.
    pub fn step_name(self) -> &'static str {
        match self {
            Self::Progressive | Self::Southwell => "shot",
            Self::Jacobi | Self::GaussSeidel => "sweep",
        }
    }
}

impl Choice for Solver {
    const ALL: &'static [Self] = &[Self::Progressive, Self::Jacobi, Self::GaussSeidel, Self::Southwell];
    const KIND: &'static str = "solver";

    fn name(self) -> &'static str {
        match self {
            Self::Progressive => "progressive",
            Self::Jacobi => "jacobi",
            Self::GaussSeidel => "gauss-seidel",
            Self::Southwell => "southwell",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Progressive => "Progressive",
            Self::Jacobi => "Jacobi",
            Self::GaussSeidel => "Gauss-Seidel",
            Self::Southwell => "Southwell",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Progressive => "The brightest patch shoots; form factors are computed as they are needed",
            Self::Jacobi => "Full matrix: all patches gather at once, one bounce of light a sweep",
            Self::GaussSeidel => "Full matrix: patch after patch gathers what is newest, about half the sweeps",
            Self::Southwell => "Full matrix: the brightest patch shoots, as in progressive radiosity",
        }
    }
}

/// How form factors are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FormFactorMethod {
    /// From centre to centre, as if both were far away: above 1 for patches that are near.
    Centroid,
    /// The same with the shooter as a disc: never above 1.
    Disc,
    /// Closed form from points to the polygon, times the visible share.
    #[default]
    Polygon,
    /// Share of the cosine-distributed rays that arrive.
    Rays,
    /// The scene drawn onto half a cube round the shooter's centre.
    Hemicube,
}

impl Choice for FormFactorMethod {
    const ALL: &'static [Self] = &[Self::Centroid, Self::Disc, Self::Polygon, Self::Rays, Self::Hemicube];
    const KIND: &'static str = "form factor";

    fn name(self) -> &'static str {
        match self {
            Self::Centroid => "centroid",
            Self::Disc => "disc",
            Self::Polygon => "polygon",
            Self::Rays => "rays",
            Self::Hemicube => "hemicube",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Centroid => "Centroid",
            Self::Disc => "Disc",
            Self::Polygon => "Polygon",
            Self::Rays => "Rays",
            Self::Hemicube => "Hemicube",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Centroid => "The lecture's estimate from centre to centre; it fails where patches are near",
            Self::Disc => "Centre to centre with the shooter as a disc; better near by, and never above 1",
            Self::Polygon => "Lambert's closed form to the whole polygon, times the share of rays that see it",
            Self::Rays => "Rays from the shooter, as many as its flux deserves; each carries the same light",
            Self::Hemicube => "The scene drawn onto five faces round the shooter's centre, with an item buffer",
        }
    }
}
