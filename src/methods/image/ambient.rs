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
use crate::methods::transport::{Media, Transport};
use crate::solution::Scattering;
use crate::tracer::Ray;
use std::f32::consts::PI;
use std::sync::Arc;

/// What a picture is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parts {
    /// The share of ambient light that arrives.
    Occlusion,
    /// The light of the first surface's diffuse lobe, with the ambient light where that is occluded.
    Diffuse { is_occluded: bool },
}

/// Looks at the first surface and no further.
pub struct AmbientLook {
    transport: Arc<Transport>,
    parts: Parts,
    occlusion: AmbientOcclusion,
    light_rays: u32,
    /// E of the ambient light where nothing is occluded, W/m².
    ambient: Rgb,
}

impl AmbientLook {
    /// The ambient light is as bright as light between surfaces is on average. Where nothing emits, its radiance is 1.
    pub fn new(transport: Arc<Transport>, parts: Parts, settings: &Settings) -> Self {
        let is_dark = transport.emitters().is_empty();
        let ambient = if is_dark { Rgb::splat(PI) } else { mean_indirect_irradiance(&transport.world) };
        Self {
            occlusion: AmbientOcclusion::new(transport.clone(), &settings.occlusion),
            light_rays: settings.image.light_rays,
            transport,
            parts,
            ambient,
        }
    }
}

impl Look for AmbientLook {
    fn look(&self, ray: Ray, media: Media, draws: &mut Draws, _scratch: &mut Scratch) -> Sight {
        let Some(surface) = self.transport.meet(&ray) else { return Sight { rays: 1, ..Sight::default() } };
        let rays = self.occlusion.rays();
        let share = |draws: &Draws| {
            let visibility = self.occlusion.visibility(&surface, |i| draws.spread(Use::Ambient, i, rays));
            (visibility.share, u64::from(rays))
        };
        let (radiance, more) = match self.parts {
            Parts::Occlusion => {
                let (share, rays) = share(draws);
                (Rgb::splat(share), rays)
            }
            Parts::Diffuse { is_occluded } => {
                let bsdf = self.transport.bsdf(&surface, -ray.direction, &media).only(Scattering::Diffuse);
                let is_dark = self.transport.emitters().is_empty();
                let (share, mut more) = match (is_occluded, is_dark) {
                    (true, _) => share(draws),
                    (false, true) => (1.0, 0),
                    (false, false) => (0.0, 0),
                };
                let mut radiance = self.transport.emission(&surface) + bsdf.diffuse() * self.ambient * share / PI;
                if !is_dark {
                    radiance += direct::spread(&self.transport, &surface, &bsdf, self.light_rays, draws);
                    more += u64::from(self.light_rays);
                }
                (radiance, more)
            }
        };
        Sight { radiance, is_surface: true, rays: 1 + more }
    }

    fn transport(&self) -> &Transport {
        &self.transport
    }
}
