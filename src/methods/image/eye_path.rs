//! The way of a ray from the eye over specular surfaces, to wherever light is known (Whitted 1980; Kajiya 1986).

use super::draws::{Draws, Use};
use super::photon_batches::PhotonBatches;
use crate::math::rgb::Rgb;
use crate::methods::cost::Cost;
use crate::methods::mis::power_heuristic;
use crate::methods::photon_map::Scratch;
use crate::methods::shadows::is_lit;
use crate::methods::transport::{Bsdf, Media, Surface, Transport};
use crate::solution::{Path, PathMatcher, Scattering};
use crate::tracer::Ray;
use std::sync::Arc;

/// A ray meets at most this many specular surfaces.
const MAX_EVENTS: usize = 30;
/// At so many surfaces all specular lobes are followed: of glass, what it reflects and what it lets through.
const SPLIT_EVENTS: usize = 2;
/// Rays that carry less than this share of the light to the eye are ended at random.
const FAINT: f32 = 0.25;

/// A place that is seen, and how it is.
pub struct Seen<'a> {
    pub surface: &'a Surface,
    pub bsdf: &'a Bsdf,
    /// Events from the eye backwards.
    pub to_eye: Path,
    /// The glass that it is seen through.
    pub media: Media,
}

impl Seen<'_> {
    /// Whether nothing is between it and the eye: the same in every sample of a pixel.
    pub fn is_direct(&self) -> bool {
        self.to_eye.is_empty()
    }

    /// Of `rays` to emitters those that are worth while: behind a mirror one is enough.
    pub fn light_rays(&self, rays: u32) -> u32 {
        if self.is_direct() { rays } else { 1 }
    }
}

/// What is known of the light that diffuse lobes send on.
pub trait DiffuseLight: Send + Sync {
    /// Radiance that the diffuse lobe of the place sends towards the eye, W/(m²·sr).
    fn leaving(&self, seen: &Seen<'_>, tools: &mut Tools<'_>) -> Rgb;

    /// Whether this light is shown on a surface: on what has a diffuse lobe.
    fn is_shown_on(&self, bsdf: &Bsdf) -> bool {
        bsdf.diffuse() != Rgb::ZERO
    }
}

/// What each sample of a pixel works with.
pub struct Tools<'a> {
    pub draws: &'a mut Draws,
    pub scratch: &'a mut Scratch,
    /// Of all samples so far.
    pub cost: &'a mut Cost,
    /// What batches of photons say each for itself, where that is asked for.
    pub batches: Option<&'a mut PhotonBatches>,
}

/// What is seen along rays from the eye.
pub trait Look: Send + Sync {
    /// What a ray brings that starts in this glass.
    fn look(&self, ray: Ray, media: Media, tools: &mut Tools<'_>) -> Sight;

    fn transport(&self) -> &Transport;
}

/// Follows rays from the eye.
pub struct EyePath {
    pub transport: Arc<Transport>,
    pub light: Box<dyn DiffuseLight>,
    /// Which paths are shown; the light has its own.
    pub matcher: PathMatcher,
}

/// What one ray from the eye brought.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sight {
    /// L, W/(m²·sr).
    pub radiance: Rgb,
    /// Whether there is a surface at all.
    pub is_surface: bool,
}

/// A ray on its way from the eye.
#[derive(Clone, Copy)]
struct Leg {
    ray: Ray,
    /// Share of the light that arrives along it which reaches the eye: as flux, and what radiance is to be multiplied by
    /// besides, in glass.
    throughput: Rgb,
    narrowing: f32,
    media: Media,
    /// Events from the eye on.
    to_eye: Path,
    /// The glossy lobe that it left, if it was one.
    gloss: Option<GlossSample>,
}

/// How a glossy lobe chose a direction.
#[derive(Clone, Copy)]
struct GlossSample {
    surface: Surface,
    /// 1/sr
    pdf: f32,
}

impl Look for EyePath {
    /// Radiance that arrives along the ray: what surfaces emit and what their diffuse lobes send on, directly and over
    /// specular lobes. At the first surfaces all of these are followed, later on one of them.
    fn look(&self, ray: Ray, media: Media, tools: &mut Tools<'_>) -> Sight {
        let leg = Leg { ray, throughput: Rgb::ONE, narrowing: 1.0, media, to_eye: Path::LIGHT, gloss: None };
        let mut sight = Sight::default();
        tools.cost.look();
        self.follow(&leg, &mut sight, tools);
        sight
    }

    fn transport(&self) -> &Transport {
        &self.transport
    }
}

impl EyePath {
    fn follow(&self, leg: &Leg, sight: &mut Sight, tools: &mut Tools<'_>) {
        let Some(surface) = self.transport.meet(&leg.ray) else { return };
        sight.is_surface = true;
        let emitted = self.transport.emission(&surface);
        if emitted != Rgb::ZERO && self.matcher.passes(Path::LIGHT, None, leg.to_eye) {
            let weight = self.weight_of_met(leg, &surface);
            sight.radiance += weight * leg.throughput * leg.narrowing * emitted;
        }
        let bsdf = self.transport.bsdf(&surface, -leg.ray.direction, &leg.media);
        if self.light.is_shown_on(&bsdf) {
            let seen =
                Seen { surface: &surface, bsdf: &bsdf.only(Scattering::Diffuse), to_eye: leg.to_eye, media: leg.media };
            sight.radiance += leg.throughput * leg.narrowing * self.light.leaving(&seen, tools);
        }
        for effect in self.transport.skipped(&surface).iter() {
            tools.cost.save(effect, 1);
        }
        if !bsdf.is_specular() || leg.to_eye.len() == MAX_EVENTS {
            return;
        }
        if leg.to_eye.len() < SPLIT_EVENTS {
            for lobe in bsdf.specular_lobes() {
                self.go_on(leg, &surface, &lobe, sight, tools);
            }
        } else {
            self.go_on(leg, &surface, &bsdf.only(Scattering::Specular), sight, tools);
        }
    }

    /// The weight of an emitter that a ray met: less than 1 where the glossy lobe that it left had a sample of the emitters.
    fn weight_of_met(&self, leg: &Leg, met: &Surface) -> f32 {
        match &leg.gloss {
            None => 1.0,
            Some(_) if self.transport.ignores_occluders => 0.0,
            Some(gloss) => {
                power_heuristic(gloss.pdf, self.transport.emitters().pdf(&gloss.surface, met, leg.ray.direction))
            }
        }
    }

    /// Radiance that a glossy lobe sends on of the light that comes straight from emitters, by a point of one of them; what the
    /// lobe's own sample meets is weighed against it.
    fn sample_gloss(&self, leg: &Leg, surface: &Surface, lobe: &Bsdf, tools: &mut Tools<'_>) -> Rgb {
        let what = leg.to_eye.is_empty().then_some(Use::Gloss);
        let (choice, at) = tools.draws.numbers(what, 0, 1);
        let Some(sample) = self.transport.emitters().sample(surface, choice, at) else { return Rgb::ZERO };
        let [_, glossy] = lobe.value(sample.direction);
        if glossy == Rgb::ZERO || !is_lit(&self.transport, surface, sample.point, tools.cost) {
            return Rgb::ZERO;
        }
        let [_, other] = lobe.densities(sample.direction, &lobe.lobe_probabilities(leg.throughput));
        let weight = if self.transport.ignores_occluders { 1.0 } else { power_heuristic(sample.pdf, other) };
        weight * glossy * sample.radiance
    }

    /// Follows a lobe, or one of several. What carries little is ended at random, with no cap on survival: a mirror that loses
    /// nothing adds no noise, and `MAX_EVENTS` ends all.
    fn go_on(&self, leg: &Leg, surface: &Surface, lobe: &Bsdf, sight: &mut Sight, tools: &mut Tools<'_>) {
        if lobe.is_glossy() && self.matcher.passes(Path::LIGHT, Some(Scattering::Specular), leg.to_eye) {
            sight.radiance += leg.throughput * leg.narrowing * self.sample_gloss(leg, surface, lobe, tools);
        }
        let Some(sample) = lobe.sample(leg.throughput, &mut tools.draws.stream) else { return };
        let throughput = leg.throughput * sample.weight;
        let survival = (throughput.max_element() / FAINT).min(1.0);
        if tools.draws.stream.uniform() >= survival {
            return;
        }
        let next = Leg {
            ray: self.transport.leave(surface, sample.direction),
            throughput: throughput / survival,
            narrowing: leg.narrowing * sample.narrowing,
            media: if sample.crosses { self.transport.media_behind(surface, leg.media) } else { leg.media },
            to_eye: leg.to_eye.then(Scattering::Specular),
            gloss: (!sample.is_sharp).then_some(GlossSample { surface: *surface, pdf: sample.density }),
        };
        tools.cost.spend(sample.effect(), 1);
        self.follow(&next, sight, tools);
    }
}
