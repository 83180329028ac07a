//! Form factors from all elements to one shooter, on all cores.

use super::polygon::{Kernel, Shooter};
use super::visibility::{Rays, Sightline};
use super::{Shot, clamped, plane_tolerance};
use crate::effects::Effect;
use crate::math::random::hash;
use crate::mesh::{Mesh, Patch};
use crate::solution::Counters;
use std::ops::Range;

/// A batch holds about this many elements: some milliseconds of work at most, after which the cancel flag is looked at.
const BATCH: u32 = 128;

/// The elements in batches of whole patches.
pub struct Receivers {
    batches: Vec<Batch>,
}

struct Batch {
    patches: Range<u32>,
    elements: Range<u32>,
}

/// A shot as receivers see it: a formula, times the share of shadow rays that arrive.
pub struct Sight<'a> {
    shot: &'a Shot<'a>,
    kernel: Kernel,
    shooter: Shooter,
    sightline: Sightline<'a>,
    /// See [`plane_tolerance`].
    tolerance: f32,
}

impl<'a> Sight<'a> {
    /// `shadow_rays` are those for all the irradiance that is expected.
    pub fn new(shot: &'a Shot<'a>, kernel: Kernel, shadow_rays: u32) -> Self {
        let rays = Rays { most: shadow_rays, per_form_factor: f64::from(shadow_rays) * shot.relative_radiosity };
        Self {
            shot,
            kernel,
            shooter: Shooter::new(shot.shooter()),
            sightline: Sightline::new(shot.world, shot.shooter(), rays),
            tolerance: plane_tolerance(shot.world),
        }
    }

    /// Whether some points of the receiver and the shooter face each other.
    pub fn may_reach(&self, receiver: &Patch) -> bool {
        self.shooter.out_of_sight(receiver, self.tolerance).is_none()
    }

    /// F in [0, 1] from element `index` of a patch that may be reached; counts the work.
    pub fn form_factor(&self, patch: &Patch, index: usize, work: &mut Counters) -> f64 {
        let mesh = &self.shot.world.mesh;
        let element = &mesh.elements[index];
        if element.exposed == 0.0 {
            return 0.0;
        }
        let unoccluded = self.shooter.form_factor(self.kernel, mesh, element, patch.normal.as_dvec3());
        let (bounded, is_cut) = clamped(unoccluded);
        work.form_factors += 1;
        work.clamped += u64::from(is_cut);
        if bounded == 0.0 {
            return 0.0;
        }
        if !self.shot.effects.contains(Effect::Shadows) {
            // All that face each other see each other.
            work.bill.save(Effect::Shadows, self.sightline.rays_to(bounded).into());
            return bounded;
        }
        let shift = hash(self.shot.seed, self.shot.pass, index as u64);
        let (visible, rays) = self.sightline.visible_share(element, patch.normal, bounded, shift);
        work.shadow_rays += u64::from(rays);
        work.rays += u64::from(rays);
        work.bill.spend(Effect::Shadows, rays.into());
        bounded * visible
    }
}

impl Receivers {
    pub fn new(mesh: &Mesh) -> Self {
        let mut batches = Vec::new();
        let mut first = 0;
        for (index, patch) in mesh.patches.iter().enumerate() {
            let elements = mesh.patches[first as usize].elements.start..patch.elements.end;
            let is_last = index + 1 == mesh.patches.len();
            if is_last || elements.len() as u32 >= BATCH {
                let end = index as u32 + 1;
                batches.push(Batch { patches: first..end, elements });
                first = end;
            }
        }
        Self { batches }
    }

    /// Fills `form_factors`, one an element, with F · visibility. If cancelled, some keep their old values.
    pub fn gather(&self, sight: &Sight, form_factors: &mut [f64]) -> Counters {
        gather(&self.batches, sight, form_factors)
    }
}

/// Halves the batches until one is left, so that every core has work and nothing is allocated.
fn gather(batches: &[Batch], sight: &Sight, form_factors: &mut [f64]) -> Counters {
    match batches {
        [] => Counters::default(),
        [batch] => gather_batch(batch, sight, form_factors),
        _ => {
            let (low, high) = batches.split_at(batches.len() / 2);
            let split = (high[0].elements.start - low[0].elements.start) as usize;
            let (low_out, high_out) = form_factors.split_at_mut(split);
            let (mut work, more) = rayon::join(|| gather(low, sight, low_out), || gather(high, sight, high_out));
            work += more;
            work
        }
    }
}

fn gather_batch(batch: &Batch, sight: &Sight, form_factors: &mut [f64]) -> Counters {
    let mut work = Counters::default();
    if sight.shot.cancel.is_requested() {
        return work;
    }
    let first = batch.elements.start;
    let mesh = &sight.shot.world.mesh;
    for patch in &mesh.patches[batch.patches.start as usize..batch.patches.end as usize] {
        let elements = patch.elements.start as usize..patch.elements.end as usize;
        let out = &mut form_factors[elements.start - first as usize..elements.end - first as usize];
        if !sight.may_reach(patch) {
            out.fill(0.0);
            continue;
        }
        for (index, out) in elements.zip(out) {
            *out = sight.form_factor(patch, index, &mut work);
        }
    }
    work
}
