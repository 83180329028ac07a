//! Light between diffuse surfaces, gathered at each place that is seen by rays into the photon map (Jensen 1996).

use super::arrivals::ArrivalMaps;
use super::direct;
use super::draws::{Draws, Use};
use super::eye_path::{DiffuseLight, Seen};
use super::lights::direct_light;
use super::photon_light::PhotonLight;
use crate::math::random::Stream;
use crate::math::rgb::Rgb;
use crate::math::warp::{cosine_hemisphere, frame};
use crate::methods::photon_map::Scratch;
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
    fn leaving(&self, seen: &Seen<'_>, draws: &mut Draws, scratch: &mut Scratch) -> (Rgb, u64) {
        let (mut radiance, mut rays) = (Rgb::ZERO, 0);
        if self.matcher.passes(Path::LIGHT, Some(Scattering::Diffuse), seen.to_eye) {
            (radiance, rays) = direct_light(&self.transport, seen, self.light_rays, draws);
        }
        radiance += self.caustics.leaving(seen, draws, scratch).0;
        // Behind a mirror a quarter is enough, since less is seen there, and behind two a quarter of these.
        let count = (self.gather_rays >> (2 * seen.to_eye.len()).min(31)).max(1);
        let around = frame(seen.surface.normal);
        let mut sum = Rgb::ZERO;
        for i in 0..count {
            // Only what the eye sees directly is the same in every sample of a pixel.
            let at = if seen.to_eye.is_empty() {
                draws.spread(Use::Gather, i, count)
            } else {
                stratified(i, count, &mut draws.stream)
            };
            let direction = around * cosine_hemisphere(at);
            if direction.dot(seen.surface.facing) > 0.0 {
                let ray = self.transport.leave(seen.surface, direction);
                // A filter tells paths apart by their last bounces, which are known only without a further one.
                let (arriving, more) = self.arriving(seen.to_eye, ray, seen.media, self.matcher.passes_all(), draws);
                sum += arriving;
                rays += more;
            }
        }
        (radiance + seen.bsdf.diffuse() * sum / count.max(1) as f32, rays)
    }
}

/// Point `i` of `count` in [0, 1)², each in a row of its own.
fn stratified(i: u32, count: u32, stream: &mut Stream) -> Vec2 {
    let at = stream.uniform2();
    Vec2::new((i as f32 + at.x) / count as f32, at.y)
}

impl GatherLight {
    /// Radiance that arrives along a gathering ray, without what comes from emitters directly or over specular surfaces, which
    /// is known already; and the rays that this took. With `refines`, what is near is gathered one bounce further.
    fn arriving(&self, to_eye: Path, mut ray: Ray, mut media: Media, refines: bool, draws: &mut Draws) -> (Rgb, u64) {
        let (mut radiance, mut rays) = (Rgb::ZERO, 0);
        let mut throughput = Rgb::ONE;
        for event in 0..MAX_EVENTS {
            rays += 1;
            let Some(surface) = self.transport.meet(&ray) else { break };
            let bsdf = self.transport.bsdf(&surface, -ray.direction, &media);
            if bsdf.diffuse() != Rgb::ZERO {
                let is_near = event == 0 && surface.distance < NEAR_ELEMENTS * self.transport.world.element_size;
                if refines && is_near {
                    let (leaving, more) =
                        self.leaving_near(&surface, &bsdf.only(Scattering::Diffuse), to_eye, media, draws);
                    radiance += throughput * leaving;
                    rays += more;
                } else {
                    let irradiance = self.arrivals.irradiance(&self.matcher, &surface, event, to_eye);
                    radiance += throughput * bsdf.diffuse() * irradiance / PI;
                }
            }
            if !bsdf.is_specular() {
                break;
            }
            let Some(sample) = bsdf.only(Scattering::Specular).sample(throughput, &mut draws.stream) else { break };
            throughput *= sample.weight * sample.narrowing;
            if sample.crosses {
                media = self.transport.media_behind(&surface, media);
            }
            ray = self.transport.leave(&surface, sample.direction);
        }
        (radiance, rays)
    }

    /// Radiance that a place near by sends: its own direct light, the photons of caustics, and one gathering ray further.
    fn leaving_near(
        &self,
        surface: &Surface,
        bsdf: &Bsdf,
        to_eye: Path,
        media: Media,
        draws: &mut Draws,
    ) -> (Rgb, u64) {
        let direct = direct::random(&self.transport, surface, bsdf, draws);
        let caustic = self.arrivals.caustic_irradiance(surface);
        let direction = frame(surface.normal) * cosine_hemisphere(draws.stream.uniform2());
        let (indirect, rays) = if direction.dot(surface.facing) > 0.0 {
            self.arriving(to_eye, self.transport.leave(surface, direction), media, false, draws)
        } else {
            (Rgb::ZERO, 0)
        };
        (direct + bsdf.diffuse() * (caustic / PI + indirect), rays + 1)
    }
}
