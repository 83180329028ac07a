//! The camera: what turning, moving and fitting keep, at every size of scene.

use glam::{DVec3, DVec4, Vec3};
use lightwell::camera::{Camera, Flight};
use lightwell::math::bounds::Bounds;
use lightwell::scene::Viewpoint;

const VIEWPOINT: Viewpoint =
    Viewpoint { eye: Vec3::new(3.0, 2.0, 5.0), target: Vec3::new(0.5, 0.25, -1.0), up: Vec3::Y, vertical_fov: 40.0 };
const BOUNDS: Bounds = Bounds { min: Vec3::new(-2.0, -1.0, -3.0), max: Vec3::new(2.0, 1.5, 1.0) };

fn camera() -> Camera {
    Camera::new(&VIEWPOINT, &BOUNDS)
}

fn distance(camera: &Camera) -> f64 {
    camera.eye().distance(camera.viewpoint().target.as_dvec3())
}

/// Position in the picture, -1 to 1 to the right and up, and depth.
fn project(camera: &Camera, aspect: f32, position: DVec3) -> DVec3 {
    camera.clip_from_world(aspect).project_point3(position)
}

fn corners(bounds: &Bounds) -> impl Iterator<Item = DVec3> {
    let (min, extent) = (bounds.min.as_dvec3(), bounds.extent().as_dvec3());
    (0..8).map(move |i| min + extent * DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)))
}

/// Single precision of the viewpoint, relative to lengths of some 10.
const ROUNDING: f32 = 1e-5;

#[test]
fn a_camera_stands_where_its_viewpoint_says() {
    let stated = camera().viewpoint();
    assert!(stated.eye.abs_diff_eq(VIEWPOINT.eye, ROUNDING));
    assert!(stated.target.abs_diff_eq(VIEWPOINT.target, ROUNDING));
    assert!((stated.vertical_fov - VIEWPOINT.vertical_fov).abs() < ROUNDING);
}

#[test]
fn orbiting_keeps_the_distance_and_the_horizon() {
    let mut camera = camera();
    let before = distance(&camera);
    for step in 0..200 {
        camera.orbit(0.07, if step < 100 { 0.05 } else { -0.05 });
        assert!((distance(&camera) - before).abs() < f64::from(ROUNDING));
        let above = project(&camera, 1.0, VIEWPOINT.target.as_dvec3() + 0.01 * DVec3::Y);
        assert!(above.y > 0.0, "up is down after {step} steps");
        assert!(camera.clip_from_world(1.0).is_finite());
    }
}

#[test]
fn a_long_drag_up_or_down_ends_before_the_pole() {
    for dy in [9.0, -9.0] {
        let mut camera = camera();
        let offset = |camera: &Camera| (camera.eye() - VIEWPOINT.target.as_dvec3()).with_y(0.0);
        let before = offset(&camera);
        camera.orbit(0.0, dy);
        let after = offset(&camera);
        assert!(after.length() > 0.0 && after.angle_between(before) < 1e-6, "{after} is on the other side of {before}");
    }
}

#[test]
fn a_drag_over_the_whole_height_is_half_a_turn() {
    let mut camera = camera();
    let offset = camera.eye() - VIEWPOINT.target.as_dvec3();
    camera.orbit(1.0, 0.0);
    let turned = camera.eye() - VIEWPOINT.target.as_dvec3();
    assert!(turned.abs_diff_eq(DVec3::new(-offset.x, offset.y, -offset.z), f64::from(ROUNDING)));
}

#[test]
fn dragging_to_the_right_moves_the_near_side_to_the_right() {
    let mut camera = camera();
    let near = VIEWPOINT.target.as_dvec3().lerp(camera.eye(), 0.1);
    camera.orbit(0.01, 0.0);
    assert!(project(&camera, 1.0, near).x > 0.0);
    camera.orbit(-0.01, 0.01);
    assert!(project(&camera, 1.0, near).y < 0.0);
}

#[test]
fn the_target_stays_under_the_pointer_while_panning() {
    let mut camera = camera();
    camera.pan(0.1, 0.2);
    // The picture is 2 high, and down is negative.
    let seen = project(&camera, 2.0, VIEWPOINT.target.as_dvec3());
    assert!((2.0 * seen.x - 0.2).abs() < f64::from(ROUNDING), "{seen}");
    assert!((seen.y + 0.4).abs() < f64::from(ROUNDING), "{seen}");
}

#[test]
fn a_ray_through_a_point_of_the_picture_is_seen_at_that_point() {
    let mut camera = camera();
    camera.orbit(0.3, 0.1);
    let size = [300, 200];
    for at in [[0.0, 0.0], [300.0, 0.0], [150.0, 100.0], [17.5, 140.25], [299.0, 199.0]] {
        let ray = camera.ray(at, size);
        assert!((ray.direction.length() - 1.0).abs() < ROUNDING);
        for distance in [0.5, 3.0, 200.0] {
            let seen = project(&camera, 1.5, (ray.origin + distance * ray.direction).as_dvec3());
            let back = [150.0 * (1.0 + seen.x), 100.0 * (1.0 - seen.y)];
            // Coordinates of some 10 are rounded to single precision, at half a unit away, where one is 275 pixels.
            let tolerance = 2.0 * 275.0 * 10.0 * f64::from(f32::EPSILON) / 0.5;
            for axis in 0..2 {
                assert!((back[axis] - f64::from(at[axis])).abs() < tolerance, "{back:?}, not {at:?}, at {distance}");
            }
        }
    }
}

#[test]
fn zooming_stops_before_it_reaches_the_target_or_loses_the_scene() {
    let mut camera = camera();
    let before = distance(&camera);
    camera.zoom(0.5);
    assert!((distance(&camera) - 0.5 * before).abs() < f64::from(ROUNDING));
    camera.zoom(0.0);
    assert!(distance(&camera) > 0.0);
    camera.zoom(f32::INFINITY);
    assert!(distance(&camera).is_finite());
}

#[test]
fn what_fits_is_all_in_the_picture_and_fills_most_of_it() {
    for aspect in [0.3, 1.0, 2.5] {
        let mut camera = camera();
        camera.fit(&BOUNDS, aspect);
        let mut widest = 0.0_f64;
        for corner in corners(&BOUNDS) {
            let seen = project(&camera, aspect, corner);
            assert!(seen.x.abs() < 1.0 && seen.y.abs() < 1.0 && seen.z > 0.0 && seen.z < 1.0, "{seen} at {aspect}");
            widest = widest.max(seen.x.abs()).max(seen.y.abs());
        }
        assert!(widest > 0.5, "{widest} at {aspect}");
    }
}

#[test]
fn the_size_of_a_scene_and_its_distance_from_the_origin_do_not_matter() {
    let point = DVec3::new(-0.5, 0.75, 0.5);
    let seen = project(&camera(), 1.5, point);
    for scale in [1e-6_f32, 1.0, 1e6] {
        let scaled = |position: Vec3| scale * position;
        let viewpoint = Viewpoint { eye: scaled(VIEWPOINT.eye), target: scaled(VIEWPOINT.target), ..VIEWPOINT };
        let bounds = Bounds { min: scaled(BOUNDS.min), max: scaled(BOUNDS.max) };
        let camera = Camera::new(&viewpoint, &bounds);
        let scaled_seen = project(&camera, 1.5, f64::from(scale) * point);
        assert!(scaled_seen.abs_diff_eq(seen, f64::from(ROUNDING)), "{scaled_seen} at {scale}, not {seen}");
    }
}

#[test]
fn depth_falls_from_one_at_the_near_plane_to_zero_at_infinity() {
    let camera = camera();
    let ahead = (VIEWPOINT.target.as_dvec3() - camera.eye()).normalize();
    let depth = |distance: f64| {
        let clip: DVec4 = camera.clip_from_world(1.0) * (camera.eye() + distance * ahead).extend(1.0);
        clip.z / clip.w
    };
    assert!(depth(1e-6) > 1.0);
    assert!(depth(1.0) > depth(2.0) && depth(2.0) > depth(1e6));
    assert!(depth(1e9) > 0.0 && depth(1e9) < 1e-9);
}

#[test]
fn a_view_along_the_up_vector_or_from_the_target_itself_is_mended() {
    for viewpoint in [
        Viewpoint { eye: VIEWPOINT.target + 3.0 * Vec3::Y, ..VIEWPOINT },
        Viewpoint { eye: VIEWPOINT.target, ..VIEWPOINT },
        Viewpoint { up: Vec3::ZERO, ..VIEWPOINT },
    ] {
        let camera = Camera::new(&viewpoint, &BOUNDS);
        assert!(camera.clip_from_world(1.0).is_finite());
        assert!(camera.clip_from_world(1.0).determinant() != 0.0);
    }
}

#[test]
fn a_flight_starts_and_ends_at_its_cameras_and_turns_the_shorter_way() {
    let from = camera();
    let mut to = from;
    to.orbit(1.9, 0.05);
    to.zoom(4.0);
    let near = |a: &Camera, b: &Camera| a.eye().distance(b.eye()) < f64::from(ROUNDING);
    assert!(near(&from.toward(&to, 0.0), &from));
    assert!(near(&from.toward(&to, 1.0), &to));
    // 1.9 half turns one way are 0.1 the other way, so the eye stays on its side of the target.
    let halfway = from.toward(&to, 0.5);
    let target = VIEWPOINT.target.as_dvec3();
    assert!((halfway.eye() - target).dot(from.eye() - target) > 0.0);
    assert!((distance(&halfway) - 2.0 * distance(&from)).abs() < f64::from(ROUNDING));

    let flight = Flight { from, to };
    assert!(near(&flight.at(0.0).expect("under way"), &from));
    assert_eq!(flight.at(Flight::DURATION), None);
}
