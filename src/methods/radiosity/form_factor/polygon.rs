//! Form factor from a receiving element to a shooting patch by a formula, without regard to what stands between.

use super::centroid::{Facet, centroid, disc};
use crate::math::polygon::{Plate, are_opposed, form_factor, rounding_along, vector_area};
use crate::mesh::{Element, Mesh, Patch};
use crate::solution::Zero;
use glam::{DVec3, Vec3A};

/// A receiver nearer to the shooter than this many of its own radii is integrated over, not looked at in its centre.
const NEAR_RADII: f64 = 4.0;
/// Relative error of that integral: far below the noise of shadow rays.
pub(super) const TOLERANCE: f64 = 1e-4;

/// The formula.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    Centroid,
    Disc,
    Polygon,
}

/// A shooting patch, made ready for many receivers.
pub struct Shooter {
    facet: Facet,
    plate: Plate,
    corners: [DVec3; 4],
    count: usize,
    normal: Vec3A,
    /// Distance of the farthest corner from the centre, m.
    radius: f64,
}

impl Shooter {
    pub fn new(patch: &Patch) -> Self {
        let mut corners = [DVec3::ZERO; 4];
        let count = patch.corners().len();
        for (to, from) in corners.iter_mut().zip(patch.corners()) {
            *to = from.as_dvec3();
        }
        let center = patch.center.as_dvec3();
        let radius = corners[..count].iter().map(|corner| corner.distance(center)).fold(0.0, f64::max);
        // Its whole area, exposed or not: how much of it is seen is a matter of visibility.
        let area = vector_area(&corners[..count]).length();
        let facet = Facet { center, normal: patch.normal.as_dvec3(), area };
        Self { facet, plate: Plate::new(&corners[..count]), corners, count, normal: patch.normal, radius }
    }

    /// Why no part of the receiving patch can see the front of the shooter, whatever stands between them, or `None` if
    /// some may: each reaches more than `tolerance` (m) above the other's plane. Patches of one plane do not, whatever
    /// their corners were rounded to. Of those that face each other, however near, all
    /// that is more than rounding counts.
    pub fn out_of_sight(&self, receiver: &Patch, tolerance: f32) -> Option<Zero> {
        let are_opposed = are_opposed(receiver.normal.as_dvec3(), self.facet.normal);
        let tolerance = if are_opposed { self.rounding(receiver) } else { tolerance };
        let center = self.facet.center.as_vec3a();
        let height = |corner: &glam::Vec3| (Vec3A::from(*corner) - center).dot(self.normal);
        let above_receiver = |corner: &DVec3| (corner.as_vec3a() - receiver.center).dot(receiver.normal) > tolerance;
        let corners = receiver.corners();
        if corners.iter().any(|corner| height(corner) > tolerance)
            && self.corners[..self.count].iter().any(above_receiver)
        {
            return None;
        }
        let is_flat = corners.iter().all(|corner| height(corner).abs() <= tolerance);
        Some(if is_flat && receiver.normal.dot(self.normal) > 0.0 { Zero::SamePlane } else { Zero::FacesAway })
    }

    /// Heights above the planes of shooter and receiver that may be rounding, m, where these are parallel.
    fn rounding(&self, receiver: &Patch) -> f32 {
        let of_receiver = receiver.corners().iter().map(|corner| corner.as_dvec3());
        rounding_along(self.facet.normal, self.corners[..self.count].iter().copied().chain(of_receiver)) as f32
    }

    /// Form factor from an element with this unit normal to the shooter.
    pub fn form_factor(&self, kernel: Kernel, mesh: &Mesh, element: &Element, normal: DVec3) -> f64 {
        let receiver = || Facet { center: element.center.as_dvec3(), normal, area: element.area };
        match kernel {
            Kernel::Centroid => centroid(&receiver(), &self.facet),
            Kernel::Disc => disc(&receiver(), &self.facet),
            Kernel::Polygon => self.mean_form_factor(mesh, element, normal),
        }
    }

    /// Mean over the element: at its centre, or over all its points where the shooter is so near that it looks different
    /// from each.
    fn mean_form_factor(&self, mesh: &Mesh, element: &Element, normal: DVec3) -> f64 {
        let center = element.center.as_dvec3();
        // The radius of a square; what is longer is narrower, and the area is at hand.
        let radius = (0.5 * element.area).sqrt();
        if center.distance(self.facet.center) - self.radius > NEAR_RADII * radius {
            return form_factor(center, normal, &self.corners[..self.count]);
        }
        let mut corners = [DVec3::ZERO; 4];
        for (to, &from) in corners.iter_mut().zip(element.corners()) {
            *to = mesh.vertices[from as usize].as_dvec3();
        }
        let receiver = Plate::new(&corners[..element.corners().len()]);
        // By contours it may be below 0 by rounding.
        receiver.exchange(&self.plate, TOLERANCE).max(0.0) / receiver.area()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cancel::Cancel;
    use crate::math::polygon::parallel_rectangles;
    use crate::mesh::subdivide;
    use crate::scene::{Polygon, Scene, Source};
    use glam::Vec3;

    /// Two unit squares face to face at distance `gap`, each cut into elements of at most `size`.
    fn facing_squares(gap: f32, size: f64) -> Mesh {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let mut positions: Vec<Vec3> = corners.iter().map(|&(x, z)| Vec3::new(x, gap, z)).collect();
        positions.extend(corners.iter().rev().map(|&(x, z)| Vec3::new(x, 0.0, z)));
        let scene = Scene {
            name: "squares".to_owned(),
            source: Source::Builtin("squares"),
            origin: DVec3::ZERO,
            positions,
            normals: Vec::new(),
            polygons: vec![Polygon::new(&[0, 1, 2, 3], 0, 0, 0), Polygon::new(&[4, 5, 6, 7], 0, 0, 0)],
            materials: Vec::new(),
            objects: Vec::new(),
            viewpoint: None,
            findings: Vec::new(),
        };
        subdivide(&scene, &[true, false, true, false], 4, size, &Cancel::default()).expect("nothing cancels it")
    }

    /// Σ A_e F_e over the second square for a first square that is one patch.
    fn exchange(gap: f32, size: f64) -> f64 {
        let mesh = facing_squares(gap, size);
        let receivers = mesh.side(1, true).expect("meshed").elements.clone();
        mesh.patches[..mesh.side(0, true).expect("meshed").patches.end as usize]
            .iter()
            .map(|patch| {
                let shooter = Shooter::new(patch);
                let of = |element: &Element| {
                    let normal = mesh.patches[element.patch as usize].normal.as_dvec3();
                    element.area * shooter.form_factor(Kernel::Polygon, &mesh, element, normal)
                };
                mesh.elements[receivers.start as usize..receivers.end as usize].iter().map(of).sum::<f64>()
            })
            .sum()
    }

    #[test]
    fn facing_squares_approach_the_exact_value_with_the_square_of_the_element_size() {
        let exact = parallel_rectangles(1.0, 1.0, 1.0);
        let error = |size| (exchange(1.0, size) - exact).abs();
        let (coarse, fine) = (error(0.125), error(0.0625));
        // Second order: half the size, a quarter of the error. Gauss points near the shooter do better.
        assert!(fine < coarse / 3.5 && fine / exact < 2e-3, "{coarse} {fine}");
    }

    #[test]
    fn very_near_squares_keep_their_form_factor_below_one() {
        let got = exchange(0.1, 0.0625);
        let exact = parallel_rectangles(1.0, 1.0, 0.1);
        assert!(got < 1.0 && (got / exact - 1.0).abs() < 5e-3, "{got} for {exact}");
    }
}
