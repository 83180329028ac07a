//! Ambient occlusion: how much of an even light from everywhere arrives at a point (Zhukov, Iones, Kronin 1998; Landis
//! 2002). It is a guess at indirect light, and needs no emitter.

mod falloff;
mod pattern;
mod point;
mod vertices;

pub use falloff::{Falloff, OcclusionSettings, Range};
pub use pattern::Pattern;
pub use point::shares;
pub use vertices::VertexOcclusion;

use crate::math::warp::{cosine_hemisphere, frame};
use crate::methods::transport::{Surface, Transport};
use crate::tracer::Ray;
use glam::{Mat3A, Vec2, Vec3A};
use std::sync::Arc;

/// Asks of points how much ambient light arrives there.
pub struct AmbientOcclusion {
    transport: Arc<Transport>,
    falloff: Falloff,
    /// m
    range: f32,
    rays: u32,
}

/// What some rays found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Visibility {
    /// Share of the ambient light that arrives, in [0, 1].
    pub share: f32,
    /// Sum of the free directions, each by how free it is: where light comes from, not of unit length. 0 where none comes.
    pub bent_normal: Vec3A,
}

impl AmbientOcclusion {
    pub fn new(transport: Arc<Transport>, settings: &OcclusionSettings) -> Self {
        let range = settings.range.metres(transport.world.bounds.radius());
        Self { falloff: settings.falloff, range, rays: settings.rays, transport }
    }

    /// Rays that one question takes.
    pub fn rays(&self) -> u32 {
        self.rays
    }

    /// The mean over rays that are distributed by their cosine with the shading normal; `square` gives points of [0, 1)²,
    /// which should be stratified. What a shading normal tilts below the surface arrives nowhere, and counts as dark.
    pub fn visibility(&self, surface: &Surface, square: impl Fn(u32) -> Vec2) -> Visibility {
        let directions = (0..self.rays).map(|i| cosine_hemisphere(square(i)));
        self.mean(surface, frame(surface.normal), directions)
    }

    /// The same by the directions of a pattern that was made for as many rays, for question number `time` of `asker`.
    pub fn visibility_by(&self, pattern: &Pattern, surface: &Surface, asker: u64, time: u64) -> Visibility {
        let (directions, turn) = pattern.block(asker, time);
        self.mean(surface, frame(surface.normal) * turn, directions.iter().copied())
    }

    /// Over directions about z, which `around` turns to the surface.
    fn mean(&self, surface: &Surface, around: Mat3A, directions: impl Iterator<Item = Vec3A>) -> Visibility {
        let tracer = &self.transport.world.tracer;
        let reach = self.falloff.reach(self.range);
        let is_all_or_nothing = self.falloff.is_all_or_nothing(self.range);
        let free_share = |ray: &Ray| {
            if is_all_or_nothing {
                return if tracer.is_free(ray, reach) { 1.0 } else { 0.0 };
            }
            let hit = tracer.closest_within(ray, reach);
            hit.map_or(1.0, |hit| 1.0 - self.falloff.occlusion(hit.distance, self.range))
        };
        let (mut sum, mut bent_normal) = (0.0, Vec3A::ZERO);
        for direction in directions {
            let direction = around * direction;
            if direction.dot(surface.facing) > 0.0 {
                let free = free_share(&Ray::leaving(surface.surface_point(), direction));
                sum += free;
                bent_normal += free * direction;
            }
        }
        Visibility { share: sum / self.rays.max(1) as f32, bent_normal }
    }
}
