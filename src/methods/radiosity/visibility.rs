//! How much of a shooting patch a receiving element sees, by shadow rays.

use crate::math::random::Stream;
use crate::math::warp::triangle;
use crate::mesh::{Element, Mesh, Patch};
use crate::tracer::Tracer;
use crate::world::is_covered;
use glam::{Vec2, Vec3A, Vec4};

/// 1/g, 1/g², 1/g³, 1/g⁴, where g solves g⁵ = g + 1: multiples of these fill [0, 1)⁴ evenly at every length (Roberts
/// 2018). Two coordinates are on the receiver, two on the shooter, so that the mean is over both areas and a shadow's
/// edge is not a staircase of elements.
const STEP: Vec4 = Vec4::new(0.856_674_9, 0.733_891_9, 0.628_706_7, 0.538_597_3);
/// Points tried for each ray on an element that is partly covered.
const TRIES: u32 = 16;

/// The receivers and the shooter that rays run between.
pub struct Sightline<'a> {
    pub mesh: &'a Mesh,
    pub tracer: &'a Tracer,
    pub shooter: &'a Patch,
    /// Rays for each receiver.
    pub rays: u32,
}

impl Sightline<'_> {
    /// Share of point pairs of element and shooter that see each other, among those that face each other, and the
    /// number of rays traced. `stream` shifts the pattern of points, so that neighbours do not err alike.
    pub fn visible_share(&self, element: &Element, normal: Vec3A, stream: &mut Stream) -> (f64, u32) {
        let (corners, count) = self.mesh.element_corners(element);
        let receiver = (corners.map(Vec3A::from), count);
        let shooter = corners_of(self.shooter);
        let (low, high) = (stream.uniform2(), stream.uniform2());
        let mut at = Vec4::new(low.x, low.y, high.x, high.y);
        let tries = if element.exposed < 1.0 { TRIES * self.rays } else { self.rays };
        let (mut pairs, mut facing, mut visible) = (0, 0, 0);
        for _ in 0..tries {
            at = (at + STEP).fract();
            let from = self.tracer.lift(point(&receiver, Vec2::new(at.x, at.y)), normal);
            if element.exposed < 1.0 && is_covered(self.mesh, self.tracer, from, normal) {
                continue;
            }
            let to = self.tracer.lift(point(&shooter, Vec2::new(at.z, at.w)), self.shooter.normal);
            let way = to - from;
            if way.dot(normal) > 0.0 && way.dot(self.shooter.normal) < 0.0 {
                facing += 1;
                visible += u32::from(self.tracer.is_visible(from, to));
            }
            pairs += 1;
            if pairs == self.rays {
                break;
            }
        }
        let share = if facing > 0 { f64::from(visible) / f64::from(facing) } else { 0.0 };
        (share, facing)
    }
}

/// A point of a patch for coordinates in [0, 1)².
pub fn shooter_point(patch: &Patch, at: Vec2) -> Vec3A {
    point(&corners_of(patch), at)
}

fn corners_of(patch: &Patch) -> ([Vec3A; 4], usize) {
    let corners = patch.corners();
    (std::array::from_fn(|i| Vec3A::from(corners[i.min(corners.len() - 1)])), corners.len())
}

/// A point of a triangle or quad. Cells of a quad's grid are near enough to parallelograms for the bilinear map to be
/// even.
fn point(([a, b, c, d], count): &([Vec3A; 4], usize), at: Vec2) -> Vec3A {
    if *count == 3 {
        let weights = triangle(at);
        *a + weights.x * (*b - *a) + weights.y * (*c - *a)
    } else {
        a.lerp(*b, at.x).lerp(d.lerp(*c, at.x), at.y)
    }
}
