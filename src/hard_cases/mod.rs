//! The gallery of hard cases: small scenes and numbers on which programs of this kind are known to break.
//!
//! Every row holds one number against a closed form or a brute-force oracle and names the guard that makes it hold. What
//! no method here can do stays in the gallery as a known limit: its row says how far off the number is, and
//! fails if that changes.

mod emitters;
mod form_factors;
mod input;
mod leaks;
mod materials;
mod meshes;
mod oracle;
mod rays;
mod row;
mod scale;
mod solvers;
mod stage;

pub use row::{Expected, Row, Rows, Verdict, about, exactly};

use crate::cancel::{Cancel, Cancelled};
use crate::scene::Scene;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

/// A hard case: what is hard about it, how to try it, and how to look at it.
pub struct Case {
    /// For command lines and tables.
    pub name: &'static str,
    /// What is hard about it: one sentence.
    pub about: &'static str,
    /// Adds the rows of the case.
    pub measure: fn(&mut Rows) -> Result<(), Cancelled>,
    /// The case as a scene to look at; `None` for a case that no scene can hold.
    pub scene: fn() -> Option<Arc<Scene>>,
}

impl Case {
    /// Runs the case; `None` if it was cancelled. A panic becomes a row that fails.
    pub fn run(&self, cancel: &Cancel) -> Option<Vec<Row>> {
        let mut rows = Rows::new(self.name, cancel);
        match catch_unwind(AssertUnwindSafe(|| (self.measure)(&mut rows))) {
            Ok(Ok(())) => {}
            Ok(Err(Cancelled)) => return None,
            Err(panic) => rows.crashed(reason(&*panic)),
        }
        Some(rows.into_rows())
    }
}

/// What a panic said.
fn reason(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given")
}

/// All cases, in the order in which they are listed.
pub fn cases() -> impl Iterator<Item = &'static Case> {
    let files = [
        form_factors::CASES,
        rays::CASES,
        leaks::CASES,
        meshes::CASES,
        scale::CASES,
        materials::CASES,
        emitters::CASES,
        solvers::CASES,
        input::CASES,
    ];
    files.into_iter().flatten()
}
