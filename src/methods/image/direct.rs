//! Light straight from the emitters, by rays to points of them.

use super::draws::{Draws, Use};
use crate::math::rgb::Rgb;
use crate::methods::transport::{Bsdf, LampPoint, Surface, Transport};

/// Radiance that the diffuse lobe of a surface sends on of the light that comes straight from emitters, W/(m²·sr), by
/// `rays` rays to points that are well spread over the samples of a pixel.
pub fn spread(transport: &Transport, surface: &Surface, bsdf: &Bsdf, rays: u32, draws: &Draws) -> Rgb {
    let sum: Rgb = (0..rays)
        .map(|i| {
            let lamp =
                transport.emitters().point(draws.spread1(Use::Light, i, rays), draws.spread(Use::Light, i, rays));
            lamp.map_or(Rgb::ZERO, |lamp| from_point(transport, surface, bsdf, &lamp))
        })
        .sum();
    sum / rays.max(1) as f32
}

/// The same by one ray to a point chosen at random.
pub fn random(transport: &Transport, surface: &Surface, bsdf: &Bsdf, draws: &mut Draws) -> Rgb {
    let lamp = transport.emitters().point(draws.stream.uniform(), draws.stream.uniform2());
    lamp.map_or(Rgb::ZERO, |lamp| from_point(transport, surface, bsdf, &lamp))
}

/// What one point of an emitter stands for.
fn from_point(transport: &Transport, surface: &Surface, bsdf: &Bsdf, lamp: &LampPoint) -> Rgb {
    let way = lamp.point - surface.point;
    let square = way.length_squared();
    let direction = way / square.sqrt();
    let cosine_at_lamp = -direction.dot(lamp.normal);
    if lamp.polygon == surface.polygon || cosine_at_lamp.is_nan() || cosine_at_lamp <= 0.0 {
        return Rgb::ZERO;
    }
    let [diffuse, _] = bsdf.value(direction);
    if diffuse == Rgb::ZERO || !transport.sees(surface, lamp.point) {
        return Rgb::ZERO;
    }
    lamp.radiance * diffuse * (cosine_at_lamp / (square * lamp.density))
}
