//! How a surface reflects and emits, as MTL files state it.

use crate::math::rgb::Rgb;
use std::f32::consts::PI;

/// A material with every value already inside its physical range.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    pub name: String,
    /// Diffuse reflectance ρ (`Kd`), each channel in [0, [`Material::MAX_REFLECTANCE`]].
    pub diffuse: Rgb,
    /// Specular reflectance (`Ks`), each channel in [0, 1].
    pub specular: Rgb,
    /// Phong exponent (`Ns`).
    pub shininess: f32,
    /// Emitted radiance (`Ke`), W/(m²·sr).
    pub emission: Rgb,
    /// Index of refraction (`Ni`).
    pub refraction_index: f32,
    /// Transmission filter (`Tf`), each channel in [0, 1]: which share passes of the light that goes through. It says
    /// nothing about an opaque material. 1 where the file states none.
    pub transmission: Rgb,
    /// Opacity in [0, 1] (`d`, or 1 − `Tr`).
    pub opacity: f32,
    /// Illumination model (`illum`), where the file states one.
    pub illumination_model: Option<u8>,
}

impl Material {
    /// The largest diffuse reflectance that a scene may have: with 1 in a closed room, light would never die out.
    pub const MAX_REFLECTANCE: f32 = 0.999;

    /// A grey diffuse material for faces whose file names none.
    pub fn grey(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            diffuse: Rgb::splat(0.5),
            specular: Rgb::ZERO,
            shininess: 10.0,
            emission: Rgb::ZERO,
            refraction_index: 1.0,
            transmission: Rgb::ONE,
            opacity: 1.0,
            illumination_model: None,
        }
    }

    /// Emitted exitance M_e = π · `Ke`, W/m².
    pub fn exitance(&self) -> Rgb {
        self.emission * PI
    }

    pub fn is_emitter(&self) -> bool {
        self.emission.max_element() > 0.0
    }

    /// What the surface does with light, by the illumination model of the MTL format: 3, 5 and 8 are mirrors, 4, 6, 7 and 9
    /// glass, and any other is glossy where it states `Ks`.
    pub fn lobes(&self) -> Lobes {
        let model = self.illumination_model.unwrap_or(2);
        let is_glass = matches!(model, 4 | 6 | 7 | 9);
        let is_mirror = matches!(model, 3 | 5 | 8);
        // Glass that states no opacity is all glass.
        let opaque = if is_glass && self.opacity >= 1.0 { 0.0 } else { self.opacity };
        let specular = if model <= 1 { Rgb::ZERO } else { self.specular };
        Lobes {
            diffuse: opaque * self.diffuse,
            glossy: if is_glass || is_mirror { Rgb::ZERO } else { opaque * specular },
            exponent: self.shininess,
            mirror: if is_mirror { opaque * specular } else { Rgb::ZERO },
            glass: if is_glass { 1.0 - opaque } else { 0.0 },
            filter: self.transmission,
            straight: if is_glass { Rgb::ZERO } else { (1.0 - opaque) * self.transmission },
        }
    }

    /// Whether the file asks for a mirror, gloss or glass beside the diffuse part.
    pub fn is_specular(&self) -> bool {
        let mirror_or_glass = matches!(self.illumination_model, Some(3..=9));
        let glossy = self.specular.max_element() > 0.0 && self.illumination_model != Some(1);
        mirror_or_glass || glossy || self.opacity < 1.0
    }
}

/// Which shares of the light that arrives go where; the rest is absorbed. No channel sums to more than 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lobes {
    /// ρ
    pub diffuse: Rgb,
    /// Round the mirror direction, for light along the normal.
    pub glossy: Rgb,
    /// Phong's exponent of the glossy lobe.
    pub exponent: f32,
    /// In the mirror direction.
    pub mirror: Rgb,
    /// Share that meets a boundary of glass, which reflects and refracts it after Fresnel and Snell.
    pub glass: f32,
    /// Share that glass lets through of what it refracts, at each boundary.
    pub filter: Rgb,
    /// Passes without a turn.
    pub straight: Rgb,
}

impl Lobes {
    /// Whether there is anything but a diffuse lobe.
    pub fn is_specular(&self) -> bool {
        Self { diffuse: Rgb::ZERO, exponent: 0.0, filter: Rgb::ZERO, ..*self } != Self::default()
    }
}
