//! Emitters that shine the wrong way, lie in a wall, or light nothing.

use super::sides::emitting_sides;
use super::surface::Surfaces;
use super::{TOUCHING, triangles};
use crate::math::bounds::Bounds;
use crate::math::random::Stream;
use crate::mesh::side_index;
use crate::scene::{Finding, FindingKind, Scene, Severity};
use crate::tracer::{Ray, Tracer};
use glam::{Vec3, Vec3A};
use rayon::prelude::*;

/// Rays that look out from one side of an emitter.
const LOOKS: u64 = 64;
/// An emitter whose front has less than this share of its view open, and whose back has more, is turned.
const BLIND_SHARE: f32 = 1.0 / 16.0;
/// What is nearer than this times the square root of the emitter's area stands right before it.
const NEAR: f32 = 0.25;
/// Emitters in the plane of another surface are moved by this share of the scene's radius: still touching it.
const STEP: f32 = TOUCHING / 4.0;
/// Surfaces closer than this share of the scene's radius lie in one plane.
const SAME_PLANE: f32 = 1e-6;
const LOOK_PASS: u64 = 4;

/// Turns emitters whose front faces a wall or the void while their back faces the scene. Neighbours in one object turn
/// each for itself. Where all surfaces glow, the scene is on the side from which more of it is seen.
pub fn turn(scene: &mut Scene, tracer: &Tracer) -> Vec<Finding> {
    let surfaces = Surfaces::new(scene);
    let fronts = emitting_sides(scene);
    let glows_all_over = fronts.len() == scene.polygons.len();
    let shines_away = |front: &usize| {
        let [front, back] = [*front, front + 1].map(|side| open_view(scene, &surfaces, tracer, side, glows_all_over));
        if glows_all_over { back > front + BLIND_SHARE } else { front < BLIND_SHARE && back > BLIND_SHARE }
    };
    let fronts: Vec<usize> = fronts.into_par_iter().filter(shines_away).collect();
    let mut turn = |front: usize| {
        let polygon = front / 2;
        scene.polygons[polygon] = scene.polygons[polygon].turned();
        Finding {
            severity: Severity::Note,
            kind: FindingKind::EmitterTurned,
            subject: subject(scene, polygon),
            problem: "its front faces a wall or the void, and its back faces the scene".to_owned(),
            remedy: "turned round, so that it lights the scene".to_owned(),
        }
    };
    fronts.into_iter().map(&mut turn).collect()
}

/// The share of rays from a side that meet something which is not right before it and, unless emitters count, no emitter:
/// the inside of a lamp sees itself.
fn open_view(scene: &Scene, surfaces: &Surfaces, tracer: &Tracer, side: usize, emitters_count: bool) -> f32 {
    let near = NEAR * (surfaces.area(side) as f32).sqrt();
    let mut stream = Stream::new(0, LOOK_PASS, side as u64);
    let open = (0..LOOKS).filter(|_| {
        let from = surfaces.place(side, &mut stream);
        // A wall in the plane of the emitter hides neither side.
        surfaces.bounce_beyond(&from, tracer, &mut stream).is_some_and(|place| {
            let material = &scene.materials[scene.polygons[place.side / 2].material as usize];
            (emitters_count || !material.is_emitter()) && from.point.distance(place.point) > near
        })
    });
    open.count() as f32 / LOOKS as f32
}

/// Moves emitters that lie exactly in the plane of another surface a hair towards their front, so that they are before it
/// whichever of the two comes later in the file.
pub fn move_off_walls(scene: &mut Scene) -> Vec<Finding> {
    let surfaces = Surfaces::new(scene);
    let radius = Bounds::of(surfaces.corners()).radius();
    let emits = |polygon: u32| scene.materials[scene.polygons[polygon as usize].material as usize].is_emitter();
    // Without the emitters, a ray down on one meets what lies behind it.
    let mut walls = triangles(scene);
    walls.retain(|&(polygon, _)| !emits(polygon));
    let walls = Tracer::new(&walls);
    let mut findings = Vec::new();
    for front in emitting_sides(scene) {
        let polygon = front / 2;
        let Some(wall) = wall_behind(&surfaces, &walls, front, SAME_PLANE * radius) else { continue };
        let step =
            Vec3::from(surfaces.normal(front)) * (STEP * radius).min(0.5 * room_before(&surfaces, &walls, front));
        move_polygon(scene, polygon, step);
        findings.push(Finding {
            severity: Severity::Note,
            kind: FindingKind::EmitterMoved,
            subject: subject(scene, polygon),
            problem: format!("it lies in the plane of {}", subject(scene, wall)),
            remedy: format!("moved {:.2e} m towards its front", step.length()),
        });
    }
    findings
}

/// The polygon of `walls` that holds the emitter's centre and lies in its plane, within `tolerance`, m.
fn wall_behind(surfaces: &Surfaces, walls: &Tracer, front: usize, tolerance: f32) -> Option<usize> {
    let corners = surfaces.corners_of(front / 2);
    let center = corners.iter().sum::<Vec3A>() / corners.len() as f32;
    let normal = surfaces.normal(front);
    let distance = tolerance + walls.offset();
    let hit = walls.closest(&Ray::new(center + distance * normal, -normal))?;
    let (wall, wall_normal) = (hit.polygon as usize, surfaces.normal(side_index(hit.polygon, true)));
    let on_wall = surfaces.corners_of(wall)[0];
    let is_in_plane = corners.iter().all(|&corner| (corner - on_wall).dot(wall_normal).abs() <= tolerance);
    // What is wholly before the front is lit by it, however near it is.
    let is_before = corners.iter().all(|&corner| (on_wall - corner).dot(normal) > 0.0);
    (is_in_plane && !is_before).then_some(wall)
}

/// Distance from the middle of an emitter to what its front faces, m.
fn room_before(surfaces: &Surfaces, walls: &Tracer, front: usize) -> f32 {
    let corners = surfaces.corners_of(front / 2);
    let center = corners.iter().sum::<Vec3A>() / corners.len() as f32;
    // Off a wall in the same plane.
    let start = walls.lift(center, surfaces.normal(front));
    let ahead = walls.closest(&Ray::new(start, surfaces.normal(front)));
    ahead.map_or(f32::INFINITY, |hit| hit.distance)
}

/// Gives the polygon corners of its own, since others may share the old ones.
fn move_polygon(scene: &mut Scene, index: usize, step: Vec3) {
    let old = scene.polygons[index];
    let corners: Vec<u32> = old
        .corners()
        .iter()
        .map(|&corner| {
            scene.positions.push(scene.positions[corner as usize] + step);
            scene.positions.len() as u32 - 1
        })
        .collect();
    scene.polygons[index] = old.at_corners(&corners);
}

/// Emitters whose light meets nothing.
pub fn hidden(scene: &Scene, surfaces: &Surfaces, tracer: &Tracer) -> Vec<Finding> {
    let sees_nothing = |side: &usize| {
        let mut stream = Stream::new(1, LOOK_PASS, *side as u64);
        !(0..LOOKS).any(|_| {
            let from = surfaces.place(*side, &mut stream);
            surfaces.bounce(&from, tracer, &mut stream).is_some()
        })
    };
    let finding = |side: usize| Finding {
        severity: Severity::Warning,
        kind: FindingKind::EmitterHidden,
        subject: subject(scene, side / 2),
        problem: "nothing in the scene sees it".to_owned(),
        remedy: "kept; all its light escapes".to_owned(),
    };
    emitting_sides(scene).into_iter().filter(sees_nothing).map(finding).collect()
}

/// How a finding names a polygon.
fn subject(scene: &Scene, polygon: usize) -> String {
    let polygon = &scene.polygons[polygon];
    let object = scene.objects.get(polygon.object as usize).map_or("", String::as_str);
    match polygon.line {
        0 => format!("object '{object}'"),
        line => format!("object '{object}', line {line}"),
    }
}
