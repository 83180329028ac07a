//! Reflection and refraction at a smooth boundary (Snell; Fresnel 1823, for unpolarised light).
//!
//! The sums are in double precision: near the angle of total reflection they are differences of nearly equal numbers.

use glam::{DVec3, Vec3A};

/// The direction in which a mirror sends light that leaves to `towards`; both unit vectors point away from the surface.
pub fn reflect(towards: Vec3A, normal: Vec3A) -> Vec3A {
    2.0 * towards.dot(normal) * normal - towards
}

/// The direction behind the boundary, pointing away from it, for light on the side of `normal` that arrives from or leaves
/// to `towards`; `None` where it is reflected totally. `index` is the refraction index behind the boundary over that
/// before it. Unit vectors.
pub fn refract(towards: Vec3A, normal: Vec3A, index: f32) -> Option<Vec3A> {
    let (towards, normal): (DVec3, DVec3) = (towards.as_dvec3(), normal.as_dvec3());
    let cosine = towards.dot(normal);
    let behind = cosine_behind(cosine, index.into())?;
    let inverse = 1.0 / f64::from(index);
    Some(((inverse * cosine - behind) * normal - inverse * towards).normalize().as_vec3a())
}

/// Share of unpolarised light that a boundary reflects, in [0, 1], for the cosine to its normal in [0, 1] and `index` as in
/// [`refract`].
pub fn fresnel_reflectance(cosine: f32, index: f32) -> f32 {
    reflectance(f64::from(cosine).clamp(0.0, 1.0), index.into()) as f32
}

fn reflectance(cosine: f64, index: f64) -> f64 {
    let Some(behind) = cosine_behind(cosine, index) else { return 1.0 };
    let parallel = (index * cosine - behind) / (index * cosine + behind);
    let perpendicular = (cosine - index * behind) / (cosine + index * behind);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}

/// Cosine of the refracted ray to the normal; `None` where there is none.
fn cosine_behind(cosine: f64, index: f64) -> Option<f64> {
    let square = 1.0 - (1.0 - cosine * cosine).max(0.0) / (index * index);
    (square > 0.0).then(|| square.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The other form of the equations, by sines and tangents of the two angles; and the same from the other side.
    #[test]
    fn reflectance_follows_fresnel_on_both_sides_of_a_boundary() {
        for index in [0.4, 1.0 / 1.5, 1.33, 1.5, 2.5] {
            for tenths in 1..900 {
                let angle = (0.1 * f64::from(tenths)).to_radians();
                if angle.sin() >= index {
                    assert_eq!(reflectance(angle.cos(), index), 1.0);
                    continue;
                }
                let behind = (angle.sin() / index).asin();
                let (sum, difference) = (angle + behind, angle - behind);
                let (s, p) = (difference.sin() / sum.sin(), difference.tan() / sum.tan());
                let expected = 0.5 * (s * s + p * p);
                for got in [reflectance(angle.cos(), index), reflectance(behind.cos(), 1.0 / index)] {
                    // Near total reflection rounding grows by its square root.
                    assert!((got - expected).abs() < 1e-7, "n = {index}, {angle}: {got}, not {expected}");
                }
            }
        }
    }
}
