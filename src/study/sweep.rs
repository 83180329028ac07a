//! A study of one scene: which recipes are tried, in which order, and what came of them.

use super::attempt::{Outcome, Price, Verdict, attempt};
use super::bench::Bench;
use super::knob::{Gain, gains};
use super::recipe::{Recipe, Way};
use crate::accuracy::{Error, Offer, Truth, front, level_from, slope_at_end};
use crate::cancel::Cancel;
use crate::choice::Choice;
use crate::errors::with_causes;
use crate::mesh::MeshSettings;
use crate::methods::{FormFactorMethod, ImageSettings, OcclusionSettings, PhotonSettings, Settings, Solver};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Share of the budget for all recipes; the rest goes to the truth, which all of them share.
const RECIPES: f64 = 0.7;
/// Share of it that path tracing gets, which is never done.
const PATHS: f64 = 0.15;
/// A recipe may take at most this share of the time that is left for all, and so many times a fair one: most need far less.
const AT_MOST: f64 = 0.2;
const FAIR_SHARES: f64 = 4.0;

/// An outcome and how far off it is.
#[derive(Clone, Debug)]
pub struct Measured {
    /// Which of the runs it belongs to, from 0.
    pub run: usize,
    pub recipe: Recipe,
    pub is_finished: bool,
    pub price: Price,
    pub error: Error,
}

/// What a study has found.
#[derive(Clone, Debug, Default)]
pub struct Study {
    /// Run by run, each in the order of time.
    pub measured: Vec<Measured>,
    /// Indices of those that no other beats, from the cheapest to the dearest.
    pub front: Vec<usize>,
    /// For each way whose errors fall with its samples or passes, with which exponent over time.
    pub slopes: Vec<(Way, f64)>,
    /// Of each run of radiosity whose error levelled off: the first outcome that was as good as its last.
    pub levels: Vec<usize>,
    pub gains: Vec<Gain>,
    pub truth: Arc<Truth>,
    /// Recipes that could not be followed, with the reason.
    pub refused: Vec<(Recipe, String)>,
    pub elapsed: Duration,
    /// Threads that all ran on.
    pub threads: usize,
}

/// How far a study is.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Recipes that are done, of so many.
    pub done: usize,
    pub of: usize,
    pub recipe: Option<&'a Recipe>,
}

/// Tries recipes on a scene until `end`, and keeps in mind what they cost; ends at once where there is no light. `tell` hears how
/// far it is.
pub fn study(
    bench: &mut Bench,
    settings: &Settings,
    [start, end]: [Instant; 2],
    cancel: &Cancel,
    tell: &mut dyn FnMut(&Progress<'_>),
) -> Study {
    if !bench.world().census.light_may_arrive {
        return Study { elapsed: start.elapsed(), ..Study::default() };
    }
    let budget = end.saturating_duration_since(start);
    let end_of_recipes = start + budget.mul_f64(RECIPES);
    let end_of_sweep = end_of_recipes - budget.mul_f64(PATHS);
    let recipes = recipes(bench, settings);
    let mut outcomes: Vec<(usize, Outcome)> = Vec::new();
    let mut refused = Vec::new();
    for (run, recipe) in recipes.iter().enumerate() {
        tell(&Progress { done: run, of: recipes.len(), recipe: Some(recipe) });
        let now = Instant::now();
        let is_last = run + 1 == recipes.len();
        let share = (FAIR_SHARES / (recipes.len() - run) as f64).min(AT_MOST);
        let until = if is_last {
            // Whatever others have overdrawn: its slope is what one knows beforehand.
            end_of_recipes.max(now + budget.mul_f64(PATHS)).min(end)
        } else {
            now + left(now, end_of_sweep).mul_f64(share)
        };
        let tried = attempt(bench, recipe, until, cancel, &mut |outcome| {
            outcomes.push((run, Outcome { light: None, ..outcome }));
            Verdict::Continue(())
        });
        if let Err(reason) = tried {
            refused.push((*recipe, with_causes(&reason)));
        }
    }
    tell(&Progress { done: recipes.len(), of: recipes.len(), recipe: None });
    bench.refine_until(end, cancel);
    let mut study = judged(&outcomes, bench.reference.truth());
    for run in study.measured.iter().filter(|run| run.is_finished) {
        bench.memory.note(run.recipe, &run.price, run.error.rms);
    }
    study.refused = refused;
    study.elapsed = start.elapsed();
    study.threads = rayon::current_num_threads();
    study
}

fn left(now: Instant, end: Instant) -> Duration {
    end.saturating_duration_since(now)
}

/// Outcomes held against the truth, and what follows from them.
fn judged(outcomes: &[(usize, Outcome)], truth: &Arc<Truth>) -> Study {
    let measure = |(run, outcome): &(usize, Outcome)| {
        let Outcome { recipe, is_finished, price, ref found, .. } = *outcome;
        Some(Measured { run: *run, recipe, is_finished, price, error: truth.error(found)? })
    };
    let measured: Vec<Measured> = outcomes.iter().filter_map(measure).collect();
    let offers: Vec<Offer> = measured.iter().map(Measured::offer).collect();
    let finished: Vec<&Measured> = measured.iter().filter(|measured| measured.is_finished).collect();
    Study {
        front: front(&offers),
        slopes: Way::ALL.iter().filter_map(|&way| Some((way, slope_of(way, &measured)?))).collect(),
        levels: levels(&measured),
        gains: gains(&finished),
        truth: truth.clone(),
        measured,
        ..Study::default()
    }
}

impl Measured {
    pub fn offer(&self) -> Offer {
        Offer { seconds: self.price.seconds, error: self.error.rms }
    }

    /// The last of its run.
    pub fn is_last(&self, all: &[Self]) -> bool {
        let last = all.iter().rfind(|other| other.run == self.run);
        last.is_some_and(|last| last.price == self.price)
    }
}

/// Of the longest run of a way that has nothing to prepare.
fn slope_of(way: Way, measured: &[Measured]) -> Option<f64> {
    if !matches!(way, Way::PhotonMap | Way::DiffuseAo | Way::Reference) {
        return None;
    }
    let of_run = |run: usize| -> Vec<Offer> {
        let of_run = measured.iter().filter(|measured| measured.run == run && measured.recipe.way == way);
        of_run.map(Measured::offer).collect()
    };
    let runs = measured.iter().map(|measured| measured.run).max()? + 1;
    let longest = (0..runs).map(of_run).max_by_key(Vec::len)?;
    slope_at_end(&longest)
}

/// Of runs of radiosity, which tend to the bias of their mesh and of their form factors.
fn levels(measured: &[Measured]) -> Vec<usize> {
    let mut levels = Vec::new();
    let mut start = 0;
    for run in measured.chunk_by(|one, next| one.run == next.run) {
        let offers: Vec<Offer> = run.iter().map(Measured::offer).collect();
        if run[0].recipe.way == Way::Radiosity {
            levels.extend(level_from(&offers).map(|since| start + since));
        }
        start += run.len();
    }
    levels
}

/// What is tried: around the defaults, one knob at a time, the cheap before the dear, and paths last.
fn recipes(bench: &Bench, settings: &Settings) -> Vec<Recipe> {
    let automatic = bench.world().element_size;
    let element = |times: f32| {
        let mesh = MeshSettings { element_size: Some(automatic * times), ..settings.mesh };
        Settings { mesh, ..*settings }
    };
    let base = element(2.0);
    let photons = |count: u32| {
        let photons = PhotonSettings { count, caustic_count: count, is_progressive: false, ..settings.photons };
        Settings { photons, ..*settings }
    };
    let radiosity = |settings: Settings| Recipe { way: Way::Radiosity, settings };
    let mut recipes: Vec<Recipe> = Vec::new();
    recipes.extend([4.0, 2.0].map(|times| radiosity(element(times))));
    recipes.extend([25_000, 50_000, 100_000].map(|count| Recipe { way: Way::PhotonMap, settings: photons(count) }));
    recipes.extend(of_views(settings, &element, &photons));
    recipes.extend(of_form_factors(&base).map(radiosity));
    recipes.push(radiosity(Settings { unshot_limit: 10.0 * settings.unshot_limit, ..base }));
    recipes.extend(
        [Solver::Jacobi, Solver::GaussSeidel, Solver::Southwell].map(|solver| radiosity(Settings { solver, ..base })),
    );
    recipes.extend(of_estimates(&photons(100_000)).map(|settings| Recipe { way: Way::PhotonMap, settings }));
    recipes.extend(
        [4.0, 1.0].map(|times| radiosity(Settings { form_factor: FormFactorMethod::Centroid, ..element(times) })),
    );
    recipes.extend([1.0, 0.5].map(|times| radiosity(element(times))));
    recipes.extend([200_000, 400_000, 800_000].map(|count| Recipe { way: Way::PhotonMap, settings: photons(count) }));
    let progressive = PhotonSettings { is_progressive: true, passes: 1 << 10, ..photons(50_000).photons };
    recipes.push(Recipe { way: Way::PhotonMap, settings: Settings { photons: progressive, ..*settings } });
    recipes.push(Recipe { way: Way::Reference, settings: *settings });
    recipes
}

fn of_views(settings: &Settings, element: &dyn Fn(f32) -> Settings, photons: &dyn Fn(u32) -> Settings) -> Vec<Recipe> {
    let samples = 64;
    let image = ImageSettings { samples, ..settings.image };
    let direct = |times: f32, light_rays: u32| Recipe {
        way: Way::RadiosityDirect,
        settings: Settings { image: ImageSettings { light_rays, ..image }, ..element(times) },
    };
    let gather = |gather_rays: u32| Recipe {
        way: Way::FinalGather,
        settings: Settings { image: ImageSettings { gather_rays, ..image }, ..photons(100_000) },
    };
    let occlusion = |rays: u32| Recipe {
        way: Way::DiffuseAo,
        settings: Settings { image, occlusion: OcclusionSettings { rays, ..settings.occlusion }, ..*settings },
    };
    vec![
        occlusion(8),
        occlusion(16),
        direct(4.0, 4),
        direct(2.0, 4),
        direct(2.0, 8),
        direct(1.0, 4),
        gather(16),
        gather(32),
        gather(64),
    ]
}

/// Other ways to form factors than that of `base`, and other numbers for each.
fn of_form_factors(base: &Settings) -> impl Iterator<Item = Settings> {
    let by = |form_factor| Settings { form_factor, ..*base };
    let rays = |light_rays| Settings { light_rays, ..by(FormFactorMethod::Rays) };
    let cells = |hemicube_resolution| Settings { hemicube_resolution, ..by(FormFactorMethod::Hemicube) };
    let base = *base;
    [
        by(FormFactorMethod::Centroid),
        by(FormFactorMethod::Disc),
        Settings { shadow_rays: base.shadow_rays / 2, ..base },
        Settings { shadow_rays: 2 * base.shadow_rays, ..base },
        rays(base.light_rays / 4),
        rays(base.light_rays),
        cells(base.hemicube_resolution / 2),
        cells(base.hemicube_resolution),
    ]
    .into_iter()
}

/// The same photons read off in other ways.
fn of_estimates(base: &Settings) -> impl Iterator<Item = Settings> {
    let with = |photons: PhotonSettings| Settings { photons, ..*base };
    let nearest = base.photons.nearest;
    [
        with(PhotonSettings { nearest: nearest / 2, ..base.photons }),
        with(PhotonSettings { nearest: 2 * nearest, ..base.photons }),
        with(PhotonSettings { nearest: 4 * nearest, ..base.photons }),
    ]
    .into_iter()
}
