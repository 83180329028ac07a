//! What accuracy costs in time: ways to compute light are run on one scene, and each is held against the truth.

mod attempt;
mod bench;
mod budget;
mod family;
mod inquiry;
mod knob;
mod lit;
mod memory;
mod not_found;
mod picture;
mod progress;
mod recipe;
mod seek;
mod sweep;
mod worlds;

pub use attempt::{CannotTry, Outcome, Price, Verdict, attempt};
pub use bench::Bench;
pub use budget::{Budget, Prediction};
pub use inquiry::{Answer, Choice, Inquiry, Question, State};
pub use knob::{Gain, Knob, Setting, Turn, gains};
pub use lit::Light;
pub use memory::{Known, Memory};
pub use not_found::NotFound;
pub use picture::{PictureRequest, PictureResult, picture};
pub use progress::SearchProgress;
pub use recipe::{Recipe, Way};
pub use seek::{SearchResult, seek};
pub use sweep::{Measured, Progress, Study, study};
pub use worlds::Worlds;
