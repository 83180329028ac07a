//! Light straight from the emitters, by rays to points of them.

use super::draws::Use;
use super::eye_path::Tools;
use crate::effects::Effect;
use crate::math::rgb::Rgb;
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
    let way = lamp.point - surface.point;
    let square = way.length_squared();
    let direction = way / square.sqrt();
    let cosine_at_lamp = -direction.dot(lamp.normal);
    if lamp.polygon == surface.polygon || cosine_at_lamp.is_nan() || cosine_at_lamp <= 0.0 {
        return Rgb::ZERO;
    }
    let [diffuse, _] = bsdf.value(direction);
    if diffuse == Rgb::ZERO {
        return Rgb::ZERO;
    }
    if transport.effects.contains(Effect::Shadows) {
        tools.cost.spend(Effect::Shadows, 1);
        if !transport.sees(surface, lamp.point) {
            return Rgb::ZERO;
        }
    } else {
        tools.cost.save(Effect::Shadows, 1);
    }
    lamp.radiance * diffuse * (cosine_at_lamp / (square * lamp.density))
}
