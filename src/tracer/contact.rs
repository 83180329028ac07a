//! Which of two surfaces comes first along a ray where they touch or nearly touch: decided in double precision.
//!
//! Single precision knows a point to some units in the last place of the scene's coordinates. A ray that leaves a surface
//! must meet one that lies closer than that, and must not meet one that lies behind. Both are decided by the planes of the
//! triangles, whose corners are exact in double precision.
//!
//! Where two polygons coincide, so that rounding of their corners decides which one is in front at which place, they have one
//! order all over: as if each were moved towards its front by an infinitesimal distance, those that come later farther. So
//! the two sides of a panel, or of a wall between two rooms, are seen each from its own side, a rug lies on the floor that comes
//! before it, and glass that stands on a floor is in optical contact with it.

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

/// Where a ray intersects a facet.
struct Intersection {
    /// m
    distance: f64,
    is_between_edges: bool,
    is_front: bool,
}

/// Decides where single precision does not.
pub struct Contact {
    /// Half-width of the zone in which single precision decides nothing, m.
    pub slack: f64,
}

impl Facet {
    pub fn new(corners: &[Vec3; 3], polygon: u32) -> Self {
        let corners = corners.map(|corner| corner.as_dvec3());
        let [a, b, c] = corners;
        Self { corners, normal: (b - a).cross(c - a).normalize_or_zero(), polygon }
    }

    /// Whether it has no area, so that no ray meets it.
    pub fn is_line(&self) -> bool {
        self.normal == DVec3::ZERO
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

    /// Where a ray intersects the facet, or its outline if the ray passes just beside it.
    fn intersect(&self, origin: DVec3, direction: DVec3) -> Intersection {
        let corners = self.corners.map(|corner| corner - origin);
        let [a, b, c] = corners;
        let weights = [b.cross(c), c.cross(a), a.cross(b)].map(|moment| moment.dot(direction));
        let sum: f64 = weights.iter().sum();
        let is_between_edges = weights.iter().all(|weight| weight * sum >= 0.0);
        let distance = if is_between_edges {
            weights.iter().zip(corners).map(|(weight, corner)| weight * corner.dot(direction)).sum::<f64>() / sum
        } else {
            let nearest = [(a, b), (b, c), (c, a)].map(|edge| nearest_of_edge(edge, direction));
            nearest.into_iter().min_by(|one, other| one.1.total_cmp(&other.1)).map_or(0.0, |(distance, _)| distance)
        };
        Intersection { distance, is_between_edges, is_front: self.faces(direction) }
    }

    /// Whether a ray in this direction meets the front.
    pub fn faces(&self, direction: DVec3) -> bool {
        self.normal.dot(direction) < 0.0
    }

    /// Whether the two share an edge.
    fn adjoins(&self, other: &Self) -> bool {
        self.corners.iter().filter(|corner| other.corners.contains(corner)).count() == 2
    }

    /// Whether the other facet, in the same plane, lies beyond one of this one's edges but for so much, m.
    fn has_beside(&self, other: &Self, rounding: f64) -> bool {
        let [a, b, c] = self.corners;
        [(a, b), (b, c), (c, a)].into_iter().any(|(from, to)| {
            let outwards = (to - from).cross(self.normal).normalize_or_zero();
            other.corners.iter().all(|corner| (corner - from).dot(outwards) >= -rounding)
        })
    }

    fn longest_edge_squared(&self) -> f64 {
        let [a, b, c] = self.corners;
        a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a))
    }
}

impl Contact {
    /// How far a ray goes in this unit direction, from a point in the plane of the first facet of one polygon, until it meets the
    /// first facet of another, m; `None` if it does not. Each polygon is given by all its facets.
    pub fn distance(&self, from: &[Facet; 2], point: DVec3, to: &[Facet; 2], direction: DVec3) -> Option<f64> {
        let (start, end) = (&from[0], &to[0]);
        if end.is_line() {
            return None;
        }
        // Single precision found the crossing, and may have taken one of two facets that share an edge for the other.
        let contains = |point, margin| to.iter().any(|facet| !facet.is_line() && facet.contains(point, margin));
        let are_in_one_plane = self.coincide(start, end);
        if are_in_one_plane && self.overlap(from, to) && contains(end.project(point), 0.0) {
            return self.is_ranked_before(start, end, direction).then_some(0.0);
        }
        let do_adjoin = || from.iter().any(|one| to.iter().any(|other| one.adjoins(other)));
        let margin = if are_in_one_plane || do_adjoin() { 0.0 } else { self.slack };
        let distance = -end.height(point) / end.normal.dot(direction);
        (distance > 0.0 && contains(point + distance * direction, margin)).then_some(distance)
    }

    /// Whether two polygons in one plane overlap by more than rounding.
    fn overlap(&self, one: &[Facet; 2], other: &[Facet; 2]) -> bool {
        let rounding = NEAR * self.slack;
        let are_apart = |a: &Facet, b: &Facet| a.has_beside(b, rounding) || b.has_beside(a, rounding);
        one.iter().any(|a| other.iter().any(|b| !are_apart(a, b)))
    }

    /// Whether a ray hits the first facet before the second, where single precision finds that it hits both. Where the ray passes
    /// just outside the outline of a body, it hits the front side of the body, not the inside.
    pub fn is_before(&self, first: &Facet, second: &Facet, origin: DVec3, direction: DVec3) -> bool {
        if self.coincide(first, second) {
            return self.is_ranked_before(first, second, direction);
        }
        let [first, second] = [first, second].map(|facet| facet.intersect(origin, direction));
        let are_certain = first.is_between_edges && second.is_between_edges;
        if !are_certain && first.is_front != second.is_front && (first.distance - second.distance).abs() <= self.slack {
            return first.is_front;
        }
        first.distance < second.distance
    }

    /// Whether rounding decides which of the two is in front: they are in one plane but for rounding, and the smaller one is
    /// not wholly on one side of the other.
    fn coincide(&self, one: &Facet, other: &Facet) -> bool {
        if one.is_line() || other.is_line() {
            return false;
        }
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
        // Higher is farther along the ray.
        let rank = |facet: &Facet| {
            let place = i64::from(facet.polygon) + 1;
            if facet.normal.dot(direction) > 0.0 { place } else { -place }
        };
        rank(first) < rank(second)
    }
}

/// Where an edge, given relative to a ray's origin, is nearest to the ray's line: the distance along the ray, and the square of
/// that between the two.
fn nearest_of_edge((from, to): (DVec3, DVec3), direction: DVec3) -> (f64, f64) {
    let [beside, along] = [from, to - from].map(|vector| vector.reject_from_normalized(direction));
    let share = (-beside.dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (from.lerp(to, share).dot(direction), (beside + share * along).length_squared())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cmp::Ordering;

    const UP: [[usize; 3]; 2] = [[0, 1, 2], [0, 2, 1]];

    fn facet(polygon: u32, height: f32, faces_up: bool) -> Facet {
        let corners = [Vec3::new(0.0, height, 0.0), Vec3::new(0.0, height, 9.0), Vec3::new(9.0, height, 0.0)];
        Facet::new(&UP[usize::from(!faces_up)].map(|corner| corners[corner]), polygon)
    }

    const CONTACT: Contact = Contact { slack: 1e-3 };

    #[test]
    fn both_sides_of_a_panel_are_seen() {
        let (up, down) = (facet(0, 1.0, true), facet(1, 1.0, false));
        let point = DVec3::ONE;
        assert_eq!(CONTACT.distance(&[up; 2], point, &[down; 2], DVec3::Y), None);
        assert_eq!(CONTACT.distance(&[down; 2], point, &[up; 2], -DVec3::Y), None);
        // Through the panel, the other side is met.
        assert_eq!(CONTACT.distance(&[up; 2], point, &[down; 2], -DVec3::Y), Some(0.0));
        assert!(CONTACT.is_before(&up, &down, point + DVec3::Y, -DVec3::Y));
        assert!(CONTACT.is_before(&down, &up, point - DVec3::Y, DVec3::Y));
    }

    #[test]
    fn polygons_that_coincide_have_one_order_however_many_there_are() {
        let facets = [(0, true), (1, false), (2, true), (3, false)].map(|(polygon, up)| facet(polygon, 1.0, up));
        for direction in [DVec3::Y, -DVec3::Y] {
            let mut order: Vec<usize> = (0..facets.len()).collect();
            let is_before =
                |a: usize, b: usize| CONTACT.is_before(&facets[a], &facets[b], DVec3::ONE - direction, direction);
            order.sort_by(|&a, &b| if is_before(a, b) { Ordering::Less } else { Ordering::Greater });
            // The fronts that face the ray, the one that comes last on top, then the backs, in the opposite order.
            assert_eq!(order, if direction.y > 0.0 { [3, 1, 0, 2] } else { [2, 0, 1, 3] });
            assert!(
                (0..4).all(|i| (i + 1..4).all(|j| is_before(order[i], order[j]) && !is_before(order[j], order[i])))
            );
        }
    }

    #[test]
    fn what_is_a_hair_before_a_surface_is_met_and_what_is_a_hair_behind_is_not() {
        let (floor, above) = (facet(0, 256.0, true), facet(1, 256.0_f32.next_up(), false));
        let point = floor.project(DVec3::new(1.0, 256.1, 1.0));
        let distance = CONTACT.distance(&[floor; 2], point, &[above; 2], DVec3::Y);
        assert!(distance.is_some_and(|distance| (distance - 2.0_f64.powi(-15)).abs() < 1e-12), "{distance:?}");
        assert_eq!(CONTACT.distance(&[floor; 2], point, &[above; 2], -DVec3::Y), None);
        let along = DVec3::new(1.0, 1e-6, 0.0).normalize();
        assert_eq!(CONTACT.distance(&[floor; 2], point, &[above; 2], along), None, "beyond its edge");
    }
}
