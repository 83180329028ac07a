//! Light between diffuse surfaces, gathered at each place that is seen by rays into the photon map (Jensen 1996).

use super::arrivals::{ArrivalMaps, Onward};
use super::direct::{Receiver, Samples};
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
use glam::{Vec2, Vec3A};
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

/// A ray that gathers what diffuse surfaces send to the place that it leaves.
struct GatherRay<'a> {
    from: &'a Surface,
    direction: Vec3A,
    media: Media,
    /// Events from the eye to the place.
    to_eye: Path,
    /// Whether what is near is gathered one bounce further.
    refines: bool,
    /// How the direct light of the place is sampled, if emitters that are met count.
    direct: Option<Samples>,
    /// What radiance that arrives along the ray counts, per channel.
    weight: Rgb,
}

impl DiffuseLight for GatherLight {
    fn leaving(&self, seen: &Seen<'_>, tools: &mut Tools<'_>) -> Rgb {
        let count = self.gather_count(seen, tools);
        let direct = self.shared_direct(seen, count);
        let mut radiance = Rgb::ZERO;
        if let Some(samples) = direct {
            radiance += self.receiver(seen.surface, seen.bsdf, seen.is_direct()).sample_emitters(samples, tools);
        } else if self.shows_direct(seen) {
            radiance += direct_light(&self.transport, seen, self.light_rays, tools);
        }
        if self.transport.effects.contains(Effect::Caustics) {
            radiance += self.caustics.leaving(seen, tools);
        }
        radiance + self.gather(seen, count, direct, tools)
    }
}

/// Point `i` of `count` in [0, 1)², each in a row of its own.
fn stratified(i: u32, count: u32, stream: &mut Stream) -> Vec2 {
    let at = stream.uniform2();
    Vec2::new((i as f32 + at.x) / count as f32, at.y)
}

impl GatherLight {
    fn shows_direct(&self, seen: &Seen<'_>) -> bool {
        self.matcher.passes(Path::LIGHT, Some(Scattering::Diffuse), seen.to_eye)
    }

    fn receiver<'a>(&'a self, surface: &'a Surface, bsdf: &'a Bsdf, is_spread: bool) -> Receiver<'a> {
        Receiver { transport: &self.transport, surface, bsdf, is_spread }
    }

    /// Gathering rays of a place: behind a mirror a quarter is enough, since less is seen there, and behind two a quarter of
    /// these.
    fn gather_count(&self, seen: &Seen<'_>, tools: &mut Tools<'_>) -> u32 {
        let count = (self.gather_rays >> (2 * seen.to_eye.len()).min(31)).max(1);
        if self.transport.effects.contains(Effect::Interreflection) {
            return count;
        }
        tools.cost.save(Effect::Interreflection, count);
        0
    }

    /// How direct light is sampled where gathering rays, which are cosine-distributed anyway, share in it.
    fn shared_direct(&self, seen: &Seen<'_>, count: u32) -> Option<Samples> {
        let is_simulated = self.transport.effects.contains(Effect::DirectLight) && !self.transport.ignores_occluders;
        let is_shared = count > 0 && is_simulated && self.shows_direct(seen);
        is_shared.then(|| Samples { light: seen.light_rays(self.light_rays), cosine: count })
    }

    /// Radiance that the diffuse lobe sends on of the light from other diffuse surfaces, and of the emitters that gathering
    /// rays meet.
    fn gather(&self, seen: &Seen<'_>, count: u32, direct: Option<Samples>, tools: &mut Tools<'_>) -> Rgb {
        let weight = seen.bsdf.diffuse() / count.max(1) as f32;
        let mut sum = Rgb::ZERO;
        for i in 0..count {
            // Only what the eye sees directly is the same in every sample of a pixel.
            let at = if seen.is_direct() {
                tools.draws.spread(Use::Gather, i, count)
            } else {
                stratified(i, count, &mut tools.draws.stream)
            };
            let direction = cosine_above(seen.surface.normal, seen.surface.facing, at);
            if direction.dot(seen.surface.facing) > 0.0 {
                let ray = GatherRay {
                    from: seen.surface,
                    direction,
                    media: seen.media,
                    to_eye: seen.to_eye,
                    // A filter tells paths apart by their last bounces, which are known only without a further one.
                    refines: self.matcher.passes_all(),
                    direct,
                    weight,
                };
                sum += self.arriving(&ray, tools);
            }
        }
        weight * sum
    }

    /// Radiance that arrives along a gathering ray: from diffuse surfaces, and from the emitter that it meets first, as far as
    /// that counts. What comes from emitters over specular surfaces is known already.
    fn arriving(&self, gather_ray: &GatherRay<'_>, tools: &mut Tools<'_>) -> Rgb {
        let GatherRay { mut media, to_eye, weight, .. } = *gather_ray;
        let mut ray = self.transport.leave(gather_ray.from, gather_ray.direction);
        let mut radiance = Rgb::ZERO;
        let mut throughput = Rgb::ONE;
        for event in 0..MAX_EVENTS {
            tools.cost.spend(Effect::Interreflection, 1);
            let Some(surface) = self.transport.meet(&ray) else { break };
            if event == 0 {
                radiance += self.emission_met(gather_ray, &surface);
            }
            let bsdf = self.transport.bsdf(&surface, -ray.direction, &media);
            if bsdf.diffuse() != Rgb::ZERO {
                let is_near = event == 0 && surface.distance < NEAR_ELEMENTS * self.transport.world.element_size;
                if gather_ray.refines && is_near {
                    let bsdf = bsdf.only(Scattering::Diffuse);
                    let place =
                        NearPlace { surface: &surface, bsdf: &bsdf, media, to_eye, weight: weight * throughput };
                    radiance += throughput * self.leaving_near(&place, tools);
                } else {
                    let onward = Onward { matcher: &self.matcher, events: event, to_eye };
                    let counts = weight * throughput * bsdf.diffuse() / PI;
                    let irradiance = self.arrivals.irradiance(onward, &surface, counts, tools.batches.as_deref_mut());
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

    /// Radiance of the emitter that a gathering ray met, by its weight against points of emitters.
    fn emission_met(&self, ray: &GatherRay<'_>, met: &Surface) -> Rgb {
        let emission = self.transport.emission(met);
        match ray.direct {
            Some(samples) if emission != Rgb::ZERO => {
                samples.weight_of_met(&self.transport, ray.from, met, ray.direction) * emission
            }
            _ => Rgb::ZERO,
        }
    }

    /// Radiance that a place near by sends: its own direct light, the photons of caustics, and one gathering ray further.
    fn leaving_near(&self, place: &NearPlace<'_>, tools: &mut Tools<'_>) -> Rgb {
        let NearPlace { surface, bsdf, media, to_eye, .. } = *place;
        let meets_emitters = !self.transport.ignores_occluders;
        let samples = Samples { light: 1, cosine: u32::from(meets_emitters) };
        let direct = self.receiver(surface, bsdf, false).sample_emitters(samples, tools);
        let weight = place.weight * bsdf.diffuse();
        let caustic = self.arrivals.caustic_irradiance(surface, weight / PI, tools.batches.as_deref_mut());
        let direction = cosine_above(surface.normal, surface.facing, tools.draws.stream.uniform2());
        let gathered = if direction.dot(surface.facing) > 0.0 {
            let direct = meets_emitters.then_some(samples);
            let ray = GatherRay { from: surface, direction, media, to_eye, refines: false, direct, weight };
            self.arriving(&ray, tools)
        } else {
            Rgb::ZERO
        };
        direct + bsdf.diffuse() * (caustic / PI + gathered)
    }
}

/// A place that a gathering ray met so near that it gathers, too.
struct NearPlace<'a> {
    surface: &'a Surface,
    /// Its diffuse lobe.
    bsdf: &'a Bsdf,
    media: Media,
    /// Events from the eye to the place that gathered first.
    to_eye: Path,
    /// What radiance that it sends counts, per channel.
    weight: Rgb,
}
