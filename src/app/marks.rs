//! The picked points on the screen, and the way between them.

use crate::camera::Camera;
use crate::solution::{Equation, Visibility};
use egui::Vec2;
use glam::{DMat4, DVec4, Vec3};

/// Where they are, in shares of the viewport's width and height from the top left; `None` where it is not in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marks {
    /// x′
    pub point: Option<Vec2>,
    /// Whether the eye sees x′.
    pub is_seen: bool,
    /// x″
    pub source: Option<Vec2>,
    /// The way from x′ to x″, where nothing stands on it.
    pub free: Option<[Vec2; 2]>,
    /// The way from x′ to what stands before x″.
    pub blocked: Option<[Vec2; 2]>,
    /// The way from there to x″, or all of it where the two do not face each other.
    pub beyond: Option<[Vec2; 2]>,
}

impl Marks {
    /// As `camera` sees them in a picture of this size, pixels.
    pub fn of(equation: &Equation, camera: &Camera, size: [u32; 2]) -> Self {
        let clip_from_world = camera.clip_from_world(size[0] as f32 / size[1].max(1) as f32);
        let way = |from, to| on_screen(&clip_from_world, from, to);
        let place = |point| way(point, point).map(|[place, _]| place);
        let (point, source) = (equation.point, equation.source);
        let [mut free, mut blocked, mut beyond] = [None; 3];
        match source.map(|source| (source.visibility, source.point)) {
            Some((Visibility::Free, source)) => free = way(point, source),
            Some((Visibility::Blocked { at, .. }, source)) => {
                blocked = way(point, at);
                beyond = way(at, source);
            }
            Some((Visibility::FacesAway, source)) => beyond = way(point, source),
            None => {}
        }
        let is_seen = equation.sight == Visibility::Free;
        Self {
            point: place(point),
            is_seen,
            source: source.and_then(|source| place(source.point)),
            free,
            blocked,
            beyond,
        }
    }
}

/// The ends of the part of a line that is in the picture.
fn on_screen(clip_from_world: &DMat4, from: Vec3, to: Vec3) -> Option<[Vec2; 2]> {
    let [from, to] = [from, to].map(|point| *clip_from_world * point.as_dvec3().extend(1.0));
    let ends = clipped(from, to)?;
    Some(ends.map(|clip| Vec2::new((0.5 + 0.5 * clip.x / clip.w) as f32, (0.5 - 0.5 * clip.y / clip.w) as f32)))
}

/// Left, right, bottom and top of the picture, and the near plane, at which w is z: what is inside is on the positive side.
const EDGES: [DVec4; 5] = [
    DVec4::new(1.0, 0.0, 0.0, 1.0),
    DVec4::new(-1.0, 0.0, 0.0, 1.0),
    DVec4::new(0.0, 1.0, 0.0, 1.0),
    DVec4::new(0.0, -1.0, 0.0, 1.0),
    DVec4::new(0.0, 0.0, -1.0, 1.0),
];

/// The part of a line that lies inside of all edges, in clip coordinates (Liang, Barsky 1984).
fn clipped(mut from: DVec4, mut to: DVec4) -> Option<[DVec4; 2]> {
    for edge in EDGES {
        let (start, end) = (edge.dot(from), edge.dot(to));
        let crossing = || from.lerp(to, start / (start - end));
        match (start >= 0.0, end >= 0.0) {
            (true, true) => {}
            (true, false) => to = crossing(),
            (false, true) => from = crossing(),
            (false, false) => return None,
        }
    }
    Some([from, to])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::bounds::Bounds;
    use crate::scene::Viewpoint;

    #[test]
    fn lines_are_cut_at_the_edges_of_the_picture_and_before_the_eye() {
        // At (0, 0, 2), looking at the origin, a right angle from top to bottom: two metres before the eye, half a picture
        // is two metres high.
        let viewpoint = Viewpoint { eye: 2.0 * Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, vertical_fov: 90.0 };
        let camera = Camera::new(&viewpoint, &Bounds { min: -Vec3::ONE, max: Vec3::ONE });
        let clip_from_world = camera.clip_from_world(1.0);
        let shown = |from, to| on_screen(&clip_from_world, from, to);
        let is = |shown: Option<[Vec2; 2]>, wanted: [[f32; 2]; 2]| {
            let shown = shown.expect("it is in the picture");
            (0..2).all(|end| (shown[end] - Vec2::from(wanted[end])).length() < 1e-6)
        };
        assert!(is(shown(Vec3::ZERO, Vec3::Y), [[0.5, 0.5], [0.5, 0.25]]));
        assert!(is(shown(Vec3::ZERO, 4.0 * Vec3::X), [[0.5, 0.5], [1.0, 0.5]]), "on the right it ends");
        assert!(is(shown(Vec3::Y, Vec3::new(0.0, 1.0, 4.0)), [[0.5, 0.25], [0.5, 0.0]]), "it passes above the eye");
        assert_eq!(shown(3.0 * Vec3::Z, 4.0 * Vec3::Z), None, "behind the eye there is nothing");
    }
}
