//! The truth by brute force: the radiance along rays from the eye by plain path tracing.

use lightwell::camera::Camera;
use lightwell::math::random::Stream;
use lightwell::math::rgb::Rgb;
use lightwell::math::stats::Moments;
use lightwell::methods::transport::{Bsdf, Media, Surface, Transport};
use lightwell::solution::Scattering;
use lightwell::tracer::Ray;
use rayon::prelude::*;

/// What a region of a picture shows, W/(m²·sr) summed over RGB, with its standard error, and the mean of each channel.
#[allow(dead_code, reason = "only the tests ask for parts of pictures")]
pub struct Region {
    pub total: Moments,
    pub mean: Rgb,
}

/// Mean radiance of a rectangle, in shares of a square picture from the top left, by so many paths.
#[allow(dead_code, reason = "only the tests ask for parts of pictures")]
pub fn region(transport: &Transport, camera: &Camera, x: [f32; 2], y: [f32; 2], paths: u64) -> Region {
    const SIZE: f32 = 512.0;
    let path = |index: u64| {
        let mut stream = Stream::new(17, 4, index);
        let at = stream.uniform2();
        let place = [x[0] + at.x * (x[1] - x[0]), y[0] + at.y * (y[1] - y[0])].map(|share| share * SIZE);
        radiance(transport, camera.ray(place, [SIZE as u32; 2]), &mut stream)
    };
    let paths: Vec<Rgb> = (0..paths).into_par_iter().map(path).collect();
    let mut total = Moments::default();
    for path in &paths {
        total.add(f64::from(path.element_sum()));
    }
    Region { total, mean: paths.iter().sum::<Rgb>() / paths.len() as f32 }
}

/// Mean radiance of a pixel by so many paths, W/(m²·sr), and the variance of that mean.
#[allow(dead_code, reason = "only the bench asks for whole pictures")]
pub fn pixel(transport: &Transport, camera: &Camera, at: [u32; 2], size: [u32; 2], paths: u64) -> (Rgb, Rgb) {
    let mut stream = Stream::new(18, u64::from(at[0]), u64::from(at[1]));
    let (mut sum, mut squares) = (Rgb::ZERO, Rgb::ZERO);
    for _ in 0..paths {
        let place = stream.uniform2() + glam::Vec2::new(at[0] as f32, at[1] as f32);
        let path = radiance(transport, camera.ray(place.to_array(), size), &mut stream);
        sum += path;
        squares += path * path;
    }
    let mean = sum / paths as f32;
    (mean, (squares / paths as f32 - mean * mean).max(Rgb::ZERO) / paths as f32)
}

/// One path: light from the lamps at each diffuse surface; after anything else, lamps count where they are met.
fn radiance(transport: &Transport, mut ray: Ray, stream: &mut Stream) -> Rgb {
    let (mut sum, mut throughput, mut media) = (Rgb::ZERO, Rgb::ONE, Media::default());
    let mut meets_lamps = true;
    for bounce in 0.. {
        let Some(surface) = transport.meet(&ray) else { break };
        if meets_lamps {
            sum += throughput * transport.emission(&surface);
        }
        let bsdf = transport.bsdf(&surface, -ray.direction, &media);
        sum += throughput * direct(transport, &surface, &bsdf, stream);
        let Some(sample) = bsdf.sample(throughput, stream) else { break };
        throughput *= sample.weight * sample.narrowing;
        meets_lamps = sample.scattering == Scattering::Specular;
        if bounce > 3 {
            let survival = throughput.max_element().min(0.95);
            if stream.uniform() >= survival {
                break;
            }
            throughput /= survival;
        }
        if sample.crosses {
            media = transport.media_behind(&surface, media);
        }
        ray = transport.leave(&surface, sample.direction);
    }
    sum
}

fn direct(transport: &Transport, surface: &Surface, bsdf: &Bsdf, stream: &mut Stream) -> Rgb {
    let sample = transport.emitters().sample(surface, stream.uniform(), stream.uniform2());
    let seen = sample.filter(|sample| transport.sees(surface, sample.point));
    seen.map_or(Rgb::ZERO, |sample| sample.radiance * bsdf.value(sample.direction)[0])
}
