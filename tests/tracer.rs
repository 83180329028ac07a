//! No ray is lost: at shared edges and vertices, very near a surface, at any scale, along the axes, from far away.

#[path = "common/shapes.rs"]
mod shapes;

use glam::{Vec3, Vec3A};
use lightwell::math::random::Stream;
use lightwell::math::warp::{cosine_hemisphere, frame};
use lightwell::tracer::{Ray, Tracer};
use shapes::{Triangles, cube, placed, sphere};

const SCALES: [f32; 3] = [1e-6, 1.0, 1e6];

fn tracer(triangles: &Triangles) -> Tracer {
    let owned: Vec<_> = triangles.iter().enumerate().map(|(i, &corners)| (i as u32, corners)).collect();
    Tracer::new(&owned)
}

fn toward(origin: Vec3, target: Vec3) -> Ray {
    Ray { origin: origin.into(), direction: (target - origin).normalize().into() }
}

/// A random point inside the unit ball, scaled and moved like the mesh.
fn inside(stream: &mut Stream, scale: f32, shift: Vec3) -> Vec3 {
    let point = Vec3::new(stream.uniform(), stream.uniform(), stream.uniform()) - 0.5;
    scale * (point + shift)
}

#[test]
fn a_million_rays_at_edges_and_vertices_all_hit() {
    let shift = Vec3::new(0.25, -0.5, 0.125);
    for mesh in [sphere(4), cube(8)] {
        for scale in SCALES {
            let triangles = placed(&mesh, scale, shift);
            let tracer = tracer(&triangles);
            let mut stream = Stream::new(1, 0, 0);
            let rays = (1 << 20) / (2 * SCALES.len());
            let mut lost = 0;
            for i in 0..rays {
                let corners = triangles[(stream.bits() % triangles.len() as u64) as usize];
                let first = (stream.bits() % 3) as usize;
                let (a, b) = (corners[first], corners[(first + 1) % 3]);
                let target = if i % 4 == 0 { a } else { a.lerp(b, stream.uniform()) };
                let ray = toward(inside(&mut stream, scale, shift), target);
                lost += u32::from(tracer.closest(&ray).is_none());
            }
            assert_eq!(lost, 0, "of {rays} rays at scale {scale}");
        }
    }
}

#[test]
fn no_ray_from_a_lifted_surface_point_leaves_a_closed_mesh_or_meets_its_own_triangle() {
    let shift = Vec3::new(0.25, -0.5, 0.125);
    for mesh in [sphere(4), cube(8)] {
        for scale in SCALES {
            let triangles = placed(&mesh, scale, shift);
            let tracer = tracer(&triangles);
            let mut stream = Stream::new(2, 0, 0);
            let rays = (1 << 20) / (2 * SCALES.len());
            for _ in 0..rays {
                let index = (stream.bits() % triangles.len() as u64) as usize;
                let [a, b, c] = triangles[index].map(Vec3A::from);
                let weights = lightwell::math::warp::triangle(stream.uniform2());
                let point = a + weights.x * (b - a) + weights.y * (c - a);
                let inward = -(b - a).cross(c - a).normalize();
                let direction = frame(inward) * cosine_hemisphere(stream.uniform2());
                let hit = tracer.closest(&Ray { origin: tracer.lift(point, inward), direction });
                let hit = hit.unwrap_or_else(|| panic!("a ray left through {index} at scale {scale}"));
                assert_ne!(hit.polygon as usize, index, "a ray met its own triangle at scale {scale}");
                assert!(!hit.is_front, "a ray from inside met an outside at scale {scale}");
            }
        }
    }
}

#[test]
fn surfaces_a_hair_apart_block_each_other() {
    // Two shells whose gap is a few times the lift: rays from the inner one must all stop at the outer one at once.
    for scale in SCALES {
        let inner = placed(&cube(4), scale, Vec3::ZERO);
        let gap = 1e-4;
        let mut triangles = inner.clone();
        triangles.extend(placed(&cube(4), scale * (1.0 + gap), Vec3::ZERO));
        let tracer = tracer(&triangles);
        assert!(tracer.offset() * 4.0 < gap * scale);
        let mut stream = Stream::new(3, 0, 0);
        for _ in 0..1 << 18 {
            let index = (stream.bits() % inner.len() as u64) as usize;
            let [a, b, c] = inner[index].map(Vec3A::from);
            let weights = lightwell::math::warp::triangle(stream.uniform2());
            let outward = (b - a).cross(c - a).normalize();
            let origin = tracer.lift(a + weights.x * (b - a) + weights.y * (c - a), outward);
            let direction = frame(outward) * cosine_hemisphere(stream.uniform2());
            let hit = tracer.closest(&Ray { origin, direction }).expect("the outer shell is closed");
            assert!(hit.polygon as usize >= inner.len() && !hit.is_front, "scale {scale}: {hit:?}");
            assert!(!tracer.is_visible(origin, origin + 4.0 * scale * direction));
        }
    }
}

#[test]
fn rays_along_the_axes_hit_with_either_sign_of_zero() {
    let tracer = tracer(&cube(3));
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        for direction in [axis, -axis] {
            for zero in [0.0_f32, -0.0] {
                let direction = Vec3::from_array(direction.to_array().map(|x| if x == 0.0 { zero } else { x }));
                let hit = tracer.closest(&Ray { origin: Vec3A::splat(0.01), direction: direction.into() });
                let distance = hit.unwrap_or_else(|| panic!("no hit along {direction}")).distance;
                assert!((distance - (1.0 - 0.01 * direction.element_sum())).abs() < 1e-5, "{direction}: {distance}");
            }
        }
    }
}

#[test]
fn rays_from_far_away_hit_what_they_are_aimed_at() {
    let tracer = tracer(&placed(&sphere(5), 1.0, Vec3::ZERO));
    let mut stream = Stream::new(4, 0, 0);
    for _ in 0..200_000 {
        let eye = 1e5 * (Vec3::new(stream.uniform(), stream.uniform(), stream.uniform()) - 0.5).normalize();
        // Aimed well inside the sphere: the rounding of a direction, 6e-8, moves a ray by 6e-3 at this distance.
        let ray = toward(eye, inside(&mut stream, 1.0, Vec3::ZERO));
        let hit = tracer.closest(&ray).expect("a hit");
        assert!(hit.is_front && (hit.distance - eye.length()).abs() < 2.0);
    }
}

#[test]
fn distance_and_visibility_agree_with_geometry() {
    let tracer = tracer(&cube(2));
    let (from, to) = (Vec3A::new(0.1, 0.2, 0.3), Vec3A::new(-0.5, 0.7, -0.9));
    assert!(tracer.is_visible(from, to) && tracer.is_visible(from, from));
    assert!(!tracer.is_visible(from, Vec3A::new(0.1, 3.0, 0.3)));
    let hit = tracer.closest(&Ray { origin: from, direction: Vec3A::Y }).expect("the top");
    assert!((hit.distance - 0.8).abs() < 1e-6 && !hit.is_front);
}

#[test]
fn an_empty_scene_stops_nothing() {
    let tracer = tracer(&Vec::new());
    assert!(tracer.closest(&Ray { origin: Vec3A::ZERO, direction: Vec3A::X }).is_none());
    assert!(tracer.is_visible(Vec3A::ZERO, Vec3A::ONE));
}

#[test]
fn a_limited_ray_meets_what_is_within_its_reach_and_nothing_beyond() {
    for scale in SCALES {
        let square = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| scale * Vec3::new(x, y, 0.0));
        let tracer = tracer(&vec![[square[0], square[1], square[2]], [square[0], square[2], square[3]]]);
        // From near by, and from so far away that the ray is begun anew before the scene.
        for distance in [0.5, 100.0] {
            let ray = toward(scale * Vec3::new(0.1, 0.2, distance), scale * Vec3::new(0.1, 0.2, 0.0));
            for (reach, is_met) in [(0.99, false), (1.01, true), (f32::INFINITY, true)] {
                let reach = reach * scale * distance;
                assert_eq!(tracer.closest_within(&ray, reach).is_some(), is_met, "{scale} {distance} {reach}");
                if distance < 1.0 {
                    assert_eq!(tracer.is_free(&ray, reach), !is_met, "{scale} {reach}");
                }
            }
        }
    }
}
