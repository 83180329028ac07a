//! Bodies of glass as the doctor leaves them: fronts look out of the glass, and what has no inside is a sheet.

use crate::shapes::{cube, placed, sphere};
use crate::{object, scene, turned};
use glam::{DVec3, Vec3};
use lightwell::scene::{FindingKind, Lobes, Scene, Severity};

const MTL: &str = "newmtl glass\nKd 0 0 0\nTf 1 0.9 1\nNi 1.5\nillum 7\nnewmtl water\nKd 0 0 0\nNi 1.33\nillum 7\n\
                   newmtl chalk\nKd 0.8 0.8 0.8\nKe 1 1 1\n";

/// Findings about the shape of glass, with their subjects.
fn told(scene: &Scene) -> Vec<(FindingKind, Severity, &str)> {
    let about_shape = |kind| matches!(kind, FindingKind::GlassTurned | FindingKind::GlassOpen);
    let findings = scene.findings.iter().filter(|finding| about_shape(finding.kind));
    findings.map(|finding| (finding.kind, finding.severity, finding.subject.as_str())).collect()
}

/// What the faces of an object enclose, m³; negative where they look inwards.
fn volume(scene: &Scene, object: &str) -> f64 {
    let faces = scene.polygons.iter().filter(|polygon| scene.objects[polygon.object as usize] == object);
    let volumes = faces.map(|face| {
        let corner = |i: usize| scene.positions[face.corners()[i] as usize].as_dvec3();
        let [a, b, c]: [DVec3; 3] = [corner(0), corner(1), corner(2)];
        a.dot(b.cross(c)) / 6.0
    });
    volumes.sum()
}

/// Half the size of the unit ball, somewhere.
fn bubble() -> Vec<[Vec3; 3]> {
    placed(&sphere(2), 0.5, Vec3::new(0.2, 0.3, 0.1))
}

#[test]
fn bodies_that_look_outwards_stay_as_they_are() {
    let obj = object("ball", "glass", &sphere(2)) + &object("die", "glass", &placed(&cube(1), 1.0, Vec3::splat(5.0)));
    let scene = scene(&obj, MTL);
    assert_eq!(told(&scene), []);
    assert!(volume(&scene, "ball") > 0.0 && volume(&scene, "die") > 0.0);
}

#[test]
fn each_body_that_looks_inwards_is_turned() {
    // One object of two bodies, and its second one is the wrong way round: 24 triangles of a cube after 128 of a ball.
    let die = turned(&placed(&cube(2), 1.0, Vec3::splat(5.0)));
    let pair = [sphere(2), die.clone()].concat();
    let scene = scene(&object("pair", "glass", &pair), MTL);
    let line = 1 + 2 + 3 * pair.len() + 128 + 1;
    let subject = format!("object 'pair', line {line}");
    assert_eq!(told(&scene), [(FindingKind::GlassTurned, Severity::Note, subject.as_str())]);
    // A polyhedron inside the unit sphere, 4.19 m³, and a cube of 8 m³.
    let inside = volume(&scene, "pair");
    assert!(inside > 8.0 + 3.5 && inside < 8.0 + 4.19, "{inside}");
    assert_eq!(scene.polygons.iter().filter(|polygon| polygon.material != 0).count(), 0);
}

#[test]
fn faces_that_disagree_with_their_neighbours_are_turned() {
    for all in [false, true] {
        let mut ball = sphere(3);
        for i in [0, 7, 100, 101, 102, 511] {
            ball[i] = turned(&ball[i..=i])[0];
        }
        let ball = if all { turned(&ball) } else { ball };
        let scene = scene(&object("ball", "glass", &ball), MTL);
        assert_eq!(told(&scene).len(), 1);
        let faces = if all { 512 - 6 } else { 6 };
        let finding = scene.findings.iter().find(|finding| finding.kind == FindingKind::GlassTurned).expect("told");
        assert!(finding.problem.starts_with(&format!("{faces} of the 512 faces")), "{}", finding.problem);
        let inside = volume(&scene, "ball");
        assert!(inside > 4.0 && inside < 4.19, "{inside}");
    }
}

#[test]
fn a_bubble_looks_into_itself() {
    // As it should be, and the whole thing the wrong way round.
    for (outer, inner, turns) in [(sphere(2), turned(&bubble()), 0), (turned(&sphere(2)), bubble(), 2)] {
        let scene = scene(&(object("ball", "glass", &outer) + &object("bubble", "glass", &inner)), MTL);
        assert_eq!(told(&scene).len(), turns, "{:?}", told(&scene));
        assert!(volume(&scene, "ball") > 0.0 && volume(&scene, "bubble") < 0.0);
    }
    // Water in glass is no bubble, nor is glass beside glass.
    let water = object("ball", "glass", &sphere(2)) + &object("drop", "water", &turned(&bubble()));
    let beside = object("ball", "glass", &sphere(2))
        + &object("drop", "glass", &turned(&placed(&sphere(2), 0.5, Vec3::splat(3.0))));
    for obj in [water, beside] {
        let scene = scene(&obj, MTL);
        assert_eq!(told(&scene).len(), 1);
        assert!(told(&scene)[0].2.starts_with("object 'drop'"));
        assert!(volume(&scene, "ball") > 0.0 && volume(&scene, "drop") > 0.0);
    }
}

#[test]
fn glass_that_is_not_closed_is_a_sheet() {
    let bowl: Vec<[Vec3; 3]> = sphere(3).into_iter().filter(|t| t.iter().all(|corner| corner.y <= 1e-6)).collect();
    let obj = object("ball", "glass", &placed(&sphere(2), 1.0, Vec3::splat(4.0))) + &object("bowl", "glass", &bowl);
    let scene = scene(&obj, MTL);
    assert_eq!(told(&scene).len(), 1);
    assert_eq!((told(&scene)[0].0, told(&scene)[0].1), (FindingKind::GlassOpen, Severity::Warning));
    assert!(told(&scene)[0].2.starts_with("object 'bowl'"));
    for polygon in &scene.polygons {
        let material = &scene.materials[polygon.material as usize];
        assert_eq!(material.name, "glass");
        let is_sheet = scene.objects[polygon.object as usize] == "bowl";
        assert_eq!(material.is_glass(), !is_sheet);
        if is_sheet {
            let lobes = Lobes { exponent: 0.0, ..material.lobes() };
            assert_eq!(lobes, Lobes { straight: Vec3::new(1.0, 0.9, 1.0), ..Lobes::default() });
        }
    }
}

#[test]
fn a_small_gap_leaves_a_body_its_inside() {
    let mut ball = sphere(3);
    ball.truncate(511);
    let scene = scene(&object("ball", "glass", &turned(&ball)), MTL);
    let kinds: Vec<FindingKind> = told(&scene).iter().map(|finding| finding.0).collect();
    assert_eq!(kinds, [FindingKind::GlassOpen, FindingKind::GlassTurned]);
    assert!(scene.materials[0].is_glass() && volume(&scene, "ball") > 4.0);
}

#[test]
fn other_materials_look_where_they_like() {
    let scene = scene(&object("room", "chalk", &turned(&cube(1))), MTL);
    assert_eq!(told(&scene), []);
    assert_eq!(volume(&scene, "room"), -8.0);
}
