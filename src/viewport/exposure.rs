//! From radiance to what a screen can show.

use crate::choice::Choice;
use crate::math::rgb::{Rgb, Rgb64, luminance};
use crate::solution::Solution;
use crate::world::World;
use std::f64::consts::PI;

/// How bright the picture is. An exposure of `ev` shows a radiance L [W/(m²·sr)] as 2^ev · L, where 1 is the white of a
/// screen before its [`ToneCurve`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Exposure {
    /// See [`automatic_exposure`].
    #[default]
    Automatic,
    /// This many stops.
    Manual(f32),
}

impl Exposure {
    /// The exposure in stops.
    pub fn ev(self, world: &World, solution: Option<&Solution>) -> f32 {
        match self {
            Self::Automatic => automatic_exposure(world, solution),
            Self::Manual(ev) => ev,
        }
    }
}

/// How exposed values become values of a screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToneCurve {
    /// Values up to 1 as they are; what is brighter is white.
    #[default]
    Linear,
    /// A film's shoulder and toe: Narkowicz's fit (2016) of the reference curve of the Academy Color Encoding System.
    Filmic,
}

impl Choice for ToneCurve {
    const ALL: &'static [Self] = &[Self::Linear, Self::Filmic];
    const KIND: &'static str = "tone curve";

    fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Filmic => "filmic",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Linear => "Linear",
            Self::Filmic => "Filmic",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Linear => "In proportion to radiance; what is brighter than white is cut off",
            Self::Filmic => "Bright light fades to white as on film",
        }
    }
}

/// What the mean radiance of a picture is shown as.
const MID_GREY: f64 = 0.18;

/// The exposure in stops at which the surfaces that do not emit will be mid grey on average, once all light is there; all
/// surfaces, where all emit. One for all views of a scene, so that they can be compared.
///
/// It foresees the end by the ambient term of Cohen, Chen, Wallace and Greenberg (1988), so it hardly changes while light
/// spreads: brightness is seen to grow. Without a radiosity solution all light is still to come. 0 where there is no light.
pub fn automatic_exposure(world: &World, solution: Option<&Solution>) -> f32 {
    let mean_radiance = f64::from(luminance(expected_radiosity(world, solution).as_vec3())) / PI;
    if mean_radiance > 0.0 { (MID_GREY / mean_radiance).log2() as f32 } else { 0.0 }
}

/// The mean radiosity [W/m²] that elements without emission will have in the end: what they have now, and what they will
/// reflect of the ambient light.
fn expected_radiosity(world: &World, solution: Option<&Solution>) -> Rgb64 {
    let mut dark = Surfaces::default();
    let mut bright = Surfaces::default();
    for patch in &world.mesh.patches {
        let material = &world.scene.materials[patch.material as usize];
        let lobes = material.lobes();
        if lobes.diffuse == Rgb::ZERO && lobes.is_specular() && !material.is_emitter() {
            // A mirror, or glass: as bright as what is seen in it.
            continue;
        }
        let surfaces = if material.is_emitter() { &mut bright } else { &mut dark };
        surfaces.area += patch.area;
        surfaces.reflecting += patch.area * lobes.diffuse.as_dvec3();
        match solution {
            Some(solution) => {
                for index in patch.elements.start as usize..patch.elements.end as usize {
                    surfaces.flux += world.mesh.elements[index].area * solution.light.radiosity[index].as_dvec3();
                }
            }
            // Fronts shine.
            None if patch.is_front => surfaces.flux += patch.area * material.exitance().as_dvec3(),
            None => {}
        }
    }
    let all = Surfaces {
        area: dark.area + bright.area,
        reflecting: dark.reflecting + bright.reflecting,
        flux: dark.flux + bright.flux,
    };
    if all.area == 0.0 {
        return Rgb64::ZERO;
    }
    let ambient = solution.map_or_else(|| all.ambient(), |solution| solution.ambient.as_dvec3());
    let seen = if dark.area > 0.0 { &dark } else { &all };
    (seen.flux + seen.reflecting * ambient) / seen.area
}

/// Sums over some surfaces.
#[derive(Default)]
struct Surfaces {
    /// m²
    area: f64,
    /// ρ A, m²
    reflecting: Rgb64,
    /// B A, W
    flux: Rgb64,
}

impl Surfaces {
    /// The mean irradiance that their flux will bring with all its reflections if it spreads evenly, W/m².
    fn ambient(&self) -> Rgb64 {
        self.flux / (self.area - self.reflecting)
    }
}
