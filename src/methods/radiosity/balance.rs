//! What the radiosity of the picked patch is made of.

use super::simulated;
use super::surfaces::{exitance, reflectance};
use crate::cancel::Cancel;
use crate::effects::{Effect, Effects};
use crate::math::rgb::{Rgb64, total};
use crate::mesh::Patch;
use crate::methods::Settings;
use crate::solution::{Balance, Contribution, Picked, Solution};
use crate::world::World;

/// After so many patches the cancel flag is looked at: a fraction of a millisecond.
const BATCH: usize = 4096;

/// A radiosity solution, seen from a patch whose form factors are known.
pub struct PickedLight<'a> {
    pub(super) world: &'a World,
    pub(super) solution: &'a Solution,
    picked: &'a Picked,
    pub(super) effects: Effects,
    /// ρ of the picked patch.
    pub(super) reflectance: Rgb64,
}

impl<'a> PickedLight<'a> {
    /// All of one world; the solution was made with these settings.
    pub fn new(world: &'a World, settings: &Settings, solution: &'a Solution, picked: &'a Picked) -> Self {
        let effects = simulated(world, settings);
        let reflectance = reflectance(world, &world.mesh.patches[picked.patch as usize], effects);
        Self { world, solution, picked, effects, reflectance }
    }

    /// Gathers ρ F B from all patches; `None` if cancelled.
    pub fn balance(&self, cancel: &Cancel) -> Option<Balance> {
        let patch = self.patch();
        let (radiosity, emission) = (self.radiosity(patch), self.exitance(patch));
        let (mut contributions, mut unshot) = (Vec::new(), Rgb64::ZERO);
        for (index, (other, form_factor)) in self.row().into_iter().enumerate() {
            if index % BATCH == 0 && cancel.is_requested() {
                return None;
            }
            let light = self.contribution(other, form_factor);
            unshot += self.reflectance * form_factor * self.unshot(other);
            if light != Rgb64::ZERO {
                contributions.push(Contribution { patch: other, form_factor, light });
            }
        }
        let gathered: Rgb64 = contributions.iter().map(|contribution| contribution.light).sum();
        let other_count = contributions.len().saturating_sub(Balance::MOST);
        let largest = largest(contributions);
        let of_largest: Rgb64 = largest.iter().map(|contribution| contribution.light).sum();
        Some(Balance {
            patch: self.picked.patch,
            radiosity,
            emission,
            // Where there are no others, rounding must not make some.
            others: if other_count > 0 { gathered - of_largest } else { Rgb64::ZERO },
            other_count,
            largest,
            unshot,
            difference: radiosity - emission - gathered + unshot,
            is_by_matrix: self.solution.matrix.is_some(),
        })
    }

    /// The picked patch.
    pub(super) fn patch(&self) -> &'a Patch {
        &self.world.mesh.patches[self.picked.patch as usize]
    }

    /// M_e of a patch, W/m².
    pub(super) fn exitance(&self, patch: &Patch) -> Rgb64 {
        exitance(self.world, patch, self.effects)
    }

    /// F from the picked patch to another one: of the matrix where the solver has one, else as the patch was looked from.
    pub(super) fn form_factor(&self, other: u32) -> f64 {
        match &self.solution.matrix {
            Some(matrix) => {
                let (columns, values) = matrix.form_factors.row(self.picked.patch as usize);
                columns.binary_search(&other).map_or(0.0, |place| values[place])
            }
            None => self.picked.form_factors[other as usize],
        }
    }

    /// ρ F B, W/m², or ρ F M_e where no light goes on from surface to surface.
    pub(super) fn contribution(&self, other: u32, form_factor: f64) -> Rgb64 {
        let patch = &self.world.mesh.patches[other as usize];
        let reflects = self.effects.contains(Effect::Interreflection);
        let sent = if reflects { self.radiosity(patch) } else { self.exitance(patch) };
        self.reflectance * form_factor * sent
    }

    /// The form factors from the picked patch that are not 0.
    fn row(&self) -> Vec<(u32, f64)> {
        match &self.solution.matrix {
            Some(matrix) => {
                let (columns, values) = matrix.form_factors.row(self.picked.patch as usize);
                columns.iter().copied().zip(values.iter().copied()).collect()
            }
            None => (0..).zip(self.picked.form_factors.iter().copied()).filter(|(_, factor)| *factor > 0.0).collect(),
        }
    }

    /// Mean B over a patch, W/m².
    fn radiosity(&self, patch: &Patch) -> Rgb64 {
        self.world.mesh.patch_mean(patch, &self.solution.light.radiosity)
    }

    /// ΔB of a patch, W/m²: all its elements have the same.
    fn unshot(&self, patch: u32) -> Rgb64 {
        let first = self.world.mesh.patches[patch as usize].elements.start;
        self.solution.light.unshot[first as usize].as_dvec3()
    }
}

/// The first few by their light; of equals the one that comes first in the mesh.
fn largest(mut contributions: Vec<Contribution>) -> Vec<Contribution> {
    let order =
        |a: &Contribution, b: &Contribution| total(b.light).total_cmp(&total(a.light)).then(a.patch.cmp(&b.patch));
    if contributions.len() > Balance::MOST {
        contributions.select_nth_unstable_by(Balance::MOST, order);
        contributions.truncate(Balance::MOST);
    }
    contributions.sort_unstable_by(order);
    contributions
}
