//! How far solutions are from the truth, and what that costs: one measure for all methods.

mod error;
mod points;

pub use error::Error;
pub use points::{ProbePoint, spread};
