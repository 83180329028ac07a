//! Pictures: every pixel has the radiance that it should have. Needs a graphics adapter; one in software will do.

mod device;
mod exposure;
mod images;
mod outlines;
mod photons;
mod picking;
mod radiance;
mod views;

use glam::{DVec3, Vec2, Vec3};
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::{Element, MeshSettings};
use lightwell::scene::{Material, Polygon, Scene, Source, Viewpoint};
use lightwell::solution::{Closure, Counters, ElementLight, Energy, PathFilter, Solution};
use lightwell::viewport::{AdapterChoice, Frame, Gpu, Light, PhotonLook, Picture, ToneCurve, View};
use lightwell::world::World;
use std::sync::Arc;
use std::time::Duration;

/// Rounding to a half float, which has 11 bits, and a little of single precision before and after.
const HALF_ROUNDING: f32 = 1.01 / 2048.0;
/// Graphics adapters round positions in a picture to 1/256 pixel; two of them make an edge.
const SNAP: f32 = 2.0 / 256.0;

/// A device, or nothing where there is none; with `REQUIRE_GPU=1` that is a failure.
fn gpu() -> Option<Gpu> {
    match Gpu::new(&AdapterChoice::System) {
        Ok(gpu) => Some(gpu),
        Err(error) if std::env::var("REQUIRE_GPU").is_ok_and(|value| value == "1") => panic!("{error}"),
        Err(error) => {
            println!("skipped: {error}");
            None
        }
    }
}

/// A square of 2 x 2 in the plane z = 0, or half of it, with its front to a camera on the z axis. It is an emitter, because
/// only what light reaches has elements.
fn plane(corners: &[u32], scale: f32, offset: Vec3) -> Arc<World> {
    build(plane_scene(corners, scale, offset), 0.5 * scale)
}

fn plane_scene(corners: &[u32], scale: f32, offset: Vec3) -> Scene {
    let place = |x: f32, y: f32, z: f32| offset + scale * Vec3::new(x, y, z);
    Scene {
        name: "plane".to_owned(),
        source: Source::Builtin("plane"),
        origin: DVec3::ZERO,
        positions: vec![place(-1.0, -1.0, 0.0), place(1.0, -1.0, 0.0), place(1.0, 1.0, 0.0), place(-1.0, 1.0, 0.0)],
        normals: Vec::new(),
        polygons: vec![Polygon::new(corners, 0, 0, 0)],
        materials: vec![Material { emission: Rgb::ONE, ..Material::grey("glow") }],
        objects: vec!["plane".to_owned()],
        viewpoint: Some(Viewpoint {
            eye: place(0.0, 0.0, 3.0),
            target: place(0.0, 0.0, 0.0),
            up: Vec3::Y,
            vertical_fov: 45.0,
        }),
        findings: Vec::new(),
    }
}

fn square() -> Arc<World> {
    plane(&[0, 1, 2, 3], 1.0, Vec3::ZERO)
}

fn build(scene: Scene, element_size: f32) -> Arc<World> {
    build_in_patches(scene, element_size, MeshSettings::default().elements_per_patch_edge)
}

fn build_in_patches(scene: Scene, element_size: f32, elements_per_patch_edge: u32) -> Arc<World> {
    let settings = MeshSettings { element_size: Some(element_size), elements_per_patch_edge };
    Arc::new(World::build(scene, &settings, &Cancel::default()).expect("a world"))
}

/// A solution in which the radiosity of element i is `radiosity(i)`, and a fifth of it is unshot.
fn solution(world: &World, radiosity: impl Fn(usize) -> Rgb) -> Solution {
    let radiosity: Vec<Rgb> = (0..world.mesh.elements.len()).map(radiosity).collect();
    Solution {
        steps: 1,
        elapsed: Duration::ZERO,
        converged: false,
        energy: Energy::default(),
        closure: Closure::default(),
        counters: Counters::default(),
        shooter: Some(0),
        light: ElementLight {
            irradiance: radiosity.clone(),
            direct: radiosity.clone(),
            unshot: radiosity.iter().map(|&value| 0.2 * value).collect(),
            radiosity,
        },
        ..Solution::default()
    }
}

fn light(solution: &Solution) -> Light {
    solution.clone().into()
}

/// Different in every element and channel.
fn motley(element: usize) -> Rgb {
    let i = element as f32;
    Rgb::new(1.0 + i, 40.0 - i, 3.0 + (7.0 * i) % 11.0)
}

/// A size whose rows are not what graphics adapters copy without padding.
const SIZE: [u32; 2] = [119, 83];

fn frame(world: &World, view: View) -> Frame {
    Frame {
        camera: Camera::new(&world.viewpoint, &world.bounds),
        size: SIZE,
        view,
        bounce: 0,
        ambient: false,
        wireframe: false,
        show_shooter: false,
        photons: PhotonLook::default(),
        filter: PathFilter::default(),
        exposure_ev: -3.0,
        tone: ToneCurve::Filmic,
    }
}

fn pixel(picture: &Picture, x: u32, y: u32) -> [f32; 4] {
    picture.linear[(y * picture.size[0] + x) as usize]
}

fn pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)))
}

/// Where the middle of a pixel meets the plane z = 0, and the size of a pixel there, in the units of [`square`].
fn on_plane(x: u32, y: u32) -> (Vec2, f32) {
    let pixel = 2.0 * 3.0 * (22.5_f32).to_radians().tan() / SIZE[1] as f32;
    let from_middle = Vec2::new(x as f32 + 0.5 - 0.5 * SIZE[0] as f32, 0.5 * SIZE[1] as f32 - y as f32 - 0.5);
    (pixel * from_middle, pixel)
}

fn corners(world: &World, element: &Element) -> Vec<Vec2> {
    element.corners().iter().map(|&corner| world.mesh.vertices[corner as usize].truncate()).collect()
}

/// Distance from `point` to the outline of a polygon that runs counter-clockwise: positive inside.
fn depth_inside(corners: &[Vec2], point: Vec2) -> f32 {
    let edge = |i: usize| {
        let (from, to) = (corners[i], corners[(i + 1) % corners.len()]);
        (to - from).normalize().perp_dot(point - from)
    };
    (0..corners.len()).map(edge).fold(f32::INFINITY, f32::min)
}

/// The element on the front of the plane that holds all of the pixel, with a margin.
fn element_at(world: &World, x: u32, y: u32) -> Option<usize> {
    let (point, pixel) = on_plane(x, y);
    let faces_camera = |element: &Element| world.mesh.patches[element.patch as usize].normal.z > 0.0;
    let holds =
        |element: &Element| faces_camera(element) && depth_inside(&corners(world, element), point) > 0.8 * pixel;
    world.mesh.elements.iter().position(holds)
}
