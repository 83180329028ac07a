//! One recipe followed to its end, or until time is up, and measured on its way.

use super::bench::Bench;
use super::lit::{Light, bytes_of_photons, bytes_of_radiosity, light_of, trace_pass};
use super::recipe::{Recipe, Way};
use crate::accuracy::{Found, ProbePoint, by_photons, by_radiosity, surfaces};
use crate::cancel::Cancel;
use crate::methods::image::Meters;
use crate::methods::path_trace::{Sensor, Sensors};
use crate::methods::photon_map::{ProgressivePoints, Which};
use crate::methods::transport::Transport;
use crate::methods::{ImageSettings, PhotonSettings, Settings, Step};
use crate::solution::Solution;
use crate::worker::{Methods, PhotonRun, Refused, Run, Workshop};
use crate::world::{World, WorldError};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A run is measured again when it has taken so many times as long.
const PACE: f64 = 1.4;

/// Where a run stood at one moment.
#[derive(Clone)]
pub struct Outcome {
    /// With the passes, samples or unshot light that there were by then.
    pub recipe: Recipe,
    /// Whether the recipe was followed to its end.
    pub is_finished: bool,
    pub price: Price,
    pub found: Found,
    /// Light that is everywhere, where it is.
    pub light: Option<Light>,
}

/// What a run took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Price {
    /// Of the solver.
    pub seconds: f64,
    /// From the cutting of the mesh to the measuring of the error.
    pub all_seconds: f64,
    pub rays: u64,
    /// Memory that it held besides the scene.
    pub bytes: u64,
}

/// Whether a recipe is followed any further.
pub type Verdict = ControlFlow<()>;

/// Why a recipe cannot be followed.
#[derive(Debug, thiserror::Error)]
pub enum CannotTry {
    #[error(transparent)]
    World(#[from] WorldError),
    #[error(transparent)]
    Refused(#[from] Refused),
}

/// Follows a recipe until its end or until `end`, and hands out what it found at the truth's points: on its way whenever the
/// time has grown by a good part or the samples have doubled, and at last. `note` may end it before.
///
/// # Errors
/// If the scene cannot be cut so finely, or there is not enough memory.
pub fn attempt(
    bench: &mut Bench,
    recipe: &Recipe,
    end: Instant,
    cancel: &Cancel,
    note: &mut dyn FnMut(Outcome) -> Verdict,
) -> Result<(), CannotTry> {
    let settings = &recipe.settings;
    let points = bench.reference.points().clone();
    let mut trial = Trial { recipe, points: &points, start: Instant::now(), end, cancel, note };
    match recipe.way {
        Way::Radiosity => {
            let world = bench.worlds.remeshed(&settings.mesh, cancel)?;
            trial.radiosity(&world)?;
        }
        Way::RadiosityDirect => {
            let world = bench.worlds.remeshed(&settings.mesh, cancel)?;
            trial.view(&world)?;
        }
        Way::PhotonMap => trial.photons(bench.world())?,
        Way::FinalGather | Way::DiffuseAo => trial.view(bench.world())?,
        Way::Reference => trial.paths(bench.world()),
    }
    Ok(())
}

/// A recipe in the making.
struct Trial<'a> {
    recipe: &'a Recipe,
    points: &'a [ProbePoint],
    start: Instant,
    end: Instant,
    cancel: &'a Cancel,
    note: &'a mut dyn FnMut(Outcome) -> Verdict,
}

impl Trial<'_> {
    fn has_time(&self) -> bool {
        Instant::now() < self.end && !self.cancel.is_requested()
    }

    fn price(&self, elapsed: Duration, rays: u64, bytes: u64) -> Price {
        let [seconds, all_seconds] = [elapsed, self.start.elapsed()].map(|time| time.as_secs_f64());
        Price { seconds, all_seconds, rays, bytes }
    }

    /// Hands out what was found by now, with so many samples a place.
    fn tell_samples(&mut self, samples: u32, price: Price, found: Found) -> Verdict {
        let settings = self.recipe.settings;
        let image = ImageSettings { samples, ..settings.image };
        let recipe = Recipe { settings: Settings { image, ..settings }, ..*self.recipe };
        (self.note)(Outcome { recipe, is_finished: true, price, found, light: None })
    }

    /// Runs radiosity and hands out its states.
    fn radiosity(&mut self, world: &Arc<World>) -> Result<(), Refused> {
        let settings = self.recipe.settings;
        let mut run = Run::start(world.clone(), &settings)?;
        let mut next = Duration::ZERO;
        loop {
            let step = run.step(self.cancel);
            let is_finished = step == Step::Converged;
            let is_over = is_finished || step == Step::Cancelled || !self.has_time();
            let is_due = step == Step::Advanced && run.elapsed() >= next;
            if !(is_over || is_due) {
                continue;
            }
            next = run.elapsed().mul_f64(PACE);
            let solution = Arc::new(run.solution());
            let is_told_enough = solution.steps > 0 && self.tell_radiosity(world, &solution, is_finished).is_break();
            if is_over || is_told_enough {
                return Ok(());
            }
        }
    }

    /// Hands out a state of radiosity. A run that is stopped is as good as one that was to stop there.
    fn tell_radiosity(&mut self, world: &Arc<World>, solution: &Arc<Solution>, is_finished: bool) -> Verdict {
        let settings = self.recipe.settings;
        let found = by_radiosity(world, solution, self.points, settings.seed);
        let unshot_limit = if is_finished { settings.unshot_limit } else { solution.unshot_share };
        let price = self.price(solution.elapsed, solution.counters.rays, bytes_of_radiosity(world, &settings));
        (self.note)(Outcome {
            recipe: Recipe { settings: Settings { unshot_limit, ..settings }, ..*self.recipe },
            is_finished,
            price,
            found,
            light: Some(Light::Radiosity(world.clone(), solution.clone())),
        })
    }

    fn photons(&mut self, world: &Arc<World>) -> Result<(), Refused> {
        let settings = self.recipe.settings;
        let mut run = PhotonRun::of(Methods::default().photons(world, &settings)?);
        let mut means: Option<ProgressivePoints> = None;
        let mut reading = Duration::ZERO;
        let mut rays = 0;
        let passes = if settings.photons.is_progressive { settings.photons.passes } else { 1 };
        let mut next = 1;
        for pass in 1..=passes {
            if !trace_pass(&mut run, self.end, self.cancel) {
                return Ok(());
            }
            let start = Instant::now();
            let maps = run.method().maps();
            let found = if settings.photons.is_progressive {
                let means =
                    means.get_or_insert_with(|| ProgressivePoints::new(surfaces(maps.transport(), self.points)));
                means.add(&maps, Which::All);
                Found::of_samples(means.irradiance())
            } else {
                by_photons(&maps, self.points)
            };
            reading += start.elapsed();
            let solution = run.solution();
            rays += solution.counters.rays;
            if pass < next && pass != passes {
                continue;
            }
            next = (PACE * f64::from(pass)).ceil() as u32;
            let photons = PhotonSettings { passes: pass, ..settings.photons };
            let price = self.price(run.elapsed() + reading, rays, bytes_of_photons(&maps));
            let verdict = (self.note)(Outcome {
                recipe: Recipe { settings: Settings { photons, ..settings }, ..*self.recipe },
                is_finished: true,
                price,
                found,
                light: Some(Light::Photons(world.clone(), Arc::new(solution))),
            });
            if verdict.is_break() {
                return Ok(());
            }
        }
        Ok(())
    }

    /// As a view shows light, whose own light is found first.
    fn view(&mut self, world: &Arc<World>) -> Result<(), Refused> {
        let Some(view) = self.recipe.way.view() else { return Ok(()) };
        let start = Instant::now();
        let settings = &self.recipe.settings;
        let Some(lit) = light_of(world, view, settings, self.end, self.cancel)? else { return Ok(()) };
        let surfaces = surfaces(&lit.sources.transport, self.points);
        let Some(mut meters) = Meters::new(&lit.sources, view, surfaces, settings) else { return Ok(()) };
        while meters.samples() < settings.image.samples && self.has_time() && meters.step(self.cancel) {
            let samples = meters.samples();
            if samples.is_power_of_two() || samples == settings.image.samples {
                let price = self.price(start.elapsed(), lit.rays + meters.rays(), lit.bytes);
                if self.tell_samples(samples, price, Found::of_readings(&meters.readings())).is_break() {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    fn paths(&mut self, world: &Arc<World>) {
        let settings = self.recipe.settings;
        let start = Instant::now();
        let transport = Arc::new(Transport::new(world.clone(), settings.effects));
        let sensors = self.points.iter().map(|at| Sensor::new(&transport, at.point, at.normal)).collect();
        let mut sensors = Sensors::new(transport.clone(), sensors, settings.seed);
        let mut step = 1;
        while self.has_time() && sensors.step(step, self.cancel) {
            // As many again as there are: the points of a power of two are spread best.
            step = sensors.paths() / Sensors::REPLICATES as u64;
            let elapsed = start.elapsed();
            let samples = u32::try_from(sensors.paths()).unwrap_or(u32::MAX);
            let price = self.price(elapsed, sensors.rays(), 0);
            let verdict = self.tell_samples(samples, price, Found::of_samples(&sensors.irradiance()));
            // The next one would take as long as all before.
            if verdict.is_break() || Instant::now() + elapsed > self.end {
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::{Offer, level_from};
    use crate::mesh::MeshSettings;
    use crate::methods::FormFactorMethod;
    use crate::scene::Scene;

    /// The states of a run of radiosity that is solved far beyond its bias.
    fn states(bench: &mut Bench, form_factor: FormFactorMethod) -> Vec<Offer> {
        let mesh = MeshSettings { element_size: Some(0.05), ..MeshSettings::default() };
        let settings = Settings { mesh, form_factor, unshot_limit: 1e-5, ..Settings::default() };
        let (mut states, truth) = (Vec::new(), bench.reference.truth().clone());
        let end = Instant::now() + Duration::from_secs(300);
        let recipe = Recipe { way: Way::Radiosity, settings };
        attempt(bench, &recipe, end, &Cancel::default(), &mut |outcome| {
            let error = truth.error(&outcome.found).expect("light").rms;
            // Rays in place of seconds, which other programs make longer.
            states.push(Offer { seconds: outcome.price.rays as f64, error });
            Verdict::Continue(())
        })
        .expect("a run");
        states
    }

    #[test]
    fn rough_form_factors_level_off_at_a_bias_of_their_own() {
        let scene = Scene::open("cornell-box").expect("a built-in scene");
        let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
        let mut bench = Bench::open(Arc::new(world), MeshSettings::default(), None);
        (0..16).for_each(|_| assert!(bench.reference.refine(&Cancel::default())));
        let [rough, exact] =
            [FormFactorMethod::Centroid, FormFactorMethod::Polygon].map(|method| states(&mut bench, method));
        let level = level_from(&rough).expect("a level");
        let [first, last] = [rough[0].error, rough[rough.len() - 1].error];
        assert!(level > 0 && last < first / 2.0, "{rough:?}");
        // Elements are as coarse for both: what lies between is the form factors' own.
        let of_exact = exact[exact.len() - 1].error;
        assert!(last > of_exact, "{last} {of_exact}");
    }
}
