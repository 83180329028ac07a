//! A triangle or quad to pick points of.

use crate::math::warp::triangle;
use glam::{Vec2, Vec3A};

/// Points keep this share of the region's width from its edges: more than the rounding of corners of a patch as small as
/// a hundredth of the scene's coordinates, far less than anything that is measured.
const INSET: f32 = 1.0 / 16384.0;

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

    /// The point for coordinates in [0, 1)², kept off the edges, where a lifted point may lie in the plane of the next
    /// surface: uniform by area over a triangle or parallelogram. Cells of a quad's grid are
    /// near enough to parallelograms; of a whole quad that is none, every part comes up, some more often.
    #[inline]
    pub fn point(&self, at: Vec2) -> Vec3A {
        let [a, b, c, d] = self.corners;
        let at = INSET + (1.0 - 2.0 * INSET) * at;
        if self.is_quad {
            a.lerp(b, at.x).lerp(d.lerp(c, at.x), at.y)
        } else {
            let weights = triangle(at);
            a + weights.x * (b - a) + weights.y * (c - a)
        }
    }

    pub fn corners(&self) -> &[Vec3A] {
        if self.is_quad { &self.corners } else { &self.corners[..3] }
    }

    /// The same region elsewhere.
    pub fn shifted(&self, by: Vec3A) -> Self {
        Self { corners: [0, 1, 2, 3].map(|i| self.corners[i] + by), ..*self }
    }
}
