//! What light was to be, what came of it, and whether that is as it was wanted: the same words on paper, in files and in the window.

use crate::accuracy::Error;
use serde_json::{Value, json};
use std::time::Duration;

/// How good light is, and what was asked of it.
pub struct QualityReport {
    /// As a share of the mean light.
    pub error_wanted: Option<f64>,
    /// What was expected when the way was chosen, if that was anything.
    pub error_foreseen: Option<f64>,
    /// From the start of the program, or of the search.
    pub time_allowed: Option<Duration>,
    pub error: Error,
    /// Of the solver, and of the picture if the error is that of a picture.
    pub seconds: f64,
    /// Where something was asked for.
    pub targets: Option<TargetsMet>,
    /// The options that do it again, where it was chosen.
    pub options: Option<String>,
}

/// Whether a target was met.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TargetMet {
    Yes,
    /// With both numbers, as in `2.4 % > 2.0 %`.
    No(String),
    /// The reference is known too badly to say.
    Unknown,
}

impl TargetMet {
    /// Share of an error that is wanted by which the one that came of it may be uncertain.
    const SURE: f64 = 0.5;
    /// Times are kept where they are longer than what was allowed by this share at most.
    const TIME_TOLERANCE: f64 = 0.05;

    pub fn of_error(wanted: f64, error: &Error) -> Self {
        match error.below() {
            Some(limit) if limit <= wanted => Self::Yes,
            Some(_) => Self::Unknown,
            None if error.rms > wanted => Self::No(exceeds(100.0 * error.rms, 100.0 * wanted, "%")),
            None if error.uncertainty > Self::SURE * wanted => Self::Unknown,
            None => Self::Yes,
        }
    }

    pub fn of_time(allowed: Duration, seconds: f64) -> Self {
        let allowed = allowed.as_secs_f64();
        if seconds <= (1.0 + Self::TIME_TOLERANCE) * allowed {
            Self::Yes
        } else {
            Self::No(exceeds(seconds, allowed, "s"))
        }
    }

    /// `None` where it is not known.
    fn known(&self) -> Option<bool> {
        match self {
            Self::Yes => Some(true),
            Self::No(_) => Some(false),
            Self::Unknown => None,
        }
    }
}

/// That one number is larger than another, with as many decimals as show it, and one at least.
fn exceeds(number: f64, limit: f64, unit: &str) -> String {
    let written = |decimals: usize| [number, limit].map(|number| format!("{number:.decimals$}"));
    let differs = (1..6).map(written).find(|[number, limit]| number != limit);
    let [number, limit] = differs.unwrap_or_else(|| written(6));
    format!("{number} {unit} > {limit} {unit}")
}

/// Whether the targets were met that there were.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TargetsMet {
    pub error: Option<TargetMet>,
    pub time: Option<TargetMet>,
}

impl TargetsMet {
    fn named(&self) -> impl Iterator<Item = (&'static str, &TargetMet)> {
        [("error", &self.error), ("time", &self.time)].into_iter().filter_map(|(name, met)| Some((name, met.as_ref()?)))
    }

    /// What was kept, and then what was not: `time target met; target missed: 2.4 % > 2.0 %`.
    pub fn in_words(&self) -> String {
        let named = |wanted: &TargetMet| -> Vec<&str> {
            self.named().filter(|(_, met)| *met == wanted).map(|(name, _)| name).collect()
        };
        let met = match named(&TargetMet::Yes)[..] {
            [] => None,
            [name] => Some(format!("{name} target met")),
            ref names => Some(format!("{} targets met", names.join(" and "))),
        };
        let missed = self.named().filter_map(|(_, met)| match met {
            TargetMet::No(numbers) => Some(format!("target missed: {numbers}")),
            _ => None,
        });
        let unknown = named(&TargetMet::Unknown);
        let unknown = unknown
            .into_iter()
            .map(|name| format!("the reference is too noisy to tell whether the {name} target was met"));
        met.into_iter().chain(missed).chain(unknown).collect::<Vec<String>>().join("; ")
    }

    /// For each target whether it was met; `null` where that is not known.
    pub fn json(&self) -> Value {
        Value::Object(self.named().map(|(name, met)| (name.to_owned(), json!(met.known()))).collect())
    }
}

impl QualityReport {
    /// What was asked for, and what was expected of the rest; empty where nothing was asked for.
    pub fn promised(&self) -> String {
        let foreseen = |error| format!("an error of {} foreseen", percent(error));
        let is_told = |foreseen: &f64| self.error_wanted.is_none_or(|wanted| *foreseen > wanted);
        let wanted = [
            self.error_wanted.map(|error| format!("an error of {}", percent(error))),
            self.time_allowed.map(|time| format!("{:.2} s in all", time.as_secs_f64())),
            self.time_allowed.and(self.error_foreseen).filter(is_told).map(foreseen),
        ];
        wanted.into_iter().flatten().collect::<Vec<String>>().join(", ")
    }

    pub fn achieved(&self) -> String {
        let of = if self.error.below().is_some() { "" } else { "of " };
        format!("an error {of}{} in {:.3} s of the solver", self.error.in_words(), self.seconds)
    }

    /// As names and values.
    pub fn facts(&self) -> Vec<(String, String)> {
        let promised = Some(self.promised()).filter(|promised| !promised.is_empty());
        let facts = [
            ("Promised", promised),
            ("Achieved", Some(self.achieved())),
            ("Kept", self.targets.as_ref().map(TargetsMet::in_words)),
            ("Chosen", self.options.clone()),
        ];
        facts.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value?))).collect()
    }
}

/// An error as it is written in JSON: `error` is `null` where it cannot be told from none, and `error_below_percent` is what it
/// is surely below then.
pub fn error_json(error: &Error) -> [(&'static str, Value); 3] {
    let below = error.below();
    [
        ("error", json!(below.is_none().then_some(error.rms))),
        ("error_uncertainty", json!(error.uncertainty)),
        ("error_below_percent", json!(below.map(|limit| 100.0 * limit))),
    ]
}

/// A share as percent. As many decimals as it takes not to write 0 for what is not.
pub fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent != 0.0 && percent.abs() < 0.005 { format!("{percent:.1e} %") } else { format!("{percent:.2} %") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(rms: f64, uncertainty: f64, upper: f64) -> Error {
        Error { rms, uncertainty, upper, ..Error::default() }
    }

    #[test]
    fn an_error_target_is_met_where_that_is_known() {
        let met = |found| TargetMet::of_error(0.02, &found);
        assert_eq!(met(error(0.015, 0.002, 0.018)), TargetMet::Yes);
        assert_eq!(met(error(0.024, 0.002, 0.027)), TargetMet::No("2.4 % > 2.0 %".to_owned()));
        assert_eq!(met(error(0.02004, 0.002, 0.023)), TargetMet::No("2.004 % > 2.000 %".to_owned()));
        // Known to half of what is wanted at best.
        assert_eq!(met(error(0.018, 0.0105, 0.03)), TargetMet::Unknown);
        // Nothing is seen of it behind the noise, which would hide more, or less, than is wanted.
        assert_eq!(met(error(0.0, 0.071, 0.091)), TargetMet::Unknown);
        assert_eq!(met(error(0.0, 0.012, 0.0154)), TargetMet::Yes);
    }

    #[test]
    fn what_was_kept_is_named_and_what_was_missed_has_its_numbers() {
        let missed = TargetMet::of_error(0.02, &error(0.024, 0.001, 0.026));
        let [in_time, late] = [10.4, 11.24].map(|seconds| TargetMet::of_time(Duration::from_secs(10), seconds));
        let words = |error: Option<&TargetMet>, time: Option<&TargetMet>| {
            let met = TargetsMet { error: error.cloned(), time: time.cloned() };
            (met.in_words(), met.json().to_string())
        };
        let expected = |words: &str, json: &str| (words.to_owned(), json.to_owned());
        let yes = Some(&TargetMet::Yes);
        assert_eq!(words(yes, None), expected("error target met", r#"{"error":true}"#));
        assert_eq!(words(yes, Some(&in_time)), expected("error and time targets met", r#"{"error":true,"time":true}"#));
        let both = expected("time target met; target missed: 2.4 % > 2.0 %", r#"{"error":false,"time":true}"#);
        assert_eq!(words(Some(&missed), Some(&in_time)), both);
        assert_eq!(words(None, Some(&late)), expected("target missed: 11.2 s > 10.0 s", r#"{"time":false}"#));
        let unknown = "the reference is too noisy to tell whether the error target was met";
        assert_eq!(words(Some(&TargetMet::Unknown), None), expected(unknown, r#"{"error":null}"#));
    }

    #[test]
    fn an_error_that_is_not_seen_is_written_as_a_limit_everywhere() {
        let unseen = error(0.0, 0.071, 0.0911);
        let report = QualityReport {
            error_wanted: None,
            error_foreseen: Some(0.03),
            time_allowed: Some(Duration::from_secs(3)),
            error: unseen,
            seconds: 2.0,
            targets: Some(TargetsMet { time: Some(TargetMet::Yes), error: None }),
            options: None,
        };
        let achieved = "an error below 9.11 % (95 % confidence) in 2.000 s of the solver";
        let facts = [
            ("Promised", "3.00 s in all, an error of 3.00 % foreseen"),
            ("Achieved", achieved),
            ("Kept", "time target met"),
        ];
        assert_eq!(report.facts(), facts.map(|(name, value)| (name.to_owned(), value.to_owned())));
        let [error, _, (_, below)] = error_json(&unseen);
        assert_eq!(error, ("error", Value::Null));
        assert!((below.as_f64().expect("a number") - 9.11).abs() < 1e-9);
        assert_eq!(
            (percent(1e-11), percent(0.0), percent(0.016)),
            ("1.0e-9 %".into(), "0.00 %".into(), "1.60 %".into())
        );
    }
}
