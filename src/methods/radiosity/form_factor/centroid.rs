//! Form factors from centre to centre: the lecture's rough estimate, right where both patches are small and far apart.

use glam::DVec3;
use std::f64::consts::PI;

/// A small flat surface.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    pub center: DVec3,
    /// Unit length.
    pub normal: DVec3,
    /// m².
    pub area: f64,
}

/// cosθ cosθ' A' / (π r²), which exceeds 1 where the distance is small against the size. The lecture prints 2π for π; with
/// that, a closed room would lose half of its light at every bounce.
pub fn centroid(from: &Facet, to: &Facet) -> f64 {
    let (cosines, squared) = cosines(from, to);
    if cosines > 0.0 { cosines * to.area / (PI * squared) } else { 0.0 }
}

/// cosθ cosθ' A' / (π r² + A'): the receiver sees a disc of area A' instead, face to face exact and never above 1 (Wallace,
/// Elmquist, Haines 1989).
pub fn disc(from: &Facet, to: &Facet) -> f64 {
    let (cosines, squared) = cosines(from, to);
    if cosines > 0.0 { cosines * to.area / (PI * squared + to.area) } else { 0.0 }
}

/// cosθ cosθ' at the line between the centres, 0 where one lies behind the other, and the square of its length.
fn cosines(from: &Facet, to: &Facet) -> (f64, f64) {
    let way = to.center - from.center;
    let squared = way.length_squared();
    let (here, there) = (way.dot(from.normal), -way.dot(to.normal));
    if here > 0.0 && there > 0.0 { (here * there / squared, squared) } else { (0.0, squared) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facing_unit_squares(gap: f64) -> [Facet; 2] {
        [
            Facet { center: DVec3::ZERO, normal: DVec3::Z, area: 1.0 },
            Facet { center: gap * DVec3::Z, normal: DVec3::NEG_Z, area: 1.0 },
        ]
    }

    #[test]
    fn near_by_the_centroid_breaks_down_and_the_disc_does_not() {
        let [a, b] = facing_unit_squares(0.1);
        assert!((centroid(&a, &b) - 100.0 / PI).abs() < 1e-12);
        assert!((disc(&a, &b) - 1.0 / (0.01 * PI + 1.0)).abs() < 1e-15);
    }

    #[test]
    fn what_faces_away_gets_nothing() {
        let [a, b] = facing_unit_squares(1.0);
        let turned = Facet { normal: DVec3::Z, ..b };
        assert_eq!((centroid(&a, &turned), disc(&turned, &a)), (0.0, 0.0));
        assert_eq!((centroid(&a, &a), disc(&a, &a)), (0.0, 0.0));
    }
}
