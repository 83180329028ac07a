//! What a scene calls for: which effects of light matter in a world, and why.

mod advice;
mod bill;
mod effect;
mod plan;
mod switches;
mod verdict;

pub use advice::{Advice, Approach};
pub use bill::Bill;
pub use effect::{Effect, Effects};
pub use plan::{Plan, needed, plan};
pub use switches::Switches;
pub use verdict::Verdict;
