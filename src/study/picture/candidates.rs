//! Candidates for a picture: ways to make it, each with light that can be made finer.

use crate::mesh::MeshSettings;
use crate::methods::{ImageSettings, PhotonSettings, Settings, Solver};
use crate::study::recipe::{Recipe, Way};
use crate::world::World;

/// Longest edge of an element to begin with, in those of the automatic mesh.
const COARSE: f32 = 4.0;
/// Photons to begin with, and how many times as many the next light has.
const PHOTONS: u32 = 100_000;
const MORE_PHOTONS: u32 = 4;
/// Light between surfaces is smooth: what is unshot at last is far below what else it is off by.
const UNSHOT: f64 = 5e-3;
/// Rays of a sample: the more samples, the smoother the edges.
const GATHER_RAYS: u32 = 16;
const LIGHT_RAYS: u32 = 2;

/// A way to make a picture, and how fine its light is by now.
#[derive(Clone, Debug)]
pub struct Candidate {
    first: Recipe,
    /// How often the light was made finer.
    turns: i32,
    /// What is expected of the next turn: to the seconds of the light, and to its bias.
    growth: f64,
    decay: f64,
    last: Option<(f64, f64)>,
    /// Where the pilot with the finest light so far is kept.
    pub runner: Option<usize>,
    pub has_ended: bool,
}

/// All ways, or one of them. First come those without light of their own, then photons, whose cost is known; radiosity may take
/// any time.
pub fn of(world: &World, settings: &Settings, way: Option<Way>) -> Vec<Candidate> {
    let image = ImageSettings { gather_rays: GATHER_RAYS, light_rays: LIGHT_RAYS, ..settings.image };
    let size = settings.mesh.element_size.unwrap_or(COARSE * world.element_size);
    let mesh = MeshSettings { element_size: Some(size), ..settings.mesh };
    let radiosity = Settings { mesh, unshot_limit: UNSHOT, image, ..*settings };
    let photons = PhotonSettings { count: PHOTONS, caustic_count: PHOTONS, ..settings.photons };
    let candidate = |way, settings| Candidate {
        first: Recipe { way, settings },
        turns: 0,
        growth: 4.5,
        decay: 0.5,
        last: None,
        runner: None,
        has_ended: false,
    };
    let all = [
        candidate(Way::Reference, Settings { image, ..*settings }),
        candidate(Way::DiffuseAo, Settings { image, ..*settings }),
        candidate(Way::FinalGather, Settings { photons, image, ..*settings }),
        candidate(Way::RadiosityDirect, radiosity),
        candidate(Way::RadiosityDirect, Settings { solver: Solver::Southwell, ..radiosity }),
    ];
    all.into_iter().filter(|candidate| way.is_none_or(|way| way == candidate.first.way)).collect()
}

/// Ends all candidates but one that lead to the same light, as soon as it is known which of them is the fastest.
pub fn keep_the_faster(candidates: &mut [Candidate]) {
    let seconds = |candidate: &Candidate| candidate.last.map(|(seconds, _)| seconds);
    let rivals = candidates.iter().filter(|candidate| candidate.first.way == Way::RadiosityDirect);
    if let Some(fastest) = rivals.clone().filter_map(seconds).reduce(f64::min)
        && rivals.clone().all(|candidate| candidate.has_ended || candidate.turns == 0 && candidate.last.is_some())
    {
        let slower = |candidate: &&mut Candidate| {
            candidate.first.way == Way::RadiosityDirect
                && candidate.turns == 0
                && seconds(candidate).is_some_and(|own| own > fastest)
        };
        candidates.iter_mut().filter(slower).for_each(Candidate::end);
    }
}

impl Candidate {
    /// The next to be tried.
    pub fn recipe(&self) -> Recipe {
        let Recipe { way, settings } = self.first;
        let turns = if self.runner.is_some() { self.turns + 1 } else { self.turns };
        let settings = match way {
            Way::RadiosityDirect => {
                let size = settings.mesh.element_size.map(|size| size * 0.5_f32.powi(turns));
                Settings { mesh: MeshSettings { element_size: size, ..settings.mesh }, ..settings }
            }
            _ => {
                let more = MORE_PHOTONS.saturating_pow(turns.unsigned_abs());
                let [count, caustic_count] = [settings.photons.count, settings.photons.caustic_count]
                    .map(|count| count.saturating_mul(more).min(PhotonSettings::MAX_COUNT));
                Settings { photons: PhotonSettings { count, caustic_count, ..settings.photons }, ..settings }
            }
        };
        Recipe { way, settings }
    }

    /// Takes note of what the light took and how far off it is, and of where its pilot is kept.
    pub fn note(&mut self, seconds: f64, bias: f64, runner: usize) {
        if self.runner.is_some() {
            self.turns += 1;
        }
        if let Some((seconds_before, bias_before)) = self.last {
            self.growth = (seconds / seconds_before).clamp(2.0, 16.0);
            self.decay = if bias < bias_before { (bias / bias_before).max(0.2) } else { 1.0 };
        }
        self.last = Some((seconds, bias));
        self.runner = Some(runner);
        // Rays that find all light themselves find no more of it by another light.
        self.has_ended |= matches!(self.first.way, Way::Reference | Way::DiffuseAo) || self.decay == 1.0;
    }

    /// Nothing finer is to be had.
    pub fn end(&mut self) {
        self.has_ended = true;
    }

    /// What light that is finer by so many turns may be expected to take.
    pub fn light_seconds(&self, turns: i32) -> f64 {
        self.last.map_or(0.0, |(seconds, _)| seconds * self.growth.powi(turns))
    }

    /// What share of the bias that may be expected to leave.
    pub fn bias_left(&self, turns: i32) -> f64 {
        self.decay.powi(turns)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cancel::Cancel;
    use crate::scene::Scene;

    fn candidates() -> Vec<Candidate> {
        let scene = Scene::open("cornell-box").expect("a built-in scene");
        let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
        of(&world, &Settings::default(), None)
    }

    fn ended(candidates: &[Candidate]) -> Vec<bool> {
        candidates.iter().map(|candidate| candidate.has_ended).collect()
    }

    #[test]
    fn what_a_turn_brought_is_expected_of_the_next() {
        let mut candidate = candidates().remove(3);
        candidate.note(1.0, 0.08, 0);
        candidate.note(3.0, 0.02, 1);
        assert_eq!((candidate.light_seconds(1), candidate.light_seconds(2)), (9.0, 27.0));
        assert!((candidate.bias_left(1) - 0.25).abs() < 1e-12 && (candidate.bias_left(2) - 0.0625).abs() < 1e-12);
        let [first, next] = [candidate.first, candidate.recipe()].map(|recipe| recipe.settings.mesh.element_size);
        assert_eq!(next, first.map(|size| size / 4.0));
        // A bias that does not fall any further, or that cannot be told from none.
        candidate.note(9.0, 0.02, 2);
        assert!(candidate.has_ended);
        let mut exact = candidates().remove(2);
        exact.note(1.0, 0.0, 0);
        assert!(!exact.has_ended);
        exact.note(4.0, 0.0, 1);
        assert!(exact.has_ended);
    }

    #[test]
    fn of_two_lines_to_the_same_light_the_faster_goes_on() {
        let mut candidates = candidates();
        keep_the_faster(&mut candidates);
        candidates[3].note(1.0, 0.1, 0);
        keep_the_faster(&mut candidates);
        assert_eq!(ended(&candidates), [false; 5]);
        candidates[4].note(0.5, 0.1, 1);
        keep_the_faster(&mut candidates);
        assert_eq!(ended(&candidates), [false, false, false, true, false]);
    }

    #[test]
    fn a_line_that_cannot_begin_stands_in_nobodys_way() {
        let mut candidates = candidates();
        candidates[4].end();
        candidates[3].note(1.0, 0.1, 0);
        keep_the_faster(&mut candidates);
        assert_eq!(ended(&candidates), [false, false, false, false, true]);
    }
}
