//! How far off each run on a scene was after how much time, kept for comparison.

use super::LightKind;
use crate::accuracy::{Error, Found, Truth};
use crate::methods::Settings;
use std::sync::Arc;

/// A run is measured again when it has taken so many times as long.
const PACE: f64 = 1.15;

/// A run and how far off it was.
#[derive(Clone, Debug)]
pub struct Track {
    /// Counts the measured runs on this scene, from 1.
    pub number: u32,
    pub kind: LightKind,
    pub settings: Settings,
    /// In the order of time.
    pub points: Vec<TrackPoint>,
}

/// How far off a run was at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackPoint {
    pub seconds: f64,
    pub error: Error,
}

/// The tracks of all runs on one scene, in the order in which they began.
#[derive(Default)]
pub struct Tracks {
    entries: Vec<Entry>,
    begun: u32,
}

/// A track and what it was measured from: when the truth gets better known, so does every error of before.
struct Entry {
    track: Arc<Track>,
    found: Vec<(f64, Found)>,
}

impl Tracks {
    /// All that were measured; each is immutable and shared.
    pub fn measured(&self) -> Vec<Arc<Track>> {
        self.entries.iter().filter(|entry| !entry.track.points.is_empty()).map(|entry| entry.track.clone()).collect()
    }

    /// Begins the track of a new run. One that was never measured leaves none.
    pub fn begin(&mut self, kind: LightKind, settings: &Settings) {
        self.entries.retain(|entry| entry.track.kind != kind || !entry.found.is_empty());
        self.begun += 1;
        let track = Track { number: self.begun, kind, settings: *settings, points: Vec::new() };
        self.entries.push(Entry { track: Arc::new(track), found: Vec::new() });
    }

    /// Whether the run of this kind should be measured now, on the way or at rest.
    pub fn is_due(&self, kind: LightKind, seconds: f64, is_resting: bool) -> bool {
        let Some(entry) = self.entries.iter().rfind(|entry| entry.track.kind == kind) else { return false };
        let last = entry.found.last().map_or(0.0, |(last, _)| *last);
        seconds > last && (is_resting || seconds >= PACE * last)
    }

    /// Takes in what the run of this kind found.
    pub fn record(&mut self, kind: LightKind, seconds: f64, found: Found, truth: &Truth) {
        let Some(entry) = self.entries.iter_mut().rfind(|entry| entry.track.kind == kind) else { return };
        entry.found.push((seconds, found));
        entry.judge(truth);
    }

    /// Holds everything against a truth that is better known.
    pub fn judge(&mut self, truth: &Truth) {
        for entry in &mut self.entries {
            entry.judge(truth);
        }
    }

    /// The smallest error of the latest of each run.
    pub fn smallest(&self) -> Option<Error> {
        let latest = self.entries.iter().filter_map(|entry| entry.track.points.last());
        latest.map(|point| point.error).min_by(|a, b| a.rms.total_cmp(&b.rms))
    }
}

impl Entry {
    fn judge(&mut self, truth: &Truth) {
        let point =
            |(seconds, found): &(f64, Found)| Some(TrackPoint { seconds: *seconds, error: truth.error(found)? });
        Arc::make_mut(&mut self.track).points = self.found.iter().filter_map(point).collect();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rgb::Rgb;
    use crate::math::stats::Moments;

    /// E = 1 in all channels of `points` points.
    fn truth(points: usize) -> Truth {
        let mut one = Moments::default();
        one.add(1.0);
        Truth { paths: 1, irradiance: vec![[one; 3]; points], mean: 1.0, floor: 0.0 }
    }

    fn found(value: f32, points: usize) -> Found {
        Found { irradiance: vec![Rgb::splat(value); points], variance: None }
    }

    #[test]
    fn runs_are_measured_by_the_logarithm_of_time_and_once_more_at_their_end() {
        let mut tracks = Tracks::default();
        assert!(!tracks.is_due(LightKind::Radiosity, 1.0, true));
        tracks.begin(LightKind::Radiosity, &Settings::default());
        assert!(!tracks.is_due(LightKind::Radiosity, 0.0, true));
        assert!(tracks.is_due(LightKind::Radiosity, 0.1, false));
        tracks.record(LightKind::Radiosity, 1.0, found(0.5, 4), &truth(4));
        assert!(!tracks.is_due(LightKind::Radiosity, 1.1, false) && tracks.is_due(LightKind::Radiosity, 1.2, false));
        assert!(tracks.is_due(LightKind::Radiosity, 1.1, true) && !tracks.is_due(LightKind::Radiosity, 1.0, true));
        assert!(!tracks.is_due(LightKind::Photons, 5.0, true));
    }

    #[test]
    fn a_better_truth_corrects_all_errors_and_the_smallest_is_told() {
        let mut tracks = Tracks::default();
        tracks.begin(LightKind::Radiosity, &Settings::default());
        tracks.record(LightKind::Radiosity, 1.0, found(0.5, 4), &truth(4));
        tracks.begin(LightKind::Photons, &Settings::default());
        tracks.record(LightKind::Photons, 1.0, found(0.9, 4), &truth(4));
        let smallest = tracks.smallest().expect("two are measured");
        assert!((smallest.rms - 0.1).abs() < 1e-6);
        // Twice as much light as was thought.
        let mut two = Moments::default();
        two.add(2.0);
        tracks.judge(&Truth { irradiance: vec![[two; 3]; 4], mean: 2.0, ..truth(4) });
        let errors: Vec<f64> = tracks.measured().iter().map(|track| track.points[0].error.rms).collect();
        assert!((errors[0] - 0.75).abs() < 1e-6 && (errors[1] - 0.55).abs() < 1e-6, "{errors:?}");
    }

    #[test]
    fn a_run_that_was_never_measured_leaves_no_track() {
        let mut tracks = Tracks::default();
        tracks.begin(LightKind::Radiosity, &Settings::default());
        tracks.begin(LightKind::Radiosity, &Settings::default());
        tracks.record(LightKind::Radiosity, 1.0, found(0.5, 4), &truth(4));
        tracks.begin(LightKind::Radiosity, &Settings::default());
        assert_eq!(tracks.entries.len(), 2);
        assert_eq!(tracks.measured().len(), 1);
    }
}
