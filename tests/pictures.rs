//! Small pictures against those in `screenshots/tests`, so that no change of what is drawn goes unseen.
//!
//! Write them anew with `UPDATE_SCREENSHOTS=1 cargo test --release --test pictures`, and look at them.

use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::choice::Choice;
use lightwell::mesh::MeshSettings;
use lightwell::methods::radiosity::pick;
use lightwell::methods::{Settings, Solver, Step};
use lightwell::scene::Scene;
use lightwell::solution::{PathFilter, Solution};
use lightwell::viewport::{
    AdapterChoice, Frame, Gpu, Light, PhotonLook, Picture, ToneCurve, View, automatic_exposure, diagram, pick_patch,
    render_picture,
};
use lightwell::worker::Run;
use lightwell::world::World;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Adapters may place and round samples in their own ways: a hard edge that moves by one sixteenth of a pixel changes it
/// by 16 of 255. Over the picture this averages to far less than one step of 8 bits.
const MEAN_DIFFERENCE: f64 = 0.75;

/// Width and height, pixels.
const SIZE: [u32; 2] = [160, 120];
/// On the red wall of the Cornell box, where nothing stands before it.
const RED_WALL: [f32; 2] = [32.0, 50.0];

fn reference(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("screenshots/tests").join(format!("{name}.png"))
}

/// Mean absolute difference of two pictures, in steps of 8 bits.
fn difference(picture: &Picture, reference: &image::RgbaImage) -> f64 {
    assert_eq!([reference.width(), reference.height()], picture.size);
    let pairs = picture.srgb.as_flattened().iter().zip(reference.as_raw());
    pairs.map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>() / reference.as_raw().len() as f64
}

fn settings() -> Settings {
    Settings { mesh: MeshSettings::default(), ..Settings::default() }
}

fn world(scene: &str, settings: &Settings) -> Arc<World> {
    let scene = Scene::open(scene).expect("a built-in scene");
    Arc::new(World::build(scene, &settings.mesh, &Cancel::default()).expect("a world"))
}

/// The light after some steps; those that only prepare do not count.
fn solve(world: &Arc<World>, settings: &Settings, steps: usize) -> Solution {
    let mut run = Run::start(world.clone(), settings).expect("enough memory");
    let mut done = 0;
    while done < steps {
        done += usize::from(run.step(&Cancel::default()) != Step::Prepared);
    }
    run.solution()
}

fn compare_view(gpu: &Gpu, scene: &str, view: View, wireframe: bool, shots: usize) {
    let settings = settings();
    let world = world(scene, &settings);
    let solution = solve(&world, &settings, shots);
    let camera = Camera::new(&world.viewpoint, &world.bounds);
    let frame = Frame {
        camera,
        size: SIZE,
        view,
        bounce: 0,
        ambient: false,
        wireframe,
        show_shooter: wireframe,
        photons: PhotonLook::default(),
        filter: PathFilter::default(),
        exposure_ev: automatic_exposure(&world, Some(&solution)),
        tone: ToneCurve::Linear,
    };
    let patch = pick_patch(&world, &camera, RED_WALL, SIZE).expect("a patch of the wall");
    let picked = view
        .is_false_colour()
        .then(|| Arc::new(pick(&world, &settings, patch, &Cancel::default()).expect("nothing cancels it")));
    let light = Light { picked, ..solution.into() };
    let picture = render_picture(gpu, &world, &light, &frame, 16).expect("a picture");
    compare(&picture, &format!("{scene}-{}", view.name()));
}

/// Against the reference of this name.
fn compare(picture: &Picture, name: &str) {
    let path = reference(name);
    if std::env::var_os("UPDATE_SCREENSHOTS").is_some() {
        let ([width, height], pixels) = (picture.size, picture.srgb.as_flattened());
        image::save_buffer(&path, pixels, width, height, image::ColorType::Rgba8).expect("the picture is written");
        return;
    }
    let reference = image::open(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())).into_rgba8();
    let difference = difference(picture, &reference);
    assert!(difference < MEAN_DIFFERENCE, "{}: off by {difference:.2} steps in the mean", path.display());
}

#[test]
fn views_are_as_they_were() {
    let gpu = match Gpu::new(&AdapterChoice::System) {
        Ok(gpu) => gpu,
        Err(error) if std::env::var_os("REQUIRE_GPU").is_some() => panic!("a graphics adapter is required: {error}"),
        Err(error) => return println!("skipped: {error}"),
    };
    compare_view(&gpu, "cornell-box", View::Smooth, false, 300);
    compare_view(&gpu, "cornell-box", View::Patches, true, 100);
    compare_view(&gpu, "cornell-box", View::Unshot, false, 30);
    compare_view(&gpu, "cornell-box", View::Absorbed, false, 100);
    compare_view(&gpu, "cornell-box", View::FormFactors, false, 0);
    compare_view(&gpu, "two-rooms", View::Smooth, false, 150);
}

#[test]
fn diagrams_are_as_they_were() {
    let mut settings = settings();
    settings.solver = Solver::Jacobi;
    settings.mesh.element_size = Some(0.1);
    settings.hemicube_resolution = 64;
    let world = world("cornell-box", &settings);
    let camera = Camera::new(&world.viewpoint, &world.bounds);
    let matrix = solve(&world, &settings, 1).matrix.expect("the matrix is built before the first sweep");
    compare(&diagram::matrix(&matrix, 160).picture, "cornell-box-matrix");
    let patch = pick_patch(&world, &camera, RED_WALL, SIZE).expect("a patch of the wall");
    let buffer = pick(&world, &settings, patch, &Cancel::default()).expect("nothing cancels it").item_buffer;
    compare(&diagram::item_buffer(&buffer, &world, 160), "cornell-box-item-buffer");
}
