//! Polygons that stand for a smooth surface: the normals at their corners, and the one in between.

use super::{Polygon, Scene};
use glam::{DVec3, Vec3};

/// Normals within this of the polygon's own, as 1 − cos, say nothing that its plane does not: 0.08°.
const FLAT: f64 = 1e-6;

/// The least cosine between a polygon's own normal and one at its corner. At 0 the surface that the polygon stands for would
/// be at right angles to it, and between two such normals there might be none.
const LEAST_COSINE: f64 = 1e-3;

/// What the normals at the corners of a polygon say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Smoothness {
    /// Nothing beside its own normal, or nothing at all.
    Flat,
    Smooth,
    /// They are not all on one side of it.
    Contrary,
}

/// Judges the normals of a polygon. All of them may be behind it: then it winds the other way.
pub fn smoothness(positions: &[Vec3], normals: &[Vec3], polygon: &Polygon) -> Smoothness {
    let Some(own) = polygon.normals() else { return Smoothness::Flat };
    let corners: Vec<DVec3> = polygon.corners().iter().map(|&i| positions[i as usize].as_dvec3()).collect();
    let pieces = corners[1..].windows(2).map(|pair| (pair[0] - corners[0]).cross(pair[1] - corners[0]));
    let front = pieces.sum::<DVec3>().normalize_or_zero();
    let cosines = own.iter().map(|&normal| normals[normal as usize].as_dvec3().dot(front));
    let (low, high) = cosines.fold((1.0, -1.0), |(low, high): (f64, f64), c| (low.min(c), high.max(c)));
    if low < LEAST_COSINE && high > -LEAST_COSINE {
        Smoothness::Contrary
    } else if low > 1.0 - FLAT || high < FLAT - 1.0 {
        Smoothness::Flat
    } else {
        Smoothness::Smooth
    }
}

impl Scene {
    /// Unit normal at a point of a polygon, of the smooth surface that it stands for, on the side of the polygon's front;
    /// `None` where it stands for no other surface. Normals are interpolated over the triangles as which it is traced
    /// (Phong 1975).
    pub fn shading_normal(&self, polygon: usize, point: Vec3) -> Option<Vec3> {
        let polygon = &self.polygons[polygon];
        let normals = polygon.normals.as_ref()?;
        let point = point.as_dvec3();
        let corner = |place: usize| self.positions[polygon.corners[place] as usize].as_dvec3();
        let normal = |place: usize| self.normals[normals[place] as usize];
        let first = corner(0);
        let mut at = Barycentric::new(point - first, corner(1) - first, corner(2) - first);
        let (mut second, mut third) = (1, 2);
        if at.second < 0.0 && polygon.corner_count == 4 {
            (second, third) = (2, 3);
            at = Barycentric::new(point - first, corner(2) - first, corner(3) - first);
        }
        let shares = [at.second.max(0.0), at.third.max(0.0)];
        let [second_share, third_share] = shares.map(|share| share as f32);
        let first_share = (1.0 - second_share - third_share).max(0.0);
        let sum = first_share * normal(0) + second_share * normal(second) + third_share * normal(third);
        let sum = if sum.dot(at.front.as_vec3()) < 0.0 { -sum } else { sum };
        sum.try_normalize()
    }
}

/// A point of a triangle as shares of its second and third corner, in its plane in [0, 1]. In double precision, which slivers
/// need.
struct Barycentric {
    second: f64,
    third: f64,
    /// Unit normal of the triangle's front.
    front: DVec3,
}

impl Barycentric {
    /// All from the triangle's first corner.
    fn new(point: DVec3, second: DVec3, third: DVec3) -> Self {
        let double_area = second.cross(third);
        let length = double_area.length();
        let front = double_area / length;
        Self { second: point.cross(third).dot(front) / length, third: second.cross(point).dot(front) / length, front }
    }
}

/// Leaves only the normals that polygons name.
pub fn drop_unused_normals(normals: &mut Vec<Vec3>, polygons: &mut [Polygon]) {
    let used = polygons.iter().filter_map(Polygon::normals).flatten().copied();
    let new_index = keep_used(normals, used);
    for polygon in polygons {
        polygon.normals = polygon.normals.map(|own| own.map(|normal| new_index[normal as usize]));
    }
}

/// Leaves only the items that are used, and returns for each of those before its new index.
pub fn keep_used<T>(items: &mut Vec<T>, used: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut is_used = vec![false; items.len()];
    used.for_each(|item| is_used[item as usize] = true);
    let mut used_before = 0;
    let new_index = is_used
        .iter()
        .map(|&is_used| {
            used_before += u32::from(is_used);
            used_before.saturating_sub(1)
        })
        .collect();
    let mut is_used = is_used.into_iter();
    items.retain(|_| is_used.next() == Some(true));
    new_index
}
