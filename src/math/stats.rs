//! Means, spreads and what they say about each other.

/// Running mean and variance of a stream of numbers (Welford 1962): one pass, no cancellation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    count: u64,
    mean: f64,
    squares: f64,
}

impl Moments {
    /// Takes one more number in.
    pub fn add(&mut self, value: f64) {
        self.count += 1;
        let from_old_mean = value - self.mean;
        self.mean += from_old_mean / self.count as f64;
        self.squares += from_old_mean * (value - self.mean);
    }

    pub fn count(&self) -> u64 {
        self.count
    }

    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Unbiased estimate of the variance; 0 for fewer than two numbers.
    pub fn variance(&self) -> f64 {
        if self.count < 2 { 0.0 } else { self.squares / (self.count - 1) as f64 }
    }

    /// Standard deviation of the mean of independent numbers.
    pub fn standard_error(&self) -> f64 {
        if self.count < 2 { 0.0 } else { (self.variance() / self.count as f64).sqrt() }
    }
}

/// The root of an estimate of a mean square, which may have come out below 0, and the root's standard error, by that of the
/// square. Of a square that cannot be told from 0 the root cannot, either.
pub fn root_of_square(square: f64, deviation: f64) -> (f64, f64) {
    let root = |square: f64| square.max(0.0).sqrt();
    let rms = root(square);
    (rms, (root(square.max(0.0) + deviation) - rms).max(rms - root(square - deviation)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_is_never_surer_than_its_square() {
        let (rms, uncertainty) = root_of_square(4.0, 0.04);
        assert!(rms == 2.0 && (uncertainty - 0.01).abs() < 1e-4);
        assert_eq!(root_of_square(-9.0, 4.0), (0.0, 2.0));
        assert_eq!(root_of_square(0.0, 0.0), (0.0, 0.0));
    }

    #[test]
    fn moments_of_a_small_set_far_from_zero() {
        let mut moments = Moments::default();
        for value in [1e9 + 4.0, 1e9 + 7.0, 1e9 + 13.0, 1e9 + 16.0] {
            moments.add(value);
        }
        assert_eq!((moments.count(), moments.mean(), moments.variance()), (4, 1e9 + 10.0, 30.0));
        assert!((moments.standard_error() - 7.5_f64.sqrt()).abs() < 1e-12);
    }
}
