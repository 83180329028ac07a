//! Where solutions are held against the truth.

mod points;

pub use points::{ProbePoint, spread};
