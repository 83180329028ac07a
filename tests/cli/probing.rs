//! `lightwell probe`.

use crate::{assert_contains, folder, json, keys, printed, program, refusal, stdout};
use std::io::Write;
use std::process::Stdio;

/// The table that a probe prints: for each point r, g, b.
fn table(text: &str) -> Vec<[f64; 3]> {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("x,y,z,nx,ny,nz,r,g,b"));
    lines
        .map(|line| {
            let numbers: Vec<f64> = line.split(',').map(|field| field.parse().expect("a number")).collect();
            assert_eq!(numbers.len(), 9, "{line}");
            [numbers[6], numbers[7], numbers[8]]
        })
        .collect()
}

/// On the floor, on a wall, and in the air with normals of any length and direction.
const FURNACE_POINTS: &str =
    "# points\n0.3 0 0.6 0 1 0\n\n0.5 0 0.5 0 2 0\n1 0.4 0.7 -1 0 0\n0.5 0.5 0.5 0 1 0\n0.2 0.7 0.4 1 -2 3\n";

#[test]
fn in_a_furnace_irradiance_is_the_same_everywhere() {
    let folder = folder();
    std::fs::write(folder.path().join("points.txt"), FURNACE_POINTS).expect("a file");
    let text = printed(&folder, "probe furnace --points points.txt --element 0.0625 --converge 0.01");
    let irradiances = table(&text);
    assert_eq!(irradiances.len(), 5);
    // E = B = M_e / (1 − ρ) = 2 W/m². A ten-thousandth is unshot; the rest is the project's own aim for a furnace.
    for value in irradiances.iter().flatten() {
        assert!((value / 2.0 - 1.0).abs() < 5e-3, "{text}");
    }
    assert!(text.lines().nth(1).is_some_and(|line| line.starts_with("0.3,0,0.6,0,1,0,")), "{text}");
}

#[test]
fn points_are_read_from_standard_input_too() {
    let folder = folder();
    std::fs::write(folder.path().join("points.txt"), FURNACE_POINTS).expect("a file");
    let from_file = printed(&folder, "probe furnace --element 0.25 --points points.txt");
    let mut command = program(&folder, "probe furnace --element 0.25 --points -");
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("the program starts");
    child.stdin.take().expect("an input").write_all(FURNACE_POINTS.as_bytes()).expect("it reads");
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(stdout(&output), from_file);
    let points = json(&folder, "probe furnace --element 0.25 --points points.txt --json");
    assert_eq!(points["points"].as_array().map(Vec::len), Some(5));
    assert_eq!(keys(&points["points"][0]), ["irradiance", "normal", "point"]);
}

#[test]
fn a_malformed_line_is_named() {
    let folder = folder();
    for (line, reason) in [
        ("0.5 0 0.5 0 1", "six numbers"),
        ("0.5 0 zero 0 1 0", "six numbers"),
        ("0.5 0 0.5 0 0 0", "length"),
        ("0.5 inf 0.5 0 1 0", "finite"),
    ] {
        std::fs::write(folder.path().join("points"), format!("# first\n0.5 0 0.5 0 1 0\n{line}\n")).expect("a file");
        assert_contains(&refusal(&folder, "probe furnace --points points", 1), &["points, line 3", reason]);
    }
    let message = refusal(&folder, "probe furnace --points nowhere.txt", 1);
    assert_contains(&message, &["cannot read points from nowhere.txt", "No such file"]);
}
