//! What every command that solves takes, and the solving.

use super::effect_options::EffectOptions;
use super::values;
use super::{CliError, warn_of};
use crate::cancel::Cancel;
use crate::choice::{Choice, parse};
use crate::mesh::MeshSettings;
use crate::methods::{FormFactorMethod, Settings, Solver, Step};
use crate::scene::Scene;
use crate::solution::Solution;
use crate::worker::Run;
use crate::world::{World, with_ceiling_light};
use clap::Args;
use std::sync::Arc;
use std::time::Duration;

/// The scene, and how finely it is cut.
#[derive(Args, Debug)]
pub struct SceneOptions {
    /// The path of an OBJ file, or the name of a built-in scene
    scene: String,
    /// Add a ceiling light where the scene has no emitter of its own
    #[arg(long)]
    ceiling_light: bool,
    /// Longest edge of an element, in the scene's units [default: about 8000 elements in all]
    #[arg(long, value_name = "SIZE", value_parser = values::positive)]
    element: Option<f64>,
    /// Every random number comes from this
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub seed: u64,
}

impl SceneOptions {
    /// Opens the scene and prepares it, with patches of so many elements along each edge.
    pub fn open(&self, elements_per_patch_edge: u32) -> Result<Arc<World>, CliError> {
        let mut scene = Scene::open(&self.scene)?;
        if self.ceiling_light && !scene.has_emitter() {
            scene = with_ceiling_light(&scene);
        }
        let world = World::build(scene, &self.mesh(elements_per_patch_edge), &Cancel::default())?;
        warn_of(&world.scene.findings);
        Ok(Arc::new(world))
    }

    pub fn mesh(&self, elements_per_patch_edge: u32) -> MeshSettings {
        MeshSettings { element_size: self.element.map(|size| size as f32), elements_per_patch_edge }
    }
}

/// The scene, how its radiosity is computed, and when to stop.
#[derive(Args, Debug)]
pub struct RunOptions {
    #[command(flatten)]
    scene: SceneOptions,
    /// Stop after this many shots or sweeps
    #[arg(long, value_name = "N", group = "stop")]
    steps: Option<u64>,
    /// Stop after this much solver time; a picture from a camera gets its first sample even if that takes longer
    #[arg(long, value_name = "SECONDS", group = "stop", value_parser = values::positive)]
    time: Option<f64>,
    /// Stop when at most this share of the emitted flux is unshot [default: 0.1]
    #[arg(long, value_name = "PERCENT", group = "stop", value_parser = values::percent)]
    converge: Option<f64>,
    /// How the equations are solved
    #[arg(long, value_name = "SOLVER", default_value = Solver::default().name(), value_parser = parse::<Solver>)]
    solver: Solver,
    /// How form factors are computed
    #[arg(long, value_name = "METHOD", default_value = FormFactorMethod::default().name(), value_parser = parse::<FormFactorMethod>)]
    form_factor: FormFactorMethod,
    /// Let progressive radiosity also shoot what a patch is expected to receive later
    #[arg(long)]
    overshoot: bool,
    /// Elements along the edge of a patch, at most; with 1, every element is a patch
    #[arg(long, value_name = "N", default_value_t = MeshSettings::default().elements_per_patch_edge,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(MeshSettings::MAX_ELEMENTS_PER_PATCH_EDGE)))]
    patch_edge: u32,
    /// Rays that carry the emitted flux (form factors by rays) [default: 8000000]; for views that find
    /// direct light by rays, as `ray-traced`, shadow rays to the emitters at each place that is seen [default: 4]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(Settings::MAX_LIGHT_RAYS)))]
    pub light_rays: Option<u32>,
    /// Cells along the edge of a hemicube's top face
    #[arg(long, value_name = "N", default_value_t = Settings::default().hemicube_resolution, value_parser = values::hemicube_resolution)]
    hemicube: u32,
    /// Visibility rays of a receiver for all the light that is expected there
    #[arg(long, value_name = "N", default_value_t = Settings::default().shadow_rays,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(Settings::MAX_SHADOW_RAYS)))]
    shadow_rays: u32,
    #[command(flatten)]
    pub effects: EffectOptions,
}

/// A scene with its light.
pub struct Solved {
    pub world: Arc<World>,
    pub settings: Settings,
    pub solution: Solution,
}

impl RunOptions {
    pub fn settings(&self) -> Settings {
        let limit = self.converge.map_or(Settings::default().unshot_limit, |percent| percent / 100.0);
        Settings {
            mesh: self.scene.mesh(self.patch_edge),
            // A run that ends by a count or by the clock does not end before.
            unshot_limit: if self.steps.is_some() || self.time.is_some() { 0.0 } else { limit },
            shadow_rays: self.shadow_rays,
            solver: self.solver,
            form_factor: self.form_factor,
            overshoot: self.overshoot,
            light_rays: self.light_rays.unwrap_or(Settings::default().light_rays),
            hemicube_resolution: self.hemicube,
            seed: self.scene.seed,
            effects: self.effects.switches(),
            ..Settings::default()
        }
    }

    /// Whether nothing is said of how light is computed.
    pub fn is_plain(&self) -> bool {
        let Settings { seed, effects, unshot_limit, .. } = self.settings();
        self.settings() == Settings { seed, effects, unshot_limit, ..Settings::default() } && self.light_rays.is_none()
    }

    /// The solver time after which a run ends.
    pub fn time(&self) -> Option<Duration> {
        // More seconds than a duration holds are no limit.
        self.time.map(|seconds| Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX))
    }

    /// Why these options do not lead to radiosity, if they do not.
    pub fn objection_by_radiosity(&self) -> Option<String> {
        let few = self.light_rays.filter(|&rays| rays < Settings::MIN_LIGHT_RAYS);
        few.map(|_| format!("radiosity takes --light-rays of {} or more", Settings::MIN_LIGHT_RAYS))
    }

    /// An option that says when radiosity stops and nothing else.
    pub fn stop_of_radiosity(&self) -> Option<&'static str> {
        let steps = self.steps.map(|_| "--steps");
        steps.or(self.converge.map(|_| "--converge"))
    }

    /// Opens the scene and prepares it.
    pub fn open(&self) -> Result<Arc<World>, CliError> {
        self.scene.open(self.patch_edge)
    }

    /// Runs radiosity in the opened scene until it should stop.
    pub fn solve_in(&self, world: Arc<World>, settings: Settings) -> Result<Solved, CliError> {
        let mut run = Run::start(world.clone(), &settings)?;
        run_until(&mut run, self.steps.unwrap_or(u64::MAX), self.time().unwrap_or(Duration::MAX));
        let mut solution = run.solution();
        // However it ended, this says whether it would have ended by itself.
        solution.converged = solution.unshot_share <= Settings::default().unshot_limit.max(settings.unshot_limit);
        Ok(Solved { world, settings, solution })
    }
}

/// Takes steps until there are so many, until they took so long or until the run has converged.
fn run_until(run: &mut Run, steps: u64, time: Duration) {
    let mut steps_left = steps;
    while steps_left > 0 && run.elapsed() < time {
        match run.step(&Cancel::default()) {
            Step::Prepared => {}
            Step::Advanced => steps_left -= 1,
            Step::Converged | Step::Cancelled => break,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::ManualTime;

    #[test]
    fn a_run_ends_with_its_steps_or_its_time() {
        let scene = Scene::open("furnace").expect("a built-in scene");
        let settings = Settings { unshot_limit: 0.0, ..Settings::default() };
        let world = Arc::new(World::build(scene, &settings.mesh, &Cancel::default()).expect("a world"));
        for (steps, seconds, done) in [(u64::MAX, 5, 5), (3, 5, 3), (u64::MAX, 0, 0), (0, 5, 0)] {
            // Every step takes a second.
            let clock = ManualTime::ticking(Duration::from_secs(1));
            let mut run = Run::start(world.clone(), &settings).expect("enough memory").with_clock(clock);
            run_until(&mut run, steps, Duration::from_secs(seconds));
            assert_eq!(run.solution().steps, done);
        }
    }
}
