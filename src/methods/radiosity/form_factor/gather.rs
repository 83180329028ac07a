//! Form factors from all elements to one shooter, on all cores.

use super::polygon::{Kernel, Shooter};
use super::visibility::Sightline;
use super::{Shot, clamped, plane_tolerance};
use crate::math::random::hash;
use crate::mesh::Mesh;
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

/// A shot as all receivers see it.
pub struct Sight<'a> {
    pub shot: &'a Shot<'a>,
    pub kernel: Kernel,
    pub shooter: Shooter,
    pub sightline: Sightline<'a>,
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
    let Sight { shot, kernel, shooter, sightline } = sight;
    if shot.cancel.is_requested() {
        return work;
    }
    let tolerance = plane_tolerance(shot.world);
    let first = batch.elements.start;
    let mesh = &shot.world.mesh;
    for patch in &mesh.patches[batch.patches.start as usize..batch.patches.end as usize] {
        let elements = patch.elements.start as usize..patch.elements.end as usize;
        let out = &mut form_factors[elements.start - first as usize..elements.end - first as usize];
        if shooter.out_of_sight(patch, tolerance).is_some() {
            out.fill(0.0);
            continue;
        }
        let normal = patch.normal.as_dvec3();
        for (index, out) in elements.zip(out) {
            let element = &mesh.elements[index];
            *out = 0.0;
            if element.exposed == 0.0 {
                continue;
            }
            let (form_factor, is_cut) = clamped(shooter.form_factor(*kernel, mesh, element, normal));
            work.form_factors += 1;
            work.clamped += u64::from(is_cut);
            if form_factor > 0.0 {
                let shift = hash(shot.seed, shot.pass, index as u64);
                let (visible, rays) = sightline.visible_share(element, patch.normal, form_factor, shift);
                *out = form_factor * visible;
                work.shadow_rays += u64::from(rays);
                work.rays += u64::from(rays);
            }
        }
    }
    work
}
