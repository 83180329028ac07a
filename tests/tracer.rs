//! No ray is lost: at shared edges and vertices, very near a surface, at any scale, along the axes, from far away.

#[path = "common/shapes.rs"]
mod shapes;

use glam::{Quat, Vec3, Vec3A};
use lightwell::math::random::Stream;
use lightwell::math::warp::{cosine_hemisphere, frame};
use lightwell::tracer::{Ray, SurfacePoint, Tracer};
use shapes::{Triangles, cube, placed, sphere};

const SCALES: [f32; 3] = [1e-6, 1.0, 1e6];

fn tracer(triangles: &Triangles) -> Tracer {
    let owned: Vec<_> = triangles.iter().enumerate().map(|(i, &corners)| (i as u32, corners)).collect();
    Tracer::new(&owned)
}

fn toward(origin: Vec3, target: Vec3) -> Ray {
    Ray::new(origin.into(), (target - origin).normalize().into())
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
fn no_ray_from_a_surface_point_leaves_a_closed_mesh_or_meets_its_own_triangle() {
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
                let from = SurfacePoint { point, polygon: index as u32 };
                let hit = tracer.closest(&Ray::leaving(from, direction));
                let hit = hit.unwrap_or_else(|| panic!("a ray left through {index} at scale {scale}"));
                assert_ne!(hit.polygon as usize, index, "a ray met its own triangle at scale {scale}");
                assert!(!hit.is_front, "a ray from inside met an outside at scale {scale}");
            }
        }
    }
}

#[test]
fn surfaces_a_hair_apart_block_each_other() {
    // Rays from the inner one of two shells must all stop at the outer one at once.
    for scale in SCALES {
        let inner = placed(&cube(4), scale, Vec3::ZERO);
        let gap = 1e-4;
        let mut triangles = inner.clone();
        triangles.extend(placed(&cube(4), scale * (1.0 + gap), Vec3::ZERO));
        let tracer = tracer(&triangles);
        let mut stream = Stream::new(3, 0, 0);
        for _ in 0..1 << 18 {
            let index = (stream.bits() % inner.len() as u64) as usize;
            let [a, b, c] = inner[index].map(Vec3A::from);
            let weights = lightwell::math::warp::triangle(stream.uniform2());
            let outward = (b - a).cross(c - a).normalize();
            let point = a + weights.x * (b - a) + weights.y * (c - a);
            let from = SurfacePoint { point, polygon: index as u32 };
            let direction = frame(outward) * cosine_hemisphere(stream.uniform2());
            let hit = tracer.closest(&Ray::leaving(from, direction)).expect("the outer shell is closed");
            assert!(hit.polygon as usize >= inner.len() && !hit.is_front, "scale {scale}: {hit:?}");
            assert!(!tracer.is_unoccluded(from, SurfacePoint::in_space(point + 4.0 * scale * direction)));
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
                let hit = tracer.closest(&Ray::new(Vec3A::splat(0.01), direction.into()));
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
    let sees = |to| tracer.is_unoccluded(SurfacePoint::in_space(from), SurfacePoint::in_space(to));
    assert!(sees(to) && sees(from) && !sees(Vec3A::new(0.1, 3.0, 0.3)));
    let hit = tracer.closest(&Ray::new(from, Vec3A::Y)).expect("the top");
    assert!((hit.distance - 0.8).abs() < 1e-6 && !hit.is_front);
}

#[test]
fn an_empty_scene_stops_nothing() {
    let tracer = tracer(&Vec::new());
    assert!(tracer.closest(&Ray::new(Vec3A::ZERO, Vec3A::X)).is_none());
    assert!(tracer.is_free(&Ray::new(Vec3A::ZERO, Vec3A::X), 1.0));
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

/// A polygon of three or four corners.
type Corners = Vec<Vec3>;

/// A box from `low` to `high`, with its normals outwards, or inwards.
fn block(low: Vec3, high: Vec3, faces_outwards: bool) -> Vec<Corners> {
    let corner =
        |i: usize| Vec3::from_array([0, 1, 2].map(|axis| if i >> axis & 1 == 0 { low[axis] } else { high[axis] }));
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let turned = |face: [usize; 4]| if faces_outwards { [face[0], face[3], face[2], face[1]] } else { face };
    faces.into_iter().map(|face| turned(face).map(corner).to_vec()).collect()
}

/// Two slopes that meet a floor at an acute edge, and gables: the inside of a closed roof of this height.
fn attic(height: f32) -> Vec<Corners> {
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let [a, b, c, d] = [at(-1.0, 0.0, -1.0), at(1.0, 0.0, -1.0), at(1.0, 0.0, 1.0), at(-1.0, 0.0, 1.0)];
    let [e, f] = [at(0.0, height, -1.0), at(0.0, height, 1.0)];
    vec![vec![d, c, b, a], vec![a, e, f, d], vec![b, c, f, e], vec![a, b, e], vec![d, f, c]]
}

/// A tracer of polygons, turned, moved and scaled, and their normals.
fn placed_tracer(polygons: &[Corners], turn: Quat, shift: Vec3, scale: f32) -> (Tracer, Vec<Vec3A>) {
    let mut triangles = Vec::new();
    let mut normals = Vec::new();
    for (polygon, corners) in polygons.iter().enumerate() {
        let corners: Vec<Vec3> = corners.iter().map(|&corner| scale * (turn * corner + shift)).collect();
        for pair in corners[1..].windows(2) {
            triangles.push((polygon as u32, [corners[0], pair[0], pair[1]]));
        }
        let [a, b, c] = [corners[0], corners[1], corners[2]].map(Vec3::as_dvec3);
        normals.push((b - a).cross(c - a).normalize().as_vec3a());
    }
    (Tracer::new(&triangles), normals)
}

/// Walks at random from polygon to polygon, through those from `first_clear` on in one of two cases. Fails if a ray leaves.
fn walk(name: &str, polygons: &[Corners], first_clear: usize, steps: usize) {
    let height = 0.4 * polygons.iter().flatten().map(|corner| corner.y).fold(0.0, f32::max);
    let mut stream = Stream::new(7, 0, polygons.len() as u64);
    let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.3, 1.1, -0.7);
    let shift = Vec3::new(3.0, -5.0, 2.0);
    for (turn, shift) in [(Quat::IDENTITY, Vec3::ZERO), (Quat::IDENTITY, shift), (turn, Vec3::ZERO), (turn, shift)] {
        for scale in SCALES {
            let (tracer, normals) = placed_tracer(polygons, turn, shift, scale);
            let middle = scale * (turn * Vec3::new(0.02, height, 0.02) + shift);
            let mut ray = Ray::new(middle.into(), Vec3A::new(0.3, -0.8, 0.2).normalize());
            for step in 0..steps {
                let Some(hit) = tracer.closest(&ray) else {
                    panic!("{name}, scale {scale}, turned by {turn}, moved by {shift}: step {step} left: {ray:?}");
                };
                let normal = normals[hit.polygon as usize];
                let facing = if hit.is_front { normal } else { -normal };
                let crosses = hit.polygon as usize >= first_clear && stream.uniform() < 0.5;
                let side = if crosses { -facing } else { facing };
                let direction = frame(side) * cosine_hemisphere(stream.uniform2());
                ray = Ray::leaving(hit.surface_point(), direction);
            }
        }
    }
}

#[test]
fn no_walk_leaves_a_closed_room_whatever_clear_things_touch_its_walls() {
    let room = || block(Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 2.0, 1.0), false);
    for gap in [0.0, 1e-9, 1e-8, 6e-8, 1.2e-7, 2.4e-7, 1e-6, 3e-6, 1e-5, 1e-4, -6e-8, -1e-7, -1e-6, -1e-4] {
        let mut polygons = room();
        polygons.extend(block(Vec3::new(-0.5, gap, -0.5), Vec3::new(0.5, 0.6, 0.5), true));
        walk(&format!("a body over the floor by {gap}"), &polygons, 6, 40_000);
        let mut polygons = room();
        polygons.push([[-0.5, -0.5], [-0.5, 0.5], [0.5, 0.5], [0.5, -0.5]].map(|[x, z]| Vec3::new(x, gap, z)).to_vec());
        walk(&format!("a sheet over the floor by {gap}"), &polygons, 6, 40_000);
        let mut polygons = room();
        polygons.extend(block(Vec3::new(-1.0 + gap, gap, -0.5), Vec3::new(0.0, 0.6, 1.0 - gap), true));
        polygons.extend(block(Vec3::new(-0.5, 0.6 + gap, -0.5), Vec3::new(0.5, 2.0 - gap, 0.5), true));
        walk(&format!("bodies in a corner and on each other by {gap}"), &polygons, 6, 40_000);
    }
}

#[test]
fn no_walk_leaves_a_closed_room_through_its_edges() {
    walk("a box", &block(Vec3::new(-1.0, 0.0, -1.0), Vec3::new(1.0, 2.0, 1.0), false), 6, 400_000);
    for height in [1.0, 0.1, 0.01] {
        walk(&format!("an attic of height {height}"), &attic(height), 5, 100_000);
    }
}

#[test]
fn points_of_surfaces_see_each_other_across_the_smallest_gap_and_not_through_what_lies_between() {
    let square = |height: f32| {
        [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]].map(|[x, z]| Vec3::new(x, height, z)).to_vec()
    };
    for gap in [1e-9, 1e-7, 1e-4] {
        // A floor that faces up, a sheet, and a ceiling that faces down.
        let ceiling: Corners = square(gap).into_iter().rev().collect();
        let open = [square(0.0), ceiling.clone()];
        let shut = [square(0.0), ceiling, square(0.5 * gap)];
        for (polygons, is_open) in [(&open[..], true), (&shut[..], false)] {
            let (tracer, _) = placed_tracer(polygons, Quat::IDENTITY, Vec3::ZERO, 1.0);
            let mut stream = Stream::new(8, 0, 0);
            for _ in 0..10_000 {
                let [from, to] = [(0, 0.0), (1, gap)].map(|(polygon, height)| {
                    let at = 1.8 * (stream.uniform2() - 0.5);
                    SurfacePoint { point: Vec3A::new(at.x, height, at.y), polygon }
                });
                assert_eq!(tracer.is_unoccluded(from, to), is_open, "gap {gap}: {from:?} {to:?}");
                let up = Ray::leaving(from, frame(Vec3A::Y) * cosine_hemisphere(stream.uniform2()));
                let expected = if is_open { 1 } else { 2 };
                // Rays that graze may pass below the edge of the ceiling.
                if up.direction.y > 0.1 {
                    assert_eq!(tracer.closest(&up).map(|hit| hit.polygon), Some(expected), "gap {gap}: {up:?}");
                }
            }
        }
    }
}

#[test]
fn from_outside_of_a_convex_body_its_inside_is_not_seen() {
    let shift = Vec3::new(0.3, 0.2, 0.1);
    for scale in SCALES {
        let triangles = placed(&sphere(3), scale, shift);
        let tracer = tracer(&triangles);
        let mut stream = Stream::new(8, 0, 0);
        for _ in 0..400_000 {
            // Towards an edge, from an eye for which it may be a part of the outline.
            let mut pick = || triangles[(stream.bits() % triangles.len() as u64) as usize];
            let ([a, b, c], [over, ..]) = (pick(), pick());
            let beside = 10.0_f32.powf(-7.0 * stream.uniform());
            let eye = scale * shift + 3.0 * (over - scale * shift);
            let ray = toward(eye, a.lerp(b, stream.uniform()).lerp(c, beside));
            let Some(hit) = tracer.closest(&ray) else { continue };
            assert!(hit.is_front, "scale {scale}: {ray:?} meets {hit:?}");
            // Out again, however flatly.
            let [a, b, c] = triangles[hit.polygon as usize].map(Vec3A::from);
            let height = 10.0_f32.powf(-6.0 * stream.uniform());
            let along = (b - a).normalize() * (stream.uniform() - 0.5) + (c - a).normalize() * (stream.uniform() - 0.5);
            let out = (height * (b - a).cross(c - a).normalize() + along).normalize();
            let next = tracer.closest(&Ray::leaving(hit.surface_point(), out));
            assert_eq!(next, None, "scale {scale}: out of {hit:?} to {out}, {height} high");
        }
    }
}
