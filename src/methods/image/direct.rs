//! Light straight from the emitters on diffuse surfaces: next-event estimation, weighed against cosine-distributed rays where
//! emitters are near.

use super::draws::Use;
use super::eye_path::Tools;
use crate::effects::Effect;
use crate::math::rgb::Rgb;
use crate::math::warp::{cosine_above, share_above};
use crate::methods::mis::power_heuristic;
use crate::methods::shadows::is_lit;
use crate::methods::transport::{Bsdf, Surface, Transport};
use glam::Vec3A;
use std::f32::consts::PI;

/// How often the direct light of a place is sampled in either way.
#[derive(Clone, Copy, Debug)]
pub struct Samples {
    /// Points of emitters.
    pub light: u32,
    /// Cosine-distributed rays: 0 where there are none that may meet an emitter.
    pub cosine: u32,
}

/// A place whose direct light is looked for.
pub struct Receiver<'a> {
    pub transport: &'a Transport,
    pub surface: &'a Surface,
    /// Only its diffuse lobe counts.
    pub bsdf: &'a Bsdf,
    /// Whether numbers are low-discrepancy over the samples of a pixel, which pays where all these see about the same place.
    pub is_spread: bool,
}

impl Samples {
    /// The weight of an emitter that a cosine-distributed ray from `surface` met.
    pub fn weight_of_met(&self, transport: &Transport, surface: &Surface, met: &Surface, direction: Vec3A) -> f32 {
        let pdf = transport.emitters().pdf(surface, met, direction);
        power_heuristic(self.cosine as f32 * cosine_pdf(surface, direction), self.light as f32 * pdf)
    }
}

/// Of the directions of diffuse rays, 1/sr.
fn cosine_pdf(surface: &Surface, direction: Vec3A) -> f32 {
    direction.dot(surface.normal).max(0.0) / (PI * share_above(surface.normal, surface.facing))
}

impl Receiver<'_> {
    /// Radiance that the diffuse lobe sends on of direct light, W/(m²·sr), by `count` points of emitters, and where emitters
    /// are near by as many cosine-distributed rays.
    pub fn sample_direct(&self, count: u32, tools: &mut Tools<'_>) -> Rgb {
        let is_near = !self.transport.ignores_occluders && self.transport.emitters().are_near(self.surface);
        let samples = Samples { light: count, cosine: if is_near { count } else { 0 } };
        let by_points = self.sample_emitters(samples, tools);
        if is_near { by_points + self.sample_cosine(samples, tools) } else { by_points }
    }

    /// The part that points of emitters have of it.
    pub fn sample_emitters(&self, samples: Samples, tools: &mut Tools<'_>) -> Rgb {
        let sum: Rgb = (0..samples.light).map(|i| self.sample_emitter(i, samples, tools)).sum();
        sum / samples.light.max(1) as f32
    }

    fn sample_emitter(&self, i: u32, samples: Samples, tools: &mut Tools<'_>) -> Rgb {
        let (choice, at) = tools.draws.numbers(self.is_spread.then_some(Use::Light), i, samples.light);
        let Some(sample) = self.transport.emitters().sample(self.surface, choice, at) else { return Rgb::ZERO };
        let [diffuse, _] = self.bsdf.value(sample.direction);
        if diffuse == Rgb::ZERO || !is_lit(self.transport, self.surface, sample.point, tools.cost) {
            return Rgb::ZERO;
        }
        let other = samples.cosine as f32 * cosine_pdf(self.surface, sample.direction);
        power_heuristic(samples.light as f32 * sample.pdf, other) * diffuse * sample.radiance
    }

    /// The part that cosine-distributed rays have of it.
    fn sample_cosine(&self, samples: Samples, tools: &mut Tools<'_>) -> Rgb {
        let mut sum = Rgb::ZERO;
        for i in 0..samples.cosine {
            let (_, at) = tools.draws.numbers(self.is_spread.then_some(Use::DirectCosine), i, samples.cosine);
            let direction = cosine_above(self.surface.normal, self.surface.facing, at);
            if direction.dot(self.surface.facing) > 0.0 {
                tools.cost.spend(Effect::DirectLight, 1);
                let met = self.transport.meet(&self.transport.leave(self.surface, direction));
                sum += met.map_or(Rgb::ZERO, |met| self.emission_met(&met, direction, samples));
            }
        }
        self.bsdf.diffuse() * sum / samples.cosine.max(1) as f32
    }

    fn emission_met(&self, met: &Surface, direction: Vec3A, samples: Samples) -> Rgb {
        let emission = self.transport.emission(met);
        if emission == Rgb::ZERO {
            return Rgb::ZERO;
        }
        samples.weight_of_met(self.transport, self.surface, met, direction) * emission
    }
}
