//! Mirrors, glass and gloss against the laws of optics.

mod bodies;
mod boundaries;
mod leaks;
mod lenses;
mod lobes;
mod materials;
mod mirrors;
mod normals;
#[path = "../common/shapes.rs"]
mod shapes;

use glam::{Vec3, Vec3A};
use lightwell::cancel::Cancel;
use lightwell::effects::Switches;
use lightwell::math::random::Stream;
use lightwell::mesh::MeshSettings;
use lightwell::methods::transport::{Media, Surface, Transport};
use lightwell::scene::Scene;
use lightwell::tracer::Ray;
use lightwell::world::World;
use std::fmt::Write;
use std::sync::Arc;

/// A scene from OBJ and MTL text.
fn scene(obj: &str, mtl: &str) -> Scene {
    Scene::from_text("scene", &format!("mtllib all\n{obj}"), mtl).expect("the scene opens")
}

/// The same, ready for rays. No scene here has a light, so that none calls for what glass does.
fn transport(obj: &str, mtl: &str) -> Transport {
    let world = World::build(scene(obj, mtl), &MeshSettings::default(), &Cancel::default()).expect("a world");
    Transport::new(Arc::new(world), Switches::ALL)
}

/// OBJ text of triangles, which are one object of one material.
fn object(name: &str, material: &str, triangles: &[[Vec3; 3]]) -> String {
    let mut text = format!("o {name}\nusemtl {material}\n");
    for corner in triangles.iter().flatten() {
        let _ = writeln!(text, "v {} {} {}", corner.x, corner.y, corner.z);
    }
    for face in 0..triangles.len() {
        let first = 3 * (face as i64 - triangles.len() as i64);
        let _ = writeln!(text, "f {} {} {}", first, first + 1, first + 2);
    }
    text
}

/// OBJ text of a ball round the origin with the normals of a sphere, as `8 · 4^depth` triangles.
fn smooth_ball(name: &str, material: &str, depth: u32, radius: f32) -> String {
    let mut text = format!("o {name}\nusemtl {material}\n");
    for triangle in shapes::sphere(depth) {
        for normal in triangle {
            let corner = radius * normal;
            let _ = writeln!(text, "v {} {} {}", corner.x, corner.y, corner.z);
            let _ = writeln!(text, "vn {} {} {}", normal.x, normal.y, normal.z);
        }
        text += "f -3//-3 -2//-2 -1//-1\n";
    }
    text
}

/// Triangles wound the other way.
fn turned(triangles: &[[Vec3; 3]]) -> Vec<[Vec3; 3]> {
    triangles.iter().map(|&[a, b, c]| [a, c, b]).collect()
}

/// A place on the plane z = 0, met from above; the smooth surface is as flat.
fn plane() -> Surface {
    Surface {
        polygon: 0,
        is_front: true,
        distance: 1.0,
        point: Vec3A::ZERO,
        facing: Vec3A::Z,
        normal: Vec3A::Z,
        material: 0,
    }
}

/// Unit vector at an angle to z, radians.
fn slanted(angle: f32) -> Vec3A {
    Vec3A::new(angle.sin(), 0.0, angle.cos())
}

/// The ray that goes on through the next surface, its media, and the narrowing of its radiance there.
fn go_through(transport: &Transport, ray: &Ray, media: Media, stream: &mut Stream) -> (Ray, Media, f32) {
    let surface = transport.meet(ray).expect("a surface");
    let bsdf = transport.bsdf(&surface, -ray.direction, &media);
    let samples = (0..10_000).filter_map(|_| bsdf.sample(Vec3::ONE, stream));
    let through = samples.into_iter().find(|sample| sample.crosses).expect("some of it goes through");
    (transport.leave(&surface, through.direction), media.across(&surface), through.narrowing)
}
