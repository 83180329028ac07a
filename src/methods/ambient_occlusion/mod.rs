//! Ambient occlusion: how much of the even light from everywhere arrives at a point (Zhukov, Iones, Kronin 1998; Landis
//! 2002). It is a guess at indirect light, and needs no emitter.

mod falloff;

pub use falloff::{Falloff, OcclusionSettings, Range};
