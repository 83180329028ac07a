//! `lightwell probe`: the irradiance at points, by a method or as it truly is, or the share of ambient light that arrives.

mod measured;
mod methods;
mod points;

use super::occlusion_options::OcclusionOptions;
use super::photon_options::{LightMethod, PhotonOptions};
use super::run_options::RunOptions;
use super::solve::check_method;
use super::{CliError, refuse, values};
use crate::choice::{Choice, parse};
use crate::solution::CameraView;
use crate::worker::Subject;
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    run: RunOptions,
    /// What is computed: light by radiosity or photon-map, by path tracing as reference, or ambient-occlusion
    #[arg(long, value_name = "METHOD", default_value = Method::default().name(), value_parser = parse::<Method>)]
    method: Method,
    #[command(flatten)]
    photons: PhotonOptions,
    #[command(flatten)]
    occlusion: OcclusionOptions,
    /// Lines of `x y z nx ny nz`; `-` for standard input
    #[arg(long, value_name = "FILE|-", required_unless_present = "spread")]
    points: Option<PathBuf>,
    /// Instead, N points spread by area over all surfaces that light reaches: the same for all methods with this --seed
    #[arg(long, value_name = "N", conflicts_with = "points", value_parser = values::count::<{ MOST_POINTS }>)]
    spread: Option<u32>,
    /// Paths from each point, for --method reference [default: 4096, or as many as --time allows]
    #[arg(long, value_name = "N", value_parser = values::count::<{ u32::MAX }>)]
    samples: Option<u32>,
    /// Print one JSON object and nothing else
    #[arg(long)]
    json: bool,
}

/// Of `--spread`.
const MOST_POINTS: u32 = 1_000_000;

/// What is computed at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    Light(LightMethod),
    /// Light without a bias.
    Reference,
    AmbientOcclusion,
}

impl Default for Method {
    fn default() -> Self {
        Self::Light(LightMethod::default())
    }
}

impl Choice for Method {
    const ALL: &'static [Self] = &[
        Self::Light(LightMethod::Radiosity),
        Self::Light(LightMethod::PhotonMap),
        Self::Reference,
        Self::AmbientOcclusion,
    ];
    const KIND: &'static str = LightMethod::KIND;

    fn name(self) -> &'static str {
        match self {
            Self::Light(method) => method.name(),
            Self::Reference => CameraView::Reference.name(),
            Self::AmbientOcclusion => CameraView::AmbientOcclusion.name(),
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Light(method) => method.label(),
            Self::Reference => CameraView::Reference.label(),
            Self::AmbientOcclusion => CameraView::AmbientOcclusion.label(),
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Light(method) => method.meaning(),
            Self::Reference => CameraView::Reference.meaning(),
            Self::AmbientOcclusion => CameraView::AmbientOcclusion.meaning(),
        }
    }
}

pub fn run(options: &Options) -> Result<(), CliError> {
    options.check();
    let world = options.run.open()?;
    let sensors = match &options.points {
        Some(path) => points::read(path)?,
        None => points::spread(&world, options.spread.unwrap_or_default(), options.run.settings().seed),
    };
    let measured = match options.method {
        Method::Light(LightMethod::Radiosity) => methods::by_radiosity(options, world, &sensors)?,
        Method::Light(LightMethod::PhotonMap) => methods::by_photons(options, world, &sensors)?,
        Method::Reference => methods::by_paths(options, world, &sensors)?,
        Method::AmbientOcclusion => methods::by_occlusion(options, world, &sensors)?,
    };
    measured::print(&measured, options.json)
}

impl Options {
    /// Ends the program, as any other wrong command line does, where an option is about another method.
    fn check(&self) {
        let (run, name) = (&self.run, self.method.name());
        let rays = run.light_rays.map(|_| "--light-rays");
        let samples = self.samples.map(|_| "--samples");
        let stranger = match self.method {
            Method::Light(method) => {
                check_method(method, run, &self.photons);
                self.occlusion.given().or(samples)
            }
            Method::Reference => self.photons.given().or(run.stop_of_radiosity()).or(rays).or(self.occlusion.given()),
            Method::AmbientOcclusion => {
                let time = run.time().map(|_| "--time");
                self.photons.given().or(run.stop_of_radiosity()).or(rays).or(time).or(samples)
            }
        };
        if let Some(option) = stranger {
            refuse(&format!("{option} is not for --method {name}"));
        }
        let view = match self.method {
            Method::Light(_) => None,
            Method::Reference => Some(CameraView::Reference),
            Method::AmbientOcclusion => Some(CameraView::AmbientOcclusion),
        };
        if let Some(view) = view
            && let Some(objection) =
                run.effects.objection(Subject::Camera(view), &run.settings(), &format!("--method {name}"))
        {
            refuse(&objection);
        }
    }
}
