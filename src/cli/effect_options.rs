//! What commands take that simulate effects, and what they say of those that they skipped.

use crate::choice::{Choice, parse};
use crate::effects::{Bill, Effect, Effects, Switches, plan};
use crate::methods::Settings;
use crate::worker::{Entry, Subject};
use crate::world::World;
use clap::Args;
use serde_json::{Value, json};

/// Which effects are simulated.
#[derive(Args, Debug)]
#[command(next_help_heading = "Effects")]
pub struct EffectOptions {
    /// Simulate only the effects that the scene calls for, or all of them: planned or all
    #[arg(long, value_name = "WHICH", default_value = Which::default().name(), value_parser = parse::<Which>)]
    effects: Which,
    /// Leave an effect out, even if the scene calls for it; may be given several times
    #[arg(long, value_name = "EFFECT", value_parser = parse::<Effect>)]
    without: Vec<Effect>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Which {
    #[default]
    Planned,
    All,
}

impl Choice for Which {
    const ALL: &'static [Self] = &[Self::Planned, Self::All];
    const KIND: &'static str = "set of effects";

    fn name(self) -> &'static str {
        match self {
            Self::Planned => "planned",
            Self::All => "all",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Planned => "Planned",
            Self::All => "All",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Planned => "Those that the scene calls for",
            Self::All => "All, though some cost time and change nothing",
        }
    }
}

impl EffectOptions {
    pub fn switches(&self) -> Switches {
        let forced = match self.effects {
            Which::Planned => Effects::default(),
            Which::All => Effects::ALL,
        };
        Switches { forced, off: self.without.iter().copied().collect() }
    }

    /// Why what was asked for cannot be had, if it cannot: `subject` has a `name`.
    pub fn objection(&self, subject: Subject, settings: &Settings, name: &str) -> Option<String> {
        let repertoire = subject.repertoire(settings);
        let stranger = self.without.iter().find(|effect| !repertoire.contains(**effect))?;
        let known: Vec<_> = repertoire.iter().map(Effect::name).collect();
        let known = if known.is_empty() { "nothing".to_owned() } else { known.join(", ") };
        Some(format!("--without {} is not for {name}, which can leave out {known}", stranger.name()))
    }
}

/// Adds to a report which effects were simulated and which were skipped and why, with rays by effect.
pub fn report(value: &mut Value, subject: Subject, world: &World, settings: &Settings, bill: &Bill) {
    let plan = plan(world);
    let reason = |effect: Effect| {
        let verdict = plan.verdicts.iter().find(|verdict| verdict.effect == effect);
        verdict.map_or_else(String::new, |verdict| match verdict.is_needed {
            true => format!("It was left out. {}", verdict.if_missed),
            false => verdict.reason.clone(),
        })
    };
    let (simulated, skipped): (Vec<Entry>, Vec<Entry>) =
        subject.account(world, settings, bill).into_iter().partition(|entry| entry.is_simulated);
    let simulated = simulated.iter().map(|entry| json!({ "effect": entry.effect.name(), "rays": entry.spent }));
    let skipped = skipped.iter().map(
        |entry| json!({ "effect": entry.effect.name(), "reason": reason(entry.effect), "rays_saved": entry.saved }),
    );
    value["simulated"] = simulated.collect();
    value["skipped"] = skipped.collect();
}
