//! How far a search is, on standard error: one line that changes on a terminal, and a few lines elsewhere.

use crate::study::SearchProgress;
use std::io::{IsTerminal, Write};
use std::time::Instant;

/// Columns that a line takes at most: a longer one would not be overwritten.
const COLUMNS: usize = 79;
/// Seconds between two changes of a line on a terminal, and before the first line elsewhere.
const OFTEN: f64 = 0.1;
const FIRST: f64 = 2.0;
/// Elsewhere each line comes after so many times as long as the one before it.
const SELDOM: f64 = 2.0;

/// Prints it. What is left on a terminal is wiped out in the end.
pub struct ProgressLine {
    start: Instant,
    pace: Pace,
}

impl ProgressLine {
    pub fn new() -> Self {
        Self { start: Instant::now(), pace: Pace::new(std::io::stderr().is_terminal()) }
    }

    pub fn tell(&mut self, progress: &SearchProgress) {
        if let Some(text) = self.pace.text(self.start.elapsed().as_secs_f64(), progress) {
            // Nobody is worse off for a line that could not be printed.
            let _ = write!(std::io::stderr(), "{text}");
        }
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        if self.pace.is_terminal {
            let _ = write!(std::io::stderr(), "{WIPED}");
        }
    }
}

/// Back to the first column, and nothing after it.
const WIPED: &str = "\r\x1b[K";

/// When there is something to print, and what.
struct Pace {
    is_terminal: bool,
    /// Seconds before which nothing is printed.
    next: f64,
}

impl Pace {
    fn new(is_terminal: bool) -> Self {
        Self { is_terminal, next: if is_terminal { 0.0 } else { FIRST } }
    }

    fn text(&mut self, seconds: f64, progress: &SearchProgress) -> Option<String> {
        if seconds < self.next {
            return None;
        }
        let line = format!("{seconds:6.1} s  {progress}");
        if self.is_terminal {
            self.next = seconds + OFTEN;
            return Some(format!("{WIPED}{}", line.chars().take(COLUMNS).collect::<String>()));
        }
        self.next = SELDOM * seconds;
        Some(format!("{line}\n"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn progress() -> SearchProgress {
        SearchProgress { doing: "trying final-gather".to_owned(), best: Some("reference, 3.00 % foreseen".to_owned()) }
    }

    #[test]
    fn elsewhere_five_minutes_are_a_few_lines() {
        let mut pace = Pace::new(false);
        let lines: Vec<String> = (0..3000).filter_map(|i| pace.text(f64::from(i) / 10.0, &progress())).collect();
        assert_eq!(lines.len(), 8, "{lines:?}");
        assert_eq!(lines[0], "   2.0 s  trying final-gather; best so far: reference, 3.00 % foreseen\n");
    }

    #[test]
    fn on_a_terminal_one_line_changes() {
        let mut pace = Pace::new(true);
        let first = pace.text(0.0, &progress()).expect("a line");
        assert!(first.starts_with(WIPED) && !first.contains('\n'), "{first}");
        assert_eq!(pace.text(0.05, &progress()), None);
        let long = SearchProgress::of("x".repeat(200));
        assert_eq!(pace.text(0.2, &long).expect("a line").chars().count(), WIPED.chars().count() + COLUMNS);
    }
}
