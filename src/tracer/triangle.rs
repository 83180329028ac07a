//! The watertight ray-triangle test (Woop, Benthin, Wald 2013).

use super::BOX_PADDING;
use glam::{Vec3A, Vec3Swizzles};
use obvhs::Boundable;
use obvhs::aabb::Aabb;

/// Three corners in frame coordinates: all their x, all their y and all their z, so that one instruction works on all three.
#[derive(Clone, Copy, Debug)]
pub struct Triangle([Vec3A; 3]);

/// A triangle with the padding that its box needs.
pub struct PaddedTriangle {
    pub triangle: Triangle,
    /// Frame units.
    pub padding: f32,
}

/// Where the line of a ray meets a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// Along the ray, negative behind its origin, in frame units.
    pub distance: f32,
    /// Barycentric coordinates, times their sum.
    weights: Vec3A,
}

impl Triangle {
    pub fn new(corners: [[f32; 3]; 3]) -> Self {
        let [a, b, c] = corners;
        Self([0, 1, 2].map(|axis| Vec3A::new(a[axis], b[axis], c[axis])))
    }

    fn corner(&self, i: usize) -> Vec3A {
        let [x, y, z] = self.0;
        Vec3A::new(x[i], y[i], z[i])
    }

    /// Normal by winding, not of unit length.
    pub fn normal(&self) -> Vec3A {
        (self.corner(1) - self.corner(0)).cross(self.corner(2) - self.corner(0))
    }

    /// The point of a crossing.
    pub fn point(&self, crossing: &Crossing) -> Vec3A {
        let weights = crossing.weights / crossing.weights.element_sum();
        Vec3A::from_array(self.0.map(|axis| axis.dot(weights)))
    }

    /// The distance of a crossing from the nearest edge, at least.
    pub fn distance_to_edges(&self, crossing: &Crossing) -> f32 {
        let [a, b, c] = [0, 1, 2].map(|i| self.corner(i));
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt();
        let share = (crossing.weights / crossing.weights.element_sum()).min_element();
        share * self.normal().length() / longest
    }

    /// The centre of gravity.
    pub fn center(&self) -> Vec3A {
        Vec3A::from_array(self.0.map(|axis| axis.element_sum() / 3.0))
    }
}

impl Boundable for PaddedTriangle {
    fn aabb(&self) -> Aabb {
        let padding = Vec3A::splat(self.padding.max(BOX_PADDING));
        let [low, high] = [Vec3A::min_element, Vec3A::max_element].map(|of| Vec3A::from_array(self.triangle.0.map(of)));
        Aabb { min: low - padding, max: high + padding }
    }
}

/// The shear that turns a ray into the z axis, computed once for all its triangles.
pub struct Shear {
    origin: Vec3A,
    /// Axes x, y, z of the sheared space; z is the one along which the ray moves most.
    axes: [usize; 3],
    /// Shear along x and y, and the scale of z.
    factors: [f32; 3],
}

impl Shear {
    pub fn new(origin: Vec3A, direction: Vec3A) -> Self {
        let z = direction.abs().max_position();
        let direction = direction.to_array();
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let scale = 1.0 / direction[z];
        Self { origin, axes, factors: [direction[axes[0]] * scale, direction[axes[1]] * scale, scale] }
    }

    /// Where the line of the ray meets the triangle, before or behind its origin. In the sheared plane a triangle is hit where
    /// its three edge functions agree in sign. Both triangles at an edge compute the same value for it, and a rounded
    /// difference of two products has the right sign or is 0; since 0 agrees with either sign, there is no gap, and the
    /// original's second try in double precision, which decides which of the two triangles is hit, is not needed.
    #[inline(always)]
    pub fn intersect(&self, triangle: &Triangle) -> Option<Crossing> {
        // The corners in the space where the ray starts at the origin and runs along z.
        let [x, y, z] = self.axes;
        let depth = triangle.0[z] - Vec3A::splat(self.origin[z]);
        let across = triangle.0[x] - Vec3A::splat(self.origin[x]) - self.factors[0] * depth;
        let along = triangle.0[y] - Vec3A::splat(self.origin[y]) - self.factors[1] * depth;
        // Of the edges from the second corner to the third, from the third to the first, from the first to the second.
        let edges = across.zxy() * along.yzx() - along.zxy() * across.yzx();
        let any_negative = edges.cmplt(Vec3A::ZERO).any();
        let any_positive = edges.cmpgt(Vec3A::ZERO).any();
        let determinant = edges.element_sum();
        if (any_negative && any_positive) || determinant == 0.0 {
            return None;
        }
        Some(Crossing { distance: self.factors[2] * edges.dot(depth) / determinant, weights: edges })
    }
}
