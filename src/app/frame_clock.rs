//! How long the window's own work takes.

use super::model::FrameTime;
use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Times of the frames of the last second.
#[derive(Default)]
pub struct FrameClock {
    frames: VecDeque<(Instant, Duration)>,
}

impl FrameClock {
    const WINDOW: Duration = Duration::from_secs(1);

    /// Notes a frame whose work began at `start` and ends now.
    pub fn end_frame(&mut self, start: Instant) {
        let now = Instant::now();
        self.frames.push_back((now, now - start));
        while self.frames.front().is_some_and(|(ended, _)| now - *ended > Self::WINDOW) {
            self.frames.pop_front();
        }
    }

    pub fn frame_time(&self) -> FrameTime {
        let times = self.frames.iter().map(|(_, time)| *time);
        let count = self.frames.len().max(1) as u32;
        FrameTime { mean: times.clone().sum::<Duration>() / count, worst: times.max().unwrap_or_default() }
    }
}
