//! All emitters of a scene: where light starts, and where shadow rays go.

use super::emitter::Emitter;
use super::emitter_tree::{ChosenEmitter, EmitterTree};
use super::{Media, Surface};
use crate::math::bounds::Bounds;
use crate::math::box_tree::{BoxTree, grown};
use crate::math::random::{hash, sobol2};
use crate::math::rgb::{Rgb, Rgb64, total};
use crate::math::warp::{cosine_hemisphere, frame};
use crate::tracer::{Ray, SurfacePoint};
use crate::world::World;
use glam::{Vec2, Vec3A};
use std::f64::consts::PI;

/// Points of one low-discrepancy sequence; the next ones belong to another.
const SEQUENCE: u64 = 1 << 16;
/// Coordinates of surfaces are known to about this share of the tracer's offset, which is 32 units in the last
/// place: a place that is so near to the plane of an emitter is taken to be in it.
const ROUNDING: f64 = 1.0 / 16.0;
/// Share of the samples that choose emitters by flux, whatever is expected of them: no emitter is chosen so seldom, where the
/// expectation is wrong, that a sample counts for more than 8 times as much as if all were chosen so.
const BY_FLUX: f32 = 1.0 / 8.0;
/// Marks polygons that do not emit.
const NONE: u32 = u32::MAX;

/// The emitters, chosen in proportion to their flux where light leaves them, and where it arrives mostly in proportion to the
/// irradiance that is expected from each.
#[derive(Default)]
pub struct Emitters {
    emitters: Vec<Emitter>,
    /// For each emitter the share of the flux of it and those before, in [0, 1].
    cumulative: Vec<f64>,
    tree: EmitterTree,
    /// Of each polygon, the index of its emitter.
    of_polygon: Vec<u32>,
    /// Of each emitter, the box in which cosine-distributed rays may meet it more often than it is chosen.
    reach: BoxTree,
    flux: Rgb64,
    /// Of coordinates of surfaces, m.
    rounding: f64,
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

/// A direction from a place to a point of an emitter, and the light that comes from there if nothing is between.
#[derive(Clone, Copy, Debug)]
pub struct EmitterSample {
    /// Of the emitter.
    pub point: SurfacePoint,
    /// Unit vector towards the point.
    pub direction: Vec3A,
    /// L over `pdf`: times f |cos θ|, its expectation is the radiance that the place sends on, W/(m²·sr).
    pub radiance: Rgb,
    /// Of the direction, 1/sr.
    pub pdf: f32,
}

impl Emitters {
    /// The emitters of a world; of a polygon's front, `front` tells the unit normal and the emission, W/(m²·sr).
    pub fn new(world: &World, front: impl Fn(usize) -> (Vec3A, Rgb)) -> Self {
        let scene = &world.scene;
        let offset = world.tracer.offset();
        let (mut emitters, mut of_polygon) = (Vec::new(), vec![NONE; scene.polygons.len()]);
        for (index, polygon) in scene.polygons.iter().enumerate() {
            let (normal, radiance) = front(index);
            if radiance != Rgb::ZERO {
                let corner = |&corner: &u32| Vec3A::from(scene.positions[corner as usize]);
                let corners: Vec<Vec3A> = polygon.corners().iter().map(corner).collect();
                of_polygon[index] = emitters.len() as u32;
                emitters.push(Emitter::new(index as u32, &corners, normal, radiance));
            }
        }
        let flux: Rgb64 = emitters.iter().map(Emitter::flux).sum();
        let mut sum = 0.0;
        let mut cumulative = Vec::with_capacity(emitters.len());
        for emitter in &emitters {
            sum += total(emitter.flux()) / total(flux);
            cumulative.push(sum);
        }
        let reach = BoxTree::new(emitters.iter().map(|emitter| reach(emitter, flux)).collect());
        let tree = EmitterTree::new(&emitters);
        Self { emitters, cumulative, tree, of_polygon, reach, flux, rounding: ROUNDING * f64::from(offset) }
    }

    /// Finds out which glass each emitter is in; `media_beside` knows it of a point of a side.
    pub fn place_in_media(&mut self, media_beside: impl Fn(SurfacePoint, Vec3A) -> Media) {
        for emitter in &mut self.emitters {
            emitter.media = media_beside(emitter.point(0.0, Vec2::splat(0.5)), emitter.normal);
        }
    }

    /// Whether nothing emits.
    pub fn is_empty(&self) -> bool {
        self.emitters.is_empty()
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
        let (index, which) = self.choose_by_flux(f64::from(sobol2(place, 2, sequence).x))?;
        let emitter = &self.emitters[index];
        let direction = frame(emitter.normal) * cosine_hemisphere(sobol2(place, 1, sequence));
        let from = emitter.point(which, sobol2(place, 0, sequence));
        let flux = emitter.flux() / (self.share(index) * count as f64);
        Some(Emission { ray: Ray::leaving(from, direction), flux: flux.as_vec3(), media: emitter.media })
    }

    /// A direction from a place to an emitter, for numbers in [0, 1): emitters by their expected irradiance, then directions by
    /// solid angle where the emitter is near, and else by area. `None` where no emitter that is chosen shines on the place.
    #[inline]
    pub fn sample(&self, surface: &Surface, choice: f32, at: Vec2) -> Option<EmitterSample> {
        let ChosenEmitter { index, probability, rest: which } = self.choose(surface, choice)?;
        let emitter = &self.emitters[index];
        if emitter.polygon == surface.polygon {
            return None;
        }
        let (direction, point, pdf) = if emitter.is_near(surface.point) {
            emitter.sample_near(surface.point, self.rounding, which, at)?
        } else {
            let point = emitter.point(which, at);
            let way = point.point - surface.point;
            let distance = way.length();
            let direction = way / distance;
            (direction, point, emitter.pdf_by_area(direction, distance)?)
        };
        let pdf = pdf * probability;
        Some(EmitterSample { point, direction, radiance: emitter.radiance / pdf, pdf })
    }

    /// The density, 1/sr, with which [`Emitters::sample`] chooses the direction of a ray that went from `surface` and met an
    /// emitter.
    pub fn pdf(&self, surface: &Surface, met: &Surface, direction: Vec3A) -> f32 {
        let index = self.of_polygon[met.polygon as usize] as usize;
        let Some(emitter) = self.emitters.get(index) else { return 0.0 };
        let pdf = if emitter.is_near(surface.point) {
            emitter.pdf_near(surface.point, self.rounding)
        } else {
            emitter.pdf_by_area(direction, met.distance)
        };
        pdf.map_or(0.0, |pdf| pdf * self.probability(surface, index))
    }

    /// Whether cosine-distributed directions from a place may meet an emitter more often than [`Emitters::sample`] chooses it,
    /// so that both ways are worth while.
    pub fn are_near(&self, surface: &Surface) -> bool {
        let is_faced = |index: u32| {
            let emitter = &self.emitters[index as usize];
            let height = (surface.point - emitter.corners()[0]).dot(emitter.normal);
            emitter.polygon != surface.polygon
                && f64::from(height) > self.rounding
                && emitter.corners().iter().any(|corner| (corner - surface.point).dot(surface.facing) > 0.0)
        };
        self.reach.any_at(surface.point.into(), &is_faced)
    }

    /// An emitter for a place, by flux or by what is expected.
    fn choose(&self, surface: &Surface, choice: f32) -> Option<ChosenEmitter> {
        if self.emitters.len() < 2 || choice < BY_FLUX {
            let number = if self.emitters.len() < 2 { choice } else { choice / BY_FLUX };
            let (index, rest) = self.choose_by_flux(f64::from(number))?;
            return Some(ChosenEmitter { index, probability: self.probability(surface, index), rest });
        }
        let chosen = self.tree.choose(surface, (choice - BY_FLUX) / (1.0 - BY_FLUX))?;
        let probability = mixed(self.share(chosen.index) as f32, chosen.probability);
        Some(ChosenEmitter { probability, ..chosen })
    }

    /// The probability with which an emitter is chosen for a place.
    fn probability(&self, surface: &Surface, index: usize) -> f32 {
        if self.emitters.len() < 2 {
            1.0
        } else {
            mixed(self.share(index) as f32, self.tree.probability(surface, index))
        }
    }

    /// Of the flux.
    fn share(&self, index: usize) -> f64 {
        total(self.emitters[index].flux()) / total(self.flux)
    }

    /// An emitter in proportion to flux, and a number in [0, 1) that is left of the one that chose it.
    fn choose_by_flux(&self, choice: f64) -> Option<(usize, f32)> {
        let last = self.emitters.len().checked_sub(1)?;
        let index = self.cumulative.partition_point(|&share| share <= choice).min(last);
        let first = if index == 0 { 0.0 } else { self.cumulative[index - 1] };
        let rest = ((choice - first) / self.share(index)) as f32;
        Some((index, rest.clamp(0.0, 1.0 - f32::EPSILON)))
    }
}

fn mixed(by_flux: f32, by_expectation: f32) -> f32 {
    BY_FLUX * by_flux + (1.0 - BY_FLUX) * by_expectation
}

/// The box round an emitter in which a cosine-distributed ray may have a greater density, at most 1/π, than a point that is chosen
/// by flux, p r²/cos θ: where r² < 1/(π p), with p = π L / Φ per area. That is a rough guess where there are many.
fn reach(emitter: &Emitter, flux: Rgb64) -> Bounds {
    let square = total(flux) / (PI * PI * total(emitter.radiance.as_dvec3()));
    grown(&emitter.bounds(), square.sqrt() as f32)
}
