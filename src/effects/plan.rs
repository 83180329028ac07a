//! The plan: which effects a world calls for.

use super::advice::Advice;
use super::effect::{Effect, Effects};
use super::verdict::Verdict;
use crate::choice::Choice;
use crate::world::World;

/// Which effects a world calls for, and what is best computed how.
///
/// An effect that is not needed can be skipped without a change to the light. Where the census cannot tell, the effect is
/// needed; which sides light reaches, and whether it can leave, is known as well as the rays tell that explored the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// One for each effect, in the order in which people are shown them.
    pub verdicts: Vec<Verdict>,
    /// What is said of parts of the scene that take no part in the light: one sentence each.
    pub parts: Vec<String>,
    pub advice: Advice,
}

impl Plan {
    pub fn needed(&self) -> Effects {
        self.verdicts.iter().filter(|verdict| verdict.is_needed).map(|verdict| verdict.effect).collect()
    }
}

/// The effects that a world calls for.
pub fn needed(world: &World) -> Effects {
    Effect::ALL.iter().copied().filter(|&effect| Verdict::new(effect, world).is_needed).collect()
}

/// Plans by the census that the world took when it was built, so that this costs next to nothing.
pub fn plan(world: &World) -> Plan {
    let verdicts: Vec<Verdict> = Effect::ALL.iter().map(|&effect| Verdict::new(effect, world)).collect();
    let needed = verdicts.iter().filter(|verdict| verdict.is_needed).map(|verdict| verdict.effect).collect();
    Plan { verdicts, parts: parts(world), advice: Advice::new(needed, &world.census) }
}

fn parts(world: &World) -> Vec<String> {
    let census = &world.census;
    let mut parts = Vec::new();
    if census.unseen_emitters > 0 {
        parts.push(format!(
            "{} of {} emitters light nothing that random rays find.",
            census.unseen_emitters, census.emitters
        ));
    }
    if census.unreached() > 0 {
        parts.push(format!(
            "{} of {} polygons are reached by light from no side: they get no elements.",
            census.unreached(),
            census.polygons
        ));
    }
    parts
}
