//! In pictures from a camera.

use super::{FAR, ROUNDED, UNDER_A_CEILING, plane, settings, transport};
use glam::Vec3;
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::effects::{Effects, Switches};
use lightwell::math::rgb::Rgb;
use lightwell::math::stats::Moments;
use lightwell::mesh::MeshSettings;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::radiosity::mean_indirect_irradiance;
use lightwell::methods::transport::Transport;
use lightwell::methods::{Falloff, ImageSettings, OcclusionSettings, Range, Settings, Step};
use lightwell::scene::{Scene, Viewpoint};
use lightwell::solution::{CameraImage, CameraView};
use lightwell::world::World;
use std::f32::consts::PI;
use std::sync::Arc;

const SIZE: [u32; 2] = [32, 24];

fn picture(transport: &Arc<Transport>, view: CameraView, eye: Viewpoint, occlusion: OcclusionSettings) -> CameraImage {
    let image = ImageSettings { samples: 4, ..ImageSettings::default() };
    let settings = Settings { image, occlusion, ..Settings::default() };
    let camera = Camera::new(&eye, &transport.world.bounds);
    let sources = Sources { transport: transport.clone(), radiosity: None, photons: None };
    let mut run = ImageRun::new(&sources, view, camera, SIZE, &settings).expect("it needs no light");
    while run.step(&Cancel::default()) == Step::Advanced {}
    run.image().expect("a picture")
}

/// Down on the floor from a height of half a metre.
const DOWN: Viewpoint =
    Viewpoint { eye: Vec3::new(0.0, 0.5, 0.0), target: Vec3::ZERO, up: Vec3::Z, vertical_fov: 40.0 };

fn builtin(name: &str) -> Arc<Transport> {
    let scene = Scene::open(name).expect("a built-in scene");
    let world = World::build(scene, &MeshSettings::default(), &Cancel::default()).expect("a world");
    Arc::new(Transport::new(Arc::new(world), Switches::default()))
}

#[test]
fn every_pixel_under_a_ceiling_has_the_closed_form() {
    let transport = transport(&(plane(0.0, FAR) + &plane(1.0, FAR)));
    for (falloff, range, hidden) in UNDER_A_CEILING {
        let image =
            picture(&transport, CameraView::AmbientOcclusion, DOWN, settings(16, Range::Metres(range), falloff));
        let expected = 1.0 - hidden;
        // As with independent rays: 64 in a pixel, and five standard errors, since there are 768 pixels.
        let error = (expected * hidden / 64.0).sqrt();
        let mut sum = 0.0;
        for (pixel, radiance) in image.radiance.iter().enumerate() {
            let found = f64::from(radiance.x);
            assert!((found - expected).abs() <= 5.0 * error + ROUNDED, "{falloff:?}, pixel {pixel}: {found}");
            assert_eq!(*radiance, Rgb::splat(radiance.x));
            sum += found;
        }
        let pixels = image.radiance.len() as f64;
        assert!(
            (sum / pixels - expected).abs() <= 3.0 * error / pixels.sqrt() + ROUNDED,
            "{falloff:?}: {}",
            sum / pixels
        );
    }
}

#[test]
fn a_closed_room_is_black_at_an_unlimited_distance_and_an_open_floor_white() {
    let room = builtin("furnace");
    let home = room.world.viewpoint;
    let all = settings(16, Range::Unlimited, Falloff::None);
    let image = picture(&room, CameraView::AmbientOcclusion, home, all);
    assert!(image.radiance.iter().all(|&share| share == Rgb::ZERO));
    let floor = transport(&plane(0.0, 10.0));
    let image = picture(&floor, CameraView::AmbientOcclusion, DOWN, all);
    assert!(image.radiance.iter().all(|&share| share == Rgb::ONE));
}

#[test]
fn without_emitters_colours_are_seen_in_even_light() {
    // The grey of faces without a material reflects a half.
    let transport = transport(&(plane(0.0, FAR) + &plane(1.0, FAR)));
    let occlusion = settings(64, Range::Metres(2.0), Falloff::None);
    let diffuse = picture(&transport, CameraView::Diffuse, DOWN, occlusion);
    assert!(diffuse.radiance.iter().all(|radiance| radiance.abs_diff_eq(Rgb::splat(0.5), 1e-6)));
    let share = picture(&transport, CameraView::AmbientOcclusion, DOWN, occlusion);
    let both = picture(&transport, CameraView::DiffuseAmbient, DOWN, occlusion);
    for (both, share) in both.radiance.iter().zip(&share.radiance) {
        assert!(both.abs_diff_eq(0.5 * *share, 1e-6), "{both} of {share}");
    }
}

#[test]
fn the_mean_light_between_surfaces_is_that_of_a_furnace() {
    // Where all faces emit M and reflect ρ, M arrives straight and M / (1 − ρ) in all: the rest comes from reflections.
    let world = &builtin("furnace").world;
    let material = &world.scene.materials[world.scene.polygons[0].material as usize];
    let (emitted, reflectance) = (material.exitance(), material.diffuse);
    let expected = emitted * reflectance / (1.0 - reflectance);
    let found = mean_indirect_irradiance(world, Effects::ALL);
    // Single precision.
    assert!((found / expected - 1.0).abs().max_element() < 1e-5, "{found}, not {expected}");
}

#[test]
fn lamps_shine_in_their_own_radiance() {
    let transport = builtin("furnace");
    let occlusion = settings(16, Range::Unlimited, Falloff::None);
    let [diffuse, both] = [CameraView::Diffuse, CameraView::DiffuseAmbient]
        .map(|view| picture(&transport, view, transport.world.viewpoint, occlusion).radiance);
    let material = &transport.world.scene.materials[0];
    // All faces glow alike, so that direct light brings M everywhere: what is sent is Ke (1 + ρ).
    let expected = f64::from((material.emission * (1.0 + material.diffuse)).x);
    for image in [diffuse, both] {
        let mut pixels = Moments::default();
        image.iter().for_each(|radiance| pixels.add(f64::from(radiance.x)));
        // Pixels are independent; four standard errors, as their own spread tells them, and no more than a hundredth.
        let error = pixels.standard_error();
        assert!(
            (pixels.mean() - expected).abs() < 4.0 * error && error < 0.01 * expected,
            "{pixels:?}, not {expected}"
        );
    }
}

#[test]
fn ambient_light_is_added_to_direct_light_where_it_is_not_occluded() {
    let transport = builtin("cornell-box");
    let home = transport.world.viewpoint;
    let occlusion = settings(16, Range::Automatic, Falloff::Linear);
    let [share, diffuse, both] = [CameraView::AmbientOcclusion, CameraView::Diffuse, CameraView::DiffuseAmbient]
        .map(|view| picture(&transport, view, home, occlusion).radiance);
    // With the same seed the same places are seen, so that ρ E v / π is added, with one E. In the second row from below there
    // is the white floor alone.
    let white = Rgb::new(0.725, 0.71, 0.68);
    let expected = mean_indirect_irradiance(&transport.world, transport.effects);
    let row = (SIZE[1] as usize - 2) * SIZE[0] as usize;
    let is_floor = |pixel: &usize| diffuse[*pixel].x > 0.0 && share[*pixel].x > 0.9;
    let floor: Vec<usize> = (row + 8..row + 24).filter(is_floor).collect();
    assert!(!floor.is_empty());
    for pixel in floor {
        let light = PI * (both[pixel] - diffuse[pixel]) / (white * share[pixel]);
        // A mean of products is the product of means here, since ρ is one number; what is left is rounding.
        assert!((light / expected - 1.0).abs().max_element() < 1e-4, "pixel {pixel}: {light}, not {expected}");
    }
}
