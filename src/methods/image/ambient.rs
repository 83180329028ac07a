//! Pictures with ambient light in place of light between surfaces: how much of it arrives, the diffuse colours without it,
//! and both together (Landis 2002).

use super::direct::Receiver;
use super::eye_path::{DiffuseLight, Look, Seen, Sight, Tools};
use crate::effects::Effect;
use crate::math::rgb::Rgb;
use crate::methods::Settings;
use crate::methods::ambient_occlusion::{AmbientOcclusion, Pattern};
use crate::methods::radiosity::mean_indirect_irradiance;
use crate::methods::transport::{Bsdf, Media, Surface, Transport};
use crate::solution::Scattering;
use crate::tracer::Ray;
use std::f32::consts::PI;
use std::sync::Arc;

/// What a picture is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parts {
    /// The share of ambient light that arrives.
    Occlusion,
    /// Direct light on the diffuse lobe of the first surface; where nothing emits, ambient light on it.
    Diffuse,
    /// The same with ambient light, as far as it is not occluded.
    DiffuseAmbient,
}

/// Looks at the first surface and no further.
pub struct AmbientLook {
    transport: Arc<Transport>,
    parts: Parts,
    occlusion: AmbientOcclusion,
    pattern: Pattern,
    light_rays: u32,
    /// E of the ambient light where nothing is occluded, W/m²; 0 where it is no part of the picture.
    ambient: Rgb,
}

impl AmbientLook {
    /// The ambient light is as bright as light between surfaces is on average. Where no emitter lights anything, its radiance
    /// is 1.
    pub fn new(transport: Arc<Transport>, parts: Parts, settings: &Settings) -> Self {
        let is_dark = !transport.world.census.light_may_arrive;
        let ambient = match parts {
            Parts::Diffuse | Parts::DiffuseAmbient if settings.effects.off.contains(Effect::AmbientLight) => Rgb::ZERO,
            _ if is_dark => Rgb::splat(PI),
            Parts::Diffuse => Rgb::ZERO,
            Parts::Occlusion | Parts::DiffuseAmbient => mean_indirect_irradiance(&transport.world, transport.effects),
        };
        Self {
            occlusion: AmbientOcclusion::new(transport.clone(), &settings.occlusion),
            pattern: Pattern::new(settings.occlusion.rays, settings.seed),
            light_rays: if is_dark { 0 } else { settings.image.light_rays },
            transport,
            parts,
            ambient,
        }
    }

    /// The share of the ambient light that counts at a surface.
    fn share(&self, surface: &Surface, tools: &mut Tools<'_>) -> f32 {
        let rays = self.occlusion.rays();
        match self.parts {
            Parts::Diffuse => 1.0,
            Parts::DiffuseAmbient if self.ambient == Rgb::ZERO => {
                tools.cost.save(Effect::AmbientLight, rays);
                0.0
            }
            Parts::DiffuseAmbient | Parts::Occlusion => {
                tools.cost.spend(Effect::AmbientLight, rays);
                self.occlusion.visibility_by(&self.pattern, surface, tools.draws.pixel(), tools.draws.sample()).share
            }
        }
    }

    /// What the diffuse lobe sends on of direct light and of this share of the ambient light, W/(m²·sr).
    fn lit(&self, surface: &Surface, bsdf: &Bsdf, share: f32, tools: &mut Tools<'_>) -> Rgb {
        self.direct(surface, bsdf, tools) + bsdf.diffuse() * self.ambient * share / PI
    }

    /// Light on the diffuse lobe straight from emitters, W/(m²·sr).
    fn direct(&self, surface: &Surface, bsdf: &Bsdf, tools: &mut Tools<'_>) -> Rgb {
        if self.transport.effects.contains(Effect::DirectLight) {
            Receiver { transport: &self.transport, surface, bsdf, is_spread: true }
                .sample_direct(self.light_rays, tools)
        } else {
            tools.cost.save(Effect::DirectLight, self.light_rays);
            Rgb::ZERO
        }
    }
}

impl DiffuseLight for AmbientLook {
    fn leaving(&self, seen: &Seen<'_>, tools: &mut Tools<'_>) -> Rgb {
        let share = self.share(seen.surface, tools);
        self.lit(seen.surface, seen.bsdf, share, tools)
    }
}

impl Look for AmbientLook {
    fn look(&self, ray: Ray, media: Media, tools: &mut Tools<'_>) -> Sight {
        tools.cost.look();
        let Some(surface) = self.transport.meet(&ray) else { return Sight::default() };
        let share = self.share(&surface, tools);
        let seen = |radiance| Sight { radiance, is_surface: true };
        if self.parts == Parts::Occlusion {
            return seen(Rgb::splat(share));
        }
        let bsdf = self.transport.bsdf(&surface, -ray.direction, &media).only(Scattering::Diffuse);
        seen(self.transport.emission(&surface) + self.lit(&surface, &bsdf, share, tools))
    }

    fn transport(&self) -> &Transport {
        &self.transport
    }
}
