//! The way of a ray from the eye over specular surfaces, to wherever light is known (Whitted 1980; Kajiya 1986).

use super::draws::Draws;
use crate::math::rgb::Rgb;
use crate::methods::photon_map::Scratch;
use crate::methods::transport::{Bsdf, Media, Surface, Transport};
use crate::solution::{Path, PathMatcher, Scattering};
use crate::tracer::Ray;
use std::sync::Arc;

/// A ray meets at most this many specular surfaces.
const MAX_EVENTS: usize = 30;
/// From here on rays that carry little are ended at random.
const FREE_EVENTS: usize = 4;

/// A place that is seen, and how it is.
pub struct Seen<'a> {
    pub surface: &'a Surface,
    pub bsdf: &'a Bsdf,
    /// Events from the eye backwards.
    pub to_eye: Path,
}

/// What is known of the light that diffuse lobes send on.
pub trait DiffuseLight: Send + Sync {
    /// Radiance that the diffuse lobe of the place sends towards the eye, W/(m²·sr), and the rays that this took.
    fn leaving(&self, seen: &Seen<'_>, draws: &mut Draws, scratch: &mut Scratch) -> (Rgb, u64);
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
    pub rays: u64,
}

impl EyePath {
    /// Radiance that arrives along a ray: what surfaces emit and what their diffuse lobes send on, directly and over specular
    /// lobes, one of which is followed at random at each surface.
    pub fn look(&self, mut ray: Ray, draws: &mut Draws, scratch: &mut Scratch) -> Sight {
        let mut sight = Sight::default();
        let (mut throughput, mut media, mut to_eye) = (Rgb::ONE, Media::default(), Path::LIGHT);
        for event in 0..MAX_EVENTS {
            sight.rays += 1;
            let Some(surface) = self.transport.meet(&ray) else { break };
            sight.is_surface = true;
            let emitted = self.transport.emission(&surface);
            if emitted != Rgb::ZERO && self.matcher.passes(Path::LIGHT, None, to_eye) {
                sight.radiance += throughput * emitted;
            }
            let bsdf = self.transport.bsdf(&surface, -ray.direction, &media);
            if bsdf.diffuse() != Rgb::ZERO {
                let seen = Seen { surface: &surface, bsdf: &bsdf.only(Scattering::Diffuse), to_eye };
                let (leaving, rays) = self.light.leaving(&seen, draws, scratch);
                sight.radiance += throughput * leaving;
                sight.rays += rays;
            }
            if !bsdf.is_specular() {
                break;
            }
            let Some(sample) = bsdf.only(Scattering::Specular).sample(throughput, &mut draws.stream) else { break };
            throughput *= sample.weight * sample.narrowing;
            if event >= FREE_EVENTS {
                let survival = throughput.max_element().min(1.0);
                if draws.stream.uniform() >= survival {
                    break;
                }
                throughput /= survival;
            }
            if sample.crosses {
                media = self.transport.media_behind(&surface, media);
            }
            to_eye = to_eye.then(Scattering::Specular);
            ray = self.transport.leave(&surface, sample.direction);
        }
        sight
    }
}
