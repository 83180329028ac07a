//! Light between diffuse surfaces, gathered at each place that is seen by rays into the photon map (Jensen 1996).

use super::arrivals::{ArrivalMaps, Onward};
use super::direct;
use super::draws::Use;
use super::eye_path::{DiffuseLight, Seen, Tools};
use super::lights::direct_light;
use super::photon_light::PhotonLight;
use crate::effects::Effect;
use crate::math::random::Stream;
use crate::math::rgb::Rgb;
use crate::math::warp::cosine_above;
use crate::methods::transport::{Bsdf, Media, Surface, Transport};
use crate::solution::{Path, PathMatcher, Scattering};
use crate::tracer::Ray;
use glam::Vec2;
use std::f32::consts::PI;
use std::sync::Arc;

/// A gathering ray goes over at most this many specular surfaces.
const MAX_EVENTS: usize = 8;
/// What is nearer than so many elements is gathered one bounce further: there, the elements that a map consists of would show.
const NEAR_ELEMENTS: f32 = 3.0;

/// Direct light and caustics as they are, all other diffuse light by gathering.
pub struct GatherLight {
    pub transport: Arc<Transport>,
    pub caustics: PhotonLight,
    pub arrivals: ArrivalMaps,
    pub gather_rays: u32,
    pub light_rays: u32,
    pub matcher: PathMatcher,
}

impl DiffuseLight for GatherLight {
    fn leaving(&self, seen: &Seen<'_>, tools: &mut Tools<'_>) -> Rgb {
        let mut radiance = Rgb::ZERO;
        if self.matcher.passes(Path::LIGHT, Some(Scattering::Diffuse), seen.to_eye) {
            radiance += direct_light(&self.transport, seen, self.light_rays, tools);
        }
        if self.transport.effects.contains(Effect::Caustics) {
            radiance += self.caustics.leaving(seen, tools);
        }
        radiance + self.indirect(seen, tools)
    }
}

/// Point `i` of `count` in [0, 1)², each in a row of its own.
fn stratified(i: u32, count: u32, stream: &mut Stream) -> Vec2 {
    let at = stream.uniform2();
    Vec2::new((i as f32 + at.x) / count as f32, at.y)
}

impl GatherLight {
    /// Radiance that the diffuse lobe sends on of the light from other diffuse surfaces.
    fn indirect(&self, seen: &Seen<'_>, tools: &mut Tools<'_>) -> Rgb {
        // Behind a mirror a quarter is enough, since less is seen there, and behind two a quarter of these.
        let count = (self.gather_rays >> (2 * seen.to_eye.len()).min(31)).max(1);
        if !self.transport.effects.contains(Effect::Interreflection) {
            tools.cost.save(Effect::Interreflection, count);
            return Rgb::ZERO;
        }
        let weight = seen.bsdf.diffuse() / count as f32;
        let mut sum = Rgb::ZERO;
        for i in 0..count {
            // Only what the eye sees directly is the same in every sample of a pixel.
            let at = if seen.to_eye.is_empty() {
                tools.draws.spread(Use::Gather, i, count)
            } else {
                stratified(i, count, &mut tools.draws.stream)
            };
            let direction = cosine_above(seen.surface.normal, seen.surface.facing, at);
            if direction.dot(seen.surface.facing) > 0.0 {
                let ray = self.transport.leave(seen.surface, direction);
                // A filter tells paths apart by their last bounces, which are known only without a further one.
                let gathering = Gathering { to_eye: seen.to_eye, refines: self.matcher.passes_all(), weight };
                sum += self.arriving(&gathering, ray, seen.media, tools);
            }
        }
        seen.bsdf.diffuse() * sum / count as f32
    }

    /// Radiance that arrives along a gathering ray, without what comes from emitters directly or over specular surfaces, which
    /// is known already.
    fn arriving(&self, gathering: &Gathering, mut ray: Ray, mut media: Media, tools: &mut Tools<'_>) -> Rgb {
        let mut radiance = Rgb::ZERO;
        let mut throughput = Rgb::ONE;
        for event in 0..MAX_EVENTS {
            tools.cost.spend(Effect::Interreflection, 1);
            let Some(surface) = self.transport.meet(&ray) else { break };
            let bsdf = self.transport.bsdf(&surface, -ray.direction, &media);
            if bsdf.diffuse() != Rgb::ZERO {
                let is_near = event == 0 && surface.distance < NEAR_ELEMENTS * self.transport.world.element_size;
                if gathering.refines && is_near {
                    let bsdf = bsdf.only(Scattering::Diffuse);
                    let near = gathering.further(throughput * bsdf.diffuse());
                    radiance += throughput * self.leaving_near(&near, &surface, &bsdf, media, tools);
                } else {
                    let weight = gathering.weight * throughput * bsdf.diffuse() / PI;
                    let onward = Onward { matcher: &self.matcher, events: event, to_eye: gathering.to_eye };
                    let irradiance = self.arrivals.irradiance(onward, &surface, weight, tools.batches.as_deref_mut());
                    radiance += throughput * bsdf.diffuse() * irradiance / PI;
                }
            }
            if !bsdf.is_specular() {
                break;
            }
            let Some(sample) = bsdf.only(Scattering::Specular).sample(throughput, &mut tools.draws.stream) else {
                break;
            };
            throughput *= sample.weight * sample.narrowing;
            if sample.crosses {
                media = self.transport.media_behind(&surface, media);
            }
            ray = self.transport.leave(&surface, sample.direction);
        }
        radiance
    }

    /// Radiance that a place near by sends: its own direct light, the photons of caustics, and one gathering ray further.
    /// `gathering` is that of the place: its weight is for radiance there that arrives.
    fn leaving_near(
        &self,
        gathering: &Gathering,
        surface: &Surface,
        bsdf: &Bsdf,
        media: Media,
        tools: &mut Tools<'_>,
    ) -> Rgb {
        let direct = direct::random(&self.transport, surface, bsdf, tools);
        let weight = gathering.weight / PI;
        let caustic = self.arrivals.caustic_irradiance(surface, weight, tools.batches.as_deref_mut());
        let direction = cosine_above(surface.normal, surface.facing, tools.draws.stream.uniform2());
        let indirect = if direction.dot(surface.facing) > 0.0 {
            self.arriving(gathering, self.transport.leave(surface, direction), media, tools)
        } else {
            Rgb::ZERO
        };
        direct + bsdf.diffuse() * (caustic / PI + indirect)
    }
}

/// What a gathering ray is for.
#[derive(Clone, Copy)]
struct Gathering {
    /// Events from the eye to the place that gathers.
    to_eye: Path,
    /// Whether what is near is gathered one bounce further.
    refines: bool,
    /// What radiance that arrives along the ray counts.
    weight: Rgb,
}

impl Gathering {
    /// One bounce further, off what sends on this share.
    fn further(&self, share: Rgb) -> Self {
        Self { refines: false, weight: self.weight * share, ..*self }
    }
}
