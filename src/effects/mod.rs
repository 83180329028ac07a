//! What a scene calls for: which effects of light matter in a world, and why.

mod effect;

pub use effect::{Effect, Effects};
