//! A ceiling light for scenes that have none.

use super::doctor::{Finding, FindingKind};
use super::material::Material;
use super::{Polygon, Scene};
use crate::math::bounds::Bounds;
use crate::math::rgb::Rgb;
use glam::Vec3;

/// Edges of the light, as a share of the scene's width and depth: about what the Cornell box has.
const SHARE: f32 = 0.25;

/// How far the light hangs under the scene's top, as a share of the scene's largest extent, so that it does not lie in
/// a ceiling's own plane.
const GAP: f32 = 0.01;

/// Emitted radiance, W/(m²·sr). The irradiance that it gives does not depend on the scene's scale: below the middle of
/// a cubic room it is some 20 · SHARE² ≈ 1.2 W/m², before any reflection.
const RADIANCE: f32 = 20.0;

const NAME: &str = "ceiling light";

impl Scene {
    pub fn has_emitter(&self) -> bool {
        self.polygons.iter().any(|polygon| self.materials[polygon.material as usize].is_emitter())
    }

    /// This scene with a rectangle that shines down from just under the top of the scene's bounding box, in its middle.
    /// A scene that has an emitter is returned as it is.
    pub fn with_ceiling_light(&self) -> Self {
        self.with_ceiling_light_under(self.bounds().max.y)
    }

    /// The same just under another height, m.
    pub fn with_ceiling_light_under(&self, top: f32) -> Self {
        let mut scene = self.clone();
        if self.has_emitter() {
            return scene;
        }
        let bounds = self.bounds();
        let (center, extent) = (bounds.center(), bounds.extent());
        let largest = extent.max_element();
        // A scene that is flat seen from above still gets a light that has an area.
        let half = 0.5 * SHARE * extent.max(Vec3::splat(0.1 * largest));
        // A scene that is flat seen from the side, such as a bare floor, gets it overhead.
        let height = if extent.y > 0.1 * largest { top - GAP * largest } else { top + 0.5 * largest };
        let first = scene.positions.len() as u32;
        let corner = |x: f32, z: f32| Vec3::new(center.x + x * half.x, height, center.z + z * half.z);
        scene.positions.extend([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]);
        let (material, object) = (scene.materials.len() as u32, scene.objects.len() as u32);
        scene.polygons.push(Polygon::new(&[first, first + 1, first + 2, first + 3], material, object, 0));
        scene.materials.push(Material { emission: Rgb::splat(RADIANCE), ..Material::grey(NAME) });
        scene.objects.push(NAME.to_owned());
        scene.findings.retain(|finding| finding.kind != FindingKind::NoEmitter);
        scene.findings.push(Finding::note(
            FindingKind::CeilingLightAdded,
            "the scene",
            "no surface emits light",
            format!(
                "a ceiling light that is not in the file was added: {} m × {} m, {RADIANCE} W/(m²·sr)",
                2.0 * half.x,
                2.0 * half.z
            ),
        ));
        scene
    }

    /// The box round all polygons.
    fn bounds(&self) -> Bounds {
        let corners = self.polygons.iter().flat_map(|polygon| polygon.corners());
        Bounds::of(corners.map(|&corner| self.positions[corner as usize]))
    }
}
