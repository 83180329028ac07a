//! Form factors against closed forms of the books, and against what must hold for any pair of polygons.

mod pairs;
mod tables;

use glam::DVec3;
use lightwell::math::polygon::vector_area;
use lightwell::methods::radiosity::form_factor::centroid::Facet;

/// A rectangle with this corner and these edges, which faces along their cross product.
fn rectangle(corner: DVec3, along: DVec3, across: DVec3) -> Vec<DVec3> {
    vec![corner, corner + along, corner + along + across, corner + across]
}

/// The unit square in the plane z = 0 that faces up.
fn floor() -> Vec<DVec3> {
    rectangle(DVec3::ZERO, DVec3::X, DVec3::Y)
}

/// The unit square above the floor that faces it.
fn ceiling(gap: f64) -> Vec<DVec3> {
    rectangle(gap * DVec3::Z, DVec3::Y, DVec3::X)
}

/// A rectangle on the floor's edge x = 0, which it faces.
fn wall(height: f64) -> Vec<DVec3> {
    rectangle(DVec3::ZERO, DVec3::Y, height * DVec3::Z)
}

fn center(corners: &[DVec3]) -> DVec3 {
    corners.iter().sum::<DVec3>() / corners.len() as f64
}

fn facet(corners: &[DVec3]) -> Facet {
    let area = vector_area(corners);
    Facet { center: center(corners), normal: area.normalize(), area: area.length() }
}

/// A quad cut into n × n.
fn pieces(corners: &[DVec3], n: usize) -> Vec<Vec<DVec3>> {
    let (along, across) = ((corners[1] - corners[0]) / n as f64, (corners[3] - corners[0]) / n as f64);
    let cells = (0..n * n).map(|cell| ((cell % n) as f64, (cell / n) as f64));
    cells.map(|(u, v)| rectangle(corners[0] + u * along + v * across, along, across)).collect()
}
