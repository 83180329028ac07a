//! Closed rooms whose light is known.

use glam::{Quat, Vec3};
use lightwell::math::rgb::Rgb;
use lightwell::scene::{Material, Polygon, Scene};

/// The built-in furnace, a closed unit cube that glows alike on all sides and reflects this much: M_e = 1 W/m².
pub fn furnace(reflectance: f32) -> Scene {
    let mut scene = Scene::open("furnace").expect("a built-in scene");
    for material in &mut scene.materials {
        material.diffuse = Rgb::splat(reflectance);
    }
    scene
}

/// E = M_e / (1 − ρ), W/m² in each channel: B = M_e + ρ E, and B = E where light is the same everywhere.
pub fn furnace_irradiance(reflectance: f32) -> f64 {
    1.0 / (1.0 - f64::from(reflectance))
}

/// Adds polygons of one material.
pub fn add(scene: &mut Scene, material: u32, polygons: &[Vec<Vec3>]) {
    for corners in polygons {
        let first = scene.positions.len() as u32;
        scene.positions.extend(corners);
        let indices: Vec<u32> = (first..first + corners.len() as u32).collect();
        scene.polygons.push(Polygon::new(&indices, material, 0, 0));
    }
}

/// Adds a material of its own; returns its index.
pub fn add_material(scene: &mut Scene, material: Material) -> u32 {
    scene.materials.push(material);
    scene.materials.len() as u32 - 1
}

/// A perfect mirror.
pub fn mirror() -> Material {
    Material { diffuse: Rgb::ZERO, specular: Rgb::ONE, illumination_model: Some(5), ..Material::grey("mirror") }
}

/// Clear glass.
pub fn glass() -> Material {
    Material {
        diffuse: Rgb::ZERO,
        specular: Rgb::ONE,
        refraction_index: 1.5,
        illumination_model: Some(7),
        ..Material::grey("glass")
    }
}

/// A square of this edge, turned and moved; its front looks along the turned z.
pub fn square(edge: f32, turn: Quat, center: Vec3) -> Vec<Vec3> {
    let corner = |x: f32, y: f32| turn * (0.5 * edge * Vec3::new(x, y, 0.0)) + center;
    vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]
}

/// The sides and the top of a box that stands on the floor, turned about y. Fronts look outwards.
pub fn block(center: Vec3, half: Vec3, angle: f32) -> Vec<Vec<Vec3>> {
    let turn = Quat::from_rotation_y(angle);
    let at = |x: f32, y: f32, z: f32| center + turn * (Vec3::new(x, y, z) * half);
    let plan = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let wall = |i: usize| {
        let ((x, z), (next_x, next_z)) = (plan[i], plan[(i + 1) % 4]);
        vec![at(x, -1.0, z), at(next_x, -1.0, next_z), at(next_x, 1.0, next_z), at(x, 1.0, z)]
    };
    let top = plan.map(|(x, z)| at(x, 1.0, z)).to_vec();
    (0..4).map(wall).chain([top]).collect()
}

/// A globe of this radius in so many rings of triangles; fronts look outwards.
pub fn globe(radius: f32, center: Vec3, rings: u32) -> Vec<Vec<Vec3>> {
    use std::f32::consts::PI;
    let at = |ring: u32, slice: u32| {
        let (down, round) = (PI * ring as f32 / rings as f32, PI * (slice % (2 * rings)) as f32 / rings as f32);
        center + radius * Vec3::new(down.sin() * round.sin(), down.cos(), down.sin() * round.cos())
    };
    let mut triangles = Vec::new();
    for (ring, slice) in (0..rings).flat_map(|ring| (0..2 * rings).map(move |slice| (ring, slice))) {
        let [a, b, c, d] = [at(ring, slice), at(ring + 1, slice), at(ring + 1, slice + 1), at(ring, slice + 1)];
        if ring + 1 < rings {
            triangles.push(vec![a, b, c]);
        }
        if ring > 0 {
            triangles.push(vec![a, c, d]);
        }
    }
    triangles
}
