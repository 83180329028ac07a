//! What is wanted of light: an error, a time.

/// Both are lines in the chart of errors, and what settings are looked for by.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct Wish {
    /// As a share of the mean irradiance.
    pub error: f64,
    /// Of the solver, s.
    pub seconds: f64,
}

impl Default for Wish {
    fn default() -> Self {
        Self { error: 0.05, seconds: 5.0 }
    }
}
