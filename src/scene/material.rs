//! How a surface reflects and emits, as MTL files state it.

use crate::math::rgb::Rgb;
use std::f32::consts::PI;

/// A material with every value already inside its physical range.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    pub name: String,
    /// Diffuse reflectance ρ (`Kd`), each channel in [0, [`Material::MAX_REFLECTANCE`]].
    pub diffuse: Rgb,
    /// Specular reflectance (`Ks`), each channel in [0, 1]. With the diffuse one it sums to at most 1, but for glass, which
    /// does not use it.
    pub specular: Rgb,
    /// Phong exponent (`Ns`).
    pub shininess: f32,
    /// Emitted radiance (`Ke`), W/(m²·sr).
    pub emission: Rgb,
    /// Index of refraction (`Ni`).
    pub refraction_index: f32,
    /// Transmission filter (`Tf`), each channel in [0, 1]: which share passes of the light that goes through, once for a
    /// whole body and once for a sheet; see [`Material::lobes`]. It says nothing about an opaque material. 1 where the file
    /// states none.
    pub transmission: Rgb,
    /// Opacity in [0, 1] (`d`, or 1 − `Tr`).
    pub opacity: f32,
    /// Illumination model (`illum`), where the file states one.
    pub illumination_model: Option<u8>,
}

impl Material {
    /// The largest diffuse reflectance that a scene may have: with 1 in a closed room, light would never die out.
    pub const MAX_REFLECTANCE: f32 = 0.999;

    /// Above this exponent (`Ns`) a glossy lobe is as narrow as a mirror's image is sharp: 0.2° across. Cosines of such
    /// angles have no digits to spare in single precision.
    const LARGEST_EXPONENT: f32 = 1e5;

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
    /// glass, 0 and 1 dull, and any other is glossy where it states `Ks`.
    ///
    /// - A mirror reflects `Ks` at every angle.
    /// - Glass reflects and lets through after Fresnel, so that its `Ks` says nothing. It is all glass unless it states an
    ///   opacity, which is the share of its diffuse part. It is a body with an inside: light that goes through crosses its
    ///   boundary twice, and √`Tf` at each crossing makes that `Tf`.
    /// - What is not opaque, but no glass, lets light straight through.
    pub fn lobes(&self) -> Lobes {
        let Some(kind) = self.specular_kind() else {
            let straight = (1.0 - self.opacity) * self.transmission;
            return Lobes { diffuse: self.opacity * self.diffuse, straight, ..Lobes::default() };
        };
        let opaque = match kind {
            SpecularKind::Glass if self.opacity >= 1.0 => 0.0,
            _ => self.opacity,
        };
        let specular = opaque * self.specular;
        let lobes = Lobes { diffuse: opaque * self.diffuse, ..Lobes::default() };
        let straight = (1.0 - opaque) * self.transmission;
        match kind {
            SpecularKind::Gloss => Lobes { glossy: specular, exponent: self.shininess, straight, ..lobes },
            SpecularKind::Mirror => Lobes { mirror: specular, straight, ..lobes },
            SpecularKind::Glass => Lobes { glass: 1.0 - opaque, filter: self.boundary_filter(), ..lobes },
        }
    }

    /// √`Tf`: the share that passes at each of the two boundaries that light crosses on its way through a body.
    fn boundary_filter(&self) -> Rgb {
        Rgb::from_array(self.transmission.to_array().map(f32::sqrt))
    }

    /// Whether it is glass, which has an inside.
    pub fn is_glass(&self) -> bool {
        self.lobes().glass > 0.0
    }

    /// The same glass without a thickness: what its surface would let into it passes straight, and `Tf` of it at the one
    /// crossing.
    pub fn as_sheet(&self) -> Self {
        let opacity = 1.0 - self.lobes().glass;
        Self { opacity, specular: Rgb::ZERO, illumination_model: None, ..self.clone() }
    }

    /// The factor, at most 1, on `Ks` that leaves it what `Kd` does not reflect.
    pub fn specular_scale(&self) -> f32 {
        match self.specular_kind() {
            Some(SpecularKind::Gloss | SpecularKind::Mirror) => {
                let quotient = |i: usize| (1.0 - self.diffuse[i]) / self.specular[i];
                (0..3).filter(|&i| self.specular[i] > 0.0).map(quotient).fold(1.0, f32::min)
            }
            Some(SpecularKind::Glass) | None => 1.0,
        }
    }

    /// `None` where there is only a diffuse part.
    fn specular_kind(&self) -> Option<SpecularKind> {
        match self.illumination_model.unwrap_or(2) {
            0 | 1 => None,
            3 | 5 | 8 => Some(SpecularKind::Mirror),
            4 | 6 | 7 | 9 => Some(SpecularKind::Glass),
            _ if self.shininess > Self::LARGEST_EXPONENT => Some(SpecularKind::Mirror),
            _ => Some(SpecularKind::Gloss),
        }
    }
}

/// What a surface is beside dull.
#[derive(Clone, Copy)]
enum SpecularKind {
    Gloss,
    Mirror,
    Glass,
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
    /// Share that glass lets through of what it refracts, at each boundary: √`Tf`.
    pub filter: Rgb,
    /// Passes without a turn.
    pub straight: Rgb,
}

impl Lobes {
    /// Whether light goes through.
    pub fn is_clear(&self) -> bool {
        self.glass > 0.0 || self.straight != Rgb::ZERO
    }

    /// The largest share of the light, over channels, that goes on in whichever way, in [0, 1].
    pub fn reflectance(&self) -> f32 {
        (self.diffuse + self.specular()).max_element()
    }

    /// The same of all but the diffuse lobe.
    pub fn specular_reflectance(&self) -> f32 {
        self.specular().max_element()
    }

    fn specular(&self) -> Rgb {
        self.glossy + self.mirror + self.straight + Rgb::splat(self.glass)
    }

    /// Whether there is anything but a diffuse lobe.
    pub fn is_specular(&self) -> bool {
        Self { diffuse: Rgb::ZERO, exponent: 0.0, filter: Rgb::ZERO, ..*self } != Self::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ρ = 0.3, `Ks` 0.6, `Ns` 40, `Tf` 0.9.
    fn material(illumination_model: Option<u8>, opacity: f32) -> Material {
        Material {
            diffuse: Rgb::splat(0.3),
            specular: Rgb::splat(0.6),
            shininess: 40.0,
            transmission: Rgb::splat(0.9),
            illumination_model,
            opacity,
            ..Material::grey("test")
        }
    }

    #[test]
    fn every_illumination_model_has_its_lobes() {
        let dull = Lobes { diffuse: Rgb::splat(0.3), ..Lobes::default() };
        let gloss = Lobes { glossy: Rgb::splat(0.6), exponent: 40.0, ..dull };
        let mirror = Lobes { mirror: Rgb::splat(0.6), ..dull };
        let glass = Lobes { glass: 1.0, filter: Rgb::splat(0.9_f32.sqrt()), ..Lobes::default() };
        for (models, expected) in [
            (&[Some(0), Some(1)][..], dull),
            (&[None, Some(2), Some(10)], gloss),
            (&[Some(3), Some(5), Some(8)], mirror),
            (&[Some(4), Some(6), Some(7), Some(9)], glass),
        ] {
            for &model in models {
                assert_eq!(material(model, 1.0).lobes(), expected, "illum {model:?}");
                assert_eq!(material(model, 1.0).is_glass(), expected == glass, "illum {model:?}");
                assert_eq!(material(model, 1.0).lobes().is_specular(), expected != dull, "illum {model:?}");
            }
        }
    }

    #[test]
    fn opacity_is_shared_with_what_passes() {
        let quarter = |model| material(model, 0.25).lobes();
        let diffuse = Rgb::splat(0.25 * 0.3);
        let straight = Rgb::splat(0.75 * 0.9);
        assert_eq!(quarter(Some(1)), Lobes { diffuse, straight, ..Lobes::default() });
        let glossy = Rgb::splat(0.25 * 0.6);
        assert_eq!(quarter(None), Lobes { diffuse, glossy, exponent: 40.0, straight, ..Lobes::default() });
        assert_eq!(quarter(Some(3)), Lobes { diffuse, mirror: glossy, straight, ..Lobes::default() });
        let filter = Rgb::splat(0.9_f32.sqrt());
        assert_eq!(quarter(Some(7)), Lobes { diffuse, glass: 0.75, filter, ..Lobes::default() });
    }

    #[test]
    fn a_lobe_too_narrow_for_single_precision_is_a_mirror() {
        let lobes = Material { shininess: 1e30, ..material(None, 1.0) }.lobes();
        assert_eq!((lobes.glossy, lobes.mirror), (Rgb::ZERO, Rgb::splat(0.6)));
    }

    #[test]
    fn specular_light_gets_what_diffuse_light_leaves() {
        let bright = |model| Material {
            diffuse: Rgb::new(0.2, 0.5, 0.9),
            specular: Rgb::new(0.6, 0.8, 0.2),
            ..material(model, 1.0)
        };
        // In red all fits, in green 0.5 of 0.8, in blue 0.1 of 0.2.
        for model in [None, Some(2), Some(3), Some(5)] {
            assert!((bright(model).specular_scale() - 0.5).abs() < 1e-6, "illum {model:?}");
        }
        for model in [Some(1), Some(7)] {
            assert_eq!(bright(model).specular_scale(), 1.0, "illum {model:?}");
        }
        assert_eq!(material(None, 1.0).specular_scale(), 1.0);
        assert_eq!(Material { specular: Rgb::ZERO, ..bright(None) }.specular_scale(), 1.0);
    }
}
