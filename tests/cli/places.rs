//! Coordinates that are given and printed are those of the file, whatever frame the program computes in.

use crate::{assert_contains, folder, json, number, printed, program, run, stderr};
use serde_json::Value;
use tempfile::TempDir;

/// A multiple of a power of two above the box's extent, m.
const FAR: f64 = 3072.0;

/// A coordinate that double and single precision hold alike, moved or not: a multiple of 1/4096 m.
fn even(coordinate: f64) -> f64 {
    (4096.0 * coordinate).round() / 4096.0
}

/// Writes the Cornell box, moved by so much in x, y and z.
fn write_box(folder: &TempDir, by: f64) {
    let moved = |line: &str| match line.strip_prefix("v ") {
        Some(rest) => rest
            .split_whitespace()
            .fold("v".to_owned(), |line, word| format!("{line} {}", even(word.parse().expect("a coordinate")) + by)),
        None => line.to_owned(),
    };
    let obj: Vec<String> = include_str!("../../assets/scenes/cornell-box.obj").lines().map(moved).collect();
    std::fs::write(
        folder.path().join("box.obj"),
        obj.join(
            "
",
        ),
    )
    .expect("a file");
    let mtl = include_str!("../../assets/scenes/cornell-box.mtl");
    std::fs::write(folder.path().join("cornell-box.mtl"), mtl).expect("a file");
}

/// Writes points on the floor, on the back wall and on a block, moved likewise.
fn write_points(folder: &TempDir, by: f64) {
    let points = [([0.278, 0.0, 0.1], "0 1 0"), ([0.25, 0.4, 0.5592], "0 0 -1"), ([0.18, 0.165, 0.17], "0 1 0")];
    let line = |(point, normal): ([f64; 3], &str)| {
        let [x, y, z] = point.map(|place| even(place) + by);
        format!(
            "{x} {y} {z} {normal}
"
        )
    };
    std::fs::write(folder.path().join("points"), points.map(line).concat()).expect("a file");
}

/// What `probe` finds in a box that was moved.
fn points(by: f64, arguments: &str) -> Vec<Value> {
    let folder = folder();
    write_box(&folder, by);
    write_points(&folder, by);
    let report = json(&folder, &format!("probe box.obj --element 0.1 --json {arguments}"));
    report["points"].as_array().expect("points").clone()
}

#[test]
fn points_of_a_far_scene_are_those_of_its_file() {
    for arguments in ["--points points", "--points points --method reference --samples 64", "--spread 20"] {
        let [near, far] = [0.0, FAR].map(|by| points(by, arguments));
        assert!(!near.is_empty() && near.len() == far.len());
        for (near, far) in near.iter().zip(&far) {
            for axis in 0..3 {
                let [place, moved] = [near, far].map(|point| number(&point["point"][axis]));
                // The nearest number in double precision.
                assert!((place + FAR - moved).abs() < 1e-12 * FAR, "{near} {far}");
                let [near, far] = [near, far].map(|point| number(&point["irradiance"][axis]));
                assert!(near > 0.0 && near == far, "{near} {far}");
            }
        }
    }
}

#[test]
fn inspect_tells_where_a_far_scene_is_in_its_file() {
    let folder = folder();
    write_box(&folder, FAR);
    let census = json(&folder, "inspect box.obj --json");
    for (what, least, most) in [("min", -0.01, 0.01), ("max", 0.54, 0.57)] {
        for axis in 0..3 {
            let place = number(&census["extent"][what][axis]) - FAR;
            assert!((least..=most).contains(&place), "{census}");
        }
    }
    for what in ["eye", "target"] {
        assert!((0..3).all(|axis| (number(&census["viewpoint"][what][axis]) - FAR).abs() < 3.0), "{census}");
    }
    assert_contains(&printed(&folder, "inspect box.obj"), &["stay those of the file"]);
}

#[test]
fn where_no_surface_is_that_is_said() {
    let folder = folder();
    write_box(&folder, FAR);
    let [x, y, z] = [0.278, 0.03, 0.05].map(|place| place + FAR);
    std::fs::write(folder.path().join("points"), format!("{x} {y} {z} 0 1 0\n{x} {FAR} {z} 0 1 0\n")).expect("a file");
    for how in ["--method radiosity --element 0.1", "--method reference --samples 16", "--error 30"] {
        let output = run(&folder, &format!("probe box.obj --points points {how}"));
        assert!(output.status.success(), "{}", stderr(&output));
        // The floor is 3 cm below, and nothing is nearer.
        assert_contains(stderr(&output), &["no surface is at 1 of 2 points", &format!("{x},{y},{z}"), "3.00e-2 m"]);
    }
    let output = program(&folder, "probe box.obj --points points --method photon-map").output().expect("it starts");
    assert_eq!(output.status.code(), Some(1));
    assert_contains(stderr(&output), &["no surface is at", &format!("{x},{y},{z}"), "3.00e-2 m"]);
}
