//! What is left of a material where some effects are not simulated.

use crate::effects::{Effect, Effects};
use crate::math::rgb::{Rgb, luminance};
use crate::scene::Lobes;

pub const SPECULAR: Effects = Effects::of(&[Effect::SpecularReflection, Effect::Gloss, Effect::Transmission]);

/// The specular effects of lobes.
pub fn effects_of(lobes: &Lobes) -> Effects {
    let is_glass = lobes.glass > 0.0;
    let effects = [
        (Effect::SpecularReflection, is_glass || lobes.mirror != Rgb::ZERO),
        (Effect::Gloss, lobes.glossy != Rgb::ZERO),
        (Effect::Transmission, is_glass || lobes.straight != Rgb::ZERO),
    ];
    effects.into_iter().filter(|(_, has)| *has).map(|(effect, _)| effect).collect()
}

/// The lobes that the simulated effects leave. Glass keeps its boundary: what it reflects is known only where light meets it.
pub fn without(lobes: &Lobes, effects: Effects) -> Lobes {
    let if_simulated = |effect, share: Rgb| if effects.contains(effect) { colour(share, effects) } else { Rgb::ZERO };
    Lobes {
        diffuse: colour(lobes.diffuse, effects),
        glossy: if_simulated(Effect::Gloss, lobes.glossy),
        mirror: if_simulated(Effect::SpecularReflection, lobes.mirror),
        filter: if_simulated(Effect::Transmission, lobes.filter),
        straight: if_simulated(Effect::Transmission, lobes.straight),
        ..*lobes
    }
}

/// A colour, or without colours a grey that is as bright to the eye. What is grey already stays as it is to the last bit.
pub fn colour(rgb: Rgb, effects: Effects) -> Rgb {
    let is_grey = rgb == Rgb::splat(rgb.x);
    if is_grey || effects.contains(Effect::Colour) { rgb } else { Rgb::splat(luminance(rgb)) }
}
