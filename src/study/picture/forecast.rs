//! What a pilot render lets one expect of the whole picture, and which of several pictures serves a budget best.

use crate::accuracy::ErrorParts;

/// An error counts as reached when it is below this share of what is wanted: it is measured in some pixels, and meant in all.
pub const SAFE: f64 = 0.9;
/// More samples are of no use once noise is this share of the squared bias: they would take away 5 % of the error at most.
const IDLE: f64 = 0.1;

/// Error model of a picture in the making: after n samples a pixel its squared error is bias + noise / n, as a share of the
/// squared mean radiance. Noise of well-spread samples falls a little faster.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forecast {
    pub parts: ErrorParts,
    /// Of a sample of every pixel of the picture, s.
    pub sample_seconds: f64,
}

/// What is wanted, in seconds since the search began.
#[derive(Clone, Copy, Debug)]
pub struct Targets {
    /// As a share of the mean radiance.
    pub error: Option<f64>,
    /// When the picture must be done.
    pub end: f64,
    /// Whether the time until `end` is to be used up where no error is wanted, or it is not reached.
    pub is_timed: bool,
}

/// How well a picture serves: one that reaches the error is better than one that does not, and of two the sooner, or the
/// more accurate, is better.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum Merit {
    /// Seconds until the error is reached.
    Reaches(f64),
    /// The error in the time left.
    Leaves(f64),
}

/// How an uncertain bias is taken.
#[derive(Clone, Copy, Debug)]
pub enum Attitude {
    /// As large as it may be: by one standard error, and half of that at least. What is not known to be good is not taken for it.
    Careful,
    /// As small as it may be: by two.
    Hopeful,
}

impl Forecast {
    /// The squared bias that is to be reckoned with, of light whose bias is `share` of what was measured.
    fn bias(&self, attitude: Attitude, share: f64) -> f64 {
        let ErrorParts { bias, bias_deviation, .. } = self.parts;
        let bias = match attitude {
            // An estimate below 0 makes a bias less likely, but not out of the question.
            Attitude::Careful => (bias + bias_deviation).max(bias_deviation / 2.0),
            Attitude::Hopeful => (bias.max(0.0) - 2.0 * bias_deviation).max(0.0),
        };
        share * share * bias
    }

    /// Whether a bias can be told from none.
    pub fn is_biased(&self) -> bool {
        self.parts.bias > self.parts.bias_deviation
    }

    /// The error of a picture that may take so long.
    fn error_in(&self, seconds: f64, attitude: Attitude, share: f64) -> f64 {
        let samples = (seconds / self.sample_seconds).floor().max(1.0);
        (self.bias(attitude, share) + self.parts.noise / samples).sqrt()
    }

    /// How long a picture of this error takes; `None` where its bias alone is larger.
    fn seconds_to(&self, error: f64, attitude: Attitude, share: f64) -> Option<f64> {
        let noise_left = error * error - self.bias(attitude, share);
        (noise_left > 0.0).then(|| self.sample_seconds * (self.parts.noise / noise_left).ceil().max(1.0))
    }

    /// Seconds after which more samples hardly make the picture more accurate.
    fn useful_seconds(&self) -> f64 {
        self.sample_seconds * (self.parts.noise / (IDLE * self.parts.bias.max(0.0))).ceil()
    }

    /// What is to be had from it at a time `now`, with light whose bias is `share` of what was measured and that is there
    /// `delay` seconds later.
    pub fn merit(&self, targets: &Targets, now: f64, attitude: Attitude, [share, delay]: [f64; 2]) -> Merit {
        let left = (targets.end - now - delay).max(0.0);
        let reaches = targets.error.and_then(|error| self.seconds_to(SAFE * error, attitude, share));
        match reaches {
            Some(seconds) if seconds <= left => Merit::Reaches(delay + seconds),
            _ => Merit::Leaves(self.error_in(left, attitude, share)),
        }
    }

    /// The same of the light that it has.
    pub fn own_merit(&self, targets: &Targets, now: f64, attitude: Attitude) -> Merit {
        self.merit(targets, now, attitude, [1.0, 0.0])
    }

    /// How long the picture will take from `now` on.
    pub fn picture_seconds(&self, targets: &Targets, now: f64) -> f64 {
        let left = (targets.end - now).max(0.0);
        match self.own_merit(targets, now, Attitude::Careful) {
            Merit::Reaches(seconds) => seconds,
            Merit::Leaves(_) if targets.is_timed => left,
            Merit::Leaves(_) => left.min(self.useful_seconds()),
        }
    }
}

impl Merit {
    /// Whether it is better by a twentieth at least.
    pub fn is_clearly_better_than(self, other: Self) -> bool {
        const CLEARLY: f64 = 0.95;
        match (self, other) {
            (Self::Reaches(one), Self::Reaches(other)) | (Self::Leaves(one), Self::Leaves(other)) => {
                one < CLEARLY * other
            }
            (one, other) => one < other,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn forecast(bias: f64, bias_deviation: f64, noise: f64, sample_seconds: f64) -> Forecast {
        Forecast { parts: ErrorParts { bias, bias_deviation, noise }, sample_seconds }
    }

    fn targets(error: Option<f64>, end: f64) -> Targets {
        Targets { error, end, is_timed: true }
    }

    #[test]
    fn an_error_that_cannot_be_had_in_the_time_leaves_what_the_time_alone_leaves() {
        let traced = forecast(0.0, 0.0, 0.64, 0.01);
        // 0.64 / (0.9 · 0.1)² = 79.01…: 80 samples.
        let Merit::Reaches(seconds) = traced.own_merit(&targets(Some(0.1), 3.0), 0.0, Attitude::Careful) else {
            panic!("0.8 s are less than 3")
        };
        assert!((seconds - 0.8).abs() < 1e-12, "{seconds}");
        let [both, alone] =
            [Some(0.01), None].map(|error| traced.own_merit(&targets(error, 2.5), 0.5, Attitude::Careful));
        let Merit::Leaves(error) = both else { panic!("64 s are more than 2") };
        assert!((error - 0.8 / 200.0_f64.sqrt()).abs() < 1e-4, "{error}");
        assert_eq!(both, alone);
        assert!(Merit::Reaches(1e9) < Merit::Leaves(1e-9));
    }

    #[test]
    fn a_bias_that_is_not_known_is_feared_by_the_careful_and_not_by_the_hopeful() {
        let unknown = forecast(-0.001, 0.004, 1e-9, 0.01);
        let merit = |attitude| unknown.own_merit(&targets(None, 1.0), 0.0, attitude);
        let (Merit::Leaves(careful), Merit::Leaves(hopeful)) = (merit(Attitude::Careful), merit(Attitude::Hopeful))
        else {
            panic!("no error was wanted")
        };
        assert!((careful - 0.003_f64.sqrt()).abs() < 1e-6 && hopeful < 1e-4, "{careful} {hopeful}");
        assert!(!unknown.is_biased() && forecast(0.005, 0.004, 0.0, 0.01).is_biased());
    }

    #[test]
    fn a_picture_takes_until_its_error_or_its_end_or_no_longer_than_it_gets_better() {
        let biased = forecast(0.01, 0.0, 0.0995, 0.01);
        let seconds = |targets| biased.picture_seconds(&targets, 1.0);
        // 0.0995 / ((0.9 · 0.2)² − 0.01) = 4.44…: 5 samples.
        assert!((seconds(targets(Some(0.2), 9.0)) - 0.05).abs() < 1e-12);
        assert_eq!(seconds(targets(Some(0.05), 9.0)), 8.0);
        // 0.0995 / (0.1 · 0.01) = 99.5: 100 samples.
        assert!((seconds(Targets { is_timed: false, ..targets(Some(0.05), 300.0) }) - 1.0).abs() < 1e-12);
    }
}
