//! What patches do with light, and sums over them that every solver needs.

use super::form_factor::Shot;
use crate::cancel::Cancel;
use crate::effects::{Effect, Effects};
use crate::math::rgb::{Rgb, Rgb64, total};
use crate::mesh::{Mesh, Patch};
use crate::methods::transport::colour;
use crate::solution::ElementLight;
use crate::world::World;

/// The irradiance that reflected light is expected to bring to the surfaces of a world on average, W/m²: all that will arrive
/// if it spreads evenly, without what comes straight from the emitters. In a closed room Φ ρ̄ / (S (1 − ρ̄)). Of the simulated
/// effects, colours count and no others.
pub fn mean_indirect_irradiance(world: &World, effects: Effects) -> Rgb {
    let surfaces = Surfaces::new(world, effects.and(Effects::of(&[Effect::Interreflection, Effect::Escape])));
    let area = surfaces.total_area();
    if area == 0.0 {
        return Rgb::ZERO;
    }
    let direct = surfaces.emitted * (1.0 - surfaces.escape_share) / area;
    (surfaces.ambient(surfaces.emitted) - direct).as_vec3()
}

/// ρ of a patch, as it is seen with these effects.
pub fn reflectance(world: &World, patch: &Patch, effects: Effects) -> Rgb64 {
    colour(world.scene.materials[patch.material as usize].lobes().diffuse, effects).as_dvec3()
}

/// M_e of a patch with these effects, W/m². Emitters shine from their front; their back only reflects.
pub fn exitance(world: &World, patch: &Patch, effects: Effects) -> Rgb64 {
    let material = &world.scene.materials[patch.material as usize];
    if patch.is_front { colour(material.exitance(), effects).as_dvec3() } else { Rgb64::ZERO }
}

/// Areas, reflectances and emission of the patches, in their order.
pub struct Surfaces {
    /// Exposed area, m².
    pub area: Vec<f64>,
    /// ρ, as it is seen.
    reflectance: Vec<Rgb64>,
    /// ρ, as light goes on by it: 0 where no interreflection is simulated.
    pub bouncing: Vec<Rgb64>,
    /// M_e, W/m²
    pub exitance: Vec<Rgb64>,
    /// Σ A M_e, W
    pub emitted: Rgb64,
    /// Those that are simulated.
    pub effects: Effects,
    /// Share of light that leaves the scene on its way from one surface to the next.
    escape_share: f64,
}

impl Surfaces {
    /// With what the simulated effects leave of the materials.
    pub fn new(world: &World, effects: Effects) -> Self {
        let patches = &world.mesh.patches;
        let reflectance: Vec<Rgb64> = patches.iter().map(|patch| reflectance(world, patch, effects)).collect();
        let exitance: Vec<Rgb64> = patches.iter().map(|patch| exitance(world, patch, effects)).collect();
        let reflects = effects.contains(Effect::Interreflection);
        Self {
            area: patches.iter().map(|patch| patch.area).collect(),
            bouncing: if reflects { reflectance.clone() } else { vec![Rgb64::ZERO; patches.len()] },
            reflectance,
            emitted: patches.iter().zip(&exitance).map(|(patch, exitance)| *exitance * patch.area).sum(),
            exitance,
            escape_share: if effects.contains(Effect::Escape) { world.escape_share } else { 0.0 },
            effects,
        }
    }

    /// Σ A b of one quantity per area for each patch, W where that is W/m².
    pub fn flux(&self, per_area: &[Rgb64]) -> Rgb64 {
        self.area.iter().zip(per_area).map(|(area, value)| *value * *area).sum()
    }

    /// Σ A |b|, summed over RGB, as a share of the emitted flux; 0 where nothing is emitted.
    pub fn share_of_emitted(&self, per_area: &[Rgb64]) -> f64 {
        let flux: f64 = self.area.iter().zip(per_area).map(|(area, value)| total(value.abs()) * area).sum();
        let emitted = total(self.emitted);
        if emitted > 0.0 { flux / emitted } else { 0.0 }
    }

    /// Total exposed area, m².
    pub fn total_area(&self) -> f64 {
        self.area.iter().sum()
    }

    /// The mean irradiance, W/m², that `flux` (W) will bring with all its reflections if it spreads evenly over a room
    /// with the mean reflectance ρ̄ of the scene and its share ε of light that escapes on the way:
    /// Φ (1 − ε) / (S (1 − ρ̄ (1 − ε))). It is the ambient term of Cohen, Chen, Wallace, Greenberg (1988), for rooms that
    /// may be open.
    pub fn ambient(&self, flux: Rgb64) -> Rgb64 {
        let area = self.total_area();
        if area == 0.0 {
            return Rgb64::ZERO;
        }
        self.spread_by(&self.bouncing, flux)
    }

    /// The same with these reflectances.
    fn spread_by(&self, reflectance: &[Rgb64], flux: Rgb64) -> Rgb64 {
        let area = self.total_area();
        let mean = self.flux(reflectance) / area;
        let arriving = 1.0 - self.escape_share;
        flux * arriving / (area * (Rgb64::ONE - mean * arriving))
    }

    /// All that a patch would shoot with every bounce of light, M_e + ρ E with the ambient irradiance E, as one shot.
    pub fn expected_shot<'a>(&self, world: &'a World, patch: usize, seed: u64, cancel: &'a Cancel) -> Shot<'a> {
        let ambient = self.spread_by(&self.reflectance, self.emitted);
        let radiosity = total(self.exitance[patch] + self.reflectance[patch] * ambient);
        let irradiance = total(ambient);
        let emitted = total(self.emitted);
        Shot {
            world,
            patch: patch as u32,
            // In a scene without light, all patches matter alike.
            relative_radiosity: if irradiance > 0.0 { radiosity / irradiance } else { 1.0 },
            flux_share: if emitted > 0.0 {
                radiosity * self.area[patch] / emitted
            } else {
                self.area[patch] / self.total_area()
            },
            effects: self.effects,
            seed,
            pass: patch as u64,
            cancel,
        }
    }

    /// Σ (1 − ρ) A E: what stays in the surfaces, W, with all that arrives where no interreflection is simulated.
    /// `irradiance` has one entry a patch.
    pub fn absorbed(&self, irradiance: &[Rgb64]) -> Rgb64 {
        let absorptance = self.bouncing.iter().map(|reflectance| Rgb64::ONE - *reflectance);
        irradiance.iter().zip(absorptance).zip(&self.area).map(|((e, absorbing), area)| absorbing * *e * *area).sum()
    }

    /// Area-weighted mean of E, W/m² summed over RGB. `irradiance` has one entry a patch.
    pub fn mean_irradiance(&self, irradiance: &[Rgb64]) -> f64 {
        let area = self.total_area();
        if area > 0.0 { total(self.flux(irradiance)) / area } else { 0.0 }
    }

    /// Light on elements, from their irradiance, the part of it that is direct, and the unshot radiosity of their patches, W/m².
    pub fn light(&self, mesh: &Mesh, irradiance: &[Rgb64], direct: &[Rgb64], unshot: &[Rgb64]) -> ElementLight {
        let elements = || mesh.elements.iter().zip(irradiance);
        let radiosity = elements().map(|(element, irradiance)| {
            let patch = element.patch as usize;
            (self.exitance[patch] + self.reflectance[patch] * *irradiance).as_vec3()
        });
        ElementLight {
            radiosity: radiosity.collect(),
            irradiance: irradiance.iter().map(|irradiance| irradiance.as_vec3()).collect(),
            direct: direct.iter().map(|direct| direct.as_vec3()).collect(),
            unshot: mesh.elements.iter().map(|element| unshot[element.patch as usize].as_vec3()).collect(),
        }
    }
}
