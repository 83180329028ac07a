//! Form factors by a hemicube on the middle of each shooter, and in closed form where that is too near.

use super::gather::Sight;
use super::hemicube::{Hemicube, Item};
use super::polygon::Kernel;
use super::{Outcome, Shot, clamped};
use crate::cancel::Cancel;
use crate::math::random::sobol2;
use crate::mesh::{Element, Mesh, Patch};
use crate::methods::Settings;
use crate::solution::{Counters, ItemBuffer};
use crate::world::{World, is_covered};
use glam::Vec3A;
use rayon::prelude::*;

/// Receivers nearer than this many radii of the shooter see it otherwise than from its middle: the five-times rule, at which
/// a point in place of a patch is wrong by a few percent.
const NEAR_RADII: f32 = 5.0;
/// Points tried on a patch whose centre is covered.
const TRIES: u32 = 256;

/// A hemicube, and the scene as it draws it.
pub struct Hemicubes {
    hemicube: Hemicube,
    /// Every element, with its index as id.
    items: Vec<Item>,
    /// Form factor from the shooter's middle to each element.
    seen: Vec<f64>,
}

impl Hemicubes {
    pub fn new(mesh: &Mesh, settings: &Settings) -> Self {
        let item = |(index, element): (usize, &Element)| {
            let corners = element.corners().iter().map(|&corner| mesh.vertices[corner as usize]);
            Item::new(&corners.collect::<Vec<_>>(), index as u32)
        };
        Self {
            hemicube: Hemicube::new(settings.hemicube_resolution),
            items: mesh.elements.iter().enumerate().map(item).collect(),
            seen: vec![0.0; mesh.elements.len()],
        }
    }

    /// Fills `form_factors`, one an element, with F from each element to the shooter; near ones with `shadow_rays` each. If
    /// cancelled, some have no value of use.
    pub fn look(&mut self, shot: &Shot, shadow_rays: u32, form_factors: &mut [f64]) -> Outcome {
        let (world, shooter) = (shot.world, shot.shooter());
        self.draw(world, shooter);
        if shot.cancel.is_requested() {
            return Outcome::default();
        }
        self.seen.fill(0.0);
        let escaping = self.hemicube.add_form_factors(&mut self.seen);
        let near = Near::new(shot, shadow_rays);
        let of = |(index, (seen, form_factor)): (usize, (&f64, &mut f64))| {
            let area = world.mesh.elements[index].area;
            let (value, mut work) = near.form_factor(&world.mesh, index).unwrap_or_else(|| {
                let far = if area > 0.0 { seen * shooter.area / area } else { 0.0 };
                (far, Counters { form_factors: u64::from(far > 0.0), ..Counters::default() })
            });
            let (bounded, is_cut) = clamped(value);
            *form_factor = bounded;
            work.clamped += u64::from(is_cut);
            work
        };
        let pairs = self.seen.par_iter().zip(form_factors.par_iter_mut()).enumerate();
        let counters = pairs.map(of).reduce(Counters::default, |mut sum, more| {
            sum += more;
            sum
        });
        Outcome { escaping, counters }
    }

    /// What is seen from the middle of a patch; the items are patches.
    pub fn item_buffer(&mut self, world: &World, patch: &Patch) -> ItemBuffer {
        self.draw(world, patch);
        let mut buffer = self.hemicube.item_buffer();
        for item in buffer.faces.iter_mut().flatten().filter(|item| **item != ItemBuffer::NOTHING) {
            *item = world.mesh.elements[*item as usize].patch;
        }
        buffer
    }

    fn draw(&mut self, world: &World, patch: &Patch) {
        self.hemicube.draw(exposed_middle(world, patch), patch.normal, &self.items);
    }
}

/// The centre of a patch, or, where something stands on it, another point of it that is not covered: from under a cover
/// nothing is seen. Lifted off the patch.
fn exposed_middle(world: &World, patch: &Patch) -> Vec3A {
    let World { mesh, tracer, .. } = world;
    let elements = &mesh.elements[patch.elements.start as usize..patch.elements.end as usize];
    if elements.iter().all(|element| element.exposed == 1.0) {
        return tracer.lift(patch.center, patch.normal);
    }
    let points = patch.region().sampler();
    let others = (0..TRIES).map(|i| points.point(sobol2(i, 0, 0)));
    let mut all = std::iter::once(patch.center).chain(others);
    let is_exposed = |point: &Vec3A| !is_covered(mesh, tracer, patch.surface_point(*point), patch.normal);
    tracer.lift(all.find(is_exposed).unwrap_or(patch.center), patch.normal)
}

/// The closed form for receivers that are too near for a point to stand for the shooter.
struct Near<'a> {
    sight: Sight<'a>,
    cancel: &'a Cancel,
    center: Vec3A,
    /// m
    reach: f32,
}

impl<'a> Near<'a> {
    fn new(shot: &'a Shot<'a>, shadow_rays: u32) -> Self {
        let patch = shot.shooter();
        let from_center = |corner: &glam::Vec3| Vec3A::from(*corner).distance(patch.center);
        let radius = patch.corners().iter().map(from_center).fold(0.0, f32::max);
        let sight = Sight::new(shot, Kernel::Polygon, shadow_rays);
        Self { sight, cancel: shot.cancel, center: patch.center, reach: NEAR_RADII * radius }
    }

    /// F from an element, and the work it took; `None` if it is far enough.
    fn form_factor(&self, mesh: &Mesh, index: usize) -> Option<(f64, Counters)> {
        let element = &mesh.elements[index];
        if element.center.distance_squared(self.center) > self.reach * self.reach {
            return None;
        }
        let patch = &mesh.patches[element.patch as usize];
        let mut work = Counters::default();
        // Rays take time, a look at the hemicube does not.
        if self.cancel.is_requested() || !self.sight.may_reach(patch) {
            return Some((0.0, work));
        }
        work.near_field = 1;
        let form_factor = self.sight.form_factor(patch, index, &mut work);
        Some((form_factor, work))
    }
}
