//! Normals of the smooth surfaces that polygons stand for.

use crate::{scene, shapes};
use glam::{Vec2, Vec3};
use lightwell::math::random::Stream;
use lightwell::scene::{Polygon, Scene};
use std::fmt::Write;

const MTL: &str = "newmtl white\nKd 0.5 0.5 0.5\nKe 1 1 1\n";

/// The unit sphere with its own points as normals, scaled and moved.
fn sphere(depth: u32, scale: f32, center: Vec3) -> Scene {
    let mut obj = "usemtl white\n".to_owned();
    for triangle in shapes::sphere(depth) {
        for point in triangle {
            let corner = center + scale * point;
            // A normal of any length has its direction.
            let normal = 7.0 * point;
            let _ =
                writeln!(obj, "v {} {} {}\nvn {} {} {}", corner.x, corner.y, corner.z, normal.x, normal.y, normal.z);
        }
        obj += "f -3//-3 -2//-2 -1//-1\n";
    }
    scene(&obj, MTL)
}

fn corners(scene: &Scene, polygon: &Polygon) -> Vec<Vec3> {
    polygon.corners().iter().map(|&corner| scene.positions[corner as usize]).collect()
}

#[test]
fn normals_of_a_ball_point_away_from_its_centre_at_any_scale() {
    for (scale, center) in [(1.0, Vec3::ZERO), (1e-6, Vec3::ZERO), (1e6, Vec3::ZERO), (1.0, Vec3::new(5.0, -3.0, 8.0))]
    {
        let scene = sphere(3, scale, center);
        assert!(scene.findings.is_empty(), "{:?}", scene.findings);
        let mut stream = Stream::new(1, 0, 0);
        for (index, polygon) in scene.polygons.iter().enumerate() {
            let [a, b, c] = corners(&scene, polygon)[..] else { panic!("a triangle") };
            for corner in [a, b, c] {
                let normal = scene.shading_normal(index, corner).expect("smooth");
                // Of a coordinate up to 8 at scale 1, rounding leaves 8 · 6e-8 = 5e-7 of an edge of 0.2: 2.4e-6.
                assert!(normal.distance((corner - center) / scale) < 1e-5, "{normal} at {corner}");
            }
            let Vec2 { x, y } = stream.uniform2();
            let (x, y) = if x + y > 1.0 { (1.0 - x, 1.0 - y) } else { (x, y) };
            let point = a + x * (b - a) + y * (c - a);
            let normal = scene.shading_normal(index, point).expect("smooth");
            // On a sphere the interpolated normal is that of the point itself.
            assert!(normal.distance((point - center).normalize()) < 1e-5);
            assert!((normal.length() - 1.0).abs() < 1e-6);
        }
    }
}

#[test]
fn flat_polygons_and_normals_that_say_nothing_have_none() {
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn 0 0 -1\nusemtl white\n";
    for face in ["f 1 2 3 4", "f 1/1 2/2 3/3 4/4", "f 1//1 2//1 3//1 4//1", "f 1//2 2//2 3//2 4//2"] {
        let scene = scene(&format!("{square}{face}\n"), MTL);
        assert_eq!(scene.shading_normal(0, Vec3::new(0.3, 0.4, 0.0)), None, "{face}");
        assert!(scene.normals.is_empty(), "{face}");
    }
}

#[test]
fn normals_are_on_the_side_of_the_front_however_they_are_stated() {
    let ahead = "vn 0.6 0 0.8\nvn -0.6 0 0.8\n";
    let behind = "vn -0.6 0 -0.8\nvn 0.6 0 -0.8\n";
    for normals in [ahead, behind] {
        let text = format!("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n{normals}usemtl white\nf 1//1 2//2 3//2 4//1\n");
        let mut scene = scene(&text, MTL);
        assert!(scene.findings.is_empty(), "{:?}", scene.findings);
        for x in [0.0, 0.25, 0.5, 1.0] {
            for y in [0.0, 0.3, 0.8, 1.0] {
                let expected = Vec3::new(0.6 - 1.2 * x, 0.0, 0.8).normalize();
                let normal = scene.shading_normal(0, Vec3::new(x, y, 0.0)).expect("smooth");
                assert!(normal.distance(expected) < 1e-6, "{normal} at {x} {y}");
            }
        }
        scene.polygons[0] = scene.polygons[0].turned();
        let normal = scene.shading_normal(0, Vec3::new(0.25, 0.5, 0.0)).expect("smooth");
        assert!(normal.distance(-Vec3::new(0.3, 0.0, 0.8).normalize()) < 1e-6, "{normal} after the turn");
    }
}

#[test]
fn normals_follow_their_corners_when_a_face_is_cut() {
    // A bent hexagon, given as one face with a corner twice: each corner's normal is told by its place.
    let mut text = String::new();
    let place = |i: u32| Vec2::from_angle(i as f32 * std::f32::consts::FRAC_PI_3);
    for i in 0..6 {
        let Vec2 { x, y } = place(i);
        let _ = writeln!(text, "v {x} {y} {}\nvn {} {} 1", 0.1 * x * x, 0.2 * x, 0.3 * y);
    }
    let scene = scene(&format!("{text}usemtl white\nf 1//1 2//2 2//2 3//3 4//4 5//5 6//6\n"), MTL);

    assert_eq!(scene.polygons.len(), 4);
    for (index, polygon) in scene.polygons.iter().enumerate() {
        for corner in corners(&scene, polygon) {
            let normal = scene.shading_normal(index, corner).expect("smooth");
            let expected = Vec3::new(0.2 * corner.x, 0.3 * corner.y, 1.0).normalize();
            assert!(normal.distance(expected) < 1e-5, "{normal} at {corner}, not {expected}");
        }
    }
}

#[test]
fn normals_left_out_go_with_their_faces() {
    // The normals of the first face, which has no area, leave no trace.
    let text = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 1 1 0\nvn 1 0 0\nvn 0.1 0 1\nvn 0 0.1 1\nusemtl white\n\
                f 1//1 2//1 3//1\nf 1//2 2//3 4//3\n";
    let scene = scene(text, MTL);
    assert_eq!(scene.normals.len(), 2);
    let normal = scene.shading_normal(0, Vec3::ZERO).expect("smooth");
    assert!(normal.distance(Vec3::new(0.1, 0.0, 1.0).normalize()) < 1e-6);
}
