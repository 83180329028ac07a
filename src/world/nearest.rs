//! How far the nearest surface is.

use super::{World, triangles};
use glam::{DVec3, Vec3, Vec3A};

impl World {
    /// Distance from a point to the nearest surface, m, on whichever side; infinite where there is none. Looks at all
    /// polygons.
    pub fn distance_to_surface(&self, point: Vec3A) -> f64 {
        let point = point.as_dvec3();
        let distance = |(_, corners): &(u32, [Vec3; 3])| {
            point.distance(nearest_on_triangle(point, corners.map(|corner| corner.as_dvec3())))
        };
        triangles(&self.scene).iter().map(distance).fold(f64::INFINITY, f64::min)
    }
}

/// The point of a triangle that is nearest to a point: above the triangle's face, or else on one of its edges.
fn nearest_on_triangle(point: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let edges = [(a, b), (b, c), (c, a)];
    if edges.iter().all(|&(from, to)| normal.cross(to - from).dot(point - from) >= 0.0) && normal != DVec3::ZERO {
        return point - normal * ((point - a).dot(normal) / normal.length_squared());
    }
    let on_edges = edges.map(|(from, to)| {
        let way = to - from;
        let along = (point - from).dot(way) / way.length_squared();
        // An edge without length has no share along it.
        from + if along > 0.0 { along.min(1.0) } else { 0.0 } * way
    });
    let nearer = |one: DVec3, other: DVec3| {
        if point.distance_squared(other) < point.distance_squared(one) { other } else { one }
    };
    nearer(nearer(on_edges[0], on_edges[1]), on_edges[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_is_on_the_face_an_edge_or_a_corner() {
        let triangle = [DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0), DVec3::new(0.0, 2.0, 0.0)];
        for (point, nearest) in [
            ([0.5, 0.5, 3.0], [0.5, 0.5, 0.0]),
            ([0.5, 0.5, -3.0], [0.5, 0.5, 0.0]),
            ([1.0, -2.0, 0.5], [1.0, 0.0, 0.0]),
            ([2.0, 2.0, 1.0], [1.0, 1.0, 0.0]),
            ([-1.0, -1.0, 0.0], [0.0, 0.0, 0.0]),
            ([5.0, -1.0, 1.0], [2.0, 0.0, 0.0]),
        ] {
            let found = nearest_on_triangle(DVec3::from_array(point), triangle);
            assert!(found.distance(DVec3::from_array(nearest)) < 1e-15, "{point:?}: {found}");
        }
    }
}
