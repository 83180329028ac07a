//! Ambient occlusion beside the light that it stands for: at the first surface, the share of ambient light, and the
//! irradiance of all light that does not come straight from an emitter, by path tracing (Kajiya 1986).

use super::direct;
use super::draws::Use;
use super::eye_path::{Look, Sight, Tools};
use crate::effects::Effect;
use crate::math::rgb::{Rgb, luminance};
use crate::math::warp::{cosine_hemisphere, frame};
use crate::methods::Settings;
use crate::methods::ambient_occlusion::{AmbientOcclusion, Pattern};
use crate::methods::transport::{Media, Surface, Transport};
use crate::solution::Scattering;
use crate::tracer::Ray;
use std::f32::consts::PI;
use std::sync::Arc;

/// Paths of a sample: as many as take about as long as its rays for ambient occlusion do.
const PATHS: u32 = 4;
/// From this bounce on, what carries little light is ended at random.
const ROULETTE: u32 = 4;
/// Nothing goes on for certain then, so that all ends.
const MOST_SURVIVAL: f32 = 0.95;

/// Looks at the first surface, and from there at all others.
pub struct ContrastLook {
    transport: Arc<Transport>,
    occlusion: AmbientOcclusion,
    pattern: Pattern,
}

impl ContrastLook {
    pub fn new(transport: Arc<Transport>, settings: &Settings) -> Self {
        Self {
            occlusion: AmbientOcclusion::new(transport.clone(), &settings.occlusion),
            pattern: Pattern::new(settings.occlusion.rays, settings.seed),
            transport,
        }
    }

    /// The share of ambient light that arrives.
    fn share(&self, surface: &Surface, tools: &mut Tools<'_>) -> f32 {
        tools.cost.rays += u64::from(self.occlusion.rays());
        let (asker, time) = (tools.draws.pixel(), tools.draws.sample());
        self.occlusion.visibility_by(&self.pattern, surface, asker, time).share
    }

    /// E of all light that comes from other surfaces than emitters, or from these over specular ones, W/m².
    fn indirect_irradiance(&self, surface: &Surface, media: Media, tools: &mut Tools<'_>) -> Rgb {
        let around = frame(surface.normal);
        let mut sum = Rgb::ZERO;
        for path in 0..PATHS {
            let direction = around * cosine_hemisphere(tools.draws.spread(Use::Gather, path, PATHS));
            if direction.dot(surface.facing) > 0.0 {
                // It may end at a diffuse surface or at a specular one.
                tools.cost.look();
                sum += self.indirect(self.transport.leave(surface, direction), media, tools);
            }
        }
        PI * sum / PATHS as f32
    }

    /// Radiance that arrives along a ray from a diffuse surface, without what an emitter sends along it: at every surface
    /// by one ray to an emitter, and further along one path. Emitters that are met over specular surfaces count, since no
    /// ray to them finds this way.
    fn indirect(&self, mut ray: Ray, mut media: Media, tools: &mut Tools<'_>) -> Rgb {
        let spreads = self.transport.effects.contains(Effect::Interreflection);
        let (mut sum, mut throughput, mut meets_emitters) = (Rgb::ZERO, Rgb::ONE, false);
        for bounce in 1.. {
            let Some(surface) = self.transport.meet(&ray) else { break };
            if meets_emitters {
                sum += throughput * self.transport.emission(&surface);
            }
            let whole = self.transport.bsdf(&surface, -ray.direction, &media);
            let bsdf = if spreads { whole } else { whole.only(Scattering::Specular) };
            for effect in self.transport.skipped(&surface).iter() {
                tools.cost.save(effect, 1);
            }
            if bsdf.diffuse() != Rgb::ZERO {
                let diffuse = bsdf.only(Scattering::Diffuse);
                sum += throughput * direct::random(&self.transport, &surface, &diffuse, tools);
            }
            if !spreads && whole.diffuse() != Rgb::ZERO {
                tools.cost.save(Effect::Interreflection, 1);
            }
            let Some(sample) = bsdf.sample(throughput, &mut tools.draws.stream) else { break };
            throughput *= sample.weight * sample.narrowing;
            meets_emitters = sample.scattering == Scattering::Specular;
            if bounce >= ROULETTE {
                let survival = throughput.max_element().min(MOST_SURVIVAL);
                if tools.draws.stream.uniform() >= survival {
                    break;
                }
                throughput /= survival;
            }
            if sample.crosses {
                media = self.transport.media_behind(&surface, media);
            }
            tools.cost.spend(sample.effect(), 1);
            ray = self.transport.leave(&surface, sample.direction);
        }
        sum
    }
}

impl Look for ContrastLook {
    /// The two numbers take the places of the first two channels.
    fn look(&self, ray: Ray, media: Media, tools: &mut Tools<'_>) -> Sight {
        tools.cost.look();
        let Some(surface) = self.transport.meet(&ray) else { return Sight::default() };
        let share = self.share(&surface, tools);
        let irradiance = self.indirect_irradiance(&surface, media, tools);
        Sight { radiance: Rgb::new(share, luminance(irradiance), 0.0), is_surface: true }
    }

    fn transport(&self) -> &Transport {
        &self.transport
    }
}
