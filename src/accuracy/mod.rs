//! Where solutions are held against the truth.

mod cache;
mod error;
mod found;
mod front;
mod pixel_truth;
mod points;
mod reference;

pub use cache::{Cache, CacheError, Key};
pub use error::Error;
pub use found::{Found, by_photons, by_radiosity, surfaces};
pub use front::{Offer, exponent, front, level_from, slope_at_end};
pub use pixel_truth::{ErrorParts, PixelTruth};
pub use points::{ProbePoint, spread};
pub use reference::{Reference, Truth};
