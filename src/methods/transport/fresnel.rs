//! Reflection and refraction at a smooth boundary (Snell; Fresnel 1823, for unpolarised light).

use glam::Vec3A;

/// The direction in which a mirror sends light that leaves to `towards`; both unit vectors point away from the surface.
pub fn reflect(towards: Vec3A, normal: Vec3A) -> Vec3A {
    2.0 * towards.dot(normal) * normal - towards
}

/// The direction behind the boundary, pointing away from it, for light on the side of `normal` that arrives from or leaves
/// to `towards`; `None` where it is reflected totally. `index` is the refraction index behind the boundary over that
/// before it. Unit vectors.
pub fn refract(towards: Vec3A, normal: Vec3A, index: f32) -> Option<Vec3A> {
    let cosine = towards.dot(normal);
    let inverse = 1.0 / index;
    let square_behind = 1.0 - inverse * inverse * (1.0 - cosine * cosine).max(0.0);
    (square_behind > 0.0).then(|| ((inverse * cosine - square_behind.sqrt()) * normal - inverse * towards).normalize())
}

/// Share of unpolarised light that a boundary reflects, in [0, 1], for the cosine to its normal in (0, 1] and `index` as in
/// [`refract`].
pub fn fresnel_reflectance(cosine: f32, index: f32) -> f32 {
    let cosine = cosine.clamp(0.0, 1.0);
    let square_behind = 1.0 - (1.0 - cosine * cosine) / (index * index);
    if square_behind <= 0.0 {
        return 1.0;
    }
    let behind = square_behind.sqrt();
    let parallel = (index * cosine - behind) / (index * cosine + behind);
    let perpendicular = (cosine - index * behind) / (cosine + index * behind);
    0.5 * (parallel * parallel + perpendicular * perpendicular)
}
