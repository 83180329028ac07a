//! Ambient occlusion beside the light that it stands for: at the first surface, the share of ambient light, and the
//! irradiance of all light that does not come straight from an emitter, by path tracing (Kajiya 1986).

use super::eye_path::{Look, Sight, Tools};
use crate::math::rgb::{Rgb, luminance};
use crate::methods::Settings;
use crate::methods::ambient_occlusion::{AmbientOcclusion, Pattern};
use crate::methods::path_trace::PathTracer;
use crate::methods::transport::{Media, Surface, Transport};
use crate::tracer::Ray;
use std::sync::Arc;

/// Paths of a sample: as many as take about as long as its rays for ambient occlusion do.
const PATHS: u32 = 4;

/// Looks at the first surface, and from there at all others.
pub struct ContrastLook {
    tracer: PathTracer,
    occlusion: AmbientOcclusion,
    pattern: Pattern,
}

impl ContrastLook {
    pub fn new(transport: Arc<Transport>, settings: &Settings) -> Self {
        Self {
            occlusion: AmbientOcclusion::new(transport.clone(), &settings.occlusion),
            pattern: Pattern::new(settings.occlusion.rays, settings.seed),
            tracer: PathTracer::of_indirect_light(transport),
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
        let path = |i| self.tracer.irradiance(surface, media, &tools.draws.path(i, PATHS), tools.cost);
        (0..PATHS).map(path).sum::<Rgb>() / PATHS as f32
    }
}

impl Look for ContrastLook {
    /// The two numbers take the places of the first two channels.
    fn look(&self, ray: Ray, media: Media, tools: &mut Tools<'_>) -> Sight {
        tools.cost.look();
        let Some(surface) = self.transport().meet(&ray) else { return Sight::default() };
        let share = self.share(&surface, tools);
        let irradiance = self.indirect_irradiance(&surface, media, tools);
        Sight { radiance: Rgb::new(share, luminance(irradiance), 0.0), is_surface: true }
    }

    fn transport(&self) -> &Transport {
        &self.tracer.transport
    }
}
