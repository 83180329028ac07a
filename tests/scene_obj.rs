//! What the loader makes of OBJ and MTL text: geometry, materials, and that no text makes it panic.

use glam::{DVec3, Vec3};
use lightwell::scene::{Finding, FindingKind, Material, Scene, SceneError, Severity};
use proptest::prelude::*;
use std::path::Path;

const LAMP: &str = "newmtl lamp\nKd 0.5 0.5 0.5\nKe 1 1 1\nnewmtl white\nKd 0.7 0.7 0.7\nnewmtl red\nKd 0.6 0.1 0.1\n";
const HEAD: &str = "mtllib scene.mtl\nusemtl lamp\n";

/// Opens an OBJ text that may name `scene.mtl`.
fn open(obj: &[u8], mtl: &[u8]) -> Result<Scene, SceneError> {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let path = folder.path().join("scene.obj");
    std::fs::write(&path, obj).expect("the scene can be written");
    std::fs::write(folder.path().join("scene.mtl"), mtl).expect("the materials can be written");
    Scene::open(path.to_str().expect("the path is text"))
}

fn scene(obj: &str) -> Scene {
    open(obj.as_bytes(), LAMP.as_bytes()).expect("the scene opens")
}

fn corpus(file: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(file);
    Scene::open(path.to_str().expect("the path is text")).expect("the scene opens")
}

fn kinds(findings: &[Finding]) -> Vec<FindingKind> {
    findings.iter().map(|finding| finding.kind).collect()
}

/// The sum of the polygons' area vectors: of a flat face cut into pieces, its area along its normal.
fn area(scene: &Scene) -> DVec3 {
    let area_of = |corners: &[u32]| {
        let corners: Vec<DVec3> = corners.iter().map(|&c| scene.positions[c as usize].as_dvec3()).collect();
        (2..corners.len()).map(|i| 0.5 * (corners[i - 1] - corners[0]).cross(corners[i] - corners[0])).sum::<DVec3>()
    };
    scene.polygons.iter().map(|polygon| area_of(polygon.corners())).sum()
}

/// The sum of the polygons' areas, whichever way they face.
fn covered(scene: &Scene) -> f64 {
    let single = |i: usize| Scene { polygons: vec![scene.polygons[i]], ..scene.clone() };
    (0..scene.polygons.len()).map(|i| area(&single(i)).length()).sum()
}

#[test]
fn objects_materials_and_lines_belong_to_their_faces() {
    let scene = scene(
        "mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nusemtl lamp\no first\nf 1 2 3 4\nf 1 2 5\n\
         usemtl red\nf -4 -3 -1\ng second\nusemtl lamp\nf 3 4 5\n",
    );
    let told: Vec<_> = scene
        .polygons
        .iter()
        .map(|p| (p.line, &*scene.objects[p.object as usize], &*scene.materials[p.material as usize].name))
        .collect();
    assert_eq!(
        told,
        [(9, "first", "lamp"), (10, "first", "lamp"), (12, "first", "red"), (15, "second", "lamp")],
        "in the order of the file"
    );
    assert_eq!(scene.polygons[2].corners().len(), 3);
    assert_eq!(scene.positions[scene.polygons[2].corners()[0] as usize], Vec3::new(1.0, 0.0, 0.0), "-4 of 5 is 2");
    assert!(scene.findings.is_empty(), "{:#?}", scene.findings);
}

#[test]
fn faces_at_the_same_place_share_their_corners() {
    // Two squares side by side, each with corners of its own, one of them −0.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nv 1 -0 0\nv 2 0 0\nv 2 1 0\nv 1 1 -0\nf 5 6 7 8\n";
    let scene = scene(&(HEAD.to_owned() + text));
    assert_eq!(scene.positions.len(), 6);
}

#[test]
fn concave_faces_keep_their_area_and_winding() {
    let scene = corpus("concave.obj");
    // The L of 3 m² and the arrow head of 1 m² both wind counter-clockwise seen from +z.
    assert!(area(&scene).distance(DVec3::new(0.0, 0.0, 4.0)) < 1e-12, "{}", area(&scene));
    assert!((covered(&scene) - 4.0).abs() < 1e-12, "no two pieces overlap");
}

#[test]
fn corners_on_a_straight_edge_are_kept() {
    // A square with a corner in the middle of each edge, and a quad that is a triangle with one more corner.
    let octagon = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 2 2 0\nv 1 2 0\nv 0 2 0\nv 0 1 0\nf 1 2 3 4 5 6 7 8\n";
    let square = scene(&(HEAD.to_owned() + octagon));
    assert_eq!(square.positions.len(), 8);
    assert_eq!(square.polygons.len(), 6);
    assert!(area(&square).distance(DVec3::Z * 4.0) < 1e-12);
    let triangle = scene(&(HEAD.to_owned() + "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3 4\n"));
    assert_eq!((triangle.positions.len(), triangle.polygons.len()), (4, 2));
    assert!(triangle.findings.is_empty());
}

#[test]
fn scenes_of_every_scale_are_read_alike() {
    for file in ["warped.obj", "degenerate.obj", "concave.obj", "crossed.obj", "duplicate.obj"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(file);
        let text = std::fs::read_to_string(path).expect("the corpus is there").replace("lamp.mtl", "scene.mtl");
        let scaled = |scale: f64| {
            let lines = text.lines().map(|line| match line.strip_prefix("v ") {
                Some(rest) => rest.split(' ').fold("v".to_owned(), |line, word| {
                    format!("{line} {:e}", word.parse::<f64>().expect("the corpus has numbers here") * scale)
                }),
                None => line.to_owned(),
            });
            scene(&lines.collect::<Vec<_>>().join("\n"))
        };
        let original = scaled(1.0);
        for scale in [1e-6, 1e-3, 1e6] {
            let other = scaled(scale);
            assert_eq!(other.polygons, original.polygons, "{file} × {scale}");
            assert_eq!(kinds(&other.findings), kinds(&original.findings), "{file} × {scale}");
        }
    }
}

#[test]
fn faces_that_were_left_out_leave_no_positions_behind() {
    let scene = scene(&(HEAD.to_owned() + "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 900 0 0\nv 901 0 0\nf 1 2 3\nf 4 5 4\n"));
    assert_eq!(kinds(&scene.findings), [FindingKind::DegenerateFace]);
    assert_eq!(scene.positions, [Vec3::ZERO, Vec3::X, Vec3::Y]);
}

#[test]
fn values_out_of_range_are_mended() {
    let scene = corpus("bad-values.obj");
    let material = |name: &str| scene.materials.iter().find(|m| m.name == name).expect("the material is used");
    assert_eq!(material("a").diffuse, Vec3::splat(0.25), "the later of two definitions");
    let b = material("b");
    assert_eq!((b.diffuse, b.emission), (Vec3::new(0.0, 0.2, 0.3), Vec3::new(0.0, 1.0, 1.0)));
    assert_eq!((b.shininess, b.refraction_index), (0.0, 0.001));
    let c = material("c");
    assert_eq!((c.diffuse, c.emission, c.illumination_model), (Vec3::splat(0.5), Vec3::ZERO, None));
    let d = material("d");
    assert_eq!((d.diffuse, d.transmission), (Vec3::new(0.0, 0.1, 0.1), Vec3::new(0.5, 1.0, 1.0)));
    assert_eq!(d.opacity, 1.0);
}

#[test]
fn reflectance_is_kept_below_one() {
    let obj = format!("{HEAD}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let scene = open(obj.as_bytes(), b"newmtl lamp\nKd 1 0.999 2\nKe 1 1 1\n").expect("the scene opens");
    assert_eq!(scene.materials[0].diffuse, Vec3::splat(Material::MAX_REFLECTANCE));
    assert_eq!(kinds(&scene.findings), [FindingKind::ReflectanceClamped]);
    assert_eq!(scene.findings[0].subject, "material 'lamp', line 2");
    assert_eq!(scene.findings[0].problem, "Kd 1 0.999 2 is a reflectance above 0.999");
}

#[test]
fn opacity_comes_from_d_before_tr() {
    for (text, opacity) in
        [("d 0.25", 0.25), ("Tr 0.25", 0.75), ("Tr 1\nd 1", 1.0), ("d 1\nTr 1", 1.0), ("d -halo 0.5", 0.5)]
    {
        let obj = format!("{HEAD}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        let mtl = format!("newmtl lamp\nKd 0.5\nKe 1\n{text}\n");
        let scene = open(obj.as_bytes(), mtl.as_bytes()).expect("the scene opens");
        assert_eq!(scene.materials[0].opacity, opacity, "{text}");
        assert_eq!(scene.materials[0].transmission, Vec3::ONE);
    }
}

#[test]
fn layout_and_encoding_do_not_matter() {
    let scene = corpus("layout.obj");
    assert_eq!(scene.objects, ["the lamp"]);
    assert_eq!(scene.materials[0].name, "lamp");
    assert_eq!(scene.polygons[0].line, 10);
    assert_eq!(scene.polygons[0].corners().len(), 4);
    let names = corpus("names.obj");
    assert_eq!(names.objects, ["Material #25"]);
    assert_eq!(names.materials.iter().map(|m| &*m.name).collect::<Vec<_>>(), ["Material #25", "pale  blue"]);
}

/// A room of 4 m × 3 m × 2 m without a lamp, scaled.
fn dark_room(scale: f32) -> Scene {
    let corner = |i: u32| Vec3::new((i & 1) as f32 * 4.0, (i >> 1 & 1) as f32 * 3.0, (i >> 2) as f32 * 2.0) * scale;
    let vertices: String = (0..8).map(corner).map(|p| format!("v {:e} {:e} {:e}\n", p.x, p.y, p.z)).collect();
    scene(&format!(
        "mtllib scene.mtl\nusemtl white\n{vertices}f 1 5 6 2\nf 3 4 8 7\nf 1 2 4 3\nf 5 7 8 6\nf 1 3 7 5\nf 2 6 8 4\n"
    ))
}

#[test]
fn a_dark_scene_gets_one_ceiling_light() {
    for scale in [1e-6, 1.0, 1e6] {
        let dark = dark_room(scale);
        assert_eq!(kinds(&dark.findings), [FindingKind::NoEmitter]);
        let lit = dark.with_ceiling_light();
        assert_eq!(lit.polygons.len(), 7);
        assert_eq!(kinds(&lit.findings), [FindingKind::CeilingLightAdded]);
        let light = Scene { polygons: lit.polygons[6..].to_vec(), ..lit.clone() };
        let expected = DVec3::new(0.0, -(4.0 / 4.0) * (2.0 / 4.0), 0.0) * f64::from(scale).powi(2);
        assert!(area(&light).distance(expected) < 1e-5 * expected.length(), "a quarter of each edge, facing down");
        for &corner in lit.polygons[6].corners() {
            let height = lit.positions[corner as usize].y / scale;
            assert!((height - 2.96).abs() < 1e-5, "1 % of 4 m under the ceiling, not at {height}");
        }
        let again = lit.with_ceiling_light();
        assert_eq!((again.polygons.len(), again.findings.len()), (7, 1), "adding twice adds one");
    }
}

#[test]
fn the_ceiling_light_is_as_bright_as_stated() {
    // Below the middle of a cube E ≈ L A / h², with A / h² = SHARE² and L = 20: 20 / 16 W/m², less what distance to the
    // light's own edges takes. Here it is the material that is checked; the room's irradiance follows from it.
    let lit = dark_room(1.0).with_ceiling_light();
    let material = &lit.materials[lit.polygons[6].material as usize];
    assert_eq!(material.emission, Vec3::splat(20.0));
    let remedy = &lit.findings[0].remedy;
    assert!(remedy.contains("not in the file") && remedy.contains("1 m × 0.5 m, 20 W/(m²·sr)"), "{remedy}");
}

#[test]
fn a_bare_floor_is_lit_from_above() {
    let floor = scene("mtllib scene.mtl\nusemtl white\nv 0 0 0\nv 0 0 2\nv 2 0 2\nv 2 0 0\nf 1 2 3 4\n");
    let lit = floor.with_ceiling_light();
    let light = lit.polygons.last().expect("a light was added");
    assert!(light.corners().iter().all(|&corner| lit.positions[corner as usize].y == 1.0));
}

/// Emitted flux of all channels, W.
fn emitted(scene: &Scene) -> f64 {
    let flux = |i: usize| {
        let single = Scene { polygons: vec![scene.polygons[i]], ..scene.clone() };
        let exitance = scene.materials[scene.polygons[i].material as usize].exitance();
        area(&single).length() * f64::from(exitance.element_sum())
    };
    (0..scene.polygons.len()).map(flux).sum()
}

/// A unit square with its front to +z, and the same with other winding and first corner.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn a_face_and_its_back_are_kept_where_they_differ() {
    let mtl = format!("{LAMP}newmtl glass\nKd 0\nNi 1.5\nillum 7\nnewmtl water\nKd 0\nNi 1.33\nillum 7\n");
    // Materials of front and back, polygons, and how grave it is that one is left out.
    for (front, back, polygons, severity) in [
        ("lamp", "lamp", 2, None),
        ("lamp", "white", 2, None),
        ("white", "red", 2, None),
        ("white", "glass", 2, None),
        ("white", "white", 1, Some(Severity::Note)),
        ("glass", "glass", 1, Some(Severity::Warning)),
        ("glass", "water", 1, Some(Severity::Warning)),
    ] {
        for ring in ["4 3 2 1", "2 1 4 3"] {
            let obj = format!("mtllib scene.mtl\n{SQUARE}usemtl {front}\nf 1 2 3 4\nusemtl {back}\nf {ring}\n");
            let scene = open(obj.as_bytes(), mtl.as_bytes()).expect("the scene opens");
            assert_eq!(scene.polygons.len(), polygons, "{front} and {back}");
            let told = scene.findings.iter().find(|finding| finding.kind == FindingKind::DuplicateFace);
            assert_eq!(told.map(|finding| finding.severity), severity, "{front} and {back}");
        }
    }
}

#[test]
fn a_face_stated_again_is_left_out_at_whichever_corner_it_begins() {
    for ring in ["1 2 3 4", "2 3 4 1", "4 1 2 3"] {
        let scene = scene(&format!("{HEAD}{SQUARE}f 1 2 3 4\nf 4 3 2 1\nf {ring}\nf 3 2 1 4\n"));
        assert_eq!((scene.polygons.len(), scene.findings.len()), (2, 2), "{:#?}", scene.findings);
    }
}

#[test]
fn a_panel_of_two_lamps_back_to_back_emits_from_both() {
    // The back has corners of its own. 2 · 1 m² · π · 3 channels · 1 W/(m²·sr).
    let scene = scene(&format!("{HEAD}{SQUARE}f 1 2 3 4\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv 0 0 0\nf 5 6 7 8\n"));
    assert!((emitted(&scene) / (6.0 * std::f64::consts::PI) - 1.0).abs() < 1e-6, "{}", emitted(&scene));
    assert!(area(&scene).length() < 1e-12, "one shines up and one down");
}

/// Pieces of the only face, each as the places of its corners in the face.
fn pieces(corners: &[DVec3]) -> Vec<Vec<usize>> {
    let vertices: String = corners.iter().map(|p| format!("v {} {} {}\n", p.x, p.y, p.z)).collect();
    let ring: String = (1..=corners.len()).map(|i| format!(" {i}")).collect();
    let scene = scene(&format!("{HEAD}{vertices}f{ring}\n"));
    let place = |corner: &u32| {
        let position = scene.positions[*corner as usize];
        corners.iter().position(|stated| stated.as_vec3() == position).expect("a corner of the face")
    };
    scene.polygons.iter().map(|polygon| polygon.corners().iter().map(place).collect()).collect()
}

#[test]
fn warped_quads_are_cut_along_their_shorter_diagonal() {
    // The left wall of the Cornell box as Cardenas and McGuire measured it (2011): 2.8427 m against 2.8429 m.
    let wall = [[-1.01, 0.0, 0.99], [-0.99, 0.0, -1.04], [-1.02, 1.99, -1.04], [-1.02, 1.99, 0.99]];
    let mut wall: Vec<DVec3> = wall.map(DVec3::from_array).to_vec();
    assert_eq!(pieces(&wall), [[0, 1, 2], [0, 2, 3]]);
    wall.rotate_left(1);
    assert_eq!(pieces(&wall), [[0, 1, 3], [1, 2, 3]]);
    // A saddle has two diagonals of the same length; tinyobjloader takes the one from the second corner.
    let saddle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [1.0, 1.0, 0.0], [0.0, 1.0, 0.1]].map(DVec3::from_array);
    assert_eq!(pieces(&saddle), [[0, 1, 3], [1, 2, 3]]);
    // The shorter diagonal of this arrow head lies outside of it.
    let arrow = [[0.0, 0.0, 0.0], [3.0, -1.0, 0.0], [2.5, 0.0, 0.1], [3.0, 1.0, 0.0]].map(DVec3::from_array);
    assert_eq!(pieces(&arrow), [[0, 1, 2], [0, 2, 3]]);
}

/// The faces of a closed room of 4 m × 3 m × 4 m with a lamp of 0.2 m × 0.2 m, `at` from the origin.
fn room_at(at: DVec3) -> String {
    let corner = |i: u32| at + DVec3::new(f64::from(i & 1) * 4.0, f64::from(i >> 1 & 1) * 3.0, f64::from(i >> 2) * 4.0);
    let lamp = [[1.9, 1.9], [2.1, 1.9], [2.1, 2.1], [1.9, 2.1]].map(|[x, z]| at + DVec3::new(x, 2.9, z));
    let vertices: String = (0..8).map(corner).chain(lamp).map(|p| format!("v {} {} {}\n", p.x, p.y, p.z)).collect();
    let room = "f 1 5 6 2\nf 3 4 8 7\nf 1 2 4 3\nf 5 7 8 6\nf 1 3 7 5\nf 2 6 8 4\n";
    format!("mtllib scene.mtl\n{vertices}o room\nusemtl white\n{room}o lamp\nusemtl lamp\nf 9 10 11 12\n")
}

/// A triangle with legs of 1 m, as an object of its own.
fn triangle_at(name: &str, at: DVec3) -> String {
    let [a, b, c] = [at, at + DVec3::X, at + DVec3::Y].map(|p| format!("v {} {} {}\n", p.x, p.y, p.z));
    format!("o {name}\nusemtl white\n{a}{b}{c}f -3 -2 -1\n")
}

/// What a room of [`room_at`] emits, W: 0.04 m² · π · 3 channels.
const ROOM_EMITS: f64 = 0.12 * std::f64::consts::PI;

#[test]
fn a_scene_keeps_its_digits_and_its_coordinates_wherever_it_is() {
    let near = scene(&room_at(DVec3::ZERO));
    assert_eq!(near.origin, DVec3::ZERO);
    for at in [DVec3::splat(3072.0), DVec3::new(-3_000_008.0, 0.0, 8e8)] {
        let far = scene(&room_at(at));
        assert_eq!(kinds(&far.findings), [FindingKind::SceneMoved], "{at}");
        assert!((emitted(&far) / ROOM_EMITS - 1.0).abs() < 1e-5, "{at}: {}", emitted(&far));
        for (moved, stated) in far.positions.iter().zip(&near.positions) {
            // The file states coordinates with ε/2 of double precision, that is 6e-8 m at 8e8 m; single precision adds 1e-7 m.
            let expected = stated.as_dvec3() + at;
            assert!(far.file_from_scene(*moved).distance(expected) < 6e-7, "{at}");
            assert!(far.scene_from_file(expected).distance(*moved) < 6e-7, "{at}");
        }
    }
    // Moved by a multiple of a power of two above its extent, what can be halved a few times is the very same.
    let far = scene(&room_at(DVec3::splat(3072.0)));
    assert_eq!(far.origin, DVec3::splat(3072.0));
    assert_eq!(far.positions[..8], near.positions[..8]);
}

#[test]
fn coordinates_in_the_file_are_as_short_as_they_were() {
    let scene = Scene { origin: DVec3::new(3000.0, 0.0, -0.5), ..scene(&room_at(DVec3::ZERO)) };
    assert_eq!(scene.file_from_scene(Vec3::new(0.25, 0.1, -0.3)), DVec3::new(3000.25, 0.1, -0.8));
}

#[test]
fn stray_faces_are_left_out_by_name_and_the_rest_keeps_its_light() {
    let far = DVec3::splat(3e6);
    let stray = |name: &str, at: DVec3| triangle_at(name, at);
    for (strays, subject) in [
        (stray("stray", DVec3::ZERO), "object 'stray', line 30"),
        (stray("one", DVec3::ZERO) + &stray("other", 2.0 * far), "object 'one', line 30 and 1 more"),
        (stray("one", DVec3::ZERO) + &stray("other", DVec3::new(3e6, 0.0, 3e6)), "object 'one', line 30 and 1 more"),
    ] {
        let scene = scene(&(room_at(far) + &strays));
        assert_eq!(scene.polygons.len(), 7);
        assert_eq!(kinds(&scene.findings), [FindingKind::FaceTooFar, FindingKind::SceneMoved], "{:#?}", scene.findings);
        assert_eq!(scene.findings[0].subject, subject);
        assert!(scene.findings[0].problem.contains("single precision"), "{}", scene.findings[0]);
        assert!((emitted(&scene) / ROOM_EMITS - 1.0).abs() < 1e-5, "{}", emitted(&scene));
    }
}

#[test]
fn what_surrounds_a_scene_or_can_be_held_beside_it_is_kept() {
    // 32 ε of 4 km are 1.6 cm: 1/256 of the room.
    let near = triangle_at("near", DVec3::new(0.0, 4000.0, 0.0));
    // A ground of 100 km has no gap around it.
    let ground =
        "o ground\nusemtl white\nv -5e4 0 -5e4\nv -5e4 0 5e4\nv 5e4 0 5e4\nv 5e4 0 -5e4\nf -4 -3 -2 -1\n".to_owned();
    for beside in [near, ground] {
        let scene = scene(&(room_at(DVec3::ZERO) + &beside));
        assert_eq!((scene.polygons.len(), scene.origin), (8, DVec3::ZERO));
        assert!(scene.findings.is_empty(), "{:#?}", scene.findings);
    }
}

#[test]
fn detail_that_is_lost_is_said() {
    // One corner of a face of the room is at the origin: no gap lies between.
    let spike = "o spike\nusemtl white\nv 0 0 0\nf 1 2 -1\n";
    let scene = scene(&(room_at(DVec3::splat(3e6)) + spike));
    assert_eq!(kinds(&scene.findings), [FindingKind::SceneMoved, FindingKind::DetailLost], "{:#?}", scene.findings);
    assert!(scene.findings[1].remedy.contains("object 'spike', line 28"), "{}", scene.findings[1]);
    assert!((emitted(&scene) / ROOM_EMITS - 1.0).abs() < 1e-5, "{}", emitted(&scene));
}

/// A strip of a roof from x = 0.7 m on, 2 m long.
fn strip(width: f64) -> String {
    let far = 0.7 + width;
    format!("{HEAD}v 0.7 1 0\nv {far} 1 0\nv {far} 1 2\nv 0.7 1 2\nf 4 3 2 1\n")
}

#[test]
fn narrow_faces_are_kept_as_long_as_single_precision_holds_them() {
    // A unit in the last place of 0.7 is 6e-8.
    for (width, kind) in [
        (1e-6, None),
        (4e-7, None),
        (1e-7, None),
        (1e-8, Some(FindingKind::FaceTooNarrow)),
        (1e-12, Some(FindingKind::FaceTooNarrow)),
        (0.0, Some(FindingKind::DegenerateFace)),
    ] {
        // A triangle beside it, so that there is a scene.
        let scene = scene(&(strip(width) + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n"));
        assert_eq!(kinds(&scene.findings), kind.into_iter().collect::<Vec<_>>(), "{width}");
        let strip = Scene { polygons: scene.polygons[..scene.polygons.len() - 1].to_vec(), ..scene.clone() };
        assert_eq!(strip.polygons.len(), usize::from(kind.is_none()), "{width}");
        assert!(kind.is_some() || area(&strip).normalize().distance(DVec3::Y) < 1e-12, "{width}");
    }
}

#[test]
fn corners_on_a_line_in_decimals_have_no_area_wherever_they_are() {
    // None of these is on the line when rounded to single precision, or even to double precision.
    for at in ["", "100000"] {
        let line: String = (1..=3).map(|i| format!("v {at}0.{i} {at}0.{} {at}0.{}\n", 2 * i, 3 * i)).collect();
        let scene = scene(&format!("{HEAD}{line}f 1 2 3\nv {at}0 {at}0 {at}0\nv {at}1 {at}0 {at}0\nf 1 4 5\n"));
        assert!(kinds(&scene.findings).contains(&FindingKind::DegenerateFace), "{at}: {:#?}", scene.findings);
        assert_eq!(scene.polygons.len(), 1, "{at}");
    }
}

/// A rotation by `turns` around an axis that is no axis of the frame.
fn tilted(point: DVec3, turns: f64) -> DVec3 {
    glam::DQuat::from_axis_angle(DVec3::new(0.4, 0.7, -0.6).normalize(), turns * std::f64::consts::TAU) * point
}

proptest! {
    /// A flat rectangle stays one quad however it is turned and placed, when it is written with six decimals: its corners
    /// then are apart along the normal by at most 2 · √3 · 0.5e-6. Of a rectangle of 3 m one coordinate is 1.2 m or
    /// more, and 16 ε of that is 2.3e-6.
    #[test]
    fn flat_quads_stay_whole(turns in 0.0..1.0, width in 3.0..20.0, height in 3.0..20.0, at in -1.0..1.0) {
        let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
        let vertices: String = corners.iter().map(|&[x, y]| {
            let p = tilted(DVec3::new(x, y, 0.0), turns) + DVec3::splat(at);
            format!("v {:.6} {:.6} {:.6}\n", p.x, p.y, p.z)
        }).collect();
        let scene = scene(&format!("{HEAD}{vertices}f 1 2 3 4\n"));
        prop_assert_eq!(scene.polygons.len(), 1);
        prop_assert!(scene.findings.is_empty());
    }

    /// A quad whose corners are off its plane and off a square by up to a fifth, so that it is convex as seen from above, is
    /// cut along its shorter diagonal into pieces that both face up and cover what its outline encloses.
    #[test]
    fn warped_quads_are_covered(off in prop::collection::vec(-0.2..0.2f64, 12)) {
        let square = [DVec3::ZERO, DVec3::X, DVec3::ONE - DVec3::Z, DVec3::Y];
        let corners: Vec<DVec3> = (0..4).map(|i| square[i] + DVec3::new(off[3 * i], off[3 * i + 1], off[3 * i + 2])).collect();
        let pieces = pieces(&corners);
        prop_assume!(pieces.len() == 2);
        let double_area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
        let areas: Vec<DVec3> = pieces.iter().map(|piece| double_area([0, 1, 2].map(|i| corners[piece[i]]))).collect();
        prop_assert!(areas.iter().all(|area| area.z > 0.0));
        let outline = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
        prop_assert!(areas.iter().sum::<DVec3>().distance(outline) < 1e-12);
        let [first, second] = [[0, 2], [1, 3]].map(|[a, b]: [usize; 2]| corners[a].distance(corners[b]));
        // A margin for the rounding that makes two equal.
        prop_assume!((first / second - 1.0).abs() > 1e-6);
        prop_assert_eq!(pieces[0].contains(&2), first < second);
    }

    /// Star-shaped faces, concave as they come, keep their area, their winding and all of their corners.
    #[test]
    fn faces_of_any_size_keep_area_winding_and_corners(
        radii in prop::collection::vec(0.2..1.0f64, 5..40),
        turns in 0.0..1.0,
        scale in prop::sample::select(vec![1e-6, 1.0, 1e6]),
    ) {
        let count = radii.len();
        let outline: Vec<DVec3> = radii.iter().enumerate().map(|(i, radius)| {
            let (sine, cosine) = (i as f64 / count as f64 * std::f64::consts::TAU).sin_cos();
            scale * tilted(DVec3::new(radius * cosine, radius * sine, 0.0), turns)
        }).collect();
        let vertices: String = outline.iter().map(|p| format!("v {:e} {:e} {:e}\n", p.x, p.y, p.z)).collect();
        let corners: String = (1..=count).map(|i| format!(" {i}")).collect();
        let scene = scene(&format!("{HEAD}{vertices}f{corners}\n"));
        let exact: DVec3 = (0..count).map(|i| 0.5 * outline[i].cross(outline[(i + 1) % count])).sum();
        // Corners are rounded to single precision: each moves by at most ε/2 of the size, along an outline of at most
        // 2 · 40 sizes.
        let bound = 40.0 * f64::from(f32::EPSILON) * scale * scale;
        prop_assert!(area(&scene).distance(exact) < bound);
        prop_assert!((covered(&scene) - exact.length()).abs() < bound);
        prop_assert_eq!(scene.positions.len(), count);
    }

    /// Stairs with a corner at every unit of their outline, in a slanted plane: none of the many corners on straight
    /// edges gets lost, so neighbours that use them find an edge to share.
    #[test]
    fn corners_on_straight_edges_are_kept(heights in prop::collection::vec(1i32..5, 2..7), turn in 0usize..100) {
        let mut outline: Vec<(i32, i32)> = (0..=heights.len() as i32).map(|x| (x, 0)).collect();
        for (x, &height) in heights.iter().enumerate().rev() {
            while outline[outline.len() - 1].1 != height {
                let (x, y) = outline[outline.len() - 1];
                outline.push((x, y + (height - y).signum()));
            }
            outline.push((x as i32, height));
        }
        outline.extend((1..heights[0]).rev().map(|y| (0, y)));
        let count = outline.len();
        outline.rotate_left(turn % count);
        // Along (1, 1, 0) and (0, 1, 2), whose cross product is (2, -2, 1).
        let vertices: String = outline.iter().map(|(x, y)| format!("v {x} {} {}\n", x + y, 2 * y)).collect();
        let corners: String = (1..=count).map(|i| format!(" {i}")).collect();
        let scene = scene(&format!("{HEAD}{vertices}f{corners}\n"));
        let cells = f64::from(heights.iter().sum::<i32>());
        prop_assert!(area(&scene).distance(cells * DVec3::new(2.0, -2.0, 1.0)) < 1e-9);
        prop_assert!((covered(&scene) - 3.0 * cells).abs() < 1e-9);
        prop_assert_eq!((scene.positions.len(), scene.polygons.len()), (count, count - 2));
    }

    /// Any bytes at all.
    #[test]
    fn no_bytes_make_it_panic(obj in prop::collection::vec(any::<u8>(), 0..300), mtl in prop::collection::vec(any::<u8>(), 0..300)) {
        let _ = open(&obj, &mtl);
    }

    /// Statements with arguments that are nearly right.
    #[test]
    fn no_statements_make_it_panic(
        obj in prop::collection::vec(statement("v|f|o|g|usemtl|mtllib|vn|vt|l|fo|\\\\"), 0..60),
        mtl in prop::collection::vec(statement("newmtl|Kd|Ks|Ke|Ns|Ni|Tf|d|Tr|illum|map_Kd"), 0..30),
    ) {
        let obj = format!("mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1e-3\n{}", obj.join("\n"));
        check(open(obj.as_bytes(), mtl.join("\n").as_bytes()))?;
    }

    /// A real scene with one stretch overwritten, cut out or doubled.
    #[test]
    fn no_damage_makes_it_panic(from in 0usize..3000, length in 0usize..200, by in "[ -~\n]{0,40}", doubled: bool) {
        let text = include_str!("../assets/scenes/cornell-box.obj").replace("cornell-box.mtl", "scene.mtl");
        let from = from.min(text.len());
        let to = (from + length).min(text.len());
        let kept = if doubled { &text[from..to] } else { "" };
        let mtl = include_str!("../assets/scenes/cornell-box.mtl");
        let cut = |text: &str| text.get(from % 400..).unwrap_or("").to_owned() + &by;
        check(open(format!("{}{kept}{by}{kept}{}", &text[..from], &text[to..]).as_bytes(), mtl.as_bytes()))?;
        check(open(text.as_bytes(), cut(mtl).as_bytes()))?;
    }
}

fn statement(keywords: &'static str) -> impl Strategy<Value = String> {
    let number = "-?[0-9]{1,2}|[0-9]\\.[0-9]{1,3}e-?[0-9]{1,2}|nan|-inf|1e39|[1-9]/[0-9]?/-?[0-9]|a b|#|\\\\|white";
    (keywords, prop::collection::vec(number, 0..9))
        .prop_map(|(keyword, words)| format!("{keyword} {}", words.join(" ")))
}

/// Whatever was read, every promise of the scene holds.
fn check(opened: Result<Scene, SceneError>) -> Result<(), TestCaseError> {
    let Ok(scene) = opened else { return Ok(()) };
    prop_assert!(!scene.polygons.is_empty());
    for polygon in &scene.polygons {
        prop_assert!((polygon.material as usize) < scene.materials.len());
        prop_assert!((polygon.object as usize) < scene.objects.len());
        let single = Scene { polygons: vec![*polygon], ..scene.clone() };
        prop_assert!(area(&single).length() > 0.0, "every polygon has an area");
    }
    prop_assert!(scene.positions.iter().all(|p| p.is_finite()));
    for material in &scene.materials {
        let is_share = |color: Vec3, max: f32| color.min_element() >= 0.0 && color.max_element() <= max;
        prop_assert!(is_share(material.diffuse, Material::MAX_REFLECTANCE));
        prop_assert!(is_share(material.specular, 1.0) && is_share(material.transmission, 1.0));
        prop_assert!(is_share(material.emission, 1e12) && (0.0..=1.0).contains(&material.opacity));
        prop_assert!(material.shininess >= 0.0 && material.refraction_index > 0.0);
    }
    Ok(())
}
