//! What a scene calls for: which effects of light matter in a world, and why.

mod advice;
mod effect;
mod plan;
mod verdict;

pub use advice::{Advice, Approach};
pub use effect::{Effect, Effects};
pub use plan::{Plan, plan};
pub use verdict::Verdict;
