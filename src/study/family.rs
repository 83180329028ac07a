//! Recipes that differ in one knob, and what is to be expected of the next of them.

use super::bench::Bench;
use super::budget::Prediction;
use super::memory::{Known, Memory};
use super::recipe::{Recipe, Way};
use crate::mesh::MeshSettings;
use crate::methods::{PhotonSettings, Settings, Solver};

/// A family whose errors fall by less than this from one turn to the next has come to its bias.
pub const LEVEL: f64 = 0.97;
/// An attempt is at most so many turns of its knob beyond what was tried before.
const MOST_TURNS: f64 = 2.0;
/// Fewer turns of a knob are not worth an attempt.
const LEAST_TURNS: f64 = 0.25;
/// Passes, which go on from each other, may be so many turns more than expected before the error that is wanted is there.
const SPARE_TURNS: f64 = 1.5;
/// Longest edge of an element to begin with, in those of the automatic mesh.
const COARSE: f32 = 4.0;
/// Photons of a pass.
const PHOTONS: u32 = 100_000;

/// Recipes that differ in one knob: each turn of it costs more and leaves less of the error.
pub struct Family {
    first: Recipe,
    /// What a turn does before it was tried: to the time, and to the error.
    expected: [f64; 2],
    /// Turns of the last attempt from the first, and what came of attempts.
    turns: f64,
    pub tried: Vec<Tried>,
    /// Whether the last of them was tried now, and not before.
    is_tried_now: bool,
    pub is_given_up: bool,
}

/// What came of an attempt.
#[derive(Clone, Copy, Debug)]
pub struct Tried {
    /// Of the solver.
    pub seconds: f64,
    /// From the cutting of the mesh to the measuring of the error.
    pub all_seconds: f64,
    pub error: f64,
    pub is_finished: bool,
}

/// Light that is everywhere: radiosity by shooting, and with all form factors kept, on finer and finer meshes; and photons, pass
/// by pass.
pub fn families(bench: &Bench, settings: &Settings) -> Vec<Family> {
    let size = Some(COARSE * bench.world().element_size);
    let coarse = Settings { mesh: MeshSettings { element_size: size, ..settings.mesh }, ..*settings };
    let passes =
        PhotonSettings { count: PHOTONS, caustic_count: PHOTONS, is_progressive: true, passes: 1, ..settings.photons };
    let family = |way, settings, expected| Family {
        first: Recipe { way, settings },
        expected,
        turns: 0.0,
        tried: Vec::new(),
        is_tried_now: false,
        is_given_up: false,
    };
    vec![
        family(Way::Radiosity, coarse, [4.5, 0.5]),
        family(Way::Radiosity, Settings { solver: Solver::Southwell, ..coarse }, [4.5, 0.5]),
        family(Way::PhotonMap, Settings { photons: passes, ..*settings }, [2.0, 0.75]),
    ]
}

impl Family {
    /// The member so many turns beyond the last that was tried; with passes to spare where the error that is wanted ends it.
    pub fn recipe(&self, turns: f64, is_ended_by_error: bool) -> Recipe {
        let Recipe { way, settings } = self.first;
        let all = self.turns + turns;
        let settings = match way {
            Way::Radiosity => {
                let size = settings.mesh.element_size.map(|size| size * 0.5_f32.powf(all as f32));
                Settings { mesh: MeshSettings { element_size: size, ..settings.mesh }, ..settings }
            }
            _ => {
                let spare = if is_ended_by_error && !self.tried.is_empty() { SPARE_TURNS } else { 0.0 };
                let passes = (all + spare).exp2().round() as u32;
                Settings { photons: PhotonSettings { passes, ..settings.photons }, ..settings }
            }
        };
        Recipe { way, settings }
    }

    /// Turns to be taken, of so many that are wanted and can be afforded: for photons whole ones. `None` where that is next to
    /// nothing, and known already.
    pub fn rounded(&self, wanted: f64, affordable: f64) -> Option<f64> {
        let is_continuous = self.first.way == Way::Radiosity;
        // What one turn brings is not known before there were two attempts.
        let most = if self.tried.len() < 2 { 1.0 } else { MOST_TURNS };
        let turns = if is_continuous { wanted.min(affordable) } else { wanted.ceil().min(affordable.floor()) };
        let turns = turns.min(most).max(-self.turns);
        let least = if is_continuous { LEAST_TURNS } else { 1.0 };
        (turns.abs() >= least || !self.is_tried_now).then_some(turns)
    }

    /// Takes over what is known of its members from before, the cheapest first.
    pub fn remember(&mut self, memory: &Memory) {
        let mut members: Vec<(f64, Tried)> = memory.runs().filter_map(|known| self.member(known)).collect();
        members.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (turns, tried) in members {
            if turns >= self.turns {
                self.note(turns - self.turns, Some(tried));
            }
        }
        // A bias that was come to may be all there is to be had.
        (self.is_given_up, self.is_tried_now) = (false, false);
    }

    /// How many turns beyond the last that was tried a recipe of the family is, as it came out.
    pub fn turns_to(&self, recipe: &Recipe) -> f64 {
        self.place(recipe).map_or(0.0, |(turns, _)| turns - self.turns)
    }

    /// How many turns from the first one a recipe is, and its settings but for these turns.
    fn place(&self, recipe: &Recipe) -> Option<(f64, Settings)> {
        let (of_family, settings) = (self.first.settings, recipe.settings);
        Some(match self.first.way {
            Way::Radiosity => {
                let turns = f64::from(of_family.mesh.element_size? / settings.mesh.element_size?).log2();
                (turns, Settings { mesh: of_family.mesh, ..settings })
            }
            _ => (
                f64::from(settings.photons.passes).log2(),
                Settings { photons: PhotonSettings { passes: 1, ..settings.photons }, ..settings },
            ),
        })
    }

    /// How many turns from the first one a known recipe is, if it belongs to the family.
    fn member(&self, known: &Known) -> Option<(f64, Tried)> {
        let (turns, same) = self.place(&known.recipe)?;
        let tried =
            Tried { seconds: known.seconds, all_seconds: known.all_seconds, error: known.error, is_finished: true };
        let is_member = known.recipe.way == self.first.way && same == self.first.settings && turns >= 0.0;
        is_member.then_some((turns, tried))
    }

    /// What so many turns are expected to come to.
    pub fn prediction(&self, turns: f64) -> Prediction {
        let Some(last) = self.tried.last() else { return Prediction { error: None, seconds: None } };
        Prediction {
            error: Some(last.error * self.decay().powf(turns)),
            seconds: Some(last.seconds * self.growth().powf(turns)),
        }
    }

    /// By how much a turn lengthens the time.
    pub fn growth(&self) -> f64 {
        // What it costs to begin hides how fast pairs of smaller elements grow in number: in the end sixteenfold.
        let least = match self.first.way {
            Way::Radiosity if self.first.settings.solver.needs_matrix() => 10.0,
            Way::Radiosity => 7.0,
            _ => 1.5,
        };
        self.expected[0].clamp(least, 16.0)
    }

    /// What share of the error a turn leaves.
    pub fn decay(&self) -> f64 {
        self.expected[1].clamp(0.2, 1.0)
    }

    /// Takes note of what came of so many turns, and expects the same of the next.
    pub fn note(&mut self, turns: f64, tried: Option<Tried>) {
        let Some(tried) = tried.filter(|tried| tried.is_finished) else {
            self.is_given_up = true;
            return;
        };
        if let Some(last) = self.tried.last().filter(|_| turns.abs() >= LEAST_TURNS) {
            let a_turn = |ratio: f64| ratio.powf(1.0 / turns);
            self.expected = [a_turn(tried.all_seconds / last.all_seconds), a_turn(tried.error / last.error)];
            // Nothing is left to be gained by more of the same.
            self.is_given_up = self.expected[1] > LEVEL;
        }
        self.turns += turns;
        self.is_tried_now = true;
        self.tried.push(tried);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cancel::Cancel;
    use crate::scene::Scene;
    use crate::world::World;
    use std::sync::Arc;

    fn photons() -> Family {
        let scene = Scene::open("furnace").expect("a built-in scene");
        let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
        let bench = Bench::open(Arc::new(world), MeshSettings::default(), None);
        families(&bench, &Settings::default()).remove(2)
    }

    /// Passes that fall short of an error are not thrown away: an attempt that the error ends may take 2^1.5 times as many as
    /// are expected to do, and counts by how many it took.
    #[test]
    fn passes_go_on_until_the_error_is_there() {
        let mut photons = photons();
        assert_eq!(photons.recipe(0.0, true).settings.photons.passes, 1);
        photons.note(0.0, Some(Tried { seconds: 1.0, all_seconds: 1.0, error: 0.4, is_finished: true }));
        let passes = |is_ended_by_error| photons.recipe(2.0, is_ended_by_error).settings.photons.passes;
        assert_eq!((passes(false), passes(true)), (4, 11));
        let came_out = Recipe { way: Way::PhotonMap, settings: photons.recipe(3.0, false).settings };
        let turns = photons.turns_to(&came_out);
        assert_eq!(turns, 3.0);
        photons.note(turns, Some(Tried { seconds: 8.0, all_seconds: 8.0, error: 0.1, is_finished: true }));
        // Twice the time and 0.63 of the error, turn by turn.
        let next = photons.prediction(1.0);
        assert!((next.seconds.expect("seconds") - 16.0).abs() < 1e-9, "{next:?}");
        assert!((next.error.expect("an error") - 0.1 * 0.25_f64.powf(1.0 / 3.0)).abs() < 1e-9, "{next:?}");
    }
}
