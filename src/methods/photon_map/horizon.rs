//! How far the surface goes on round a point before it ends, as seen in its plane.
//!
//! Photons land only on surface. Where a part of the disc of an estimate is none, the estimate would be too dark: at a
//! straight edge by half, in a corner by three quarters. So the weights of photons are divided by the part of the kernel
//! that is over surface, and photons to which the straight way leads over an edge do not count: both look at the same
//! star-shaped part of the disc.

use super::border::Segment;
use super::kernel;
use crate::math::warp::frame;
use crate::methods::Kernel;
use glam::{Mat3A, Vec2, Vec3A};
use std::f32::consts::TAU;

/// Directions in which the surface is looked along. An edge or a corner of a right angle takes as many of them as it should,
/// whichever way it is turned.
const DIRECTIONS: usize = 64;

/// Edges round a point, projected onto its plane, the point at the origin.
#[derive(Clone, Debug, Default)]
pub struct Horizon {
    lines: Vec<Line>,
    to_plane: Mat3A,
    point: Vec3A,
}

/// A part of an edge.
#[derive(Clone, Copy, Debug)]
struct Line {
    ends: [Vec2; 2],
    /// On which side of the line the origin is, and how far times the line's length, m².
    origin: f32,
}

impl Horizon {
    /// Begins at a point of a surface with this unit normal.
    pub fn begin(&mut self, point: Vec3A, normal: Vec3A) {
        self.lines.clear();
        self.to_plane = frame(normal).transpose();
        self.point = point;
    }

    /// Takes an edge in, unless it is farther than `radius`, m.
    pub fn add(&mut self, segment: &Segment, radius: f32) {
        let ends = segment.ends.map(|end| self.to_plane * (end - self.point));
        let [from, to] = ends.map(|end| Vec2::new(end.x, end.y));
        let along = to - from;
        let share = (-from.dot(along) / along.length_squared()).clamp(0.0, 1.0);
        if (from + share * along).length_squared() < radius * radius {
            self.lines.push(Line { ends: [from, to], origin: from.perp_dot(to) });
        }
    }

    /// Whether the surface ends nowhere near.
    pub fn is_open(&self) -> bool {
        self.lines.is_empty()
    }

    /// Whether the straight way to a position leads over no edge.
    pub fn sees(&self, position: Vec3A) -> bool {
        let there = self.to_plane * (position - self.point);
        let there = Vec2::new(there.x, there.y);
        !self.lines.iter().any(|line| line.is_crossed_on_the_way_to(there))
    }

    /// Share of the kernel of a disc that is over surface, in (0, 1].
    pub fn inside(&self, kernel: Kernel, radius: f32) -> f32 {
        if self.is_open() {
            return 1.0;
        }
        let share = |index: usize| {
            let direction = Vec2::from_angle(TAU * (index as f32 + 0.5) / DIRECTIONS as f32);
            let reach = self.lines.iter().map(|line| line.distance_along(direction)).fold(radius, f32::min);
            kernel::share_within(kernel, reach / radius)
        };
        let sum: f32 = (0..DIRECTIONS).map(share).sum();
        // Somewhere the surface goes on: the point is on it.
        (sum / DIRECTIONS as f32).max(0.5 / DIRECTIONS as f32)
    }
}

impl Line {
    fn is_crossed_on_the_way_to(&self, there: Vec2) -> bool {
        let [from, to] = self.ends;
        let side = (to - from).perp_dot(there - from);
        // The line is between the two points, and the way to the second leads through between its ends.
        side * self.origin < 0.0 && there.perp_dot(from) * there.perp_dot(to) <= 0.0
    }

    /// Distance in a unit direction, m, infinite where the line is not met.
    fn distance_along(&self, direction: Vec2) -> f32 {
        let [from, to] = self.ends;
        let along = to - from;
        let across = direction.perp_dot(along);
        let distance = self.origin / across;
        let is_met = direction.perp_dot(from) * direction.perp_dot(to) <= 0.0 && distance >= 0.0;
        if is_met { distance } else { f32::INFINITY }
    }
}
