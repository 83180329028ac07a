//! Small pictures against those in `screenshots/tests`, so that no change of what is drawn goes unseen.
//!
//! Write them anew with `UPDATE_SCREENSHOTS=1 cargo test --release --test pictures`, and look at them.

use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::choice::Choice;
use lightwell::mesh::MeshSettings;
use lightwell::methods::Settings;
use lightwell::scene::Scene;
use lightwell::viewport::{
    AdapterChoice, Frame, Gpu, Light, Picture, ToneCurve, View, automatic_exposure, render_picture,
};
use lightwell::worker::Run;
use lightwell::world::World;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Adapters may place and round samples in their own ways: a hard edge that moves by one sixteenth of a pixel changes it
/// by 16 of 255. Over the picture this averages to far less than one step of 8 bits.
const MEAN_DIFFERENCE: f64 = 0.75;

fn reference(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("screenshots/tests").join(format!("{name}.png"))
}

/// Mean absolute difference of two pictures, in steps of 8 bits.
fn difference(picture: &Picture, reference: &image::RgbaImage) -> f64 {
    assert_eq!([reference.width(), reference.height()], picture.size);
    let pairs = picture.srgb.as_flattened().iter().zip(reference.as_raw());
    pairs.map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / reference.as_raw().len() as f64
}

fn compare(gpu: &Gpu, scene: &str, view: View, wireframe: bool, shots: u64) {
    let settings = Settings { mesh: MeshSettings::default(), ..Settings::default() };
    let scene_read = Scene::open(scene).expect("a built-in scene");
    let world = Arc::new(World::build(scene_read, &settings.mesh, &Cancel::default()).expect("a world"));
    let mut run = Run::start(world.clone(), &settings).expect("enough memory");
    for _ in 0..shots {
        run.step(&Cancel::default());
    }
    let solution = run.solution();
    let frame = Frame {
        camera: Camera::new(&world.viewpoint, &world.bounds),
        size: [160, 120],
        view,
        bounce: 0,
        ambient: false,
        wireframe,
        show_shooter: wireframe,
        exposure_ev: automatic_exposure(&world, &solution),
        tone: ToneCurve::Linear,
    };
    let picture = render_picture(gpu, &world, &Light::from(solution), &frame, 16).expect("a picture");
    let path = reference(&format!("{scene}-{}", view.name()));
    if std::env::var_os("UPDATE_SCREENSHOTS").is_some() {
        let pixels = picture.srgb.as_flattened();
        image::save_buffer(&path, pixels, 160, 120, image::ColorType::Rgba8).expect("the picture is written");
        return;
    }
    let reference = image::open(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())).into_rgba8();
    let difference = difference(&picture, &reference);
    assert!(difference < MEAN_DIFFERENCE, "{}: off by {difference:.2} steps in the mean", path.display());
}

#[test]
fn pictures_are_as_they_were() {
    let gpu = match Gpu::new(&AdapterChoice::System) {
        Ok(gpu) => gpu,
        Err(error) if std::env::var_os("REQUIRE_GPU").is_some() => panic!("a graphics adapter is required: {error}"),
        Err(error) => return println!("skipped: {error}"),
    };
    compare(&gpu, "cornell-box", View::Smooth, false, 300);
    compare(&gpu, "cornell-box", View::Patches, true, 100);
    compare(&gpu, "cornell-box", View::Unshot, false, 30);
    compare(&gpu, "two-rooms", View::Smooth, false, 150);
}
