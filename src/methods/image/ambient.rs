//! Pictures with ambient light in place of light between surfaces: how much of it arrives, the diffuse colours without it,
//! and both together (Landis 2002).

use super::direct;
use super::draws::{Draws, Use};
use super::eye_path::{Look, Sight};
use crate::math::rgb::Rgb;
use crate::methods::Settings;
use crate::methods::ambient_occlusion::AmbientOcclusion;
use crate::methods::photon_map::Scratch;
use crate::methods::radiosity::mean_indirect_irradiance;
use crate::methods::transport::{Media, Surface, Transport};
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
    light_rays: u32,
    /// E of the ambient light where nothing is occluded, W/m²; 0 where it is no part of the picture.
    ambient: Rgb,
}

impl AmbientLook {
    /// The ambient light is as bright as light between surfaces is on average. Where nothing emits, its radiance is 1.
    pub fn new(transport: Arc<Transport>, parts: Parts, settings: &Settings) -> Self {
        let is_dark = transport.emitters().is_empty();
        let ambient = match parts {
            _ if is_dark => Rgb::splat(PI),
            Parts::Diffuse => Rgb::ZERO,
            Parts::Occlusion | Parts::DiffuseAmbient => mean_indirect_irradiance(&transport.world),
        };
        Self {
            occlusion: AmbientOcclusion::new(transport.clone(), &settings.occlusion),
            light_rays: if is_dark { 0 } else { settings.image.light_rays },
            transport,
            parts,
            ambient,
        }
    }

    /// The share of the ambient light that counts at a surface, and the rays that this took.
    fn share(&self, surface: &Surface, draws: &Draws) -> (f32, u32) {
        if self.parts == Parts::Diffuse {
            return (1.0, 0);
        }
        let rays = self.occlusion.rays();
        (self.occlusion.visibility(surface, |i| draws.spread(Use::Ambient, i, rays)).share, rays)
    }
}

impl Look for AmbientLook {
    fn look(&self, ray: Ray, media: Media, draws: &mut Draws, _scratch: &mut Scratch) -> Sight {
        let Some(surface) = self.transport.meet(&ray) else { return Sight { rays: 1, ..Sight::default() } };
        let (share, rays) = self.share(&surface, draws);
        let seen = |radiance, rays: u32| Sight { radiance, is_surface: true, rays: 1 + u64::from(rays) };
        if self.parts == Parts::Occlusion {
            return seen(Rgb::splat(share), rays);
        }
        let bsdf = self.transport.bsdf(&surface, -ray.direction, &media).only(Scattering::Diffuse);
        let direct = direct::spread(&self.transport, &surface, &bsdf, self.light_rays, draws);
        let ambient = bsdf.diffuse() * self.ambient * share / PI;
        seen(self.transport.emission(&surface) + direct + ambient, rays + self.light_rays)
    }

    fn transport(&self) -> &Transport {
        &self.transport
    }
}
