//! The rendering equation at the picked point, with the names of what takes part in it.

use crate::math::rgb::{Rgb, Rgb64, total};
use crate::solution::{Equation, Visibility};
use crate::worker::Snapshot;
use crate::world::World;

/// The equation, and the world that it is about.
#[derive(Clone, Copy)]
pub struct EquationFacts<'a> {
    pub equation: &'a Equation,
    pub world: &'a World,
}

impl<'a> EquationFacts<'a> {
    /// Of the point that is picked in a snapshot, if one is.
    pub fn of(snapshot: &'a Snapshot) -> Option<Self> {
        Some(Self { equation: snapshot.equation.as_deref()?, world: snapshot.world.as_deref()? })
    }

    /// What the scene file calls a polygon: its object, and its material.
    pub fn name_of_polygon(&self, polygon: u32) -> String {
        let scene = &self.world.scene;
        let polygon = &scene.polygons[polygon as usize];
        let material = &scene.materials[polygon.material as usize].name;
        match scene.objects.get(polygon.object as usize) {
            Some(object) if !object.is_empty() && object != material => format!("{object} ({material})"),
            _ => material.clone(),
        }
    }

    /// The same of the polygon that a patch is cut from.
    pub fn name_of_patch(&self, patch: u32) -> String {
        self.name_of_polygon(self.world.mesh.patches[patch as usize].polygon)
    }

    /// What is between two points: `nothing stands between`.
    pub fn between(&self, visibility: Visibility) -> String {
        match visibility {
            Visibility::Free => "nothing stands between".to_owned(),
            Visibility::Blocked { polygon, .. } => format!("{} stands between", self.name_of_polygon(polygon)),
            Visibility::FacesAway => "they do not face each other".to_owned(),
        }
    }

    /// The share of the radiosity that is shown, summed over red, green and blue; `None` where there is no light.
    pub fn share(&self, part: Rgb64) -> Option<f64> {
        let whole = total(self.equation.balance.radiosity);
        (whole > 0.0).then(|| total(part) / whole)
    }

    /// Whether the material at x′ has a part that sends light in single directions: a mirror, glass, or what is seen through.
    pub fn is_sharp(&self) -> bool {
        let patch = &self.world.mesh.patches[self.equation.balance.patch as usize];
        let lobes = self.world.scene.materials[patch.material as usize].lobes();
        lobes.mirror != Rgb::ZERO || lobes.is_clear()
    }
}
