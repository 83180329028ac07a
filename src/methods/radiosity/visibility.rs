//! How much of a shooting patch a receiving element sees, by shadow rays.

use crate::math::random::Stream;
use crate::math::warp::triangle;
use crate::mesh::{Element, Mesh, Patch};
use crate::tracer::Tracer;
use glam::{Vec2, Vec3A, Vec4};

/// Points of [0, 1)⁴ that are evenly spread at every length (Roberts 2018): two coordinates on the receiver, two on
/// the shooter, so that the mean is over both areas and a shadow's edge is not a staircase of elements.
pub struct Samples(Vec<Vec4>);

impl Samples {
    pub fn new(count: u32) -> Self {
        // 1/g, 1/g², 1/g³, 1/g⁴, where g solves g⁵ = g + 1.
        const STEP: [f64; 4] =
            [0.856_674_883_854_502_9, 0.733_891_856_627_126, 0.628_706_721_037_811_6, 0.538_597_257_220_299];
        let coordinate = |i: u32, step: f64| (0.5 + step * f64::from(i)).fract() as f32;
        Self((0..count).map(|i| Vec4::from_array(STEP.map(|step| coordinate(i, step)))).collect())
    }
}

/// The receiver and the shooter that rays run between.
pub struct Sightline<'a> {
    pub mesh: &'a Mesh,
    pub tracer: &'a Tracer,
    pub shooter: &'a Patch,
    pub samples: &'a Samples,
}

impl Sightline<'_> {
    /// Share of point pairs of element and shooter that see each other, among those that face each other, and the
    /// number of rays traced. `stream` shifts the pattern of points, so that neighbours do not err alike.
    pub fn visible_share(&self, element: &Element, normal: Vec3A, stream: &mut Stream) -> (f64, u32) {
        let receiver = self.mesh.element_corners(element);
        let receiver = (receiver.0.map(Vec3A::from), receiver.1);
        let shooter = corners_of(self.shooter);
        let (low, high) = (stream.uniform2(), stream.uniform2());
        let shift = Vec4::new(low.x, low.y, high.x, high.y);
        let (mut rays, mut visible) = (0, 0);
        for sample in &self.samples.0 {
            let sum = *sample + shift;
            let at = sum - sum.floor();
            let from = self.tracer.lift(point(&receiver, Vec2::new(at.x, at.y)), normal);
            let to = self.tracer.lift(point(&shooter, Vec2::new(at.z, at.w)), self.shooter.normal);
            let way = to - from;
            if way.dot(normal) > 0.0 && way.dot(self.shooter.normal) < 0.0 {
                rays += 1;
                visible += u32::from(self.tracer.is_visible(from, to));
            }
        }
        let share = if rays > 0 { f64::from(visible) / f64::from(rays) } else { 0.0 };
        (share, rays)
    }
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
