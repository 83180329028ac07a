//! Pictures: every pixel has the radiance that it should have. Needs a graphics adapter; one in software will do.

use glam::{Vec2, Vec3};
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::math::rgb::Rgb;
use lightwell::mesh::{Element, MeshSettings};
use lightwell::methods::radiosity::Radiosity;
use lightwell::methods::{Method, Settings, Step};
use lightwell::scene::{Material, Polygon, Scene, Source, Viewpoint};
use lightwell::solution::{Closure, Counters, ElementLight, Energy, Solution};
use lightwell::viewport::{
    AdapterChoice, Frame, Gpu, GpuError, Picture, ToneCurve, View, Viewport, automatic_exposure, render_picture,
};
use lightwell::world::World;
use std::f32::consts::PI;
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
fn plane(corners: &[u32], scale: f32, offset: Vec3) -> World {
    build(plane_scene(corners, scale, offset), 0.5 * scale)
}

fn plane_scene(corners: &[u32], scale: f32, offset: Vec3) -> Scene {
    let place = |x: f32, y: f32, z: f32| offset + scale * Vec3::new(x, y, z);
    Scene {
        name: "plane".to_owned(),
        source: Source::Builtin("plane"),
        positions: vec![place(-1.0, -1.0, 0.0), place(1.0, -1.0, 0.0), place(1.0, 1.0, 0.0), place(-1.0, 1.0, 0.0)],
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

fn square() -> World {
    plane(&[0, 1, 2, 3], 1.0, Vec3::ZERO)
}

fn build(scene: Scene, element_size: f32) -> World {
    let settings = MeshSettings { element_size: Some(element_size) };
    World::build(scene, &settings, &Cancel::default()).expect("a world")
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
            unshot: radiosity.iter().map(|&value| 0.2 * value).collect(),
            radiosity,
        },
    }
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
        wireframe: false,
        show_shooter: false,
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

fn assert_near(found: [f32; 4], radiance: Rgb, tolerance: impl Fn(f32) -> f32, place: &str) {
    for channel in 0..3 {
        let error = (found[channel] - radiance[channel]).abs();
        assert!(error <= tolerance(radiance[channel]), "{place}: {found:?}, not {radiance}");
    }
    assert_eq!(found[3], 1.0, "{place} is covered");
}

#[test]
fn every_pixel_of_the_constant_views_has_the_radiance_of_its_element() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let solution = solution(&world, motley);
    let radiance = |radiosity: Rgb| radiosity / PI;
    for (view, values) in [(View::Patches, &solution.light.radiosity), (View::Unshot, &solution.light.unshot)] {
        let picture = render_picture(&gpu, &world, &solution, &frame(&world, view), 4).expect("a picture");
        let mut checked = 0;
        for (x, y) in pixels() {
            if let Some(element) = element_at(&world, x, y) {
                let expected = radiance(values[element]);
                assert_near(pixel(&picture, x, y), expected, |value| HALF_ROUNDING * value, &format!("{x} {y}"));
                checked += 1;
            } else if on_plane(x, y).0.abs().max_element() > 1.0 + 0.8 * on_plane(x, y).1 {
                assert_eq!(pixel(&picture, x, y), [0.0; 4], "{x} {y} is background");
            }
        }
        assert!(checked > 1500, "{checked} pixels in {} elements", world.mesh.elements.len());
    }
}

#[test]
fn the_smooth_view_is_linear_over_triangles_and_bilinear_over_quads() {
    let Some(gpu) = gpu() else { return };
    for polygon in [&[0, 1, 2, 3][..], &[0, 1, 2], &[1, 2, 3]] {
        let world = plane(polygon, 1.0, Vec3::ZERO);
        let solution = solution(&world, motley);
        let mut at_vertices = Vec::new();
        world.mesh.smooth(&solution.light.radiosity, &mut at_vertices);
        let picture = render_picture(&gpu, &world, &solution, &frame(&world, View::Smooth), 4).expect("a picture");
        let mut checked = 0;
        for (x, y) in pixels() {
            let Some(element) = element_at(&world, x, y).map(|index| &world.mesh.elements[index]) else { continue };
            let (point, size) = on_plane(x, y);
            let corners = corners(&world, element);
            let values: Vec<Rgb> = element.corners().iter().map(|&v| at_vertices[v as usize] / PI).collect();
            let per_pixel = size * steepest(&corners, &values);
            let tolerance = |value: f32| HALF_ROUNDING * value + SNAP * per_pixel;
            assert_near(pixel(&picture, x, y), interpolated(&corners, &values, point), tolerance, &format!("{x} {y}"));
            checked += 1;
        }
        assert!(checked > 600, "{checked} pixels");
    }
}

/// Parallelogram or triangle coordinates of `point` from the first corner, then the mean of the corners' values.
fn interpolated(corners: &[Vec2], values: &[Rgb], point: Vec2) -> Rgb {
    let (along, across) = (corners[1] - corners[0], corners[corners.len() - 1] - corners[0]);
    let determinant = along.perp_dot(across);
    let u = (point - corners[0]).perp_dot(across) / determinant;
    let v = along.perp_dot(point - corners[0]) / determinant;
    match values {
        [a, b, c] => a * (1.0 - u - v) + b * u + c * v,
        [a, b, c, d] => a.lerp(*b, u).lerp(d.lerp(*c, u), v),
        _ => unreachable!("elements have three or four corners"),
    }
}

/// Largest change of a value for one unit of length, in any channel.
fn steepest(corners: &[Vec2], values: &[Rgb]) -> f32 {
    let largest = values.iter().copied().fold(Rgb::NEG_INFINITY, Rgb::max);
    let smallest = values.iter().copied().fold(Rgb::INFINITY, Rgb::min);
    let shortest = corners.iter().zip(&corners[1..]).map(|(a, b)| a.distance(*b)).fold(f32::INFINITY, f32::min);
    (largest - smallest).max_element() / shortest
}

#[test]
fn a_closed_room_is_seen_into_from_outside() {
    let Some(gpu) = gpu() else { return };
    let world = build(Scene::open("furnace").expect("a built-in scene"), 1.0);
    let solution = solution(&world, |element| {
        let facing = world.mesh.patches[world.mesh.elements[element].patch as usize].normal.z;
        if facing > 0.9 { Rgb::new(1.0, 2.0, 3.0) } else { Rgb::splat(0.1) }
    });
    // Before the front wall of the cube between 0 and 1, whose outside has no elements and whose inside looks away.
    let viewpoint =
        Viewpoint { eye: Vec3::new(0.5, 0.5, 4.0), target: Vec3::splat(0.5), up: Vec3::Y, vertical_fov: 30.0 };
    let mut frame = frame(&world, View::Patches);
    frame.camera = Camera::new(&viewpoint, &world.bounds);
    let picture = render_picture(&gpu, &world, &solution, &frame, 4).expect("a picture");
    let back_wall = pixel(&picture, SIZE[0] / 2, SIZE[1] / 2);
    assert_near(back_wall, Rgb::new(1.0, 2.0, 3.0) / PI, |value| HALF_ROUNDING * value, "the back wall");
}

#[test]
fn pictures_do_not_depend_on_the_size_of_the_scene_or_its_distance_from_the_origin() {
    let Some(gpu) = gpu() else { return };
    let reference = square();
    let picture = |world: &World| {
        let solution = solution(world, motley);
        render_picture(&gpu, world, &solution, &frame(world, View::Patches), 4).expect("a picture")
    };
    let expected = picture(&reference);
    // Powers of two, and offsets in which the corners are exact, so that only the drawing may differ.
    let cases = [(2f32.powi(-20), Vec3::ZERO), (2f32.powi(20), Vec3::ZERO), (1.0, Vec3::splat(2f32.powi(18)))];
    for (scale, offset) in cases {
        let world = plane(&[0, 1, 2, 3], scale, offset);
        assert!(picture(&world).linear == expected.linear, "scaled by {scale}, moved by {offset}");
    }
}

#[test]
fn bright_and_dark_light_both_fit_into_the_picture() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let bright = |element: usize| if element % 2 == 0 { 4e9 } else { 4e3 };
    let solution = solution(&world, |element| Rgb::splat(bright(element)));
    let picture = render_picture(&gpu, &world, &solution, &frame(&world, View::Patches), 4).expect("a picture");
    for (x, y) in pixels() {
        if let Some(element) = element_at(&world, x, y) {
            let expected = Rgb::splat(bright(element) / PI);
            assert_near(pixel(&picture, x, y), expected, |value| HALF_ROUNDING * value, &format!("{x} {y}"));
        }
    }
}

#[test]
fn more_samples_are_the_mean_of_more_places_in_a_pixel() {
    let Some(gpu) = gpu() else { return };
    let world = plane(&[0, 1, 2], 1.0, Vec3::ZERO);
    let solution = solution(&world, |_| Rgb::splat(PI));
    let mut frame = frame(&world, View::Patches);
    // Rolled, so that edges cross pixels in many ways.
    frame.camera = Camera::new(&Viewpoint { up: Vec3::new(0.3, 1.0, 0.0), ..world.viewpoint }, &world.bounds);
    let size = on_plane(0, 0).1;
    // Of the triangle, which is half the square of 2 x 2, in pixels.
    let exact = 2.0 / (size * size);
    let outline = (4.0 + 8f32.sqrt()) / size;
    let [few, many] =
        [4, 64].map(|samples| render_picture(&gpu, &world, &solution, &frame, samples).expect("a picture"));
    for (picture, samples) in [(&few, 4.0_f32), (&many, 64.0)] {
        let covered: f32 = picture.linear.iter().map(|value| value[3]).sum();
        // n samples miss the share of a pixel by 1/n at most, in every pixel of the outline.
        assert!(
            (covered - exact).abs() < 2.0 * outline / samples,
            "{covered} pixels with {samples} samples, not {exact}"
        );
        // Everything has radiance 1, so radiance is coverage.
        for value in &picture.linear {
            assert!((value[0] - value[3]).abs() <= 2.0 * HALF_ROUNDING * value[3], "{value:?}");
        }
    }
    let levels = |picture: &Picture| {
        let mut shares: Vec<u32> = picture.linear.iter().map(|value| (value[3] * 256.0).round() as u32).collect();
        shares.sort_unstable();
        shares.dedup();
        shares.len()
    };
    assert!(levels(&few) <= 5, "4 samples give quarters");
    assert!(levels(&many) > 20, "64 samples give {} shares", levels(&many));
}

#[test]
fn the_screen_shows_the_tone_curve_in_the_encoding_of_srgb() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let solution = solution(&world, motley);
    for tone in ToneCurve::ALL {
        let frame = Frame { tone, ..frame(&world, View::Smooth) };
        let picture = render_picture(&gpu, &world, &solution, &frame, 4).expect("a picture");
        for (value, shown) in picture.linear.iter().zip(&picture.srgb).filter(|(value, _)| value[3] == 1.0) {
            for channel in 0..3 {
                let expected = 255.0 * encoded(toned(tone, value[channel] / 8.0));
                let error = (f32::from(shown[channel]) - expected).abs();
                // Half a step of rounding, and 1 % of one for powers that adapters may compute in less precision.
                assert!(error <= 0.51, "{tone}: {value:?} is shown as {shown:?}");
            }
            assert_eq!(shown[3], 255);
        }
    }
}

fn toned(tone: ToneCurve, x: f32) -> f32 {
    match tone {
        ToneCurve::Linear => x.clamp(0.0, 1.0),
        ToneCurve::Filmic => ((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)).clamp(0.0, 1.0),
    }
}

fn encoded(linear: f32) -> f32 {
    if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[test]
fn outlines_are_on_the_edges_of_elements_and_not_in_the_radiance() {
    let Some(gpu) = gpu() else { return };
    for polygon in [&[0, 1, 2, 3][..], &[0, 1, 2]] {
        let world = plane(polygon, 1.0, Vec3::ZERO);
        let solution = solution(&world, |_| Rgb::splat(2.0));
        let plain = frame(&world, View::Patches);
        let lined = Frame { wireframe: true, ..plain };
        let [plain, lined] =
            [plain, lined].map(|frame| render_picture(&gpu, &world, &solution, &frame, 4).expect("one"));
        assert!(plain.linear == lined.linear, "outlines are not light");
        for (x, y) in pixels() {
            let (point, size) = on_plane(x, y);
            let is_front = |element: &&Element| world.mesh.patches[element.patch as usize].normal.z > 0.0;
            let elements = world.mesh.elements.iter().filter(is_front);
            let depth =
                elements.map(|element| depth_inside(&corners(&world, element), point)).fold(-9.0, f32::max) / size;
            let index = (y * SIZE[0] + x) as usize;
            let differs = plain.srgb[index] != lined.srgb[index];
            // A line is one pixel wide, half on each side of an edge, and half a pixel of its rim is blurred.
            assert!(!differs || depth < 1.0 + SNAP, "{x} {y} is {depth} pixels inside");
            assert!(differs || !(0.0..0.4).contains(&depth), "{x} {y} is {depth} pixels inside");
        }
    }
}

#[test]
fn the_shooter_is_outlined() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let mut solution = solution(&world, |_| Rgb::splat(2.0));
    let plain = frame(&world, View::Patches);
    let outlined = Frame { show_shooter: true, ..plain };
    let render = |solution: &Solution, frame| render_picture(&gpu, &world, solution, frame, 4).expect("a picture");
    let without = render(&solution, &plain);
    solution.shooter = None;
    assert!(render(&solution, &outlined) == without);

    let is_front = |&index: &usize| world.mesh.patches[index].normal.z > 0.0;
    let shooter = (0..world.mesh.patches.len()).find(is_front).expect("a patch in front");
    solution.shooter = Some(shooter as u32);
    let with = render(&solution, &outlined);
    assert!(with.linear == without.linear, "outlines are not light");
    let corners: Vec<Vec2> = world.mesh.patches[shooter].corners().iter().map(|corner| corner.truncate()).collect();
    for (x, y) in pixels() {
        let (point, size) = on_plane(x, y);
        let distance = distance_to_outline(&corners, point) / size;
        let at = (y * SIZE[0] + x) as usize;
        // The line is three pixels wide with square ends, and a pixel's samples are within half a pixel of its middle.
        let differs = with.srgb[at] != without.srgb[at];
        assert!(differs || distance > 1.0 - SNAP, "{x} {y} is {distance} pixels off the line");
        assert!(!differs || distance < 1.5 * 2f32.sqrt() + 0.5 + SNAP, "{x} {y} is {distance} pixels off the line");
    }
}

fn distance_to_outline(corners: &[Vec2], point: Vec2) -> f32 {
    let to_edge = |i: usize| {
        let (from, to) = (corners[i], corners[(i + 1) % corners.len()]);
        let along = ((point - from).dot(to - from) / from.distance_squared(to)).clamp(0.0, 1.0);
        from.lerp(to, along).distance(point)
    };
    (0..corners.len()).map(to_edge).fold(f32::INFINITY, f32::min)
}

#[test]
fn what_is_hidden_shows_neither_light_nor_outlines() {
    let Some(gpu) = gpu() else { return };
    let mut scene = plane_scene(&[0, 1, 2, 3], 1.0, Vec3::ZERO);
    let nearer: Vec<Vec3> = scene.positions.iter().map(|&position| position + Vec3::Z).collect();
    scene.positions.extend(nearer);
    scene.polygons.push(Polygon::new(&[4, 5, 6, 7], 0, 0, 0));
    let world = build(scene, 0.5);
    let patch_of = |element: usize| &world.mesh.patches[world.mesh.elements[element].patch as usize];
    let mut solution = solution(&world, |element| Rgb::splat(if patch_of(element).polygon == 1 { PI } else { 1e3 }));
    let behind = world.mesh.patches.iter().position(|patch| patch.polygon == 0 && patch.is_front).expect("a patch");
    solution.shooter = Some(behind as u32);
    let frame = Frame { show_shooter: true, wireframe: true, ..frame(&world, View::Patches) };
    let picture = render_picture(&gpu, &world, &solution, &frame, 4).expect("a picture");
    assert!(picture.linear.iter().all(|value| value[0] <= value[3] * (1.0 + HALF_ROUNDING)));
    solution.shooter = None;
    assert!(picture == render_picture(&gpu, &world, &solution, &frame, 4).expect("a picture"));
}

#[test]
fn the_automatic_exposure_of_a_furnace_foresees_its_radiosity() {
    // M_e = 1 and ρ = 0.5 everywhere: B = 2 in the end.
    let world = Arc::new(build(Scene::open("furnace").expect("a built-in scene"), 0.5));
    let mid_grey = (0.18 * PI / 2.0).log2();
    let mut method = Radiosity::new(Arc::clone(&world), Settings::default());
    for shot in 0..100 {
        let exposure = automatic_exposure(&world, &method.solution());
        // A shot leaves the ledger closed, but spreads light as evenly as its form factors allow.
        let tolerance = if shot == 0 { 1e-6 } else { 0.02 };
        assert!((exposure - mid_grey).abs() < tolerance, "{exposure} after {shot} shots, not {mid_grey}");
        method.step(&Cancel::default());
    }
}

#[test]
fn the_automatic_exposure_hardly_changes_while_light_spreads() {
    // Open to one side, so some light leaves, which only the first shot tells.
    let world = Arc::new(build(Scene::open("empty-box").expect("a built-in scene"), 0.5));
    let mut method = Radiosity::new(Arc::clone(&world), Settings::default());
    method.step(&Cancel::default());
    let first = automatic_exposure(&world, &method.solution());
    while method.step(&Cancel::default()) == Step::Advanced {
        let exposure = automatic_exposure(&world, &method.solution());
        assert!((exposure - first).abs() < 0.5, "{exposure}, after {first} at first: more than half a stop");
    }
    assert!(method.solution().converged);
}

#[test]
fn a_dark_world_has_an_exposure_of_zero() {
    let world = square();
    assert_eq!(automatic_exposure(&world, &solution(&world, |_| Rgb::ZERO)), 0.0);
}

#[test]
fn nothing_is_drawn_again_that_has_not_changed() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let solution = solution(&world, motley);
    let mut viewport = Viewport::new(&gpu, wgpu::TextureFormat::Bgra8Unorm);
    let frame = frame(&world, View::Smooth);
    let mut draw = |change: &dyn Fn(&mut Viewport), frame: &Frame| {
        change(&mut viewport);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        viewport.draw(&mut encoder, frame);
        gpu.queue.submit([encoder.finish()]);
        viewport.draws()
    };
    let nothing = |_: &mut Viewport| ();
    assert_eq!(draw(&nothing, &frame), 0, "there is no world yet");
    assert_eq!(draw(&|viewport| viewport.set_world(&world), &frame), 1);
    assert_eq!(draw(&|viewport| viewport.set_light(&world, &solution), &frame), 2);
    assert_eq!(draw(&nothing, &frame), 2);
    assert_eq!(draw(&nothing, &Frame { size: [0, 9], ..frame }), 2, "there is nothing to draw on");
    assert_eq!(draw(&nothing, &Frame { exposure_ev: 1.0, tone: ToneCurve::Linear, ..frame }), 2, "that is presenting");
    let mut turned = frame;
    turned.camera.orbit(0.1, 0.0);
    let different = [
        turned,
        frame,
        Frame { view: View::Unshot, ..frame },
        Frame { wireframe: true, ..frame },
        Frame { show_shooter: true, ..frame },
        Frame { size: [64, 64], ..frame },
    ];
    for (count, frame) in (3..).zip(different) {
        assert_eq!(draw(&nothing, &frame), count);
        assert_eq!(draw(&nothing, &frame), count);
    }
    gpu.check().expect("a device that works");
}

#[test]
fn a_picture_that_is_empty_or_too_large_is_refused() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let solution = solution(&world, motley);
    let limit = gpu.device.limits().max_texture_dimension_2d;
    for size in [[0, 4], [4, 0], [limit + 1, 4], [4, u32::MAX]] {
        let frame = Frame { size, ..frame(&world, View::Patches) };
        let error = render_picture(&gpu, &world, &solution, &frame, 4).expect_err("too large");
        assert!(matches!(error, GpuError::PictureSize { limit: stated, .. } if stated == limit), "{error}");
    }
}

#[test]
fn a_lost_device_is_an_error() {
    let Some(gpu) = gpu() else { return };
    let world = square();
    let solution = solution(&world, motley);
    gpu.device.destroy();
    let error = render_picture(&gpu, &world, &solution, &frame(&world, View::Patches), 4).expect_err("no device");
    assert!(matches!(error, GpuError::Failed(_)), "{error}");
}
