//! Which of two surfaces comes first along a ray where they touch or nearly touch: decided in double precision.
//!
//! Single precision knows a point to some units in the last place of the scene's coordinates. A ray that leaves a surface
//! must meet one that lies closer than that, and must not meet one that lies behind. Both are decided by the planes of the
//! triangles, whose corners are exact in double precision.
//!
//! Where two polygons coincide, so that rounding of their corners decides which one is in front at which place, they have one
//! order all over: as if each were moved back from its front by an infinitesimal distance. Glass that stands on a floor has
//! an infinitesimal gap below it, as in the limit of a small gap. The two sides of a panel, polygons with the same corners
//! back to back, are moved towards their fronts instead, so that both are seen. Of polygons that face alike the one that
//! comes later lies on top: a rug on a floor.

use glam::{DVec3, Vec3};

/// Heights of less than this share of the slack are rounding of double precision: 2e-12 of the scene's coordinates.
const ROUNDING: f64 = 1.0 / (1 << 20) as f64;
/// Polygons that are nearer to each other than this share of the slack may coincide: 4 units in the last place.
const NEAR: f64 = 0.25;

/// A triangle of a polygon, in double precision, m.
#[derive(Clone, Copy)]
pub struct Facet {
    corners: [DVec3; 3],
    /// Unit normal by winding; zero where it has none.
    normal: DVec3,
    polygon: u32,
}

/// How exact single precision is, and which polygons are sides of one panel.
pub struct Contact<T> {
    /// Half-width of the zone in which single precision decides nothing, m.
    pub slack: f64,
    /// Whether two polygons have the same corners.
    pub are_twins: T,
}

impl Facet {
    pub fn new(corners: &[Vec3; 3], polygon: u32) -> Self {
        let corners = corners.map(|corner| corner.as_dvec3());
        let [a, b, c] = corners;
        Self { corners, normal: (b - a).cross(c - a).normalize_or_zero(), polygon }
    }

    /// Distance of a point before the front, m; negative behind.
    fn height(&self, point: DVec3) -> f64 {
        (point - self.corners[0]).dot(self.normal)
    }

    /// The nearest point of the plane.
    pub fn project(&self, point: DVec3) -> DVec3 {
        point - self.height(point) * self.normal
    }

    /// Whether a point of the plane is in the triangle, or outside by at most `margin`, m.
    pub fn contains(&self, point: DVec3, margin: f64) -> bool {
        let [a, b, c] = self.corners;
        [(a, b), (b, c), (c, a)].into_iter().all(|(from, to)| {
            let edge = to - from;
            self.normal.cross(edge).dot(point - from) >= -margin * edge.length()
        })
    }

    /// Whether the two share an edge.
    fn adjoins(&self, other: &Self) -> bool {
        self.corners.iter().filter(|corner| other.corners.contains(corner)).count() >= 2
    }

    fn longest_edge_squared(&self) -> f64 {
        let [a, b, c] = self.corners;
        a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
    }
}

impl<T: Fn(u32, u32) -> bool> Contact<T> {
    /// How far a ray goes in this unit direction, from a point in the plane of one facet, until it meets the other, m; `None`
    /// if it does not.
    pub fn distance(&self, from: &Facet, point: DVec3, to: &Facet, direction: DVec3) -> Option<f64> {
        if to.normal == DVec3::ZERO {
            // A line, which nothing meets.
            return None;
        }
        // Single precision found the crossing, and may have taken one of two triangles that share an edge for the other.
        let margin = if from.adjoins(to) { 0.0 } else { self.slack };
        if self.coincide(from, to) && to.contains(to.project(point), margin) {
            return self.is_ranked_before(from, to, direction).then_some(0.0);
        }
        let distance = -to.height(point) / to.normal.dot(direction);
        (distance > 0.0 && to.contains(point + distance * direction, margin)).then_some(distance)
    }

    /// Whether a ray meets the first facet before the second, both of which it meets.
    pub fn is_before(&self, first: &Facet, second: &Facet, origin: DVec3, direction: DVec3) -> bool {
        if self.coincide(first, second) {
            return self.is_ranked_before(first, second, direction);
        }
        let distance = |facet: &Facet| -facet.height(origin) / facet.normal.dot(direction);
        distance(first) < distance(second)
    }

    /// Whether rounding decides which of the two is in front: they are in one plane but for rounding, and the smaller one is
    /// not wholly on one side of the other.
    fn coincide(&self, one: &Facet, other: &Facet) -> bool {
        let (small, large) =
            if one.longest_edge_squared() < other.longest_edge_squared() { (one, other) } else { (other, one) };
        let heights = small.corners.map(|corner| large.height(corner));
        let rounding = ROUNDING * self.slack;
        heights.iter().all(|height| height.abs() <= NEAR * self.slack)
            && !heights.iter().all(|&height| height > rounding)
            && !heights.iter().all(|&height| height < -rounding)
    }

    /// The order of polygons that coincide.
    fn is_ranked_before(&self, first: &Facet, second: &Facet, direction: DVec3) -> bool {
        let is_panel = (self.are_twins)(first.polygon, second.polygon);
        // Higher is farther along the ray: fronts of panels, and backs of all others.
        let rank = |facet: &Facet| {
            let is_facing_along = facet.normal.dot(direction) > 0.0;
            let place = i64::from(facet.polygon);
            match (is_facing_along, is_panel) {
                (true, true) => (1, place),
                (false, true) => (0, -place),
                (true, false) => (0, place),
                (false, false) => (1, -place),
            }
        };
        rank(first) < rank(second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 1]];

    fn facet(polygon: u32, height: f32, faces_up: bool) -> Facet {
        let corners = [Vec3::new(0.0, height, 0.0), Vec3::new(0.0, height, 9.0), Vec3::new(9.0, height, 0.0)];
        Facet::new(&UP[usize::from(!faces_up)].map(|corner| corners[corner]), polygon)
    }

    fn contact(are_twins: impl Fn(u32, u32) -> bool) -> Contact<impl Fn(u32, u32) -> bool> {
        Contact { slack: 1e-3, are_twins }
    }

    #[test]
    fn both_sides_of_a_panel_are_seen() {
        let (up, down) = (facet(0, 1.0, true), facet(1, 1.0, false));
        let contact = contact(|_, _| true);
        let point = DVec3::ONE;
        assert_eq!(contact.distance(&up, point, &down, DVec3::Y), None);
        assert_eq!(contact.distance(&down, point, &up, -DVec3::Y), None);
        assert!(contact.is_before(&up, &down, point + DVec3::Y, -DVec3::Y));
        assert!(contact.is_before(&down, &up, point - DVec3::Y, DVec3::Y));
    }

    #[test]
    fn what_stands_on_a_floor_has_an_infinitesimal_gap_below_it() {
        let (floor, bottom) = (facet(0, 1.0, true), facet(1, 1.0, false));
        let contact = contact(|_, _| false);
        let point = DVec3::ONE;
        assert_eq!(contact.distance(&floor, point, &bottom, DVec3::Y), Some(0.0));
        assert_eq!(contact.distance(&bottom, point, &floor, -DVec3::Y), Some(0.0));
        assert_eq!(contact.distance(&bottom, point, &floor, DVec3::Y), None);
        assert!(contact.is_before(&bottom, &floor, point + DVec3::Y, -DVec3::Y));
        assert!(!contact.is_before(&floor, &bottom, point + DVec3::Y, -DVec3::Y));
        // A rug that comes later in the file is met first from above, and last from below.
        let rug = facet(2, 1.0, true);
        assert!(contact.is_before(&rug, &floor, point + DVec3::Y, -DVec3::Y));
        assert!(contact.is_before(&floor, &rug, point - DVec3::Y, DVec3::Y));
    }

    #[test]
    fn what_is_a_hair_before_a_surface_is_met_and_what_is_a_hair_behind_is_not() {
        let (floor, above) = (facet(0, 256.0, true), facet(1, 256.0_f32.next_up(), false));
        let contact = contact(|_, _| false);
        let point = floor.project(DVec3::new(1.0, 256.1, 1.0));
        let distance = contact.distance(&floor, point, &above, DVec3::Y);
        assert!(distance.is_some_and(|distance| (distance - 2.0_f64.powi(-15)).abs() < 1e-12), "{distance:?}");
        assert_eq!(contact.distance(&floor, point, &above, -DVec3::Y), None);
        let along = DVec3::new(1.0, 1e-6, 0.0).normalize();
        assert_eq!(contact.distance(&floor, point, &above, along), None, "beyond its edge");
    }
}
