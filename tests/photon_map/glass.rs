//! Photons and glass: what they start in, and what they pass.

use super::{run_to_end, transport};
use glam::Vec3A;
use lightwell::methods::PhotonSettings;
use lightwell::methods::transport::{Media, Transport};
use lightwell::scene::Scene;
use lightwell::tracer::Ray;
use std::fmt::Write;
use std::sync::Arc;

const MTL: &str = "\
newmtl floor
Kd 0.5 0.5 0.5
newmtl lamp
Kd 0 0 0
Ke 1 1 1
newmtl glass
Kd 0 0 0
Ni 1.5
illum 7
newmtl water
Kd 0 0 0
Ni 1.33
illum 7
newmtl pane
Kd 0 0 0
Ni 1.5
d 0
illum 1
";

/// A lamp of 0.2 × 0.2 at a height, facing down.
fn lamp(height: f32) -> String {
    let corners = [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)];
    face("lamp", &corners.map(|(x, z)| [x, height, z]))
}

fn face(material: &str, corners: &[[f32; 3]]) -> String {
    let mut text = format!("usemtl {material}\n");
    for [x, y, z] in corners {
        writeln!(text, "v {x} {y} {z}").expect("a string takes it");
    }
    text + "f -4 -3 -2 -1\n"
}

/// A level square of this half width, with its front up.
fn level(material: &str, half: f32, y: f32) -> String {
    face(material, &[[-half, y, -half], [-half, y, half], [half, y, half], [half, y, -half]])
}

/// A box with its fronts outside.
fn block(material: &str, half: f32, low: f32, high: f32) -> String {
    const CORNERS: [[usize; 4]; 6] =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let corner =
        |i: usize| [[-half, half][i & 1], [low, high][i >> 1 & 1], [-half, half][i >> 2 & 1]].map(|x: f32| x + 0.0);
    let mut text = format!("usemtl {material}\n");
    for [x, y, z] in (0..8).map(corner) {
        writeln!(text, "v {x} {y} {z}").expect("a string takes it");
    }
    for corners in CORNERS {
        let [a, b, c, d] = corners.map(|corner| corner as i32 - 8);
        writeln!(text, "f {a} {b} {c} {d}").expect("a string takes it");
    }
    text
}

fn scene(parts: &[String]) -> Arc<Transport> {
    let obj = format!("mtllib m.mtl\n{}", parts.concat());
    transport(Scene::from_text("test", &obj, MTL).expect("a scene"))
}

/// The glass of this body, seen from outside along a ray from above.
fn inside_of(transport: &Transport, height: f32, media: Media) -> Media {
    let down = Ray::new(Vec3A::new(0.01, height, 0.02), Vec3A::NEG_Y);
    media.across(&transport.meet(&down).expect("a surface"))
}

#[test]
fn the_glass_round_a_point_is_known() {
    let parts = [block("glass", 1.0, 0.0, 2.0), block("water", 0.5, 0.5, 1.5), level("floor", 3.0, -0.5), lamp(1.0)];
    let transport = scene(&parts);
    let glass = inside_of(&transport, 3.0, Media::default());
    let water = inside_of(&transport, 1.9, glass);
    let at = |y: f32| transport.media_at(Vec3A::new(0.01, y, 0.02));
    assert_eq!(
        [at(3.0), at(1.75), at(1.25), at(0.25), at(-0.25)],
        [Media::default(), glass, water, glass, Media::default()]
    );
    assert_ne!(glass, water);
    // The lamp is in the water.
    let emission = transport.emitters().emit(7, 100, 0, 0).expect("a lamp");
    assert_eq!(emission.media, water);
}

#[test]
fn a_clear_pane_changes_nothing_behind_it() {
    let landed = |pane: Option<String>| {
        let mut parts = vec![level("floor", 0.4, 0.0), block("glass", 0.5, 0.3, 0.6), lamp(1.0)];
        parts.extend(pane);
        let photons = PhotonSettings { count: 200_000, caustic_count: 0, ..PhotonSettings::default() };
        let solution = run_to_end(&scene(&parts), photons).solution();
        let under_glass = solution.photons.iter().filter(|photon| photon.position.y < 0.01 && photon.path.len() >= 2);
        under_glass.count() as f64
    };
    let (without, with) = (landed(None), landed(Some(level("pane", 5.0, 0.8))));
    // Some 50,000 each: 4 standard errors of the difference. Without the losses at the glass, 8 % more would land.
    let difference = (with - without).abs();
    assert!(
        without > 20_000.0 && difference < 4.0 * (with + without).sqrt(),
        "{without} without, {with} with the pane"
    );
}

/// The same faces with their fronts on the other side.
fn turned(text: &str) -> String {
    let turned = |line: &str| match line.strip_prefix("f ") {
        Some(corners) => format!("f {}\n", corners.split(' ').rev().collect::<Vec<_>>().join(" ")),
        None => format!("{line}\n"),
    };
    text.lines().map(turned).collect()
}

/// Rays that leave glass, or go through a clear sheet, meet the floor below however near it is: nothing escapes from a closed
/// room, and what is emitted is absorbed.
#[test]
fn no_photon_leaves_a_closed_room_past_clear_things_on_its_floor() {
    let room = block("floor", 1.0, 0.0, 2.0);
    for room in [turned(&room), room] {
        for gap in [0.0, 1e-7, 1e-6, 3e-6, 1e-5, 1e-4, -1e-7, -1e-6] {
            for clear in [block("glass", 0.5, gap, 0.6), level("pane", 0.5, gap), turned(&level("pane", 0.5, gap))] {
                let photons = PhotonSettings { count: 20_000, caustic_count: 0, ..PhotonSettings::default() };
                let energy = run_to_end(&scene(&[room.clone(), clear, lamp(1.9)]), photons).solution().energy;
                assert_eq!(energy.escaped.max_element(), 0.0, "gap {gap}: {energy:?}");
                let lost = (energy.emitted - energy.absorbed).abs().max_element();
                assert!(lost <= 1e-6 * energy.emitted.max_element(), "gap {gap}: {energy:?}");
            }
        }
    }
}
