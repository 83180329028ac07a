//! The effects of light that can be simulated or skipped.

use crate::choice::Choice;
use std::fmt;

/// Something that light does, and that costs time to simulate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Light that comes straight from emitters.
    DirectLight,
    /// Surfaces that stand in the way of light.
    Shadows,
    /// Light from one diffuse surface to another.
    Interreflection,
    /// Red, green and blue apart.
    Colour,
    /// Mirrors.
    SpecularReflection,
    /// Blurred mirror images.
    Gloss,
    /// Glass, and surfaces that are not opaque.
    Transmission,
    /// Light that arrives at surfaces over specular ones alone.
    Caustics,
    /// Light that leaves the scene.
    Escape,
    /// Even light from everywhere, where nothing emits.
    AmbientLight,
}

impl Choice for Effect {
    const ALL: &'static [Self] = &[
        Self::DirectLight,
        Self::Shadows,
        Self::Interreflection,
        Self::Colour,
        Self::SpecularReflection,
        Self::Gloss,
        Self::Transmission,
        Self::Caustics,
        Self::Escape,
        Self::AmbientLight,
    ];
    const KIND: &'static str = "effect";

    fn name(self) -> &'static str {
        match self {
            Self::DirectLight => "direct-light",
            Self::Shadows => "shadows",
            Self::Interreflection => "interreflection",
            Self::Colour => "colour",
            Self::SpecularReflection => "specular-reflection",
            Self::Gloss => "gloss",
            Self::Transmission => "transmission",
            Self::Caustics => "caustics",
            Self::Escape => "escape",
            Self::AmbientLight => "ambient-light",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::DirectLight => "Direct light",
            Self::Shadows => "Shadows",
            Self::Interreflection => "Interreflection",
            Self::Colour => "Colour",
            Self::SpecularReflection => "Mirror reflection",
            Self::Gloss => "Gloss",
            Self::Transmission => "Transmission",
            Self::Caustics => "Caustics",
            Self::Escape => "Escape",
            Self::AmbientLight => "Ambient light",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::DirectLight => "Light that comes straight from emitters",
            Self::Shadows => "Surfaces that stand in the way of light",
            Self::Interreflection => "Light from one diffuse surface to another",
            Self::Colour => "Red, green and blue apart",
            Self::SpecularReflection => "Mirrors",
            Self::Gloss => "Blurred mirror images",
            Self::Transmission => "Glass, and surfaces that are not opaque",
            Self::Caustics => "Light that mirrors and glass gather on diffuse surfaces",
            Self::Escape => "Light that leaves the scene",
            Self::AmbientLight => "Even light from everywhere, where nothing emits",
        }
    }
}

/// A set of effects.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub struct Effects(u16);

impl Effects {
    pub const ALL: Self = Self((1 << Effect::ALL.len()) - 1);

    /// The set of these.
    pub const fn of(effects: &[Effect]) -> Self {
        let (mut bits, mut i) = (0, 0);
        while i < effects.len() {
            bits |= Self::bit(effects[i]);
            i += 1;
        }
        Self(bits)
    }

    pub const fn contains(self, effect: Effect) -> bool {
        self.0 & Self::bit(effect) != 0
    }

    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Those in either.
    #[must_use]
    pub const fn and(self, others: Self) -> Self {
        Self(self.0 | others.0)
    }

    /// Those that are not among the others.
    #[must_use]
    pub const fn but(self, others: Self) -> Self {
        Self(self.0 & !others.0)
    }

    /// Those in both.
    #[must_use]
    pub const fn among(self, others: Self) -> Self {
        Self(self.0 & others.0)
    }

    /// In the order in which people are shown them.
    pub fn iter(self) -> impl Iterator<Item = Effect> {
        Effect::ALL.iter().copied().filter(move |&effect| self.contains(effect))
    }

    const fn bit(effect: Effect) -> u16 {
        1 << effect as u16
    }
}

impl FromIterator<Effect> for Effects {
    fn from_iter<I: IntoIterator<Item = Effect>>(effects: I) -> Self {
        effects.into_iter().fold(Self::default(), |set, effect| set.and(Self::of(&[effect])))
    }
}

impl fmt::Debug for Effects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}
