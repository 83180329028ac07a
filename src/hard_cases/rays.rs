//! Rays that are easily lost: at edges and corners, right at their own surface, along the axes, from far away.

use super::row::exactly;
use super::stage::Stage;
use super::{Case, Rows};
use crate::cancel::Cancelled;
use crate::math::random::Stream;
use crate::math::warp::{cosine_hemisphere, frame, triangle};
use crate::tracer::{Ray, SurfacePoint, Tracer};
use glam::{DMat3, DVec3, Vec3, Vec3A};

pub const CASES: &[Case] = &[
    Case {
        name: "shared-edges",
        about: "rays aimed exactly at edges and corners that triangles of a closed surface share",
        measure: shared_edges,
        scene: || glowing_sphere().show("shared-edges"),
    },
    Case {
        name: "own-surface",
        about: "rays that start on a surface and must not meet it at once",
        measure: own_surface,
        scene: || glowing_sphere().show("own-surface"),
    },
    Case {
        name: "near-shells",
        about: "a shell round another, a ten-thousandth of their size away, that stops every ray",
        measure: near_shells,
        scene: || None,
    },
    Case {
        name: "axis-rays",
        about: "rays along the axes, whose other components are 0 or −0",
        measure: axis_rays,
        scene: || glowing_sphere().show("axis-rays"),
    },
    Case {
        name: "far-eye",
        about: "rays from a hundred thousand times the scene's size away",
        measure: far_eye,
        scene: || glowing_sphere().show("far-eye"),
    },
];

const OWN: &str =
    "a ray never meets the polygon that it leaves, and double precision decides what it meets right before it";

const RAYS: u32 = 50_000;

type Triangles = Vec<[DVec3; 3]>;

/// A unit sphere of 8 · 4⁴ triangles with their fronts inside, turned so that no edge is along an axis.
fn sphere() -> Triangles {
    let mut triangles = Triangles::new();
    for x in [DVec3::X, DVec3::NEG_X] {
        for y in [DVec3::Y, DVec3::NEG_Y] {
            for z in [DVec3::Z, DVec3::NEG_Z] {
                let inward = x.cross(y).dot(z) < 0.0;
                triangles.push(if inward { [x, y, z] } else { [x, z, y] });
            }
        }
    }
    for _ in 0..4 {
        triangles = triangles.into_iter().flat_map(quarters).collect();
    }
    let turn = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, 0.7, 1.1);
    triangles.iter().map(|corners| corners.map(|corner| turn * corner)).collect()
}

/// A triangle of the unit sphere cut at the middles of its edges.
fn quarters([a, b, c]: [DVec3; 3]) -> [[DVec3; 3]; 4] {
    let [ab, bc, ca] = [a + b, b + c, c + a].map(DVec3::normalize);
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

fn glowing_sphere() -> Stage {
    sphere().iter().fold(Stage::new().object("sphere", 0.5, 0.2), |stage, corners| stage.face(corners))
}

fn tracer(triangles: &Triangles, scale: f64) -> Tracer {
    let single = |corners: &[DVec3; 3]| corners.map(|corner| (scale * corner).as_vec3());
    let owned: Vec<_> = triangles.iter().zip(0..).map(|(corners, index)| (index, single(corners))).collect();
    Tracer::new(&owned)
}

/// A random point of the cube [−½, ½]³.
fn point_of_cube(stream: &mut Stream) -> Vec3 {
    Vec3::new(stream.uniform(), stream.uniform(), stream.uniform()) - 0.5
}

/// A ray that leaves a random point of a triangle on its front in a random direction.
fn leaving(triangles: &Triangles, index: usize, stream: &mut Stream) -> Ray {
    let [a, b, c] = triangles[index].map(|corner| corner.as_vec3a());
    let normal = (b - a).cross(c - a).normalize();
    let weights = triangle(stream.uniform2());
    let point = a + weights.x * (b - a) + weights.y * (c - a);
    let from = SurfacePoint { point, polygon: index as u32 };
    Ray::leaving(from, frame(normal) * cosine_hemisphere(stream.uniform2()))
}

fn toward(origin: Vec3, target: Vec3) -> Ray {
    Ray::new(origin.into(), (target - origin).normalize().into())
}

fn shared_edges(rows: &mut Rows) -> Result<(), Cancelled> {
    let triangles = sphere();
    let guard =
        "watertight triangles (neighbours compute the same number for an edge, and 0 is inside) in padded boxes";
    for scale in [1e-6, 1.0, 1e6] {
        let tracer = tracer(&triangles, scale);
        let mut stream = Stream::new(1, 0, 0);
        let lost = (0..RAYS).filter(|i| {
            let corners = triangles[(stream.bits() % triangles.len() as u64) as usize];
            let first = (stream.bits() % 3) as usize;
            let [a, b] = [corners[first], corners[(first + 1) % 3]].map(|corner| (scale * corner).as_vec3());
            // Every fourth at a corner.
            let target = if i % 4 == 0 { a } else { a.lerp(b, stream.uniform()) };
            let eye = scale as f32 * point_of_cube(&mut stream);
            tracer.closest(&toward(eye, target)).is_none()
        });
        rows.check(
            format!("rays lost at edges and corners, size {scale:.0e}"),
            lost.count() as f64,
            exactly(0.0),
            guard,
        );
    }
    Ok(())
}

fn own_surface(rows: &mut Rows) -> Result<(), Cancelled> {
    let triangles = sphere();
    let tracer = tracer(&triangles, 1.0);
    let mut stream = Stream::new(2, 0, 0);
    let (mut own, mut lost) = (0, 0);
    for _ in 0..RAYS {
        let index = (stream.bits() % triangles.len() as u64) as usize;
        let hit = tracer.closest(&leaving(&triangles, index, &mut stream));
        lost += u32::from(hit.is_none());
        own += u32::from(hit.is_some_and(|hit| hit.polygon as usize == index));
    }
    rows.check("rays that meet the triangle they leave", f64::from(own), exactly(0.0), OWN);
    rows.check("rays that leave a closed surface", f64::from(lost), exactly(0.0), OWN);
    Ok(())
}

fn near_shells(rows: &mut Rows) -> Result<(), Cancelled> {
    let inner: Triangles = sphere().into_iter().map(|[a, b, c]| [a, c, b]).collect();
    let outer = sphere();
    let mut both = inner.clone();
    both.extend(outer.iter().map(|corners| corners.map(|corner| 1.0001 * corner)));
    let tracer = tracer(&both, 1.0);
    let mut stream = Stream::new(3, 0, 0);
    let stray = (0..RAYS).filter(|_| {
        let index = (stream.bits() % inner.len() as u64) as usize;
        let hit = tracer.closest(&leaving(&inner, index, &mut stream));
        hit.is_none_or(|hit| (hit.polygon as usize) < inner.len() || !hit.is_front)
    });
    rows.check("rays that pass the outer shell", stray.count() as f64, exactly(0.0), OWN);
    Ok(())
}

fn axis_rays(rows: &mut Rows) -> Result<(), Cancelled> {
    let tracer = tracer(&sphere(), 1.0);
    let mut stream = Stream::new(4, 0, 0);
    let axes = [Vec3A::X, Vec3A::Y, Vec3A::Z, Vec3A::NEG_X, Vec3A::NEG_Y, Vec3A::NEG_Z];
    let lost = (0..RAYS).filter(|_| {
        let random = stream.bits();
        let zero = if random & 1 == 0 { 0.0 } else { -0.0 };
        let axis = axes[(random >> 8) as usize % 6];
        let direction = Vec3A::from_array(axis.to_array().map(|x| if x == 0.0 { zero } else { x }));
        tracer.closest(&Ray::new(point_of_cube(&mut stream).into(), direction)).is_none()
    });
    let guard = "adding 0 turns −0 into +0 before the boxes take its sign";
    rows.check("rays along the axes that are lost", lost.count() as f64, exactly(0.0), guard);
    Ok(())
}

fn far_eye(rows: &mut Rows) -> Result<(), Cancelled> {
    let tracer = tracer(&sphere(), 1.0);
    let mut stream = Stream::new(5, 0, 0);
    let lost = (0..RAYS).filter(|_| {
        let eye = 1e5 * point_of_cube(&mut stream).normalize();
        // Well inside: a direction's rounding of 6e-8 moves a ray by 6e-3 at this distance. From outside, what is near
        // shows its back.
        tracer.closest(&toward(eye, point_of_cube(&mut stream))).is_none_or(|hit| hit.is_front)
    });
    let guard = "rays skip ahead to the scene before any box is tested";
    rows.check("rays from afar that miss what is nearest", lost.count() as f64, exactly(0.0), guard);
    Ok(())
}
