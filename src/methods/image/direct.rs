//! Light straight from the emitters, by rays to points of them.

use super::draws::Use;
use super::eye_path::Tools;
use crate::math::rgb::Rgb;
use crate::methods::shadows::is_lit;
use crate::methods::transport::{Bsdf, LampPoint, Surface, Transport};

/// Radiance that the diffuse lobe of a surface sends on of the light that comes straight from emitters, W/(m²·sr), by
/// `rays` rays to points that are well spread over the samples of a pixel.
pub fn spread(transport: &Transport, surface: &Surface, bsdf: &Bsdf, rays: u32, tools: &mut Tools<'_>) -> Rgb {
    let sum: Rgb = (0..rays)
        .map(|i| {
            let (which, place) = (tools.draws.spread1(Use::Light, i, rays), tools.draws.spread(Use::Light, i, rays));
            let lamp = transport.emitters().point(which, place);
            lamp.map_or(Rgb::ZERO, |lamp| from_point(transport, surface, bsdf, &lamp, tools))
        })
        .sum();
    sum / rays.max(1) as f32
}

/// The same by one ray to a point chosen at random.
pub fn random(transport: &Transport, surface: &Surface, bsdf: &Bsdf, tools: &mut Tools<'_>) -> Rgb {
    let stream = &mut tools.draws.stream;
    let lamp = transport.emitters().point(stream.uniform(), stream.uniform2());
    lamp.map_or(Rgb::ZERO, |lamp| from_point(transport, surface, bsdf, &lamp, tools))
}

/// What one point of an emitter stands for.
fn from_point(transport: &Transport, surface: &Surface, bsdf: &Bsdf, lamp: &LampPoint, tools: &mut Tools<'_>) -> Rgb {
    let Some(arrival) = lamp.arrival(surface) else { return Rgb::ZERO };
    let [diffuse, _] = bsdf.value(arrival.direction);
    if diffuse == Rgb::ZERO || !is_lit(transport, surface, lamp.surface_point(), tools.cost) {
        return Rgb::ZERO;
    }
    diffuse * arrival.radiance
}
