//! What one patch sees.

use super::form_factor::{FormFactors, Hemicubes, Shot};
use super::simulated;
use super::surfaces::Surfaces;
use crate::cancel::Cancel;
use crate::methods::Settings;
use crate::solution::Picked;
use crate::world::World;
use std::sync::Arc;

/// A look needs no more rays than this, however much the patch shoots.
const MAX_RAYS: f64 = 1e6;

/// The form factors from a patch to all others by the method of the settings, and the view from its middle; `None` if
/// cancelled.
pub fn pick(world: &World, settings: &Settings, patch: u32, cancel: &Cancel) -> Option<Picked> {
    let mesh = &world.mesh;
    let shooter = &mesh.patches[patch as usize];
    let shot =
        Surfaces::new(world, simulated(world, settings)).expected_shot(world, patch as usize, settings.seed, cancel);
    let shot = Shot { flux_share: shot.flux_share.min(MAX_RAYS / f64::from(settings.light_rays)), ..shot };
    let mut form_factors = vec![0.0; mesh.elements.len()];
    let outcome = FormFactors::new(mesh, settings).toward(&shot, &mut form_factors);
    if cancel.is_requested() {
        return None;
    }
    // Reciprocity turns what elements see of the patch into what the patch sees of them.
    let of = |receiver: &crate::mesh::Patch| {
        let elements = receiver.elements.start as usize..receiver.elements.end as usize;
        let exchange: f64 = elements.map(|i| mesh.elements[i].area * form_factors[i]).sum();
        if shooter.area > 0.0 { exchange / shooter.area } else { 0.0 }
    };
    Some(Picked {
        patch,
        form_factors: mesh.patches.iter().map(of).collect(),
        escaping: outcome.escaping,
        item_buffer: Arc::new(Hemicubes::new(mesh, settings).item_buffer(world, shooter)),
    })
}
