//! Form factors from all elements to one shooter, on all cores.

use super::form_factor::Shooter;
use super::visibility::Sightline;
use crate::cancel::Cancel;
use crate::math::random::hash;
use crate::mesh::Mesh;
use crate::world::World;
use std::ops::{AddAssign, Range};

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

/// Work done in a pass over the receivers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    pub form_factors: u64,
    pub rays: u64,
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Self) {
        self.form_factors += other.form_factors;
        self.rays += other.rays;
    }
}

/// One shot, as all receivers see it.
pub struct Shot<'a> {
    pub world: &'a World,
    pub shooter: Shooter,
    pub sightline: Sightline<'a>,
    pub seed: u64,
    pub step: u64,
    pub cancel: &'a Cancel,
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
    pub fn gather(&self, shot: &Shot, form_factors: &mut [f64]) -> Work {
        gather(&self.batches, shot, form_factors)
    }
}

/// Σ A_e F_e, m², in one fixed order.
pub fn row_sum(mesh: &Mesh, form_factors: &[f64]) -> f64 {
    mesh.elements.iter().zip(form_factors).map(|(element, form_factor)| element.area * form_factor).sum()
}

/// Halves the batches until one is left, so that every core has work and nothing is allocated.
fn gather(batches: &[Batch], shot: &Shot, form_factors: &mut [f64]) -> Work {
    match batches {
        [] => Work::default(),
        [batch] => gather_batch(batch, shot, form_factors),
        _ => {
            let (low, high) = batches.split_at(batches.len() / 2);
            let split = (high[0].elements.start - low[0].elements.start) as usize;
            let (low_out, high_out) = form_factors.split_at_mut(split);
            let (mut work, more) = rayon::join(|| gather(low, shot, low_out), || gather(high, shot, high_out));
            work += more;
            work
        }
    }
}

fn gather_batch(batch: &Batch, shot: &Shot, form_factors: &mut [f64]) -> Work {
    let mut work = Work::default();
    if shot.cancel.is_requested() {
        return work;
    }
    // Twice as far as a lifted point: nearer planes are one plane.
    let tolerance = 2.0 * shot.world.tracer.offset();
    let first = batch.elements.start;
    let mesh = &shot.world.mesh;
    for patch in &mesh.patches[batch.patches.start as usize..batch.patches.end as usize] {
        let elements = patch.elements.start as usize..patch.elements.end as usize;
        let out = &mut form_factors[elements.start - first as usize..elements.end - first as usize];
        if !shot.shooter.may_reach(patch, tolerance) {
            out.fill(0.0);
            continue;
        }
        let normal = patch.normal.as_dvec3();
        for (index, out) in elements.zip(out) {
            let element = &mesh.elements[index];
            if element.exposed == 0.0 {
                *out = 0.0;
                continue;
            }
            *out = shot.shooter.form_factor(mesh, element, normal);
            work.form_factors += 1;
            if *out > 0.0 {
                let shift = hash(shot.seed, shot.step, index as u64);
                let (visible, rays) = shot.sightline.visible_share(element, patch.normal, *out, shift);
                *out *= visible;
                work.rays += u64::from(rays);
            }
        }
    }
    work
}
