//! What one patch sees.

use super::form_factor::{FormFactors, Hemicubes};
use super::surfaces::Surfaces;
use crate::cancel::Cancel;
use crate::methods::Settings;
use crate::solution::Picked;
use crate::world::World;
use std::sync::Arc;

/// The form factors from a patch to all others by the method of the settings, and the view from its middle.
pub fn pick(world: &World, settings: &Settings, patch: u32) -> Picked {
    let mesh = &world.mesh;
    let shooter = &mesh.patches[patch as usize];
    let never = Cancel::default();
    let shot = Surfaces::new(world).expected_shot(world, patch as usize, settings.seed, &never);
    let mut form_factors = vec![0.0; mesh.elements.len()];
    let outcome = FormFactors::new(mesh, settings).toward(&shot, &mut form_factors);
    // Reciprocity turns what elements see of the patch into what the patch sees of them.
    let of = |receiver: &crate::mesh::Patch| {
        let elements = receiver.elements.start as usize..receiver.elements.end as usize;
        let exchange: f64 = elements.map(|i| mesh.elements[i].area * form_factors[i]).sum();
        if shooter.area > 0.0 { exchange / shooter.area } else { 0.0 }
    };
    Picked {
        patch,
        form_factors: mesh.patches.iter().map(of).collect(),
        escaping: outcome.escaping,
        item_buffer: Arc::new(Hemicubes::new(mesh, settings).item_buffer(world, shooter)),
    }
}
