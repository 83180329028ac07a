//! The rendering equation as it is, without a bias (Kajiya 1986): paths from the eye, or from a point of a surface, that go on
//! at random, with a ray to an emitter at every place, each weighted by how well it finds what it finds (Veach, Guibas 1995).

mod sensors;

pub use sensors::{Sensor, Sensors};

use super::cost::Cost;
use super::mis::power_heuristic;
use super::shadows::is_lit;
use super::transport::{Bsdf, LobeProbabilities, Media, Sample, Surface, Transport};
use crate::effects::{Effect, Effects, needed};
use crate::math::random::PaddedPoint;
use crate::math::rgb::Rgb;
use crate::scene::Lobes;
use crate::solution::{Path, PathMatcher, Scattering};
use crate::tracer::Ray;
use glam::Vec2;
use std::f32::consts::PI;
use std::sync::Arc;

/// From this event on, what carries little light is ended at random.
const ROULETTE: u64 = 4;
/// At a lobe with a density nothing goes on for certain then, so that all ends.
const MOST_SURVIVAL: f32 = 0.95;
/// At mirrors and glass what loses nothing goes on for certain, or else light that is long under way between them, as by total
/// reflection in a ball, would come out 1/0.95ⁿ times as bright and as rare. From this event on that ends, too.
const MOST_CERTAIN: u64 = 512;

/// Finds the light that arrives along rays, or at points.
pub struct PathTracer {
    pub transport: Arc<Transport>,
    /// Which paths count.
    matcher: PathMatcher,
    /// Effects whose instances count.
    counted: Effects,
    /// Whether light goes from one diffuse surface to another.
    spreads: bool,
    /// What diffuse rays of surfaces are for, if for anything.
    purpose: Option<Effect>,
    /// Whether every path counts.
    counts_all: bool,
}

/// A place on a path, and what it sends on to where the path came from.
struct Vertex {
    surface: Surface,
    bsdf: Bsdf,
    media: Media,
    /// Events before it, from the eye on.
    to_eye: Path,
    /// What its diffuse rays are for, if for one effect.
    purpose: Option<Effect>,
}

impl PathTracer {
    /// With the effects that `transport` simulates.
    pub fn new(transport: Arc<Transport>, matcher: PathMatcher) -> Self {
        Self::without(Effects::default(), transport, matcher)
    }

    /// Of all light, but for what comes straight from an emitter to the first diffuse surface.
    pub fn of_indirect_light(transport: Arc<Transport>) -> Self {
        Self::without(Effects::of(&[Effect::DirectLight]), transport, PathMatcher::default())
    }

    fn without(left_out: Effects, transport: Arc<Transport>, matcher: PathMatcher) -> Self {
        let needed = needed(&transport.world);
        // What no surface sends on may still arrive: light that glass gathers on a black wall.
        let counted = transport.effects.and(Effects::ALL.but(needed)).but(left_out);
        let purposes = [Effect::Interreflection, Effect::DirectLight, Effect::Caustics];
        Self {
            counts_all: matcher.passes_all() && Effects::of(&purposes).but(counted).is_empty(),
            spreads: transport.effects.contains(Effect::Interreflection),
            purpose: purposes.into_iter().find(|&effect| transport.effects.contains(effect)),
            matcher,
            counted,
            transport,
        }
    }

    /// L, W/(m²·sr), that arrives along a ray which starts in this glass; `None` where it meets no surface.
    pub fn radiance(&self, ray: &Ray, media: Media, point: &PaddedPoint, cost: &mut Cost) -> Option<Rgb> {
        cost.look();
        let surface = self.transport.meet(ray)?;
        let emitted = if self.counts(Path::LIGHT) { self.transport.emission(&surface) } else { Rgb::ZERO };
        let vertex = self.vertex(surface, ray, media, Path::LIGHT, cost);
        Some(emitted + self.outgoing_radiance(vertex, point, cost))
    }

    /// E, W/m², on the side of a surface that it faces, whatever its material is.
    pub fn irradiance(&self, surface: &Surface, media: Media, point: &PaddedPoint, cost: &mut Cost) -> Rgb {
        // A white surface sends on all that arrives: B = E, and L = B/π.
        let white = Lobes { diffuse: Rgb::ONE, ..Lobes::default() };
        let bsdf = Bsdf::new(&white, surface, surface.normal, 1.0);
        let vertex = Vertex { surface: *surface, bsdf, media, to_eye: Path::LIGHT, purpose: None };
        PI * self.outgoing_radiance(vertex, point, cost)
    }

    /// L, W/(m²·sr), that a place sends on of all light that arrives there, by one path.
    fn outgoing_radiance(&self, mut vertex: Vertex, point: &PaddedPoint, cost: &mut Cost) -> Rgb {
        // As flux, and what radiance is to be multiplied by besides, in glass.
        let (mut sum, mut throughput, mut narrowing) = (Rgb::ZERO, Rgb::ONE, 1.0);
        for event in 0.. {
            // Of each event, one set of numbers is for the ray to an emitter, and the next for the way on.
            let probabilities = vertex.bsdf.lobe_probabilities(throughput);
            if vertex.bsdf.has_densities() {
                let direct = self.sample_direct(&vertex, &probabilities, point.four(2 * event), cost);
                sum += throughput * narrowing * direct;
            }
            let [choice, u, v, survives] = point.four(2 * event + 1);
            let Some(sample) = vertex.bsdf.sample_at(&probabilities, choice, Vec2::new(u, v)) else { break };
            throughput *= sample.weight;
            narrowing *= sample.narrowing;
            let survival = survival(throughput, event, sample.is_sharp);
            if survives >= survival {
                break;
            }
            throughput /= survival;
            let purpose = match sample.scattering {
                Scattering::Diffuse => vertex.purpose,
                Scattering::Specular => Some(sample.effect()),
            };
            match purpose {
                Some(effect) => cost.spend(effect, 1),
                None => cost.look(),
            }
            let ray = self.transport.leave(&vertex.surface, sample.direction);
            let Some(surface) = self.transport.meet(&ray) else { break };
            let to_eye = vertex.to_eye.then(sample.scattering);
            let media =
                if sample.crosses { self.transport.media_behind(&vertex.surface, vertex.media) } else { vertex.media };
            let emission = self.transport.emission(&surface);
            if emission != Rgb::ZERO && self.counts(to_eye) {
                let other = || self.transport.emitters().pdf(&vertex.surface, &surface, ray.direction);
                sum += throughput * narrowing * self.mis_weight(&sample, other) * emission;
            }
            vertex = self.vertex(surface, &ray, media, to_eye, cost);
        }
        sum
    }

    /// Where a ray met a surface, without the lobes that lead to nothing that counts.
    fn vertex(&self, surface: Surface, ray: &Ray, media: Media, to_eye: Path, cost: &mut Cost) -> Vertex {
        for effect in self.transport.skipped(&surface).iter() {
            cost.save(effect, 1);
        }
        let mut bsdf = self.transport.bsdf(&surface, -ray.direction, &media);
        if !self.spreads && bsdf.diffuse() != Rgb::ZERO {
            cost.save(Effect::Interreflection, 1);
            if to_eye.diffuse_count() > 0 || self.purpose.is_none() {
                bsdf = bsdf.only(Scattering::Specular);
            }
        }
        Vertex { surface, bsdf, media, to_eye, purpose: self.purpose }
    }

    /// The weight of an emitter that a sampled direction met; `other` is the density, 1/sr, with which a point of it would have
    /// been chosen.
    fn mis_weight(&self, sample: &Sample, other: impl Fn() -> f32) -> f32 {
        if sample.is_sharp {
            // No ray to an emitter finds this way.
            1.0
        } else if self.transport.ignores_occluders {
            0.0
        } else {
            power_heuristic(sample.density, other())
        }
    }

    /// L, W/(m²·sr), that a place sends on of the light of a point of an emitter.
    fn sample_direct(
        &self,
        vertex: &Vertex,
        probabilities: &LobeProbabilities,
        [choice, u, v, _]: [f32; 4],
        cost: &mut Cost,
    ) -> Rgb {
        let sample = self.transport.emitters().sample(&vertex.surface, choice, Vec2::new(u, v));
        let Some(sample) = sample else { return Rgb::ZERO };
        let values = vertex.bsdf.value(sample.direction);
        let densities = vertex.bsdf.densities(sample.direction, probabilities);
        let mut value = Rgb::ZERO;
        for ((of_lobe, density), scattering) in values.into_iter().zip(densities).zip(Scattering::ALL) {
            if of_lobe != Rgb::ZERO && self.counts(vertex.to_eye.then(scattering)) {
                let weight = if self.transport.ignores_occluders { 1.0 } else { power_heuristic(sample.pdf, density) };
                value += weight * of_lobe;
            }
        }
        if value == Rgb::ZERO || !is_lit(&self.transport, &vertex.surface, sample.point, cost) {
            return Rgb::ZERO;
        }
        value * sample.radiance
    }

    /// Whether light counts that came to the eye by this path, from the eye on.
    fn counts(&self, to_eye: Path) -> bool {
        self.counts_all || (self.is_simulated(to_eye) && self.matcher.passes(Path::LIGHT, None, to_eye))
    }

    /// Whether the effect is simulated that a path is an instance of.
    fn is_simulated(&self, to_eye: Path) -> bool {
        match (to_eye.diffuse_count(), to_eye.last()) {
            (0, _) | (_, None) => true,
            (_, Some(Scattering::Specular)) => self.counted.contains(Effect::Caustics),
            (1, Some(Scattering::Diffuse)) => self.counted.contains(Effect::DirectLight),
            (_, Some(Scattering::Diffuse)) => self.counted.contains(Effect::Interreflection),
        }
    }
}

/// The chance that a path goes on which carries this share of flux, from 0 on. Radiance in glass says nothing of what a path is
/// worth: it is undone where the path leaves the glass (Veach 1997, section 5.2).
fn survival(throughput: Rgb, event: u64, is_delta: bool) -> f32 {
    match event {
        0..ROULETTE => 1.0,
        ROULETTE..MOST_CERTAIN if is_delta => throughput.max_element().min(1.0),
        _ => throughput.max_element().min(MOST_SURVIVAL),
    }
}
