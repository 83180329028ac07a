//! Lightwell: an interactive explorer of global illumination.
//!
//! The modules form layers, and a name may be used only from a higher one (`tests/layering.rs` checks it): numbers
//! ([`math`]), the world ([`scene`], [`mesh`], [`tracer`], [`world`]), what it calls for ([`effects`]), what a method hands
//! out ([`solution`]), the [`methods`], where they are held against the truth ([`accuracy`]), the [`hard_cases`], the solver
//! thread ([`worker`]), the picture ([`camera`], [`viewport`]) and the two faces of the program ([`cli`], [`app`]).

pub mod accuracy;
pub mod app;
pub mod camera;
pub mod cancel;
pub mod choice;
pub mod cli;
pub mod clock;
pub mod effects;
pub mod errors;
pub mod hard_cases;
pub mod math;
pub mod mesh;
pub mod methods;
pub mod scene;
pub mod solution;
pub mod study;
pub mod tracer;
pub mod viewport;
pub mod worker;
pub mod world;
