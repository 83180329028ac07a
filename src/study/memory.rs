//! What runs on a scene have cost and brought on this machine, kept for whoever asks for a budget.

use super::attempt::Price;
use super::recipe::Recipe;
use crate::accuracy::{Cache, CacheError, Key};

/// So many runs of a scene are kept, the newest.
const MOST: usize = 1000;

/// A run that was measured.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Known {
    pub recipe: Recipe,
    /// Of the solver.
    pub seconds: f64,
    /// From the cutting of the mesh to the measuring of the error.
    pub all_seconds: f64,
    /// As a share of the mean irradiance.
    pub error: f64,
    /// Threads that it ran on.
    pub threads: usize,
}

/// All that is known of runs on one scene, on as many threads as there are now.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    known: Vec<Known>,
}

impl Memory {
    /// What is kept of a scene. What cannot be read is as good as nothing.
    pub fn load(cache: &Cache, key: &Key) -> Self {
        let text = cache.load_runs(key).unwrap_or_default();
        Self { known: serde_json::from_str(&text).unwrap_or_default() }
    }

    /// Keeps it beside what others have kept meanwhile.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn store(&self, cache: &Cache, key: &Key) -> Result<(), CacheError> {
        let mut all = Self::load(cache, key);
        self.known.iter().for_each(|known| all.take_in(*known));
        let newest = &all.known[all.known.len().saturating_sub(MOST)..];
        cache.store_runs(key, &serde_json::to_string(newest).unwrap_or_default())
    }

    fn take_in(&mut self, known: Known) {
        self.known.retain(|old| old.recipe != known.recipe || old.threads != known.threads);
        self.known.push(known);
    }

    /// Takes a run in; of the same recipe the newest counts.
    pub fn note(&mut self, recipe: Recipe, price: &Price, error: f64) {
        let Price { seconds, all_seconds, .. } = *price;
        self.take_in(Known { recipe, seconds, all_seconds, error, threads: rayon::current_num_threads() });
    }

    /// Runs on as many threads as there are now.
    pub fn runs(&self) -> impl Iterator<Item = &Known> {
        let threads = rayon::current_num_threads();
        self.known.iter().filter(move |known| known.threads == threads)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::Reference;
    use crate::cancel::Cancel;
    use crate::mesh::MeshSettings;
    use crate::methods::Settings;
    use crate::scene::Scene;
    use crate::study::Way;
    use crate::world::World;
    use std::sync::Arc;

    #[test]
    fn two_that_keep_what_they_know_keep_both() {
        let folder = tempfile::tempdir().expect("a folder");
        let cache = Cache::at(folder.path().to_owned());
        let scene = Scene::open("furnace").expect("a built-in scene");
        let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
        let key = *Reference::new(Arc::new(world)).key();
        for way in [Way::Radiosity, Way::PhotonMap] {
            let mut memory = Memory::default();
            memory.note(Recipe { way, settings: Settings::default() }, &Price::default(), 0.1);
            memory.store(&cache, &key).expect("a file");
        }
        assert_eq!(Memory::load(&cache, &key).known.len(), 2);
    }

    #[test]
    fn the_newest_of_a_recipe_counts_and_all_is_read_again() {
        let mut memory = Memory::default();
        let price = |seconds| Price { seconds, all_seconds: 2.0 * seconds, ..Price::default() };
        let recipe = Recipe { way: Way::Radiosity, settings: Settings::default() };
        memory.note(recipe, &price(1.0), 0.1);
        memory.note(Recipe { way: Way::PhotonMap, ..recipe }, &price(2.0), 0.2);
        memory.note(recipe, &price(3.0), 0.3);
        let seconds: Vec<f64> = memory.runs().map(|known| known.seconds).collect();
        assert_eq!(seconds, [2.0, 3.0]);
        let text = serde_json::to_string(&memory.known).expect("text");
        let read: Vec<Known> = serde_json::from_str(&text).expect("runs");
        assert_eq!(read, memory.known);
    }
}
