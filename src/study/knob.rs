//! What can be turned to trade time for accuracy, and what a turn of it buys.

use super::recipe::{Recipe, Way};
use super::sweep::Measured;
use std::fmt;

/// What can be turned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Knob {
    Element,
    FormFactor,
    ShadowRays,
    FluxRays,
    Hemicube,
    Solver,
    Unshot,
    Photons,
    Nearest,
    Radius,
    Passes,
    LampRays,
    GatherRays,
    AoRays,
    Samples,
}

impl Knob {
    /// The option that sets it.
    pub fn option(self) -> &'static str {
        match self {
            Self::Element => "--element",
            Self::FormFactor => "--form-factor",
            Self::ShadowRays => "--shadow-rays",
            Self::FluxRays | Self::LampRays => "--light-rays",
            Self::Hemicube => "--hemicube",
            Self::Solver => "--solver",
            Self::Unshot => "--converge",
            Self::Photons => "--photons",
            Self::Nearest => "--nearest",
            Self::Radius => "--max-radius",
            Self::Passes => "--passes",
            Self::GatherRays => "--gather-rays",
            Self::AoRays => "--ao-rays",
            Self::Samples => "--samples",
        }
    }

    /// In a sentence: "halving …".
    pub fn label(self) -> &'static str {
        match self {
            Self::Element => "the element size",
            Self::FormFactor => "form factors",
            Self::ShadowRays => "the visibility rays",
            Self::FluxRays => "the rays that carry flux",
            Self::Hemicube => "the hemicube's cells",
            Self::Solver => "the solver",
            Self::Unshot => "the unshot share",
            Self::Photons => "the photons",
            Self::Nearest => "the nearest photons",
            Self::Radius => "the largest radius",
            Self::Passes => "the passes",
            Self::LampRays => "the rays to emitters",
            Self::GatherRays => "the gathering rays",
            Self::AoRays => "the occlusion rays",
            Self::Samples => "the samples",
        }
    }

    /// A setting of it in words.
    pub fn amount(self, setting: &Setting) -> String {
        match self {
            Self::Element => format!("elements of {setting} m"),
            Self::FormFactor => format!("form factors by {setting}"),
            Self::ShadowRays => format!("{setting} visibility rays"),
            Self::FluxRays => format!("{setting} rays of flux"),
            Self::Hemicube => format!("{setting} cells"),
            Self::Solver => setting.to_string(),
            Self::Unshot => format!("{setting} % unshot"),
            Self::Photons => format!("{setting} photons"),
            Self::Nearest => format!("{setting} nearest"),
            Self::Radius => format!("radius up to {setting} m"),
            Self::Passes => format!("{setting} passes"),
            Self::LampRays => format!("{setting} rays to emitters"),
            Self::GatherRays => format!("{setting} gathering rays"),
            Self::AoRays => format!("{setting} occlusion rays"),
            Self::Samples => format!("{setting} samples"),
        }
    }

    /// Whether less of it is more accurate.
    pub fn is_better_small(self) -> bool {
        matches!(self, Self::Element | Self::Unshot)
    }
}

/// How a knob is set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    Automatic,
    Number(f64),
    Name(&'static str),
}

impl serde::Serialize for Setting {
    /// A number, or its name.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(number) => serializer.serialize_f64(*number),
            Self::Automatic | Self::Name(_) => serializer.collect_str(self),
        }
    }
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Automatic => f.write_str("automatic"),
            // Sizes are kept in single precision: as many digits as that has.
            Self::Number(number) if number.fract() != 0.0 => write!(f, "{}", *number as f32),
            Self::Number(number) => write!(f, "{number}"),
            Self::Name(name) => f.write_str(name),
        }
    }
}

/// What turning one knob buys, all others as they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Gain {
    pub way: Way,
    /// Of radiosity, how form factors are computed.
    pub by: Option<&'static str>,
    pub knob: Knob,
    pub turn: Turn,
    /// By how much longer it takes, and how much of the error is left: geometric means over all such turns.
    pub time: f64,
    pub error: f64,
}

/// How far a knob is turned, always from less accurate to more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn {
    /// By this factor, somewhere between these two.
    Times { factor: f64, from: f64, to: f64 },
    /// From the default to another choice.
    Choice { from: &'static str, to: &'static str },
}

/// Two outcomes that differ in one knob.
struct Pair {
    gain: Gain,
    count: i32,
}

/// For each knob what turns of it have bought; of numbers only turns by two, or by the smallest factor that was tried.
pub fn gains(measured: &[&Measured]) -> Vec<Gain> {
    let mut pairs: Vec<Pair> = Vec::new();
    for from in measured {
        for to in measured.iter().filter(|to| to.recipe.way == from.recipe.way) {
            let Some((by, knob, turn)) = turn(&from.recipe, &to.recipe) else { continue };
            let (time, error) = (to.price.seconds / from.price.seconds, to.error.rms / from.error.rms);
            let gain = Gain { way: from.recipe.way, by, knob, turn, time, error };
            match pairs.iter_mut().find(|pair| pair.gain.is_like(&gain)) {
                Some(pair) => pair.take_in(&gain),
                None => pairs.push(Pair { gain, count: 1 }),
            }
        }
    }
    let is_smallest = |gain: &Gain| {
        let rivals =
            pairs.iter().filter(|pair| (pair.gain.way, pair.gain.by, pair.gain.knob) == (gain.way, gain.by, gain.knob));
        rivals
            .map(|pair| pair.gain.turn.factor())
            .all(|factor| factor >= gain.turn.factor() || is_near(factor, gain.turn.factor()))
    };
    let mut gains: Vec<Gain> =
        pairs.iter().map(Pair::mean).filter(|gain| gain.error.is_finite() && is_smallest(gain)).collect();
    gains.sort_by_key(|gain| (gain.way, gain.knob, gain.by));
    gains
}

impl Gain {
    fn is_like(&self, other: &Self) -> bool {
        let is_same_turn = match (self.turn, other.turn) {
            (Turn::Times { factor, .. }, Turn::Times { factor: other, .. }) => is_near(factor, other),
            (one, other) => one == other,
        };
        (self.way, self.by, self.knob) == (other.way, other.by, other.knob) && is_same_turn
    }
}

impl Pair {
    fn take_in(&mut self, other: &Gain) {
        self.count += 1;
        self.gain.time *= other.time;
        self.gain.error *= other.error;
        if let (Turn::Times { from, to, .. }, Turn::Times { from: other_from, to: other_to, .. }) =
            (&mut self.gain.turn, other.turn)
        {
            let is_rising = *to > *from;
            *from = if is_rising { from.min(other_from) } else { from.max(other_from) };
            *to = if is_rising { to.max(other_to) } else { to.min(other_to) };
        }
    }

    fn mean(&self) -> Gain {
        let root = |product: f64| product.powf(1.0 / f64::from(self.count));
        Gain { time: root(self.gain.time), error: root(self.gain.error), ..self.gain.clone() }
    }
}

impl Turn {
    fn factor(&self) -> f64 {
        match *self {
            Self::Times { factor, .. } => factor.max(1.0 / factor),
            Self::Choice { .. } => 1.0,
        }
    }
}

fn is_near(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() < 1e-3
}

/// What leads from one recipe to another, where that is one turn towards more accuracy, or from the default to another choice.
fn turn(from: &Recipe, to: &Recipe) -> Option<(Option<&'static str>, Knob, Turn)> {
    let (knob, settings) = only_difference(from, to)?;
    let by = from.knobs().into_iter().find_map(|(knob, setting)| match setting {
        Setting::Name(name) if knob == Knob::FormFactor => Some(name),
        _ => None,
    });
    match settings {
        [Setting::Number(before), Setting::Number(after)] => {
            let is_better = if knob.is_better_small() { after < before } else { after > before };
            is_better.then_some((by, knob, Turn::Times { factor: after / before, from: before, to: after }))
        }
        [Setting::Name(before), Setting::Name(after)] => {
            from.is_default(knob).then_some((None, knob, Turn::Choice { from: before, to: after }))
        }
        _ => None,
    }
}

/// The one knob in which two recipes of a way differ, and how it is set in each; `None` where that is none, or several.
fn only_difference(one: &Recipe, other: &Recipe) -> Option<(Knob, [Setting; 2])> {
    let (one, other) = (one.knobs(), other.knobs());
    let is_by_name = |knobs: &[(Knob, Setting)]| knobs.iter().find(|(knob, _)| *knob == Knob::FormFactor).map(|k| k.1);
    if is_by_name(&one) != is_by_name(&other) {
        // Each kind of form factor has a number of its own.
        let rest = |knobs: &[(Knob, Setting)]| -> Vec<(Knob, Setting)> {
            let is_its_own =
                |knob: Knob| matches!(knob, Knob::FormFactor | Knob::ShadowRays | Knob::FluxRays | Knob::Hemicube);
            knobs.iter().copied().filter(|(knob, _)| !is_its_own(*knob)).collect()
        };
        let names = [is_by_name(&one)?, is_by_name(&other)?];
        return (rest(&one) == rest(&other)).then_some((Knob::FormFactor, names));
    }
    let mut differences = one.iter().zip(&other).filter(|(one, other)| one != other);
    let ((knob, before), (other_knob, after)) = differences.next()?;
    (differences.next().is_none() && knob == other_knob).then_some((*knob, [*before, *after]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::Error;
    use crate::mesh::MeshSettings;
    use crate::methods::{FormFactorMethod, Settings};
    use crate::study::Price;

    fn measured(way: Way, settings: Settings, seconds: f64, rms: f64) -> Measured {
        Measured {
            run: 0,
            recipe: Recipe { way, settings },
            is_finished: true,
            price: Price { seconds, ..Price::default() },
            error: Error { rms, ..Error::default() },
        }
    }

    fn with_elements(size: f32) -> Settings {
        Settings { mesh: MeshSettings { element_size: Some(size), ..MeshSettings::default() }, ..Settings::default() }
    }

    #[test]
    fn halving_the_element_size_is_told_as_the_mean_of_all_such_turns() {
        let runs = [(0.4, 1.0, 0.8), (0.2, 4.0, 0.4), (0.1, 36.0, 0.1)];
        let runs = runs.map(|(size, seconds, rms)| measured(Way::Radiosity, with_elements(size), seconds, rms));
        let gains = gains(&runs.iter().collect::<Vec<_>>());
        // By 4 and 9 times longer, by a half and a quarter of the error; turns by four are not told.
        let [gain] = &gains[..] else { panic!("{gains:?}") };
        assert_eq!((gain.knob, gain.by), (Knob::Element, Some("polygon")));
        assert!((gain.time - 6.0).abs() < 1e-9 && (gain.error - 0.125_f64.sqrt()).abs() < 1e-9, "{gain:?}");
        let Turn::Times { factor, from, to } = gain.turn else { panic!("{gain:?}") };
        assert!(is_near(factor, 0.5) && is_near(from, 0.4) && is_near(to, 0.1), "{gain:?}");
    }

    #[test]
    fn another_choice_is_held_against_the_default_and_two_changes_tell_nothing() {
        let default = with_elements(0.1);
        let hemicube = Settings { form_factor: FormFactorMethod::Hemicube, ..default };
        let other = Settings { unshot_limit: 0.5, ..hemicube };
        let runs = [(default, 1.0, 0.1), (hemicube, 3.0, 0.2), (other, 9.0, 0.9)];
        let runs = runs.map(|(settings, seconds, rms)| measured(Way::Radiosity, settings, seconds, rms));
        let gains = gains(&runs.iter().collect::<Vec<_>>());
        let turns: Vec<Turn> = gains.iter().map(|gain| gain.turn).collect();
        // The unshot share went down from a half of the light to a thousandth.
        let [Turn::Choice { from: "polygon", to: "hemicube" }, Turn::Times { factor, .. }] = turns[..] else {
            panic!("{turns:?}")
        };
        assert!(is_near(factor, 0.002), "{factor}");
    }
}
