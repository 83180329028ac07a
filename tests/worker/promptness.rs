//! A command shows within 50 ms. A step is told to stop at once (see `interruption`); here it is counted how much it may do
//! until it looks, and how much there is to do until a first picture is there. `cargo bench --bench latency` has the times.

use crate::with_elements;
use lightwell::accuracy::Reference;
use lightwell::camera::Camera;
use lightwell::cancel::Cancel;
use lightwell::choice::Choice;
use lightwell::effects::Switches;
use lightwell::methods::ambient_occlusion::VertexOcclusion;
use lightwell::methods::image::{ImageRun, Sources};
use lightwell::methods::photon_map::PhotonMapping;
use lightwell::methods::transport::Transport;
use lightwell::methods::{FormFactorMethod, ImageSettings, PhotonSettings, Settings, Solver, Step, radiosity};
use lightwell::scene::Scene;
use lightwell::solution::{CameraView, Counters};
use lightwell::world::World;
use std::sync::Arc;

/// Rays or form factors between two polls of the flag: half of 50 ms where each takes 2 µs, which is eight times what a
/// ray takes in the Cornell box.
const MOST_WORK_A_POLL: f64 = 12_500.0;
/// Rays until a coarse picture is there: 150 ms of two cores at as much.
const MOST_RAYS_TO_A_PICTURE: u64 = 150_000;

fn cornell_box(settings: &Settings) -> Arc<World> {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    Arc::new(World::build(scene, &settings.mesh, &Cancel::default()).expect("a world"))
}

fn polls_often(what: &str, work: u64, polls: u64) {
    let work = work as f64 / polls.max(1) as f64;
    println!("{what}: {work:.0} rays or form factors a poll");
    assert!(polls > 0 && work < MOST_WORK_A_POLL, "{what}: {work}");
}

/// The blocks between polls are as large in a fine mesh as in a coarse one.
#[test]
fn a_shot_polls_its_flag_often() {
    for (element_size, shadow_rays) in [(0.05, 16), (0.006, Settings::MAX_SHADOW_RAYS)] {
        let settings = Settings { shadow_rays, light_rays: 500_000, ..with_elements(element_size) };
        let world = cornell_box(&settings);
        for &form_factor in FormFactorMethod::ALL {
            let mut method = radiosity::start(world.clone(), &Settings { form_factor, ..settings });
            let cancel = Cancel::counting();
            assert_eq!(method.step(&cancel), Step::Advanced);
            let Counters { rays, form_factors, .. } = method.solution().counters;
            polls_often(&format!("{form_factor:?}, elements of {element_size}"), rays + form_factors, cancel.polls());
        }
    }
}

#[test]
fn a_full_matrix_polls_its_flag_often() {
    for solver in [Solver::Jacobi, Solver::GaussSeidel, Solver::Southwell] {
        let settings = Settings { solver, ..with_elements(0.1) };
        let mut method = radiosity::start(cornell_box(&settings), &settings);
        let cancel = Cancel::counting();
        while method.step(&cancel) == Step::Prepared {}
        let Counters { rays, form_factors, .. } = method.solution().counters;
        polls_often(&format!("{solver:?}"), rays + form_factors, cancel.polls());
    }
}

#[test]
fn photons_rounds_and_references_poll_their_flags_often() {
    let photons = PhotonSettings { count: 20_000, ..PhotonSettings::default() };
    let settings = Settings { photons, ..with_elements(0.1) };
    let world = cornell_box(&settings);
    let transport = Arc::new(Transport::new(world.clone(), Switches::default()));
    let cancel = Cancel::counting();
    let mut photons = PhotonMapping::new(transport.clone(), &settings);
    assert_eq!(photons.step(&cancel), Step::Advanced);
    polls_often("photons", photons.solution().counters.rays, cancel.polls());

    let cancel = Cancel::counting();
    let mut occlusion = VertexOcclusion::new(transport, &settings);
    while occlusion.rounds() == 0 {
        assert_eq!(occlusion.step(&cancel), Step::Advanced);
    }
    polls_often("ambient occlusion", occlusion.solution().rays, cancel.polls());

    // Paths have some six rays each.
    let cancel = Cancel::counting();
    let mut reference = Reference::new(world);
    assert!(reference.refine(&cancel));
    let paths = reference.truth().paths * reference.points().len() as u64;
    polls_often("reference", 6 * paths, cancel.polls());
}

/// A picture from the camera polls row by row; its first coarse pass is over soon.
#[test]
fn a_picture_polls_its_flag_often_and_is_soon_there() {
    let photons = PhotonSettings { count: 20_000, ..PhotonSettings::default() };
    let image = ImageSettings { samples: 1, ..ImageSettings::default() };
    let settings = Settings { photons, image, ..with_elements(0.1) };
    let world = cornell_box(&settings);
    let transport = Arc::new(Transport::new(world.clone(), Switches::default()));
    let mut mapping = PhotonMapping::new(transport.clone(), &settings);
    while mapping.step(&Cancel::default()) == Step::Advanced {}
    let mut radiosity = radiosity::start(world.clone(), &settings);
    assert_eq!(radiosity.step(&Cancel::default()), Step::Advanced);
    let sources = Sources { transport, radiosity: Some(Arc::new(radiosity.solution())), photons: Some(mapping.maps()) };
    let camera = Camera::new(&world.viewpoint, &world.bounds);
    for &view in CameraView::ALL {
        let mut run = ImageRun::new(&sources, view, camera, [640, 480], &settings).expect("its light is there");
        let cancel = Cancel::counting();
        while run.image().is_none() {
            assert_eq!(run.step(&cancel), Step::Advanced);
        }
        let rays = run.image().expect("a picture").rays;
        println!("{}: {rays} rays to a first picture", view.name());
        assert!(rays < MOST_RAYS_TO_A_PICTURE, "{}: {rays}", view.name());
        polls_often(view.name(), rays, cancel.polls());
    }
}
