//! The two scenes without an emitter: what is in them is whole, stands apart, and is where they say.

use super::{HALL_SHELL, closure_and_volume_of, corners, directed_edges, double_area, open, polygon_of, polygons_of};
use glam::DVec3;
use lightwell::scene::{Polygon, Scene};
use std::collections::{HashMap, HashSet};

const STUDY_SHELL: [&str; 4] = ["floor", "left_wall", "back_wall", "niche"];

/// Polygons sorted into bodies: those that share corners, directly or by others, are one.
fn bodies<'a>(scene: &Scene, polygons: &[&'a Polygon]) -> Vec<Vec<&'a Polygon>> {
    fn root(parents: &mut [u32], mut corner: u32) -> u32 {
        while parents[corner as usize] != corner {
            parents[corner as usize] = parents[parents[corner as usize] as usize];
            corner = parents[corner as usize];
        }
        corner
    }
    let mut parents: Vec<u32> = (0..scene.positions.len() as u32).collect();
    for polygon in polygons {
        for pair in polygon.corners().windows(2) {
            let [one, other] = [root(&mut parents, pair[0]), root(&mut parents, pair[1])];
            parents[one as usize] = other;
        }
    }
    let mut bodies: HashMap<u32, Vec<&Polygon>> = HashMap::new();
    for polygon in polygons {
        bodies.entry(root(&mut parents, polygon.corners()[0])).or_default().push(polygon);
    }
    bodies.into_values().collect()
}

/// The lowest and the highest coordinates of a body.
fn extent(scene: &Scene, body: &[&Polygon]) -> (DVec3, DVec3) {
    let places = body.iter().flat_map(|polygon| corners(scene, polygon));
    places.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), place| (low.min(place), high.max(place)))
}

#[test]
fn the_corner_of_the_study_is_open_at_its_borders_alone() {
    let scene = open("ao-study");
    let edges = directed_edges(&polygons_of(&scene, &STUDY_SHELL, true));
    let borders = |corner: u32| {
        let place = scene.positions[corner as usize];
        [place.x == 4.6, place.y == 2.6, place.z == 4.0]
    };
    for (&(from, to), &count) in &edges {
        let is_border = borders(from).into_iter().zip(borders(to)).any(|(one, other)| one && other);
        let expected = if is_border { None } else { Some(&1) };
        let place = scene.positions[from as usize];
        assert_eq!((count, edges.get(&(to, from))), (1, expected), "an edge at {place}");
    }
    let middle = DVec3::new(2.0, 1.0, 2.0);
    for object in ["floor", "left_wall", "back_wall"] {
        let wall = corners(&scene, polygon_of(&scene, object));
        assert!(double_area(&wall).dot(middle - wall[0]) > 0.0, "{object} faces away");
    }
}

/// Every body that stands in a dark scene is closed edge to edge, has its fronts outside, and shares no corner with
/// another.
#[test]
fn bodies_in_the_dark_are_closed_and_look_outwards() {
    for (name, shell, expected, triangles) in
        [("ao-study", STUDY_SHELL, 24, 2_000..8_000), ("machine-hall", HALL_SHELL, 2284, 30_000..80_000)]
    {
        let scene = open(name);
        let count: usize = scene.polygons.iter().map(|polygon| polygon.corners().len() - 2).sum();
        assert!(triangles.contains(&count), "{name} has {count} triangles");
        let bodies = bodies(&scene, &polygons_of(&scene, &shell, false));
        assert_eq!(bodies.len(), expected, "{name}");
        for body in &bodies {
            let objects: HashSet<u32> = body.iter().map(|polygon| polygon.object).collect();
            let what = &scene.objects[body[0].object as usize];
            assert_eq!(objects.len(), 1, "{name}: {what} touches another object");
            let edges = directed_edges(body);
            for (&(from, to), &count) in &edges {
                let place = scene.positions[from as usize];
                assert_eq!((count, edges.get(&(to, from))), (1, Some(&1)), "{name}: {what} is open at {place}");
            }
            let (_, volume) = closure_and_volume_of(&scene, body);
            assert!(volume > 0.0, "{name}: {what} is inside out at {}", corners(&scene, body[0])[0]);
        }
    }
}

/// Single precision is finer than 10 µm at 5 m.
#[test]
fn the_gaps_of_the_study_are_as_wide_as_it_says() {
    let scene = open("ao-study");
    let extents = |object: &str| {
        let bodies = bodies(&scene, &polygons_of(&scene, &[object], true));
        let mut extents: Vec<_> = bodies.iter().map(|body| extent(&scene, body)).collect();
        extents.sort_by(|one, other| one.0.z.total_cmp(&other.0.z));
        extents
    };
    let is = |gap: f64, expected: f64| assert!((gap - expected).abs() < 1e-5, "{gap} m instead of {expected} m");
    let slats = extents("slats");
    assert_eq!(slats.len(), 9);
    for (i, pair) in slats.windows(2).enumerate() {
        is(pair[1].0.z - pair[0].1.z, 0.005 * (i + 1) as f64);
    }
    for (board, gap) in [("board_1", 0.01), ("board_2", 0.03)] {
        is(extents(board)[0].0.x, gap);
    }
    let (floor, _) = extents("floor")[0];
    for object in scene.objects.iter().filter(|object| !STUDY_SHELL.contains(&object.as_str())) {
        let over = if object == "ball_in_niche" { 1.0 } else { floor.y };
        let lowest = extents(object).iter().map(|(low, _)| low.y).fold(f64::INFINITY, f64::min);
        // What lies on the table and nothing else stands higher.
        is(lowest - over, if object == "crate_on_table" { 0.742 } else { 0.002 });
    }
}
