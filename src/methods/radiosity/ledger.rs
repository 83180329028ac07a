//! Rows of form factors made to add up, and what escapes on the way.

use crate::math::rgb::Rgb64;
use crate::solution::Closure;

/// Sums that go on as rows come in; what is absorbed and unshot is counted from the elements and patches themselves.
#[derive(Default)]
pub struct Ledger {
    /// W.
    pub escaped: Rgb64,
    closure_sum: f64,
    closure_worst: f64,
    rows: u64,
}

impl Ledger {
    /// Closes the row of a shooter that shoots `flux` (W): its form factors sum to `row`, and its rays say which share is
    /// `escaping`. Returns the factor that makes both together 1, books what escapes, and keeps the error of before in
    /// mind.
    pub fn close_row(&mut self, flux: Rgb64, row: f64, escaping: f64) -> f64 {
        let error = (row + escaping - 1.0).abs();
        self.closure_sum += error;
        self.closure_worst = self.closure_worst.max(error);
        self.rows += 1;
        let leaving = row + escaping;
        if leaving <= 0.0 {
            // Nothing receives this flux, and no ray found a way out either.
            self.escaped += flux;
            return 0.0;
        }
        self.escaped += flux * (escaping / leaving);
        1.0 / leaving
    }

    pub fn closure(&self) -> Closure {
        Closure { mean: self.closure_sum / self.rows.max(1) as f64, worst: self.closure_worst, reciprocity: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_close_and_their_error_is_kept() {
        let mut ledger = Ledger::default();
        let scale = ledger.close_row(Rgb64::ONE, 0.77, 0.2);
        assert!((0.77 * scale + ledger.escaped.x - 1.0).abs() < 1e-15);
        ledger.close_row(Rgb64::ONE, 1.01, 0.0);
        assert!((ledger.closure().worst - 0.03).abs() < 1e-15 && (ledger.closure().mean - 0.02).abs() < 1e-15);
    }

    #[test]
    fn flux_that_nothing_receives_escapes() {
        let mut ledger = Ledger::default();
        assert_eq!(ledger.close_row(Rgb64::ONE, 0.0, 0.0), 0.0);
        assert_eq!(ledger.escaped, Rgb64::ONE);
    }
}
