//! What is known of one patch.

use crate::math::rgb::Rgb;
use crate::mesh::Patch;
use crate::solution::{Picked, Solution};
use crate::worker::Snapshot;
use crate::world::World;

/// The picked patch, its light, and its row of form factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchFacts<'a> {
    /// Among the patches of the mesh.
    pub index: u32,
    pub material: &'a str,
    /// Exposed area, m².
    pub area: f64,
    /// ρ
    pub reflectance: Rgb,
    /// M_e, W/m².
    pub exitance: Rgb,
    /// Mean over the patch, W/m²; `None` before there is a solution.
    pub light: Option<PatchLight>,
    /// Σ F over all patches.
    pub row_sum: f64,
    /// Share of its flux that leaves the scene.
    pub escaping: f64,
}

/// Means over a patch, W/m².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchLight {
    /// B
    pub radiosity: Rgb,
    /// E
    pub irradiance: Rgb,
    /// ΔB
    pub unshot: Rgb,
}

impl<'a> PatchFacts<'a> {
    /// Of the patch that is picked in a snapshot, if one is.
    pub fn of(snapshot: &'a Snapshot) -> Option<Self> {
        let (world, picked) = (snapshot.world.as_deref()?, snapshot.picked.as_deref()?);
        let Picked { patch: index, form_factors, escaping, .. } = picked;
        let patch = &world.mesh.patches[*index as usize];
        let material = &world.scene.materials[patch.material as usize];
        Some(Self {
            index: *index,
            material: &material.name,
            area: patch.area,
            reflectance: material.lobes().diffuse,
            // Only fronts shine.
            exitance: if patch.is_front { material.exitance() } else { Rgb::ZERO },
            light: snapshot.solution.as_deref().map(|solution| PatchLight::of(patch, world, solution)),
            row_sum: form_factors.iter().sum(),
            escaping: *escaping,
        })
    }
}

impl PatchLight {
    fn of(patch: &Patch, world: &World, solution: &Solution) -> Self {
        let mean = |values: &[Rgb]| world.mesh.patch_mean(patch, values).as_vec3();
        let light = &solution.light;
        Self { radiosity: mean(&light.radiosity), irradiance: mean(&light.irradiance), unshot: mean(&light.unshot) }
    }
}
