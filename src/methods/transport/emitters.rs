//! Emitters: where light starts, and where shadow rays go.

use super::{Media, Surface};
use crate::math::random::{hash, sobol2};
use crate::math::rgb::{Rgb, Rgb64, total};
use crate::math::warp::{cosine_hemisphere, frame};
use crate::mesh::{Region, Sampler};
use crate::tracer::{Ray, SurfacePoint};
use crate::world::World;
use glam::{Vec2, Vec3A};
use std::f64::consts::PI;

/// Points of one low-discrepancy sequence; the next ones belong to another.
const SEQUENCE: u64 = 1 << 16;

/// The triangles of all emitters, chosen in proportion to their flux.
#[derive(Default)]
pub struct Emitters {
    lamps: Vec<Lamp>,
    /// For each lamp the share of the flux of it and those before, in [0, 1].
    cumulative: Vec<f64>,
    flux: Rgb64,
}

/// A triangle that emits from its front.
struct Lamp {
    points: Sampler,
    normal: Vec3A,
    polygon: u32,
    media: Media,
    /// W/(m²·sr)
    radiance: Rgb,
    /// m²
    area: f64,
    /// Chance to be chosen.
    chance: f64,
}

/// A photon as it leaves an emitter.
#[derive(Clone, Copy, Debug)]
pub struct Emission {
    pub ray: Ray,
    /// W
    pub flux: Rgb,
    /// The glass that the emitter is in.
    pub media: Media,
}

/// A point of an emitter, chosen with a known density.
#[derive(Clone, Copy, Debug)]
pub struct LampPoint {
    pub point: Vec3A,
    /// Unit normal of the front.
    pub normal: Vec3A,
    pub polygon: u32,
    /// W/(m²·sr)
    pub radiance: Rgb,
    /// 1/m²
    pub density: f32,
}

/// The light that a point of an emitter sends to a place, if nothing is between.
#[derive(Clone, Copy, Debug)]
pub struct Arrival {
    /// Unit vector towards the point.
    pub direction: Vec3A,
    /// L over `density`: times f |cos θ|, its expectation is the radiance that the place sends on, W/(m²·sr).
    pub radiance: Rgb,
    /// Of the choice of the direction, 1/sr.
    pub density: f32,
}

impl LampPoint {
    /// Where shadow rays end.
    pub fn surface_point(&self) -> SurfacePoint {
        SurfacePoint { point: self.point, polygon: self.polygon }
    }

    /// `None` where the place is behind the emitter, or a part of it.
    pub fn arrival(&self, surface: &Surface) -> Option<Arrival> {
        let way = self.point - surface.point;
        let square = way.length_squared();
        let direction = way / square.sqrt();
        let cosine = -direction.dot(self.normal);
        if self.polygon == surface.polygon || cosine.is_nan() || cosine <= 0.0 {
            return None;
        }
        let density = self.density * square / cosine;
        Some(Arrival { direction, radiance: self.radiance / density, density })
    }
}

impl Emitters {
    /// The emitters of a world; of a polygon's front, `front` tells the unit normal and the emission, W/(m²·sr).
    pub fn new(world: &World, front: impl Fn(usize) -> (Vec3A, Rgb)) -> Self {
        let scene = &world.scene;
        let mut lamps = Vec::new();
        for (index, polygon) in scene.polygons.iter().enumerate() {
            let (normal, radiance) = front(index);
            if radiance == Rgb::ZERO {
                continue;
            }
            let corner = |i: usize| Vec3A::from(scene.positions[polygon.corners()[i] as usize]);
            // A quad need not be a parallelogram, on which alone a bilinear map is uniform.
            for i in 2..polygon.corners().len() {
                let corners = [corner(0), corner(i - 1), corner(i)];
                let region = Region::new([corners[0], corners[1], corners[2], corners[2]], 3);
                let [a, b, c] = corners.map(|corner| corner.as_dvec3());
                lamps.push(Lamp {
                    points: region.sampler(Vec3A::ZERO),
                    normal,
                    polygon: index as u32,
                    media: Media::default(),
                    radiance,
                    area: 0.5 * (b - a).cross(c - a).length(),
                    chance: 0.0,
                });
            }
        }
        let flux: Rgb64 = lamps.iter().map(Lamp::flux).sum();
        let mut sum = 0.0;
        let mut cumulative = Vec::with_capacity(lamps.len());
        for lamp in &mut lamps {
            lamp.chance = total(lamp.flux()) / total(flux);
            sum += lamp.chance;
            cumulative.push(sum);
        }
        Self { lamps, cumulative, flux }
    }

    /// Finds out which glass each emitter is in; `media_beside` knows it of a point of a side.
    pub fn place_in_media(&mut self, media_beside: impl Fn(SurfacePoint, Vec3A) -> Media) {
        for lamp in &mut self.lamps {
            let middle = SurfacePoint { point: lamp.points.point(Vec2::splat(0.5)), polygon: lamp.polygon };
            lamp.media = media_beside(middle, lamp.normal);
        }
    }

    /// Whether nothing emits.
    pub fn is_empty(&self) -> bool {
        self.lamps.is_empty()
    }

    /// Σ π L A, W.
    pub fn flux(&self) -> Rgb64 {
        self.flux
    }

    /// Photon `index` of `count` that share the flux of all emitters: from a point in proportion to the flux that leaves
    /// there, in a direction with the density cos θ / π. Points, directions and emitters of the first 65,536 photons of a
    /// (seed, pass), and of each 65,536 after them, are a low-discrepancy sequence. `None` where nothing emits.
    pub fn emit(&self, index: u64, count: u64, seed: u64, pass: u64) -> Option<Emission> {
        let sequence = hash(seed, pass, index / SEQUENCE) as u32;
        let place = (index % SEQUENCE) as u32;
        let lamp = self.choose(f64::from(sobol2(place, 2, sequence).x))?;
        let direction = frame(lamp.normal) * cosine_hemisphere(sobol2(place, 1, sequence));
        let from = SurfacePoint { point: lamp.points.point(sobol2(place, 0, sequence)), polygon: lamp.polygon };
        let flux = lamp.flux() / (lamp.chance * count as f64);
        Some(Emission { ray: Ray::leaving(from, direction), flux: flux.as_vec3(), media: lamp.media })
    }

    /// A point of an emitter, for numbers in [0, 1): emitters in proportion to their flux, points evenly over each. `None`
    /// where nothing emits.
    pub fn point(&self, choice: f32, at: Vec2) -> Option<LampPoint> {
        let lamp = self.choose(f64::from(choice))?;
        Some(LampPoint {
            point: lamp.points.point(at),
            normal: lamp.normal,
            polygon: lamp.polygon,
            radiance: lamp.radiance,
            density: (lamp.chance / lamp.area) as f32,
        })
    }

    /// The density, 1/sr, with which [`Emitters::point`] chooses the direction of a ray that met the front of an emitter, with
    /// this emission.
    pub fn density(&self, emission: Rgb, surface: &Surface, direction: Vec3A) -> f32 {
        // Chosen by flux, the same for all points of all triangles with this emission.
        let density = PI * total(emission.as_dvec3()) / total(self.flux);
        let cosine = -direction.dot(surface.facing);
        density as f32 * surface.distance * surface.distance / cosine.max(f32::MIN_POSITIVE)
    }

    fn choose(&self, choice: f64) -> Option<&Lamp> {
        let place = self.cumulative.partition_point(|&share| share <= choice);
        self.lamps.get(place).or(self.lamps.last())
    }
}

impl Lamp {
    /// W
    fn flux(&self) -> Rgb64 {
        self.radiance.as_dvec3() * (PI * self.area)
    }
}
