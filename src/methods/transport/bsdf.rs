//! What one place of a surface does with light: the mixture of lobes that its material states, turned to one direction.

use super::fresnel::{fresnel_reflectance, reflect, refract};
use super::{Surface, phong};
use crate::effects::Effect;
use crate::math::random::Stream;
use crate::math::rgb::Rgb;
use crate::math::warp::{cosine_above, share_above};
use crate::scene::Lobes;
use crate::solution::Scattering;
use glam::{Vec2, Vec3A};
use std::f32::consts::PI;

/// Lobes at a place, for light that leaves to, or arrives from, one direction.
#[derive(Clone, Copy, Debug)]
pub struct Bsdf {
    /// Unit vector away from the surface: where the light goes, or comes from.
    towards: Vec3A,
    normal: Vec3A,
    facing: Vec3A,
    diffuse: Rgb,
    glossy: Rgb,
    exponent: f32,
    mirror: Rgb,
    /// Reflected by the boundary of glass, and let through by it with its refraction.
    reflected: f32,
    refracted: Rgb,
    /// Passes without a turn.
    straight: Rgb,
    /// Refraction index behind the surface over that before it.
    index: f32,
}

/// Where light goes on, chosen at random.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Unit vector away from the surface, on either side.
    pub direction: Vec3A,
    /// f |cos| / density of flux, per channel: its expectation over all samples is the albedo.
    pub weight: Rgb,
    /// What radiance that comes back from there is to be multiplied by beside `weight`: 1, but where it is refracted, which
    /// spreads or narrows the solid angle that it fills.
    pub narrowing: f32,
    pub scattering: Scattering,
    /// Whether it went through the surface.
    pub crosses: bool,
    /// The density with which this direction is chosen by way of the lobe that chose it, 1/sr: 0 where directions have none.
    pub density: f32,
    /// Whether directions have no density: mirror and glass.
    pub is_sharp: bool,
}

impl Sample {
    /// What it is an instance of.
    pub fn effect(&self) -> Effect {
        match self.scattering {
            Scattering::Diffuse => Effect::Interreflection,
            Scattering::Specular if self.crosses => Effect::Transmission,
            Scattering::Specular if self.is_sharp => Effect::SpecularReflection,
            Scattering::Specular => Effect::Gloss,
        }
    }
}

/// The lobes, in the order in which one is chosen.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Lobe {
    Diffuse,
    Glossy,
    Mirror,
    Reflected,
    Refracted,
    Straight,
}

const LOBES: [Lobe; 6] = [Lobe::Diffuse, Lobe::Glossy, Lobe::Mirror, Lobe::Reflected, Lobe::Refracted, Lobe::Straight];

/// The probability with which each lobe is sampled: in proportion to what it does with some light. They sum to 1, or are all 0
/// where no lobe does anything.
#[derive(Clone, Copy, Debug)]
pub struct LobeProbabilities([f32; LOBES.len()]);

impl LobeProbabilities {
    fn of(&self, lobe: Lobe) -> f32 {
        self.0[lobe as usize]
    }
}

impl Bsdf {
    /// The lobes of a material at a surface. `index` is the refraction index behind it over that before it.
    pub fn new(lobes: &Lobes, surface: &Surface, towards: Vec3A, index: f32) -> Self {
        let cosine = towards.dot(surface.normal).max(0.0);
        let turned = if lobes.glass > 0.0 { refract(towards, surface.normal, index) } else { None };
        // Where nothing gets through, all is reflected.
        let fresnel = if turned.is_none() { 1.0 } else { fresnel_reflectance(cosine, index) };
        Self {
            towards,
            normal: surface.normal,
            facing: surface.facing,
            diffuse: lobes.diffuse,
            glossy: lobes.glossy,
            exponent: lobes.exponent,
            mirror: lobes.mirror,
            reflected: lobes.glass * fresnel,
            refracted: lobes.glass * (1.0 - fresnel) * lobes.filter,
            straight: lobes.straight,
            index,
        }
    }

    /// ρ of the diffuse lobe.
    pub fn diffuse(&self) -> Rgb {
        self.diffuse
    }

    /// Whether there is a lobe whose directions have a density.
    pub fn has_densities(&self) -> bool {
        self.diffuse != Rgb::ZERO || self.is_glossy()
    }

    /// Whether there is a lobe whose directions have no density.
    pub fn is_sharp(&self) -> bool {
        self.mirror != Rgb::ZERO || self.reflected > 0.0 || self.refracted != Rgb::ZERO || self.straight != Rgb::ZERO
    }

    /// Whether there is any lobe but the diffuse one.
    pub fn is_specular(&self) -> bool {
        self.is_glossy() || self.is_sharp()
    }

    /// Whether there is a glossy lobe.
    pub fn is_glossy(&self) -> bool {
        self.glossy != Rgb::ZERO
    }

    /// Only its specular lobes, or only its diffuse one.
    #[must_use]
    pub fn only(&self, scattering: Scattering) -> Self {
        match scattering {
            Scattering::Diffuse => Self { diffuse: self.diffuse, ..self.without_lobes() },
            Scattering::Specular => Self { diffuse: Rgb::ZERO, ..*self },
        }
    }

    /// Each of its specular lobes alone.
    pub fn specular_lobes(&self) -> impl Iterator<Item = Self> {
        let none = self.without_lobes();
        let lobes = [
            Self { glossy: self.glossy, ..none },
            Self { mirror: self.mirror, ..none },
            Self { reflected: self.reflected, ..none },
            Self { refracted: self.refracted, ..none },
            Self { straight: self.straight, ..none },
        ];
        lobes.into_iter().filter(Self::is_specular)
    }

    /// Glass that lets light through, and reflects none.
    #[must_use]
    pub fn without_reflection(&self) -> Self {
        Self { reflected: 0.0, ..*self }
    }

    fn without_lobes(&self) -> Self {
        Self {
            diffuse: Rgb::ZERO,
            glossy: Rgb::ZERO,
            mirror: Rgb::ZERO,
            reflected: 0.0,
            refracted: Rgb::ZERO,
            straight: Rgb::ZERO,
            ..*self
        }
    }

    /// Share of the light that goes on, per channel, in [0, 1]. Of the glossy lobe this is what it keeps of light along the
    /// normal, and never less than what it keeps of other light.
    pub fn albedo(&self) -> Rgb {
        LOBES.iter().map(|&lobe| self.share(lobe)).sum()
    }

    /// f |cos θ| of the lobes that have a density, 1/sr, per channel: the diffuse one and the glossy one. `direction` is a
    /// unit vector away from the surface. Nothing passes through the polygon itself, whatever its shading normal says: the
    /// diffuse lobe is what is above the polygon of a cosine lobe round the shading normal, scaled so that it keeps ρ.
    pub fn value(&self, direction: Vec3A) -> [Rgb; 2] {
        let cosine = direction.dot(self.normal);
        if cosine <= 0.0 || direction.dot(self.facing) <= 0.0 {
            return [Rgb::ZERO; 2];
        }
        let glossy = if self.is_glossy() {
            self.glossy * phong::value(reflect(self.towards, self.normal), direction, self.exponent) * cosine
        } else {
            Rgb::ZERO
        };
        [self.diffuse * (cosine / (PI * self.share_above())), glossy]
    }

    /// How likely each lobe is sampled where this light, per channel, is to be scattered.
    #[inline(always)]
    pub fn lobe_probabilities(&self, light: Rgb) -> LobeProbabilities {
        let weights = LOBES.map(|lobe| (light * self.share(lobe)).max_element());
        let sum: f32 = weights.iter().sum();
        LobeProbabilities(if sum > 0.0 { weights.map(|weight| weight / sum) } else { [0.0; LOBES.len()] })
    }

    /// The densities, 1/sr, with which [`Bsdf::sample_at`] chooses a direction by way of the diffuse lobe and of the glossy one.
    pub fn densities(&self, direction: Vec3A, probabilities: &LobeProbabilities) -> [f32; 2] {
        [Lobe::Diffuse, Lobe::Glossy].map(|lobe| {
            let probability = probabilities.of(lobe);
            if probability > 0.0 { probability * self.density(lobe, direction) } else { 0.0 }
        })
    }

    /// A direction in which light goes on, by random numbers: see [`Bsdf::sample_at`].
    pub fn sample(&self, light: Rgb, stream: &mut Stream) -> Option<Sample> {
        self.sample_at(&self.lobe_probabilities(light), stream.uniform(), stream.uniform2())
    }

    /// A direction in which light goes on, for numbers in [0, 1); `None` where no lobe does anything, or where the direction
    /// leads into the surface.
    pub fn sample_at(&self, probabilities: &LobeProbabilities, mut choice: f32, at: Vec2) -> Option<Sample> {
        let mut chosen = None;
        for lobe in LOBES {
            let probability = probabilities.of(lobe);
            if probability > 0.0 {
                chosen = Some((lobe, probability));
                if choice < probability {
                    break;
                }
                choice -= probability;
            }
        }
        let (lobe, probability) = chosen?;
        let (direction, factor) = self.direction(lobe, at)?;
        Some(Sample {
            direction,
            weight: self.share(lobe) * (factor / probability),
            narrowing: if lobe == Lobe::Refracted { 1.0 / (self.index * self.index) } else { 1.0 },
            scattering: if lobe == Lobe::Diffuse { Scattering::Diffuse } else { Scattering::Specular },
            crosses: matches!(lobe, Lobe::Refracted | Lobe::Straight),
            density: probability * self.density(lobe, direction),
            is_sharp: !matches!(lobe, Lobe::Diffuse | Lobe::Glossy),
        })
    }

    /// Share of a cosine lobe round the shading normal that is above the polygon.
    fn share_above(&self) -> f32 {
        share_above(self.normal, self.facing)
    }

    /// The density of a lobe's directions, 1/sr: 0 where they have none.
    fn density(&self, lobe: Lobe, direction: Vec3A) -> f32 {
        match lobe {
            Lobe::Diffuse => direction.dot(self.normal).max(0.0) / (PI * self.share_above()),
            Lobe::Glossy => phong::density(reflect(self.towards, self.normal), direction, self.exponent),
            Lobe::Mirror | Lobe::Reflected | Lobe::Refracted | Lobe::Straight => 0.0,
        }
    }

    /// A direction of a lobe, and the factor on the lobe's share that makes its expectation right.
    fn direction(&self, lobe: Lobe, at: Vec2) -> Option<(Vec3A, f32)> {
        match lobe {
            Lobe::Diffuse => {
                let direction = cosine_above(self.normal, self.facing, at);
                // But for rounding it always is.
                (direction.dot(self.facing) > 0.0).then_some((direction, 1.0))
            }
            Lobe::Glossy => {
                let direction = phong::sample(reflect(self.towards, self.normal), self.exponent, at);
                let cosine = direction.dot(self.normal);
                // The quotient of value and density.
                let factor = (self.exponent + 2.0) / (self.exponent + 1.0) * cosine;
                (cosine > 0.0 && direction.dot(self.facing) > 0.0).then_some((direction, factor))
            }
            Lobe::Mirror | Lobe::Reflected => Some((above(reflect(self.towards, self.normal), self.facing), 1.0)),
            Lobe::Refracted => {
                let direction = refract(self.towards, self.normal, self.index)?;
                Some((-above(-direction, self.facing), 1.0))
            }
            Lobe::Straight => Some((-self.towards, 1.0)),
        }
    }

    /// The part of the light that a lobe keeps; of the glossy lobe, for light along the normal.
    #[inline(always)]
    fn share(&self, lobe: Lobe) -> Rgb {
        match lobe {
            Lobe::Diffuse => self.diffuse,
            Lobe::Glossy => self.glossy,
            Lobe::Mirror => self.mirror,
            Lobe::Reflected => Rgb::splat(self.reflected),
            Lobe::Refracted => self.refracted,
            Lobe::Straight => self.straight,
        }
    }
}

/// The direction, or where a shading normal took it into the polygon, the nearest one that is just above it.
fn above(direction: Vec3A, facing: Vec3A) -> Vec3A {
    /// Sine of the least elevation.
    const LEAST: f32 = 1e-3;
    let elevation = direction.dot(facing);
    if elevation >= LEAST { direction } else { (direction + (LEAST - elevation) * facing).normalize() }
}
