//! A triangle or quad to pick points of.

use crate::math::warp::triangle;
use glam::{Vec2, Vec3A};

/// Rays keep this share of the way to the middle from the edges: more than the rounding of corners of a patch as small as
/// a hundredth of the scene's coordinates, far less than anything that is measured.
const INSET: f32 = 1.0 / 8192.0;

/// Three or four corners of a planar convex polygon, in single precision.
#[derive(Clone, Copy, Debug)]
pub struct Region {
    corners: [Vec3A; 4],
    is_quad: bool,
}

impl Region {
    /// The first `count`, three or four, of four corners.
    pub fn new(corners: [Vec3A; 4], count: usize) -> Self {
        Self { corners, is_quad: count == 4 }
    }

    /// The point for coordinates in [0, 1]²: uniform by area over a triangle or parallelogram. Cells of a quad's grid are
    /// near enough to parallelograms; of a whole quad that is none, every part comes up, some more often.
    pub fn point(&self, at: Vec2) -> Vec3A {
        self.sampler_between(self.corners).point(at)
    }

    /// The points to start or end rays at. They keep off the edges, where a rounded point may lie beyond the next surface.
    pub fn sampler(&self) -> Sampler {
        let [a, b, c, d] = self.corners;
        // The middle of a quad, or a point well inside of a triangle, whose last corner stands here twice.
        let inside = 0.25 * (a + b + c + d);
        self.sampler_between([a, b, c, d].map(|corner| corner.lerp(inside, INSET)))
    }

    fn sampler_between(&self, [a, b, c, d]: [Vec3A; 4]) -> Sampler {
        if self.is_quad {
            Sampler { origin: a, along: b - a, across: d - a, twist: a - b + c - d, is_quad: true }
        } else {
            Sampler { origin: a, along: b - a, across: c - a, twist: Vec3A::ZERO, is_quad: false }
        }
    }

    pub fn corners(&self) -> &[Vec3A] {
        if self.is_quad { &self.corners } else { &self.corners[..3] }
    }
}

/// A region made ready for many points: the bilinear map of its corners.
#[derive(Clone, Copy, Debug)]
pub struct Sampler {
    origin: Vec3A,
    along: Vec3A,
    across: Vec3A,
    twist: Vec3A,
    is_quad: bool,
}

impl Sampler {
    /// See [`Region::point`].
    #[inline]
    pub fn point(&self, at: Vec2) -> Vec3A {
        let at = if self.is_quad { at } else { triangle(at) };
        self.origin + at.x * self.along + at.y * (self.across + at.x * self.twist)
    }
}
