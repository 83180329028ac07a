//! How far a search is.

use std::fmt;

/// What a search does now, and the best that it has found so far, in words.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SearchProgress {
    pub doing: String,
    pub best: Option<String>,
}

impl SearchProgress {
    pub fn of(doing: impl Into<String>) -> Self {
        Self { doing: doing.into(), best: None }
    }
}

impl fmt::Display for SearchProgress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.doing)?;
        self.best.as_ref().map_or(Ok(()), |best| write!(f, "; best so far: {best}"))
    }
}
