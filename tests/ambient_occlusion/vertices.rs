//! On the vertices of the mesh.

use super::shapes;
use super::{FAR, UNDER_A_CEILING, plane, quad, settings, wall};
use glam::{Vec2, Vec3};
use lightwell::cancel::Cancel;
use lightwell::effects::Switches;
use lightwell::mesh::MeshSettings;
use lightwell::methods::ambient_occlusion::VertexOcclusion;
use lightwell::methods::transport::Transport;
use lightwell::methods::{Falloff, ImageSettings, OcclusionSettings, Range, Settings, Step};
use lightwell::scene::Scene;
use lightwell::solution::VertexShares;
use lightwell::world::World;
use std::sync::Arc;

const ANY_HIT: (Range, Falloff) = (Range::Unlimited, Falloff::None);

/// The world of some OBJ text, with elements of this size.
fn world(obj: &str, element_size: Option<f32>) -> Arc<Transport> {
    let scene = Scene::from_text("test", obj, "").expect("a scene");
    let mesh = MeshSettings { element_size, ..MeshSettings::default() };
    let world = World::build(scene, &mesh, &Cancel::default()).expect("a world");
    Arc::new(Transport::new(Arc::new(world), Switches::default()))
}

fn run_of(transport: &Arc<Transport>, occlusion: OcclusionSettings, rounds: u32, seed: u64) -> VertexOcclusion {
    let image = ImageSettings { samples: rounds, ..ImageSettings::default() };
    VertexOcclusion::new(transport.clone(), &Settings { occlusion, image, seed, ..Settings::default() })
}

fn solve(transport: &Arc<Transport>, occlusion: OcclusionSettings, rounds: u32, seed: u64) -> VertexShares {
    let mut run = run_of(transport, occlusion, rounds, seed);
    while run.step(&Cancel::default()) == Step::Advanced {}
    run.solution()
}

/// Positions and normals of vertices with their shares, without those that hang: these are interpolated.
fn at_vertices(transport: &Transport, shares: &VertexShares) -> Vec<(Vec3, Vec3, f64)> {
    let mesh = &transport.world.mesh;
    let mut normals = vec![Vec3::ZERO; mesh.vertices.len()];
    for element in &mesh.elements {
        for &corner in element.corners() {
            normals[corner as usize] = mesh.patches[element.patch as usize].normal.into();
        }
    }
    let hangs = |vertex: usize| mesh.hanging.iter().any(|hanging| hanging.vertex as usize == vertex);
    let vertices = (0..mesh.vertices.len()).filter(|&vertex| !hangs(vertex));
    vertices.map(|vertex| (mesh.vertices[vertex], normals[vertex], shares.shares[vertex].into())).collect()
}

/// Three standard errors of a mean over independent rays, each of which brings something in [0, 1]: at most √(v (1 − v) / n)
/// each. Rays of a low-discrepancy sequence are better.
fn tolerance(share: f64, rays: f64) -> f64 {
    3.0 * (share * (1.0 - share) / rays).sqrt()
}

/// Elements of 10 m on planes of 2 · 200 m: of the vertices, those near the middle see nothing of the edges.
const ELEMENT: f32 = 10.0;
const ROUNDS: u32 = 256;
const RAYS: u32 = 16;

fn is_near_middle(position: Vec3) -> bool {
    Vec2::new(position.x, position.z).abs().max_element() < 0.25 * FAR
}

#[test]
fn every_falloff_has_its_closed_form_under_a_ceiling() {
    let transport = world(&(plane(0.0, FAR) + &plane(1.0, FAR)), Some(ELEMENT));
    for (falloff, range, hidden) in UNDER_A_CEILING {
        let shares = solve(&transport, settings(RAYS, Range::Metres(range), falloff), ROUNDS, 1);
        assert!(shares.is_complete && shares.rounds == ROUNDS);
        let rays = f64::from(RAYS * ROUNDS);
        let mut inner = 0;
        for (position, normal, share) in at_vertices(&transport, &shares) {
            // Outside of the two planes there is nothing but the sky.
            let is_between = (normal.y > 0.0) == (position.y < 0.5);
            if !is_between {
                // A ray that lies in the plane itself is not free: one in 2²⁴.
                assert!(share >= 1.0 - 1.0 / rays, "{position} facing {normal}: {share}");
            } else if is_near_middle(position) {
                inner += 1;
                // Points are rounded (see `ROUNDED`), and 1/(0.75 FAR)² of the sky is beyond the edge.
                let missed = 1e-4 + 1e-4;
                let error = (share - (1.0 - hidden)).abs();
                assert!(
                    error <= tolerance(hidden, rays) + missed,
                    "{falloff:?} at {position}: {share}, not 1 − {hidden}"
                );
            }
        }
        assert!(inner >= 100, "{inner} vertices");
    }
}

#[test]
fn a_wall_and_a_corner_hide_what_closed_forms_say_at_every_vertex_along_them() {
    // Two walls on a floor, 200 m high and long; the second one in the plane x = 0.
    let corner = |y: f32, z: f32| Vec3::new(0.0, y, z);
    let other = quad([corner(0.0, -FAR), corner(FAR, -FAR), corner(FAR, FAR), corner(0.0, FAR)]);
    let transport = world(&(plane(0.0, FAR) + &wall(FAR) + &other), Some(ELEMENT));
    let shares = solve(&transport, settings(RAYS, ANY_HIT.0, ANY_HIT.1), ROUNDS, 1);
    let (mut feet, mut corners) = (0, 0);
    for (position, normal, share) in at_vertices(&transport, &shares) {
        if normal.y < 0.5 || !is_near_middle(position) {
            continue;
        }
        let (x, z) = (position.x.abs(), position.z.abs());
        // What is hidden by a wall of height FAR at a distance d, and what two of them leave in the corner itself. A vertex
        // looks from 1/512 of an element beside the wall, 0.02 m, and a wall ends after 200 m: 1e-4 and 1e-4 are missed.
        let expected = match (x < 1.0, z < 1.0) {
            (true, true) => {
                corners += 1;
                0.25
            }
            (true, false) | (false, true) if x.max(z) > 0.05 * FAR => {
                feet += 1;
                // The other wall, at this distance.
                let far = f64::from(x.max(z));
                let hidden = 0.5 * (1.0 - far / f64::from(FAR).hypot(far));
                // Half of what that one hides lies behind this one.
                0.5 - 0.5 * hidden
            }
            _ => continue,
        };
        // Of what an infinitely long wall hides, 1 − sin atan(200/50) = 3 % is missing at its ends, up to 50 m away; half of
        // it lies behind the other wall.
        let error = (share - expected).abs();
        assert!(
            error <= tolerance(expected, f64::from(RAYS * ROUNDS)) + 0.5 * 0.03 * 0.5,
            "{position}: {share}, not {expected}"
        );
    }
    assert!(feet >= 4 && corners == 1, "{feet} feet, {corners} corners");
}

#[test]
fn all_arrives_on_an_open_plane_and_none_in_a_closed_room() {
    let open = world(&plane(0.0, 1.0), None);
    let shares = solve(&open, settings(16, ANY_HIT.0, ANY_HIT.1), 4, 1);
    assert!(!shares.shares.is_empty() && shares.shares.iter().all(|&share| share == 1.0));
    let furnace = Scene::open("furnace").expect("a built-in scene");
    let world = World::build(furnace, &MeshSettings::default(), &Cancel::default()).expect("a world");
    let furnace = Arc::new(Transport::new(Arc::new(world), Switches::default()));
    let shares = solve(&furnace, settings(16, ANY_HIT.0, ANY_HIT.1), 4, 1);
    assert!(!shares.shares.is_empty() && shares.shares.iter().all(|&share| share == 0.0));
}

#[test]
fn nothing_hides_itself_at_any_scale() {
    for scale in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
        // A ball is convex: nothing of it is in the way of anything else of it. Nobody sees its inside.
        let mut obj = String::new();
        for triangle in shapes::placed(&shapes::sphere(3), scale, Vec3::new(0.3, 0.2, 0.1)) {
            for corner in triangle {
                obj += &format!("v {} {} {}\n", corner.x, corner.y, corner.z);
            }
            obj += "f -3 -2 -1\n";
        }
        let transport = world(&obj, None);
        let shares = solve(&transport, settings(16, ANY_HIT.0, ANY_HIT.1), 2, 1);
        let meshed = transport.world.mesh.sides.iter().filter(|side| side.is_some()).count();
        assert_eq!(2 * meshed, transport.world.mesh.sides.len(), "scale {scale}: the inside is closed");
        assert!(shares.shares.iter().all(|&share| share == 1.0), "scale {scale}");
    }
}

#[test]
fn what_stands_on_a_floor_leaves_no_dark_seam_under_it() {
    // A block of 1 m on a floor whose elements do not end where it does.
    let mut obj = plane(0.0, 3.0);
    for corner in shapes::cube(1).iter().flatten() {
        let placed = 0.5 * (*corner + Vec3::Y);
        obj += &format!("v {} {} {}\n", placed.x, placed.y, placed.z);
    }
    for triangle in 0..12 {
        let first = 5 + 3 * triangle;
        obj += &format!("f {} {} {}\n", first, first + 1, first + 2);
    }
    let transport = world(&obj, Some(0.7));
    let shares = solve(&transport, settings(64, ANY_HIT.0, ANY_HIT.1), 16, 1);
    let mesh = &transport.world.mesh;
    let exposed = mesh.elements.iter().filter(|element| element.exposed > 0.0);
    for corner in exposed.flat_map(|element| element.corners()) {
        // At the foot of a convex body half of the sky is free, and more farther away; 1,024 rays have a standard error of
        // 1/64 at most.
        let share = shares.shares[*corner as usize];
        assert!(share >= 0.5 - 3.0 / 64.0, "{}: {share}", mesh.vertices[*corner as usize]);
    }
}

#[test]
fn noise_falls_at_least_as_with_independent_rays() {
    let transport = world(&(plane(0.0, FAR) + &wall(1.0)), Some(ELEMENT));
    let occlusion = settings(4, Range::Metres(2.0), Falloff::Linear);
    // At the foot of the wall, over seeds and vertices.
    let deviation = |rounds: u32| {
        let (mut squares, mut count) = (0.0, 0);
        let runs: Vec<_> =
            (0..16).map(|seed| at_vertices(&transport, &solve(&transport, occlusion, rounds, seed))).collect();
        for vertex in 0..runs[0].len() {
            let (position, normal, _) = runs[0][vertex];
            if normal.y < 0.5 || position.z.abs() > 1e-3 || !is_near_middle(position) {
                continue;
            }
            let shares = runs.iter().map(|run| run[vertex].2);
            let mean = shares.clone().sum::<f64>() / runs.len() as f64;
            squares += shares.map(|share| (share - mean).powi(2)).sum::<f64>();
            count += runs.len() - 1;
        }
        assert!(count >= 128, "{count}");
        (squares / count as f64).sqrt()
    };
    // Each deviation is known to 1 part in √(2 · 128), 6.3 %; their quotient to √2 times this, of which three are allowed.
    let quotient = deviation(16) / deviation(4);
    assert!(quotient <= 0.5 * (1.0 + 3.0 * 0.089), "{quotient}");
}

#[test]
fn a_run_is_the_same_to_the_bit_on_any_number_of_threads_and_goes_on_where_it_stopped() {
    let scene = Scene::open("cornell-box").expect("a built-in scene");
    let mesh = MeshSettings { element_size: Some(0.05), ..MeshSettings::default() };
    let world = World::build(scene, &mesh, &Cancel::default()).expect("a world");
    let transport = Arc::new(Transport::new(Arc::new(world), Switches::default()));
    let occlusion = OcclusionSettings::default();
    let on = |threads: usize, seed: u64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| solve(&transport, occlusion, 3, seed))
    };
    let first = on(1, 5);
    assert_eq!(first.shares, on(2, 5).shares);
    assert_ne!(first.shares, on(2, 6).shares);
    // Interrupted by a request, and asked for more rounds later.
    let mut run = run_of(&transport, occlusion, 1, 5);
    let stop = Cancel::default();
    stop.request();
    assert_eq!((run.step(&stop), run.solution().rays), (Step::Cancelled, 0));
    while run.step(&Cancel::default()) == Step::Advanced {}
    assert_eq!(run.rounds(), 1);
    let image = ImageSettings { samples: 3, ..ImageSettings::default() };
    assert!(run.configure(&Settings { occlusion, image, seed: 5, ..Settings::default() }));
    let others = [(occlusion, 6), (OcclusionSettings { falloff: Falloff::None, ..occlusion }, 5)];
    for (occlusion, seed) in others {
        assert!(!run.configure(&Settings { occlusion, image, seed, ..Settings::default() }));
    }
    while run.step(&Cancel::default()) == Step::Advanced {}
    assert_eq!(run.solution().shares, first.shares);
}
