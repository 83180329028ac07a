//! One line of the table.

use crate::cancel::Cancel;

/// A number of a case, held against what it should be.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Row {
    /// [`super::Case::name`].
    pub case: &'static str,
    /// What is measured, with its unit where it has one.
    pub quantity: String,
    /// From a closed form or a brute-force oracle; of a limit, how far off the number is known to be.
    pub expected: f64,
    pub got: f64,
    /// Largest difference that is accepted.
    pub tolerance: f64,
    /// What makes the row hold; of a limit, why nothing does.
    pub guard: String,
    pub verdict: Verdict,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Verdict {
    /// The number is what it should be.
    Pass,
    /// It is not.
    Fail,
    /// It is wrong, as is known, and exactly as wrong as is known.
    Limit,
}

/// What a number should be.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
    value: f64,
    tolerance: f64,
}

/// This value, up to an absolute difference.
pub fn about(value: f64, tolerance: f64) -> Expected {
    Expected { value, tolerance }
}

/// This value and no other.
pub fn exactly(value: f64) -> Expected {
    about(value, 0.0)
}

/// Collects the rows of a case while it runs.
pub struct Rows<'a> {
    case: &'static str,
    /// Stops the case.
    pub cancel: &'a Cancel,
    rows: Vec<Row>,
}

impl<'a> Rows<'a> {
    pub fn new(case: &'static str, cancel: &'a Cancel) -> Self {
        Self { case, cancel, rows: Vec::new() }
    }

    /// A number that `guard` keeps right.
    pub fn check(&mut self, quantity: impl Into<String>, got: f64, expected: Expected, guard: &str) {
        self.add(quantity.into(), got, expected, guard, Verdict::Pass);
    }

    /// A number that is known to be wrong, for this `reason`, and how wrong it is.
    pub fn limit(&mut self, quantity: impl Into<String>, got: f64, expected: Expected, reason: &str) {
        self.add(quantity.into(), got, expected, reason, Verdict::Limit);
    }

    /// A case that did not come to its end.
    pub fn crashed(&mut self, reason: &str) {
        self.add("comes to its end".to_owned(), 0.0, exactly(1.0), &format!("panicked: {reason}"), Verdict::Fail);
    }

    fn add(&mut self, quantity: String, got: f64, expected: Expected, guard: &str, if_so: Verdict) {
        let Expected { value, tolerance } = expected;
        // Not a number is never near to anything.
        let verdict = if (got - value).abs() <= tolerance { if_so } else { Verdict::Fail };
        let guard = guard.to_owned();
        self.rows.push(Row { case: self.case, quantity, expected: value, got, tolerance, guard, verdict });
    }

    pub fn into_rows(self) -> Vec<Row> {
        self.rows
    }
}
