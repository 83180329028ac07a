//! The scenes that are part of the program.

mod dark;

use glam::{DVec3, Vec3};
use lightwell::scene::{BUILTINS, FindingKind, Polygon, Scene, Severity, Source};
use std::collections::HashMap;

/// Scenes for ambient occlusion, which have no emitter.
const DARK: [&str; 2] = ["ao-study", "machine-hall"];

fn open(name: &str) -> Scene {
    Scene::open(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn corners(scene: &Scene, polygon: &Polygon) -> Vec<DVec3> {
    polygon.corners().iter().map(|&corner| scene.positions[corner as usize].as_dvec3()).collect()
}

/// Twice the area, along the normal.
fn double_area(corners: &[DVec3]) -> DVec3 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(from, to)| (*from - corners[0]).cross(*to - corners[0])).sum()
}

fn polygon_of<'a>(scene: &'a Scene, object: &str) -> &'a Polygon {
    let object = scene.objects.iter().position(|name| name == object).expect("the object exists") as u32;
    scene.polygons.iter().find(|polygon| polygon.object == object).expect("the object has a polygon")
}

/// The polygons of some objects, or of all others.
fn polygons_of<'a>(scene: &'a Scene, objects: &[&str], are_meant: bool) -> Vec<&'a Polygon> {
    let is_named = |polygon: &Polygon| objects.contains(&scene.objects[polygon.object as usize].as_str());
    scene.polygons.iter().filter(|polygon| is_named(polygon) == are_meant).collect()
}

/// How often the outlines of polygons run along each edge, from one corner to the next.
fn directed_edges(polygons: &[&Polygon]) -> HashMap<(u32, u32), u32> {
    let mut edges = HashMap::new();
    for polygon in polygons {
        let ring = polygon.corners();
        for (from, to) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            *edges.entry((*from, *to)).or_insert(0) += 1;
        }
    }
    edges
}

/// ∮ of the outline's area vectors and of the volume they enclose, over some objects.
fn closure_and_volume(scene: &Scene, objects: &[&str]) -> (DVec3, f64) {
    closure_and_volume_of(scene, &polygons_of(scene, objects, true))
}

fn closure_and_volume_of(scene: &Scene, polygons: &[&Polygon]) -> (DVec3, f64) {
    let mut sums = (DVec3::ZERO, 0.0);
    for polygon in polygons {
        let corners = corners(scene, polygon);
        let area = 0.5 * double_area(&corners);
        sums.0 += area;
        sums.1 += area.dot(corners[0]) / 3.0;
    }
    sums
}

#[test]
fn every_builtin_opens_without_a_warning_but_for_those_that_are_dark() {
    for builtin in BUILTINS {
        let scene = open(builtin.name);
        let is_dark = DARK.contains(&builtin.name);
        let warnings = scene.findings.iter().filter(|finding| finding.severity == Severity::Warning);
        let warnings: Vec<_> = warnings.map(|finding| finding.kind).collect();
        let expected: &[FindingKind] = if is_dark { &[FindingKind::NoEmitter] } else { &[] };
        assert_eq!(warnings, expected, "{}: {:#?}", builtin.name, scene.findings);
        assert_eq!(scene.has_emitter(), !is_dark, "{}", builtin.name);
        assert_eq!(scene.source, Source::Builtin(builtin.name));
        assert_eq!(scene.name, builtin.name);
        assert!(scene.viewpoint.is_some());
        assert!(!builtin.description.contains('\n'));
    }
}

#[test]
fn only_the_measured_walls_are_out_of_plane() {
    for builtin in BUILTINS {
        let scene = open(builtin.name);
        // That radiosity does not see what a material reflects as a mirror is nothing wrong with the scene, nor that it
        // is meant to be dark.
        let is_fine = |kind: &FindingKind| matches!(kind, FindingKind::SpecularIgnored | FindingKind::NoEmitter);
        let kinds = scene.findings.iter().map(|finding| finding.kind);
        let kinds: Vec<_> = kinds.filter(|kind| !is_fine(kind)).collect();
        let is_measured = builtin.name.ends_with("-box") || builtin.name == "cornell-spheres";
        let expected: &[FindingKind] = if is_measured { &[FindingKind::NonPlanarFace] } else { &[] };
        assert_eq!(kinds, expected, "{}: {:#?}", builtin.name, scene.findings);
    }
}

#[test]
fn balls_rings_and_rods_are_smooth_and_the_rest_is_flat() {
    // The ends of the rod and the top of the ring are flat.
    for (name, object, smooth, flat) in [
        ("cornell-spheres", "mirror_ball", 2048, 0),
        ("cornell-spheres", "glass_ball", 2048, 0),
        ("cornell-spheres", "floor", 0, 1),
        ("caustic-ring", "ring", 256, 128),
        ("glass-block", "rod", 96, 192),
        ("glass-block", "prism", 0, 5),
        ("glossy-floor", "yellow_ball", 2048, 0),
        ("ao-study", "large_ball", 48 * 24, 0),
        ("ao-study", "stair", 0, 21 + 21 + 4 * 6),
    ] {
        let scene = open(name);
        let faces = scene.polygons.iter().filter(|face| scene.objects[face.object as usize] == object);
        let (round, plane): (Vec<&Polygon>, Vec<&Polygon>) = faces.partition(|face| face.normals().is_some());
        assert_eq!((round.len(), plane.len()), (smooth, flat), "{name}: {object}");
    }
}

/// The balls are as large as polyhedra inside spheres can be: 64 × 32 faces lack 0.5 %.
#[test]
fn bodies_of_glass_are_closed_and_look_outwards() {
    let ball = 4.0 / 3.0 * std::f64::consts::PI * 0.1_f64.powi(3);
    let prism = 3.0_f64.sqrt() / 4.0 * 0.14 * 0.14 * 0.16;
    let rod = std::f64::consts::PI * 0.06 * 0.06 * 0.26;
    for (name, object, volume) in
        [("cornell-spheres", "glass_ball", ball), ("glass-block", "prism", prism), ("glass-block", "rod", rod)]
    {
        let scene = open(name);
        let (closure, inside) = closure_and_volume(&scene, &[object]);
        assert!(closure.length() < 1e-7, "{name}: {object} is open by {closure}");
        assert!(inside < volume * (1.0 + 1e-4) && inside > 0.99 * volume, "{name}: {object} has {inside} m³");
        assert!(scene.materials[polygon_of(&scene, object).material as usize].is_glass());
    }
}

#[test]
fn the_cornell_box_has_the_measured_places() {
    let scene = open("cornell-box");
    // Floor, ceiling, back and right wall, lamp, five faces of each block; the red wall is two triangles.
    assert_eq!(scene.polygons.len(), 5 + 10 + 2);
    let lamp = corners(&scene, polygon_of(&scene, "lamp"));
    let measured = [[343.0, 548.8, 227.0], [343.0, 548.8, 332.0], [213.0, 548.8, 332.0], [213.0, 548.8, 227.0]];
    for (corner, measured) in lamp.iter().zip(measured) {
        assert!(corner.distance(DVec3::from(measured) / 1000.0) < 1e-7, "{corner}");
    }
    let area = double_area(&lamp).length() / 2.0;
    assert!((area - 0.130 * 0.105).abs() < 1e-7);
    // The lamp and the ceiling shine down, the floor up; walls face the middle of the room.
    assert!(double_area(&lamp).y < 0.0);
    let middle = DVec3::new(0.278, 0.274, 0.28);
    for object in ["floor", "ceiling", "back_wall", "right_wall", "left_wall"] {
        let wall = corners(&scene, polygon_of(&scene, object));
        assert!(double_area(&wall).dot(middle - wall[0]) > 0.0, "{object} faces away");
    }
}

#[test]
fn the_cornell_camera_sees_the_red_wall_on_the_left() {
    let scene = open("cornell-box");
    let view = scene.viewpoint.expect("the camera was measured");
    let forward = (view.target - view.eye).normalize();
    assert!(forward.distance(Vec3::Z) < 1e-6);
    let right = forward.cross(view.up).normalize();
    let red = corners(&scene, polygon_of(&scene, "left_wall"))[0];
    assert!(right.as_dvec3().dot(red - view.eye.as_dvec3()) < 0.0);
    let material = polygon_of(&scene, "left_wall").material as usize;
    assert_eq!(scene.materials[material].name, "red");
    // A 25 mm film behind a 35 mm lens.
    let degrees = 2.0 * (12.5_f64 / 35.0).atan().to_degrees();
    assert!((f64::from(view.vertical_fov) - degrees).abs() < 1e-5);
}

#[test]
fn the_furnace_is_a_closed_unit_cube_seen_from_inside() {
    let scene = open("furnace");
    let (closure, volume) = closure_and_volume(&scene, &["cube"]);
    assert_eq!(closure, DVec3::ZERO);
    // Negative, because the fronts face inwards.
    assert_eq!(volume, -1.0);
    let material = &scene.materials[0];
    assert_eq!(scene.materials.len(), 1);
    assert!((material.exitance() - Vec3::ONE).abs().max_element() < 1e-6, "M_e is 1 W/m²");
    assert_eq!(material.diffuse, Vec3::splat(0.5));
}

/// Every edge of the shell belongs to two faces, which run along it in opposite directions: nothing leaks, and no
/// two faces of it disagree on which side the room is.
#[test]
fn shells_are_closed_edge_to_edge() {
    let shells = [
        ("furnace", vec!["cube"], -1.0),
        // Two rooms of 4 m × 4 m × 2.6 m and a doorway of 0.2 m × 0.95 m × 2.05 m.
        ("two-rooms", vec!["lamp_room", "doorway", "far_room"], -(2.0 * 4.0 * 4.0 * 2.6 + 0.2 * 0.95 * 2.05)),
        ("gallery", GALLERY_SHELL.to_vec(), gallery_volume()),
        ("glossy-floor", vec!["floor", "ceiling", "walls"], -4.0 * 4.0 * 2.6),
        ("machine-hall", HALL_SHELL.to_vec(), hall_volume()),
    ];
    for (name, objects, volume) in shells {
        let scene = open(name);
        let edges = directed_edges(&polygons_of(&scene, &objects, true));
        for (&(from, to), &count) in &edges {
            let place = scene.positions[from as usize];
            assert_eq!((count, edges.get(&(to, from))), (1, Some(&1)), "{name}: an open edge at {place}");
        }
        let (_, enclosed) = closure_and_volume(&scene, &objects);
        assert!((enclosed / volume - 1.0).abs() < 1e-5, "{name} encloses {enclosed}, not {volume} m³");
    }
}

const GALLERY_SHELL: [&str; 10] = [
    "floor",
    "carpet",
    "left_wall",
    "windows",
    "right_wall",
    "aisles_and_beams",
    "vault",
    "ribs",
    "entrance_wall",
    "end_wall",
];

/// 24 m of a cross-section: 10 m × 5.2 m less two beams of 0.6 m × 0.6 m, and a half-round vault of twelve flat strips of
/// radius 2.3 m, 2.16 m in seven ribs of 0.4 m; and eight window reveals of 1.2 m × 2.8 m, 0.3 m deep, facing
/// eight niches, 0.25 m deep.
fn gallery_volume() -> f64 {
    let half_round = |radius: f64| 12.0 * 0.5 * radius * radius * (std::f64::consts::PI / 12.0).sin();
    let ribs = 7.0 * 0.4;
    let hall = 24.0 * (10.0 * 5.2 - 2.0 * 0.36);
    let vault = (24.0 - ribs) * half_round(2.3) + ribs * half_round(2.16);
    -(hall + vault + 8.0 * 1.2 * 2.8 * (0.3 + 0.25))
}

const HALL_SHELL: [&str; 4] = ["floor", "pit", "walls", "roof"];

/// 30 m of a cross-section of 18 m × 8 m and a gable of 2 m; a pit, ten windows 0.3 m deep, and a gate as deep.
fn hall_volume() -> f64 {
    let hall = 30.0 * (18.0 * 8.0 + 18.0 * 2.0 / 2.0);
    -(hall + 24.0 * 1.44 * 0.6 + 10.0 * 3.8 * 3.4 * 0.3 + 5.4 * 4.6 * 0.3)
}

#[test]
fn emitters_face_the_room() {
    for (name, objects) in [("two-rooms", vec!["lamp"]), ("gallery", vec!["lantern_1"])] {
        let scene = open(name);
        let lamp: Vec<_> =
            scene.polygons.iter().filter(|p| objects.contains(&&*scene.objects[p.object as usize])).collect();
        let middle =
            |polygon: &Polygon| corners(&scene, polygon).iter().sum::<DVec3>() / polygon.corners().len() as f64;
        for object in &objects {
            let faces = lamp.iter().filter(|p| scene.objects[p.object as usize] == *object);
            let faces: Vec<_> = faces.filter(|p| scene.materials[p.material as usize].name != "iron").collect();
            let center = faces.iter().map(|p| middle(p)).sum::<DVec3>() / faces.len() as f64;
            for face in &faces {
                assert!(double_area(&corners(&scene, face)).dot(middle(face) - center) > 0.0, "{name}: {object}");
            }
        }
    }
    let scene = open("gallery");
    let window = corners(&scene, polygon_of(&scene, "windows"));
    assert!(double_area(&window).x > 0.0, "windows shine into the hall");
}
