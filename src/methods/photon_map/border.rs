//! Where a surface ends for photons: at its own outline, and at the foot of what stands on it.

use super::facet::{Facet, Limits};
use glam::Vec3A;

/// A line at which a group of surfaces ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    pub ends: [Vec3A; 2],
    pub group: u32,
}

/// What is needed to find the segments of a side.
pub struct Border<'a> {
    pub facets: &'a [Facet],
    pub groups: &'a [u32],
    pub limits: Limits,
}

impl Border<'_> {
    /// The segments on one side of a polygon. `neighbours` are the polygons that it may touch.
    pub fn of(&self, side: usize, neighbours: &[u32]) -> Vec<Segment> {
        let group = self.groups[side];
        let facet = &self.facets[side / 2];
        let is_mate = |polygon: usize| self.groups[2 * polygon] == group || self.groups[2 * polygon + 1] == group;
        let (mates, strangers): (Vec<usize>, Vec<usize>) =
            neighbours.iter().map(|&other| other as usize).partition(|&other| is_mate(other));
        let mut lines = Vec::new();
        for edge in facet.edges() {
            let gaps = self.gaps(facet, edge, &mates);
            lines.extend(gaps.into_iter().map(|gap| gap.map(|share| edge[0].lerp(edge[1], share))));
        }
        let own = lines.len();
        for stranger in strangers {
            let feet = self.feet(facet, facet.facing(side), &self.facets[stranger]);
            for foot in feet {
                if !lines[..own].iter().any(|&line| self.is_part(foot, line)) {
                    lines.push(foot);
                }
            }
        }
        lines.into_iter().map(|ends| Segment { ends, group }).collect()
    }

    /// The parts of an edge behind which the surface does not go on in one of its `mates`, as shares of its length.
    fn gaps(&self, facet: &Facet, edge: [Vec3A; 2], mates: &[usize]) -> Vec<[f32; 2]> {
        let flat = self.limits.flat;
        let outward = (edge[1] - edge[0]).cross(facet.normal).normalize_or_zero();
        let behind = edge.map(|end| end + 2.0 * flat * outward);
        let covered = |mate: &Facet| {
            if facet.goes_on_at(edge, mate, &self.limits) {
                Some([0.0, 1.0])
            } else if mate.is_coplanar(facet, &self.limits) {
                mate.clip(behind, flat)
            } else {
                None
            }
        };
        let mut covers: Vec<[f32; 2]> = mates.iter().filter_map(|&mate| covered(&self.facets[mate])).collect();
        covers.sort_by(|a, b| a[0].total_cmp(&b[0]));
        // Shorter ones come from rounding.
        let least = 8.0 * flat / edge[0].distance(edge[1]);
        let (mut gaps, mut end) = (Vec::new(), 0.0_f32);
        for [from, to] in covers.into_iter().chain([[1.0, 1.0]]) {
            if from - end > least {
                gaps.push([end, from]);
            }
            end = end.max(to);
        }
        gaps
    }

    /// The lines in which another polygon stands on the side of `facet` to which `facing` points, or lies on it.
    fn feet(&self, facet: &Facet, facing: Vec3A, other: &Facet) -> Vec<[Vec3A; 2]> {
        let Limits { flat, touching } = self.limits;
        let [low, high] = other.heights_over(facet, facing);
        if high <= flat || low > touching {
            return Vec::new();
        }
        let lines: Vec<[Vec3A; 2]> = if high <= touching {
            other.edges().collect()
        } else {
            let height = flat + low.max(0.0);
            self.section(facet.corners()[0] + height * facing, facing, other).into_iter().collect()
        };
        let part = |line: [Vec3A; 2]| {
            let [begin, end] = facet.clip(line, touching)?;
            Some([begin, end].map(|share| line[0].lerp(line[1], share)))
        };
        lines.into_iter().filter_map(part).filter(|[from, to]| from.distance(*to) > 8.0 * flat).collect()
    }

    /// Where a polygon meets the plane through a point with this normal.
    fn section(&self, point: Vec3A, normal: Vec3A, polygon: &Facet) -> Option<[Vec3A; 2]> {
        let crossing = |[from, to]: [Vec3A; 2]| {
            let [start, end] = [from, to].map(|corner| (corner - point).dot(normal));
            ((start < 0.0) != (end < 0.0)).then(|| from.lerp(to, start / (start - end)))
        };
        let mut crossings = polygon.edges().filter_map(crossing);
        Some([crossings.next()?, crossings.next()?])
    }

    /// Whether a line is a part of another.
    fn is_part(&self, part: [Vec3A; 2], [from, to]: [Vec3A; 2]) -> bool {
        let along = (to - from).normalize_or_zero();
        let slack = 4.0 * self.limits.flat;
        part.iter().all(|&end| {
            let way = end - from;
            let place = way.dot(along);
            let off = way - place * along;
            place >= -slack && place <= from.distance(to) + slack && off.length() <= slack
        })
    }
}
