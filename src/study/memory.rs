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

    /// # Errors
    /// If it cannot be written.
    pub fn store(&self, cache: &Cache, key: &Key) -> Result<(), CacheError> {
        let newest = &self.known[self.known.len().saturating_sub(MOST)..];
        cache.store_runs(key, &serde_json::to_string(newest).unwrap_or_default())
    }

    /// Takes a run in; of the same recipe the newest counts.
    pub fn note(&mut self, recipe: Recipe, price: &Price, error: f64) {
        let Price { seconds, all_seconds, .. } = *price;
        let known = Known { recipe, seconds, all_seconds, error, threads: rayon::current_num_threads() };
        self.known.retain(|old| old.recipe != recipe || old.threads != known.threads);
        self.known.push(known);
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
    use crate::methods::Settings;
    use crate::study::Way;

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
