//! The way of one photon: emitted, scattered under Russian roulette (Arvo, Kirk 1990), absorbed or gone.

use crate::effects::Effect;
use crate::math::random::Stream;
use crate::math::rgb::Rgb;
use crate::methods::Settings;
use crate::methods::transport::{Bsdf, Emission, Surface, Transport};
use crate::solution::{Path, Scattering};
use glam::Vec3A;

/// Photons that have met this many surfaces are given up. With a reflectance of 0.999 everywhere that is 8e-8 of the flux.
/// Roulette with a lower chance of survival than the reflectance ρ would be unbiased and end sooner, but weights then grow
/// faster than photons die: from a chance of ρ² down the variance has no bound. So the bound is far, and what is lost there
/// is told ([`crate::solution::PhotonSolution::warning`]).
pub const MAX_BOUNCES: usize = 1 << 14;

/// Streams of random numbers of photons start here, out of the way of other uses.
const FIRST_PASS: u64 = 1 << 32;

/// Which map photons are traced for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapKind {
    /// All light.
    Global,
    /// Light that has met specular surfaces alone, and at least one.
    Caustic,
}

/// Photons that share the flux of all emitters.
#[derive(Clone, Copy)]
pub struct Shower<'a> {
    pub transport: &'a Transport,
    pub kind: MapKind,
    /// How many there are.
    pub count: u64,
    pub seed: u64,
    pub pass: u64,
}

/// A photon as it meets a surface.
#[derive(Clone, Copy, Debug)]
pub struct Arrival<'a> {
    pub surface: &'a Surface,
    /// W
    pub flux: Rgb,
    /// Unit direction in which it flies.
    pub direction: Vec3A,
    /// The surfaces that it met before.
    pub path: Path,
    /// ρ of the surface's diffuse lobe.
    pub diffuse: Rgb,
}

/// What became of a photon at a surface.
#[derive(Clone, Copy, Debug)]
pub struct Roulette {
    /// Chance that it went on, in [0, 1].
    pub survival: f32,
    /// How it went on; `None` where it was absorbed.
    pub scattering: Option<Scattering>,
    /// By which effect it went on, or would have if that were simulated.
    pub effect: Option<Effect>,
    /// Flux with which it went on, W: 0 where it was absorbed.
    pub flux: Rgb,
}

/// Whoever looks on while a photon is traced.
pub trait Witness {
    fn emitted(&mut self, emission: &Emission);
    /// The photon met a surface, and this is what came of it.
    fn met(&mut self, arrival: &Arrival, roulette: &Roulette);
    /// The photon flew into the void.
    fn escaped(&mut self, flux: Rgb, direction: Vec3A);
    /// The photon was given up after [`MAX_BOUNCES`].
    fn truncated(&mut self, flux: Rgb);
}

impl<'a> Shower<'a> {
    /// The photons of one map of a pass, counted from 0.
    pub fn new(transport: &'a Transport, settings: &Settings, pass: u64, kind: MapKind) -> Self {
        let count = match kind {
            MapKind::Global => settings.photons.count,
            MapKind::Caustic => settings.photons.caustic_count,
        };
        Self { transport, kind, count: count.into(), seed: settings.seed, pass }
    }

    /// Traces photon `index`. Nothing happens where nothing emits.
    pub fn trace(&self, index: u64, witness: &mut impl Witness) {
        let pass = FIRST_PASS + 2 * self.pass + u64::from(self.kind == MapKind::Caustic);
        let Some(emission) = self.transport.emitters().emit(index, self.count, self.seed, pass) else { return };
        witness.emitted(&emission);
        let mut stream = Stream::new(self.seed, pass, index);
        let Emission { mut ray, mut flux, mut media } = emission;
        let mut path = Path::LIGHT;
        for _ in 0..MAX_BOUNCES {
            let Some(surface) = self.transport.meet(&ray) else {
                witness.escaped(flux, ray.direction);
                return;
            };
            let bsdf = self.transport.whole_bsdf(&surface, -ray.direction, &media);
            let arrival = Arrival { surface: &surface, flux, direction: ray.direction, path, diffuse: bsdf.diffuse() };
            let (roulette, onward) = self.play(&bsdf, flux, &mut stream);
            witness.met(&arrival, &roulette);
            let (Some((direction, crosses)), Some(scattering)) = (onward, roulette.scattering) else { return };
            flux = roulette.flux;
            path = path.then(scattering);
            if crosses {
                media = self.transport.media_behind(&surface, media);
            }
            ray = self.transport.leave(&surface, direction);
        }
        witness.truncated(flux);
    }

    /// Whether a photon goes on, and if so in which direction and whether through the surface. It survives with the chance
    /// that keeps the flux of its brightest channel as it was, on average. There is no cap: photons of unequal flux would be
    /// noise, and what loses nothing ends at [`MAX_BOUNCES`].
    fn play(&self, bsdf: &Bsdf, flux: Rgb, stream: &mut Stream) -> (Roulette, Option<(Vec3A, bool)>) {
        let bsdf = match self.kind {
            MapKind::Global => *bsdf,
            MapKind::Caustic => bsdf.only(Scattering::Specular),
        };
        let survival = ((flux * bsdf.albedo()).max_element() / flux.max_element()).clamp(0.0, 1.0);
        let sample = if stream.uniform() < survival { bsdf.sample(flux, stream) } else { None };
        let effect = sample.map(|sample| sample.effect());
        let sample = sample.filter(|sample| self.transport.effects.contains(sample.effect()));
        let kept = sample.map_or(Rgb::ZERO, |sample| flux * sample.weight / survival);
        let roulette = Roulette { survival, scattering: sample.map(|sample| sample.scattering), effect, flux: kept };
        (roulette, sample.map(|sample| (sample.direction, sample.crosses)))
    }
}
