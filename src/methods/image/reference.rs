//! The unbiased picture: one path a sample.

use super::eye_path::{Look, Sight, Tools};
use crate::methods::path_trace::PathTracer;
use crate::methods::transport::{Media, Transport};
use crate::tracer::Ray;

impl Look for PathTracer {
    fn look(&self, ray: Ray, media: Media, tools: &mut Tools<'_>) -> Sight {
        let radiance = self.radiance(&ray, media, &tools.draws.path(0, 1), tools.cost);
        Sight { radiance: radiance.unwrap_or_default(), is_surface: radiance.is_some() }
    }

    fn transport(&self) -> &Transport {
        &self.transport
    }
}
