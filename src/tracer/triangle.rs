//! The watertight ray-triangle test (Woop, Benthin, Wald 2013), with distances to planes: barycentric coordinates of a narrow
//! triangle are too rough for them in single precision.

use super::BOX_PADDING;
use glam::{Vec3, Vec3A, Vec3Swizzles, Vec4};
use obvhs::Boundable;
use obvhs::aabb::Aabb;

/// Three corners in frame coordinates, and what is asked of a triangle that a ray meets: one line of the cache.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Triangle {
    /// All x of the corners, all y and all z, so that one instruction works on all three.
    axes: [Vec3A; 3],
    /// Unit normal by winding, and the least of the three heights; zero for a triangle without area.
    normal_and_height: Vec4,
}

/// A triangle with the padding that its box needs.
pub struct PaddedTriangle {
    pub triangle: Triangle,
    /// Frame units.
    pub padding: f32,
}

/// How the line of a ray passes between the edges of a triangle.
pub struct Edges {
    /// Barycentric coordinates, times their sum.
    edges: Vec3A,
    /// Of the corners, along the axis in which the ray moves most.
    depth: Vec3A,
}

/// Where the line of a ray meets a triangle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Crossing {
    /// Along the ray, negative behind its origin, in frame units.
    pub distance: f32,
    /// Cosine of the ray's direction with the unit normal.
    pub slope: f32,
    /// Barycentric coordinates, times their sum.
    edges: Vec3A,
}

impl Triangle {
    /// Of corners in world space. Its plane is found in double precision: of a narrow triangle, rounding would turn it.
    pub fn new(corners: &[Vec3; 3], to_frame: impl Fn(Vec3A) -> Vec3A, frame_from_world: f32) -> Self {
        let [a, b, c] = corners.map(|corner| corner.as_dvec3());
        let normal = (b - a).cross(c - a);
        let twice_area = normal.length();
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt();
        let normal_and_height = if twice_area > 0.0 {
            (normal / twice_area).as_vec3().extend((twice_area / longest) as f32 * frame_from_world)
        } else {
            Vec4::ZERO
        };
        let [a, b, c] = corners.map(|corner| to_frame(corner.into()));
        Self { axes: [0, 1, 2].map(|axis| Vec3A::new(a[axis], b[axis], c[axis])), normal_and_height }
    }

    fn normal(&self) -> Vec3A {
        Vec3A::from_vec4(self.normal_and_height)
    }

    /// Cosine of a unit direction with the unit normal.
    pub fn slope(&self, direction: Vec3A) -> f32 {
        self.normal().dot(direction)
    }

    /// The point of a crossing.
    pub fn point(&self, crossing: &Crossing) -> Vec3A {
        let weights = crossing.weights();
        Vec3A::from_array(self.axes.map(|axis| axis.dot(weights)))
    }

    /// The distance of a crossing from the nearest edge, at least.
    pub fn distance_to_edges(&self, crossing: &Crossing) -> f32 {
        crossing.weights().min_element() * self.normal_and_height.w
    }

    /// The centre of gravity.
    pub fn center(&self) -> Vec3A {
        Vec3A::from_array(self.axes.map(|axis| axis.element_sum() / 3.0))
    }
}

impl Crossing {
    fn weights(&self) -> Vec3A {
        self.edges / self.edges.element_sum()
    }
}

impl Boundable for PaddedTriangle {
    fn aabb(&self) -> Aabb {
        let padding = Vec3A::splat(self.padding.max(BOX_PADDING));
        let [low, high] =
            [Vec3A::min_element, Vec3A::max_element].map(|of| Vec3A::from_array(self.triangle.axes.map(of)));
        Aabb { min: low - padding, max: high + padding }
    }
}

/// The shear that turns a ray into the z axis, computed once for all its triangles.
pub struct Shear {
    origin: Vec3A,
    direction: Vec3A,
    /// Axes x, y, z of the sheared space; z is the one along which the ray moves most.
    axes: [usize; 3],
    /// Shear along x and y, and the scale of z.
    factors: [f32; 3],
}

impl Shear {
    pub fn new(origin: Vec3A, direction: Vec3A) -> Self {
        let z = direction.abs().max_position();
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let scale = 1.0 / direction[z];
        Self { origin, direction, axes, factors: [direction[axes[0]] * scale, direction[axes[1]] * scale, scale] }
    }

    /// Whether the line of the ray meets the triangle, before or behind its origin. In the sheared plane a triangle is hit where
    /// its three edge functions agree in sign. Both triangles at an edge compute the same value for it, and a rounded
    /// difference of two products has the right sign or is 0; since 0 agrees with either sign, there is no gap, and the
    /// original's second try in double precision, which decides which of the two triangles is hit, is not needed.
    #[inline(always)]
    pub fn intersect(&self, triangle: &Triangle) -> Option<Edges> {
        // The corners in the space where the ray starts at the origin and runs along z.
        let [x, y, z] = self.axes;
        let depth = triangle.axes[z] - Vec3A::splat(self.origin[z]);
        let across = triangle.axes[x] - Vec3A::splat(self.origin[x]) - self.factors[0] * depth;
        let along = triangle.axes[y] - Vec3A::splat(self.origin[y]) - self.factors[1] * depth;
        // Of the edges from the second corner to the third, from the third to the first, from the first to the second.
        let edges = across.zxy() * along.yzx() - along.zxy() * across.yzx();
        let any_negative = edges.cmplt(Vec3A::ZERO).any();
        let any_positive = edges.cmpgt(Vec3A::ZERO).any();
        if (any_negative && any_positive) || edges.element_sum() == 0.0 {
            return None;
        }
        Some(Edges { edges, depth })
    }

    /// Where a line that passes between the edges of a triangle meets its plane.
    #[inline(always)]
    pub fn crossing(&self, triangle: &Triangle, Edges { edges, depth }: Edges) -> Crossing {
        let slope = triangle.slope(self.direction);
        let corner = Vec3A::from_array(triangle.axes.map(|axis| axis.x));
        let distance = (corner - self.origin).dot(triangle.normal()) / slope;
        // Between the first corner and the last, also where the ray is in the plane but for rounding.
        let corners = self.factors[2] * depth;
        Crossing { distance: distance.max(corners.min_element()).min(corners.max_element()), slope, edges }
    }
}
