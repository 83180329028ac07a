//! `lightwell probe`: the irradiance at points, by a method or as it truly is, or the share of ambient light that arrives.

mod budget;
mod measured;
mod methods;
mod points;

use super::judge::Judge;
use super::occlusion_options::OcclusionOptions;
use super::photon_options::{LightMethod, PhotonOptions};
use super::run_options::RunOptions;
use super::solve::check_method;
use super::{CliError, refuse, values};
use crate::accuracy::{self, Found};
use crate::choice::{Choice, parse};
use crate::effects::{Effect, needed};
use crate::methods::image::Meters;
use crate::methods::{ImageSettings, OcclusionSettings, Settings};
use crate::solution::CameraView;
use crate::worker::Subject;
use crate::world::World;
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
pub struct Options {
    #[command(flatten)]
    run: RunOptions,
    /// What is computed: light by radiosity or photon-map; as the views radiosity-direct, final-gather, caustics or diffuse-ao
    /// show it; by path tracing as reference; or ambient-occlusion [default: radiosity, or with --error, or --time, what tells its own
    /// error]
    #[arg(long, value_name = "METHOD", value_parser = parse::<Method>)]
    method: Option<Method>,
    /// Choose how many paths from each point: the fewest whose error is at most this share of the mean irradiance of the points.
    /// With --time instead, and no --method, as many as there are in this time in all
    #[arg(long, value_name = "PERCENT", conflicts_with_all = ["steps", "converge"], value_parser = values::percent)]
    error: Option<f64>,
    #[command(flatten)]
    photons: PhotonOptions,
    #[command(flatten)]
    occlusion: OcclusionOptions,
    /// Lines of `x y z nx ny nz`, in the coordinates of the scene's file; `-` for standard input
    #[arg(long, value_name = "FILE|-", required_unless_present_any = ["spread", "accuracy"])]
    points: Option<PathBuf>,
    /// Instead, N points spread by area over all surfaces that light reaches: always the same of a scene
    #[arg(long, value_name = "N", conflicts_with = "points", value_parser = values::count::<{ MOST_POINTS }>)]
    spread: Option<u32>,
    /// Instead, the points where errors are measured, and how far off the method is there, against a path-traced reference
    /// that is kept for the next time
    #[arg(long, conflicts_with_all = ["points", "spread"])]
    accuracy: bool,
    /// Paths from each point, for --method reference [default: 4096, or as many as --time allows], or samples of a view
    /// [default: 16, or as many as --time allows]
    #[arg(long, value_name = "N", value_parser = values::count::<{ u32::MAX }>)]
    samples: Option<u32>,
    /// Diffuse rays of a sample, for --method final-gather [default: 64]
    #[arg(long, value_name = "N", value_parser = values::count::<{ ImageSettings::MAX_GATHER_RAYS }>)]
    gather_rays: Option<u32>,
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
    /// Light as pictures of a view show it: one of [`Meters::VIEWS`].
    View(CameraView),
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
        Self::View(Meters::VIEWS[0]),
        Self::View(Meters::VIEWS[1]),
        Self::View(Meters::VIEWS[2]),
        Self::View(Meters::VIEWS[3]),
        Self::Reference,
        Self::AmbientOcclusion,
    ];
    const KIND: &'static str = LightMethod::KIND;

    fn name(self) -> &'static str {
        match self {
            Self::Light(method) => method.name(),
            Self::View(view) => view.name(),
            Self::Reference => CameraView::Reference.name(),
            Self::AmbientOcclusion => CameraView::AmbientOcclusion.name(),
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Light(method) => method.label(),
            Self::View(view) => view.label(),
            Self::Reference => CameraView::Reference.label(),
            Self::AmbientOcclusion => CameraView::AmbientOcclusion.label(),
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Light(method) => method.meaning(),
            Self::View(view) => view.meaning(),
            Self::Reference => CameraView::Reference.meaning(),
            Self::AmbientOcclusion => CameraView::AmbientOcclusion.meaning(),
        }
    }
}

pub fn run(options: &Options) -> Result<(), CliError> {
    let budget = options.budget();
    if budget.is_none() {
        options.check();
    }
    let world = options.run.open()?;
    let mut judge = options.accuracy.then(|| Judge::new(world.clone()));
    let points = match (&options.points, &judge) {
        (Some(path), _) => points::read(path, &world.scene)?,
        (None, Some(judge)) => judge.points().to_vec(),
        (None, None) => accuracy::spread(&world, options.spread.unwrap_or_default() as usize),
    };
    if let Some(budget) = budget {
        points::tell_missing(&world, &points);
        let (measured, account) = budget::measure(&budget, options, world.clone(), &points)?;
        return measured::print(&world, &measured, None, Some(&account), options.json);
    }
    if options.method().is_in_the_air() {
        points::tell_missing(&world, &points);
    }
    if let Some(missing) = options.method().missing_light(&world) {
        eprintln!("{missing}");
    }
    let measured = match options.method() {
        Method::Light(LightMethod::Radiosity) => methods::by_radiosity(options, world.clone(), &points)?,
        Method::Light(LightMethod::PhotonMap) => methods::by_photons(options, world.clone(), &points)?,
        Method::View(view) => methods::by_view(options, view, world.clone(), &points)?,
        Method::Reference => methods::by_paths(options, world.clone(), &points)?,
        Method::AmbientOcclusion => methods::by_occlusion(options, world.clone(), &points)?,
    };
    let found = || Found { irradiance: measured.iter().map(|measured| measured.value).collect(), variance: None };
    let verdict = judge.as_mut().map(|judge| judge.verdict(&found()));
    measured::print(&world, &measured, verdict.as_ref(), None, options.json)
}

impl Options {
    fn method(&self) -> Method {
        self.method.unwrap_or_default()
    }

    /// Those with which a view is made: its rays to the emitters are its own.
    fn settings_of_view(&self) -> Settings {
        let default = ImageSettings::default();
        let image = ImageSettings {
            light_rays: self.run.light_rays.unwrap_or(default.light_rays),
            gather_rays: self.gather_rays.unwrap_or(default.gather_rays),
            ..default
        };
        Settings {
            light_rays: Settings::default().light_rays,
            photons: self.photons.settings(),
            image,
            occlusion: self.occlusion.settings(OcclusionSettings::default().rays),
            ..self.run.settings()
        }
    }

    /// Ends the program, as any other wrong command line does, where an option is about another method.
    fn check(&self) {
        if let Method::Light(method) = self.method() {
            check_method(method, &self.run, &self.photons);
        }
        let name = self.method().name();
        if let Some(option) = self.stranger() {
            refuse(&format!("{option} is not for --method {name}"));
        }
        let Some(view) = self.method().view() else { return };
        if self.run.light_rays.is_some_and(|rays| rays > ImageSettings::MAX_LIGHT_RAYS) {
            refuse(&format!("--method {name} takes up to {} --light-rays", ImageSettings::MAX_LIGHT_RAYS));
        }
        let subject = Subject::Camera(view);
        let objection = self.run.effects.objection(subject, &self.run.settings(), &format!("--method {name}"));
        if let Some(objection) = objection {
            refuse(&objection);
        }
    }

    /// An option that the method has no use for.
    fn stranger(&self) -> Option<&'static str> {
        let unless = |is_used: bool, option: Option<&'static str>| option.filter(|_| !is_used);
        let view = self.method().view();
        let is_light = matches!(self.method(), Method::Light(_));
        let is_share = self.method() == Method::AmbientOcclusion;
        let is_read = matches!(self.method(), Method::View(_) | Method::Reference);
        let shows = |used: fn(CameraView) -> bool| view.is_some_and(used);
        unless(is_light || shows(CameraView::needs_photons), self.photons.given())
            .or(unless(is_light || shows(CameraView::needs_radiosity), self.run.stop_of_radiosity()))
            .or(unless(is_light || shows(CameraView::samples_emitters), self.run.light_rays.map(|_| "--light-rays")))
            .or(unless(shows(CameraView::gathers), self.gather_rays.map(|_| "--gather-rays")))
            .or(unless(shows(CameraView::is_occluded), self.occlusion.given()))
            .or(unless(!is_share, self.accuracy.then_some("--accuracy")))
            .or(unless(is_read, self.samples.map(|_| "--samples")))
            .or(unless(is_light || is_read, self.run.time().map(|_| "--time")))
    }
}

impl Method {
    /// What is said of light that the method does not know, where the scene has such light.
    fn missing_light(self, world: &World) -> Option<String> {
        let knows_caustics = match self {
            Self::Light(LightMethod::Radiosity) => false,
            Self::Light(LightMethod::PhotonMap) | Self::Reference | Self::AmbientOcclusion => true,
            Self::View(view) => view.needs_photons(),
        };
        let is_missing = !knows_caustics && needed(world).contains(Effect::Caustics);
        is_missing.then(|| {
            format!(
                "note: --method {} leaves out light that reaches a point over mirrors, gloss or glass, of which this scene may \
                 have some, and all light inside of glass; photon-map, final-gather and reference know it",
                self.name()
            )
        })
    }

    /// Whether it measures where no surface is, too.
    fn is_in_the_air(self) -> bool {
        matches!(self, Self::Light(LightMethod::Radiosity) | Self::Reference)
    }

    /// The view whose effects it simulates.
    fn view(self) -> Option<CameraView> {
        match self {
            Self::Light(_) => None,
            Self::View(view) => Some(view),
            Self::Reference => Some(CameraView::Reference),
            Self::AmbientOcclusion => Some(CameraView::AmbientOcclusion),
        }
    }
}
