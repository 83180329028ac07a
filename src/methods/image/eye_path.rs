//! The way of a ray from the eye over specular surfaces, to wherever light is known (Whitted 1980; Kajiya 1986).

use super::draws::Draws;
use super::photon_batches::PhotonBatches;
use crate::math::rgb::Rgb;
use crate::methods::cost::Cost;
use crate::methods::photon_map::Scratch;
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
}

impl Look for EyePath {
    /// Radiance that arrives along the ray: what surfaces emit and what their diffuse lobes send on, directly and over
    /// specular lobes. At the first surfaces all of these are followed, later on one of them.
    fn look(&self, ray: Ray, media: Media, tools: &mut Tools<'_>) -> Sight {
        let leg = Leg { ray, throughput: Rgb::ONE, narrowing: 1.0, media, to_eye: Path::LIGHT };
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
            sight.radiance += leg.throughput * leg.narrowing * emitted;
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

    /// Follows a lobe, or one of several. What carries little is ended at random.
    fn go_on(&self, leg: &Leg, surface: &Surface, lobe: &Bsdf, sight: &mut Sight, tools: &mut Tools<'_>) {
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
        };
        tools.cost.spend(sample.effect(), 1);
        self.follow(&next, sight, tools);
    }
}
