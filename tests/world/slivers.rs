//! Faces that are next to nothing wide.

use crate::build_with;
use crate::obj::Obj;
use glam::Vec3A;
use lightwell::cancel::Cancel;
use lightwell::math::rgb::Rgb;
use lightwell::methods::radiosity::Progressive;
use lightwell::methods::{Method, Settings};
use lightwell::scene::Scene;
use lightwell::tracer::Ray;
use std::sync::Arc;

/// How many strips there are.
const STRIPS: u32 = 50;
/// Index of the first polygon of the strips.
const FIRST_STRIP: u32 = 7;

/// A closed room of 2 m with a roof half-way up and a lamp above it. The roof is closed from x = `at` on by strips of a
/// `width`, m, cut into triangles or not.
fn room_with_roof(at: f64, width: f64, is_cut: bool) -> Scene {
    let mut text = "mtllib scene.mtl\no room\nusemtl white\n".to_owned();
    let mut quad = |corners: [[f64; 3]; 4], is_cut: bool| {
        text.extend(corners.map(|[x, y, z]| format!("v {x} {y} {z}\n")));
        text += if is_cut { "f -4 -3 -2\nf -4 -2 -1\n" } else { "f -4 -3 -2 -1\n" };
    };
    let flat = |[low, high]: [f64; 2], y: f64| [[low, y, -1.0], [low, y, 1.0], [high, y, 1.0], [high, y, -1.0]];
    quad(flat([-1.0, 1.0], 0.0), false);
    quad(flat([-1.0, 1.0], 2.0), false);
    for x in [-1.0, 1.0] {
        quad([[x, 0.0, -1.0], [x, 0.0, 1.0], [x, 2.0, 1.0], [x, 2.0, -1.0]], false);
        quad([[-1.0, 0.0, x], [1.0, 0.0, x], [1.0, 2.0, x], [-1.0, 2.0, x]], false);
    }
    let edge = |strip: u32| at + f64::from(strip) * width;
    quad(flat([-1.0, edge(0)], 1.0), false);
    for strip in 0..STRIPS {
        quad(flat([edge(strip), edge(strip + 1)], 1.0), is_cut);
    }
    quad(flat([edge(STRIPS), 1.0], 1.0), false);
    text += "o lamp\nusemtl lamp\nv -0.1 1.9 -0.1\nv 0.1 1.9 -0.1\nv 0.1 1.9 0.1\nv -0.1 1.9 0.1\nf -4 -3 -2 -1\n";
    Obj::from_text(text).open()
}

#[test]
fn a_roof_of_slivers_is_tight() {
    for (at, is_cut) in [(0.0, false), (0.7, false), (0.7, true), (0.2, true)] {
        for width in [1e-5, 1e-6, 4e-7, 1e-8, 1e-12] {
            let world = build_with(room_with_roof(at, width, is_cut), 0.25);
            for i in 0..4000 {
                // Across all strips and a little more, anywhere along them.
                let share = (i as f64 + 0.5) / 4000.0;
                let x = (at + (1.2 * share - 0.1) * f64::from(STRIPS) * width) as f32;
                let origin = Vec3A::new(x, 1.5, (1.9 * (0.618 * i as f32).fract()) - 0.95);
                let ray = Ray::new(origin, Vec3A::NEG_Y);
                let hit = world.tracer.closest(&ray).expect("the room is closed");
                assert!((hit.distance - 0.5).abs() < 1e-5, "{width} m wide at {at}: {ray:?} goes on to {hit:?}");
            }
        }
    }
}

#[test]
fn light_on_slivers_is_finite_and_none_gets_through() {
    for is_cut in [false, true] {
        let world = Arc::new(build_with(room_with_roof(0.7, 4e-7, is_cut), 0.1));
        // 40 cells along each of 50 strips or twice as many of about 5 × 5, and 20 × 20 or 20 × 40 on the sides of the room above
        // the roof.
        assert!(world.mesh.elements.len() < 10_000, "{}", world.mesh.elements.len());
        let (first, count) = (FIRST_STRIP, if is_cut { 2 * STRIPS } else { STRIPS });
        let strips = world.mesh.patches.iter().filter(|patch| (first..first + count).contains(&patch.polygon));
        let area: f64 = strips.map(|patch| patch.area).sum();
        // Where the first begins and the last ends is rounded by 3e-8 m each.
        assert!((area / (2.0 * f64::from(STRIPS) * 4e-7) - 1.0).abs() < 1e-2, "{area} m²");
        let mut solver = Progressive::new(world.clone(), Settings::default());
        for _ in 0..20 {
            solver.step(&Cancel::default());
        }
        let irradiance = solver.solution().light.irradiance;
        assert!(irradiance.iter().all(|value| value.is_finite()));
        // Walls are one with those of the room below, where it stays dark.
        let below = world.mesh.elements.iter().zip(&irradiance).filter(|(element, _)| element.center.y < 0.99);
        assert!(below.clone().count() > 1000, "elements below the roof");
        assert!(below.clone().all(|(_, value)| *value == Rgb::ZERO), "light gets through the roof");
    }
}
