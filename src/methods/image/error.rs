//! The light of a view beside the truth about it, pixel by pixel.

use super::eye_path::{Look, Sight, Tools};
use crate::math::rgb::{Rgb, luminance};
use crate::methods::path_trace::PathTracer;
use crate::methods::transport::{Media, Transport};
use crate::solution::PathMatcher;
use crate::tracer::Ray;
use std::sync::Arc;

/// Looks along each ray as a view does, and by two paths whose difference tells how noisy the truth is.
pub struct ErrorLook<L> {
    judged: L,
    truth: PathTracer,
}

impl<L: Look> ErrorLook<L> {
    pub fn new(transport: Arc<Transport>, judged: L) -> Self {
        Self { judged, truth: PathTracer::new(transport, PathMatcher::default()) }
    }
}

impl<L: Look> Look for ErrorLook<L> {
    /// What [`crate::solution::PictureError::of`] is made of takes the places of the three channels. What an emitter that is
    /// seen emits itself is no light that anybody has to find.
    fn look(&self, ray: Ray, media: Media, tools: &mut Tools<'_>) -> Sight {
        tools.cost.look();
        let Some(surface) = self.transport().meet(&ray) else { return Sight::default() };
        let emitted = luminance(self.transport().emission(&surface));
        let judged = luminance(self.judged.look(ray, media, tools).radiance) - emitted;
        let [one, other] = [0, 1].map(|set| {
            let path = self.truth.radiance(&ray, media, &tools.draws.path_of_set(set), tools.cost);
            luminance(path.unwrap_or_default()) - emitted
        });
        Sight { radiance: Rgb::new(judged, (one + other) / 2.0, (one - other) / 2.0), is_surface: true }
    }

    fn transport(&self) -> &Transport {
        &self.truth.transport
    }
}
