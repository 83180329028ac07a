//! The books of photons: where their flux went, and how many of them did what.

use super::trace::{Arrival, Roulette};
use crate::effects::Effect;
use crate::math::rgb::Rgb;
use crate::solution::{Path, PhotonCounters, PhotonEnergy, Scattering};

/// Paths of up to this many surfaces are counted one by one.
const NAMED_EVENTS: usize = 6;
/// What the others are called together.
const LONGER: &str = "longer";

/// Flux and counts of some photons. At every surface what a photon loses is booked as absorbed, and what roulette adds to
/// one that goes on is taken from it, so that for each photon what it was emitted with is absorbed, escaped or truncated
/// to the last digit.
#[derive(Clone, Debug)]
pub struct Tally {
    pub energy: PhotonEnergy,
    /// All but the names of paths.
    counters: PhotonCounters,
    /// Landings by path, at [`place`].
    named: Vec<u64>,
    longer: u64,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            energy: PhotonEnergy::default(),
            counters: PhotonCounters::default(),
            named: vec![0; 2 << NAMED_EVENTS],
            longer: 0,
        }
    }
}

impl Tally {
    pub fn emit(&mut self, flux: Rgb) {
        self.energy.emitted += flux.as_dvec3();
        self.counters.emitted += 1;
        self.counters.rays += 1;
    }

    pub fn scatter(&mut self, arrival: &Arrival, roulette: &Roulette) {
        self.energy.absorbed += arrival.flux.as_dvec3() - roulette.flux.as_dvec3();
        let goes_on = roulette.scattering.is_some();
        if goes_on {
            self.counters.rays += 1;
        } else {
            self.counters.absorbed += 1;
        }
        match roulette.effect {
            Some(effect) if goes_on => self.counters.bill.spend(effect, 1),
            Some(effect) => self.counters.bill.save(effect, 1),
            None => {}
        }
    }

    /// Rays that skipping an effect saved.
    pub fn save(&mut self, effect: Effect, rays: u64) {
        self.counters.bill.save(effect, rays);
    }

    pub fn land(&mut self, path: Path, is_stored: bool) {
        self.counters.stored += u64::from(is_stored);
        let bounce = path.len();
        if self.counters.by_bounce.len() <= bounce {
            self.counters.by_bounce.resize(bounce + 1, 0);
        }
        self.counters.by_bounce[bounce] += 1;
        match place(path) {
            Some(place) => self.named[place] += 1,
            None => self.longer += 1,
        }
    }

    pub fn escape(&mut self, flux: Rgb) {
        self.energy.escaped += flux.as_dvec3();
        self.counters.escaped += 1;
    }

    /// The last ray was counted, but is not traced.
    pub fn truncate(&mut self, flux: Rgb) {
        self.energy.truncated += flux.as_dvec3();
        self.counters.truncated += 1;
        self.counters.rays -= 1;
    }

    pub fn emit_caustic(&mut self) {
        self.counters.caustic_emitted += 1;
        self.trace_caustic();
    }

    pub fn land_caustic(&mut self) {
        self.counters.caustic_stored += 1;
    }

    pub fn trace_caustic(&mut self) {
        self.counters.rays += 1;
        self.counters.bill.spend(Effect::Caustics, 1);
    }

    /// Adds what came after.
    pub fn merge(&mut self, other: &Self) {
        let PhotonEnergy { emitted, absorbed, escaped, truncated } = other.energy;
        self.energy.emitted += emitted;
        self.energy.absorbed += absorbed;
        self.energy.escaped += escaped;
        self.energy.truncated += truncated;
        let (sum, more) = (&mut self.counters, &other.counters);
        sum.emitted += more.emitted;
        sum.caustic_emitted += more.caustic_emitted;
        sum.stored += more.stored;
        sum.caustic_stored += more.caustic_stored;
        sum.absorbed += more.absorbed;
        sum.escaped += more.escaped;
        sum.truncated += more.truncated;
        sum.rays += more.rays;
        sum.bill += &more.bill;
        sum.by_bounce.resize(sum.by_bounce.len().max(more.by_bounce.len()), 0);
        add(&mut sum.by_bounce, &more.by_bounce);
        add(&mut self.named, &other.named);
        self.longer += other.longer;
    }

    /// The counts, with paths by their names.
    pub fn counters(&self) -> PhotonCounters {
        let mut by_path: Vec<(String, u64)> =
            named_paths().map(|path| (path.to_string(), place(path).map_or(0, |place| self.named[place]))).collect();
        by_path.retain(|(_, count)| *count > 0);
        by_path.sort();
        if self.longer > 0 {
            by_path.push((LONGER.to_owned(), self.longer));
        }
        PhotonCounters { by_path, ..self.counters.clone() }
    }

    pub fn counts(&self) -> &PhotonCounters {
        &self.counters
    }
}

fn add(sums: &mut [u64], more: &[u64]) {
    for (sum, more) in sums.iter_mut().zip(more) {
        *sum += more;
    }
}

/// Where a path is counted; `None` for one of too many events.
fn place(path: Path) -> Option<usize> {
    let bits = |bits, event| bits << 1 | usize::from(event == Scattering::Specular);
    (path.len() <= NAMED_EVENTS).then(|| path.events().fold(1, bits))
}

/// All paths that have a place.
fn named_paths() -> impl Iterator<Item = Path> {
    (0..=NAMED_EVENTS).flat_map(|length| {
        (0..1_u32 << length).map(move |bits| {
            let event = |i| if bits >> i & 1 == 1 { Scattering::Specular } else { Scattering::Diffuse };
            (0..length).map(event).fold(Path::LIGHT, Path::then)
        })
    })
}
