//! What the convergence chart shows, and in which words: how far each run on a scene was after how much work.

use super::format;
use crate::choice::Choice;
use crate::methods::{FormFactorMethod, PhotonSettings, Settings, Solver};
use crate::worker::{Curve, CurvePoint, LightKind, Track};
use std::sync::Arc;

/// What is drawn over what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Chart {
    pub work: Work,
    pub rest: Rest,
}

impl Chart {
    /// The point of a curve, the rest as a power of ten; `None` where the rest has no logarithm, as after overshoot that
    /// lent more light than there was left.
    pub fn point(&self, point: &CurvePoint) -> Option<[f64; 2]> {
        let work = match self.work {
            Work::Steps => point.progress.steps as f64,
            Work::Updates => point.progress.updates as f64,
            Work::Rays => point.progress.rays as f64,
            Work::Seconds => point.seconds,
        };
        let rest = match self.rest {
            Rest::Unshot => point.progress.unshot_share,
            Rest::Missing => point.progress.missing_share,
        };
        (rest > 0.0).then(|| [work, rest.log10()])
    }
}

/// What a run has spent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Work {
    #[default]
    Steps,
    Updates,
    Rays,
    Seconds,
}

impl Work {
    /// An amount of it, as the axis of a chart writes it.
    pub fn amount(self, amount: f64) -> String {
        match self {
            Self::Seconds => format::short(amount, "s"),
            _ => format::short(amount, ""),
        }
    }
}

impl Choice for Work {
    const ALL: &'static [Self] = &[Self::Steps, Self::Updates, Self::Rays, Self::Seconds];
    const KIND: &'static str = "measure of work";

    fn name(self) -> &'static str {
        match self {
            Self::Steps => "steps",
            Self::Updates => "updates",
            Self::Rays => "rays",
            Self::Seconds => "seconds",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Steps => "Shots or sweeps",
            Self::Updates => "Patch updates",
            Self::Rays => "Rays",
            Self::Seconds => "Solver time",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Steps => "A sweep takes as much work as there are patches, a shot that of one",
            Self::Updates => "Patches that shot or gathered: the fair measure between shots and sweeps",
            Self::Rays => "All rays, for form factors and for light",
            Self::Seconds => "Time in the solver, with the building of a matrix",
        }
    }
}

/// What a run has left to do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rest {
    #[default]
    Unshot,
    Missing,
}

impl Choice for Rest {
    const ALL: &'static [Self] = &[Self::Unshot, Self::Missing];
    const KIND: &'static str = "measure of what is left";

    fn name(self) -> &'static str {
        match self {
            Self::Unshot => "unshot",
            Self::Missing => "missing",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Unshot => "Unshot share",
            Self::Missing => "Missing light, estimated",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Unshot => "Of the emitted flux, what waits to be passed on: the stop rule looks at it",
            Self::Missing => "Of the light on surfaces, what unshot flux will add if it spreads evenly",
        }
    }
}

/// For each run its solver, and of its other settings those in which the runs differ.
pub fn descriptions(curves: &[Arc<Curve>]) -> Vec<String> {
    told_apart(&curves.iter().map(|curve| facts_of_radiosity(&curve.settings)).collect::<Vec<_>>())
}

/// The same of runs of which some are radiosity and others photons: each kind by itself.
pub fn descriptions_of_tracks(tracks: &[Arc<Track>]) -> Vec<String> {
    let mut descriptions = vec![String::new(); tracks.len()];
    for kind in [LightKind::Radiosity, LightKind::Photons] {
        let of_kind: Vec<usize> = (0..tracks.len()).filter(|&index| tracks[index].kind == kind).collect();
        let facts = |&index: &usize| match kind {
            LightKind::Photons => facts_of_photons(&tracks[index].settings),
            LightKind::Radiosity | LightKind::Occlusion => facts_of_radiosity(&tracks[index].settings),
        };
        let told = told_apart(&of_kind.iter().map(facts).collect::<Vec<_>>());
        for (index, description) in of_kind.into_iter().zip(told) {
            descriptions[index] = description;
        }
    }
    descriptions
}

/// The first fact of each, and those in which they differ.
fn told_apart(facts: &[Vec<Option<String>>]) -> Vec<String> {
    let differs = |kind: usize| facts.iter().any(|other| other[kind] != facts[0][kind]);
    let describe = |facts: &Vec<Option<String>>| {
        let told = facts.iter().enumerate().filter(|(kind, _)| *kind == 0 || differs(*kind));
        told.filter_map(|(_, fact)| fact.as_deref()).collect::<Vec<_>>().join(", ")
    };
    facts.iter().map(describe).collect()
}

/// Everything that can make one run of radiosity differ from another on one scene, the solver first; `None` where it plays no
/// part.
fn facts_of_radiosity(settings: &Settings) -> Vec<Option<String>> {
    let Settings { mesh, solver, form_factor, overshoot, shadow_rays, light_rays, hemicube_resolution, seed, .. } =
        *settings;
    let uses_shadow_rays = form_factor != FormFactorMethod::Rays;
    let solver_name = solver.label().to_owned();
    let is_ahead = overshoot && solver == Solver::Progressive;
    vec![
        Some(if is_ahead { format!("{solver_name} with overshoot") } else { solver_name }),
        Some(form_factor.label().to_lowercase()),
        Some(mesh.element_size.map_or("automatic mesh".to_owned(), |size| format::si(f64::from(size), "m"))),
        Some(format!("{0} × {0} elements a patch", mesh.elements_per_patch_edge)),
        uses_shadow_rays.then(|| format::counted(u64::from(shadow_rays), "shadow ray")),
        (form_factor == FormFactorMethod::Rays).then(|| format::short(f64::from(light_rays), "rays")),
        (form_factor == FormFactorMethod::Hemicube).then(|| format!("{hemicube_resolution} cells")),
        Some(format!("seed {seed}")),
    ]
}

/// The same of photons, their number first.
fn facts_of_photons(settings: &Settings) -> Vec<Option<String>> {
    let PhotonSettings { count, caustic_count, nearest, max_radius, kernel, is_progressive, .. } = settings.photons;
    vec![
        Some(format!("{} photons", format::short(f64::from(count), ""))),
        Some(if is_progressive { "progressive".to_owned() } else { "one pass".to_owned() }),
        Some(format!("{nearest} nearest")),
        Some(max_radius.map_or("automatic radius".to_owned(), |radius| format::si(f64::from(radius), "m"))),
        Some(kernel.label().to_lowercase()),
        Some(format!("{} for caustics", format::short(f64::from(caustic_count), ""))),
        Some(format!("seed {}", settings.seed)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshSettings;
    use crate::solution::Progress;

    fn curves(settings: impl IntoIterator<Item = Settings>) -> Vec<Arc<Curve>> {
        let curve = |(i, settings)| Arc::new(Curve { number: i as u32 + 1, settings, points: Vec::new() });
        settings.into_iter().enumerate().map(curve).collect()
    }

    #[test]
    fn runs_are_told_apart_by_what_differs() {
        let progressive = Settings::default();
        let jacobi = Settings { solver: Solver::Jacobi, ..progressive };
        assert_eq!(descriptions(&curves([progressive])), ["Progressive"]);
        assert_eq!(descriptions(&curves([progressive, jacobi])), ["Progressive", "Jacobi"]);
        let hemicube = Settings { form_factor: FormFactorMethod::Hemicube, ..jacobi };
        assert_eq!(descriptions(&curves([jacobi, hemicube])), ["Jacobi, polygon", "Jacobi, hemicube, 256 cells"]);
        let fine = Settings { mesh: MeshSettings { element_size: Some(0.5), ..progressive.mesh }, ..progressive };
        let ahead = Settings { overshoot: true, ..fine };
        assert_eq!(
            descriptions(&curves([fine, progressive, ahead])),
            ["Progressive, 500\u{2009}mm", "Progressive, automatic mesh", "Progressive with overshoot, 500\u{2009}mm"]
        );
    }

    #[test]
    fn what_has_no_logarithm_is_left_out() {
        let progress = Progress { steps: 7, updates: 70, rays: 700, unshot_share: 0.0, missing_share: 0.1 };
        let point = |unshot_share| CurvePoint { progress: Progress { unshot_share, ..progress }, seconds: 0.5 };
        let chart = Chart::default();
        assert_eq!(chart.point(&point(0.01)), Some([7.0, -2.0]));
        assert_eq!(chart.point(&point(0.0)), None);
        assert_eq!(chart.point(&point(-1e-3)), None);
        let chart = Chart { work: Work::Rays, rest: Rest::Missing };
        assert_eq!(chart.point(&point(0.0)), Some([700.0, -1.0]));
    }
}
