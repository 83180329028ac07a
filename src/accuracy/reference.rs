//! The truth about a scene at points that are always the same: found by path tracing, and never finished, only good enough.

use super::cache::{Cache, Key};
use super::error::Error;
use super::found::Found;
use super::points::{ProbePoint, spread};
use crate::cancel::Cancel;
use crate::effects::Switches;
use crate::math::stats::Moments;
use crate::methods::path_trace::{Sensor, Sensors};
use crate::methods::transport::Transport;
use crate::world::World;
use std::sync::Arc;

/// Every random number of the truth comes from this, whatever the seed of what is held against it.
const SEED: u64 = 0x0074_7275_7468;

/// Paths from each of the points, none of which has met any light in a scene that has none.
const DARK: u64 = 512;

/// Irradiance at points that are spread by area over all surfaces that light reaches, in the making: plain state and a step.
///
/// All effects that the scene calls for are in it, also those that a solution leaves out: that is a part of its error.
pub struct Reference {
    key: Key,
    points: Arc<[ProbePoint]>,
    sensors: Sensors,
    truth: Arc<Truth>,
}

impl Reference {
    /// So many points tell the root of a mean square to a few percent, whatever the shape of the errors.
    pub const POINTS: usize = 1024;

    /// Of a world before its first step.
    pub fn new(world: Arc<World>) -> Self {
        let points: Arc<[ProbePoint]> = spread(&world, Self::POINTS).into();
        let key = Key::of(&world.scene, &points);
        let transport = Arc::new(Transport::new(world, Switches::default()));
        let sensors = points.iter().map(|at| Sensor::new(&transport, at.point, at.normal)).collect();
        let sensors = Sensors::new(transport.clone(), sensors, SEED);
        Self { key, points, truth: Arc::new(Truth::of(&sensors)), sensors }
    }

    /// The same, going on from what is kept of this scene, if anything is.
    pub fn open(world: Arc<World>, cache: Option<&Cache>) -> Self {
        let mut reference = Self::new(world);
        if let Some((paths, sums)) = cache.and_then(|cache| cache.load(&reference.key))
            && reference.sensors.go_on_from(paths, sums)
        {
            reference.truth = Arc::new(Truth::of(&reference.sensors));
        }
        reference
    }

    /// Keeps what is known for the next time.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep(&self, cache: &Cache) -> Result<(), super::CacheError> {
        let (paths, sums) = self.sensors.found();
        cache.store(&self.key, paths, sums)
    }

    /// Of the scene and its points, for what else is kept of it.
    pub fn key(&self) -> &Key {
        &self.key
    }

    /// Whether it is about a world like this one, whatever its mesh.
    pub fn is_about(&self, world: &World) -> bool {
        self.key.is_of(&world.scene)
    }

    /// One path more from each point in each of the independent estimates, or nothing if stopped.
    pub fn refine(&mut self, cancel: &Cancel) -> bool {
        let is_finer = self.sensors.step(1, cancel);
        if is_finer {
            self.truth = Arc::new(Truth::of(&self.sensors));
        }
        is_finer
    }

    pub fn points(&self) -> &Arc<[ProbePoint]> {
        &self.points
    }

    /// What is known now.
    pub fn truth(&self) -> &Arc<Truth> {
        &self.truth
    }
}

/// What a reference knows at one moment.
#[derive(Clone, Debug, Default)]
pub struct Truth {
    /// Paths from each point.
    pub paths: u64,
    /// For each point and channel independent estimates of E, W/m².
    pub irradiance: Vec<[Moments; 3]>,
    /// Mean of E over points and channels, W/m².
    pub mean: f64,
    /// The error that the truth has itself, as [`Error::floor`]. Infinite where nothing is known or there is no light.
    pub floor: f64,
}

impl Truth {
    fn of(sensors: &Sensors) -> Self {
        let irradiance = sensors.irradiance();
        let channels = || irradiance.iter().flatten();
        let count = channels().count().max(1) as f64;
        let mean = channels().map(Moments::mean).sum::<f64>() / count;
        let noise = channels().map(|channel| channel.standard_error().powi(2)).sum::<f64>() / count;
        let is_known = sensors.paths() > 0 && mean > 0.0;
        Self {
            paths: sensors.paths(),
            floor: if is_known { noise.sqrt() / mean } else { f64::INFINITY },
            mean,
            irradiance,
        }
    }

    /// Whether so many paths have met no light that more of them would not, either.
    pub fn is_dark(&self) -> bool {
        self.paths >= DARK && self.floor.is_infinite()
    }

    /// Whether more of it would hardly tell more about an error: its own is a quarter of that.
    pub fn is_enough_for(&self, error: &Error) -> bool {
        4.0 * self.floor <= error.rms
    }

    /// How far off a method is at the points; `None` where nothing is known or there is no light.
    pub fn error(&self, found: &Found) -> Option<Error> {
        let error = Error::of(&found.irradiance, &self.irradiance).filter(|_| self.floor.is_finite())?;
        Some(found.variance.map_or(error, |variance| error.with_noise(variance, self.mean)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rgb::Rgb;
    use crate::mesh::MeshSettings;
    use crate::scene::Scene;

    fn world(name: &str) -> Arc<World> {
        let scene = Scene::open(name).expect("a built-in scene");
        Arc::new(World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world"))
    }

    fn refined(mut reference: Reference, steps: u32) -> Reference {
        (0..steps).for_each(|_| assert!(reference.refine(&Cancel::default())));
        reference
    }

    #[test]
    fn what_is_kept_is_gone_on_from_and_gives_the_same_bits() {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache::at(folder.path().to_owned());
        let world = world("cornell-box");
        refined(Reference::new(world.clone()), 2).keep(&cache).expect("a file");
        let resumed = refined(Reference::open(world.clone(), Some(&cache)), 1);
        let whole = refined(Reference::new(world), 3);
        assert_eq!(resumed.truth().paths, 3 * Sensors::REPLICATES as u64);
        assert_eq!(resumed.truth().irradiance, whole.truth().irradiance);
    }

    #[test]
    fn it_knows_its_scene_whatever_the_mesh() {
        let world = world("cornell-box");
        let coarse = MeshSettings { element_size: Some(0.5), ..MeshSettings::default() };
        let reference = Reference::new(world.clone());
        assert!(reference.is_about(&world.remeshed(&coarse, &Cancel::default()).expect("a mesh")));
        assert!(!reference.is_about(&self::world("furnace")));
    }

    #[test]
    fn the_floor_falls_with_the_root_of_the_paths_and_a_known_error_is_told() {
        let world = world("furnace");
        let few = refined(Reference::new(world), 1);
        let floor = few.truth().floor;
        let many = refined(few, 15);
        // Low-discrepancy points do at least as well as independent ones, whose floor is a quarter. Known to 1/√(2 · 31) at
        // one point, and at a thousand points far better.
        assert!(many.truth().floor < 0.3 * floor, "{floor} {}", many.truth().floor);
        // The furnace's walls send 1 W/m² and reflect a half: E = 2 everywhere.
        let truth = many.truth();
        assert!((truth.mean - 2.0).abs() < 6.0 * truth.floor, "{}", truth.mean);
        let found = Found { irradiance: vec![Rgb::splat(2.2); truth.irradiance.len()], variance: None };
        let error = truth.error(&found).expect("light");
        assert!((error.rms - 0.1).abs() < 3.0 * error.uncertainty + 6.0 * truth.floor / 32.0, "{error:?}");
    }
}
