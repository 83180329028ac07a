//! `lightwell formfactor`.

use crate::{assert_contains, folder, keys, number, program, stderr, stdout};
use serde_json::Value;
use std::process::Output;

const FLOOR: &str = "0,0,0 1,0,0 1,1,0 0,1,0";
/// Face to face with the floor at gap 1.
const CEILING: &str = "0,0,1 0,1,1 1,1,1 1,0,1";
/// Half as wide, half-way.
const BETWEEN: &str = "0.25,0.25,0.5 0.75,0.25,0.5 0.75,0.75,0.5 0.25,0.75,0.5";

/// Runs the command with polygons, which have spaces in them, and more words.
fn form_factor(polygons: &[(&str, &str)], words: &str) -> Output {
    let folder = folder();
    let mut command = program(&folder, "formfactor");
    for (option, polygon) in polygons {
        command.args([option, polygon]);
    }
    command.args(words.split_whitespace()).output().expect("the program starts")
}

/// Name and form factor of each method, after a look at the shape of the JSON.
fn methods(polygons: &[(&str, &str)], words: &str) -> Vec<(String, f64, f64)> {
    let output = form_factor(polygons, &format!("{words} --json"));
    assert!(output.status.success(), "{}", stderr(&output));
    let report: Value = serde_json::from_str(stdout(&output)).expect("one JSON object");
    assert_eq!(keys(&report), ["methods"]);
    let methods = report["methods"].as_array().expect("a list");
    methods
        .iter()
        .map(|method| {
            assert_eq!(keys(method), ["error", "form_factor", "method", "microseconds"]);
            assert!(number(&method["microseconds"]) > 0.0);
            let name = method["method"].as_str().expect("a name").to_owned();
            (name, number(&method["form_factor"]), number(&method["error"]))
        })
        .collect()
}

#[test]
fn every_method_tells_its_form_factor_and_its_error() {
    let methods = methods(&[("--from", FLOOR), ("--to", CEILING)], "--rays 16384");
    let names: Vec<&str> = methods.iter().map(|(name, ..)| name.as_str()).collect();
    assert_eq!(names, ["centroid", "disc", "polygon", "rays", "hemicube"]);
    let exact = 0.199_824_895_698_387;
    // Two Gauss points a side are good to a percent here; of n rays the share has a deviation of √(F (1 − F) / n),
    // 0.003, of which stratification leaves less; cells of the hemicube end at the edge of the square.
    let expected = [
        (std::f64::consts::FRAC_1_PI, 1e-9),
        (0.241_453_007, 1e-9),
        (exact, 2e-3),
        (exact, 0.01),
        (0.239_456_470, 1e-5),
    ];
    for ((name, value, error), (expected, tolerance)) in methods.iter().zip(expected) {
        assert!((value - expected).abs() < tolerance, "{name}: {value}");
        assert!((value - error - exact).abs() < 1e-12, "{name}: {error}");
    }
}

#[test]
fn occluders_hide_from_either_side_and_the_reference_knows_of_them() {
    for occluder in [BETWEEN, "0.25,0.75,0.5 0.75,0.75,0.5 0.75,0.25,0.5 0.25,0.25,0.5"] {
        let methods = methods(&[("--from", FLOOR), ("--to", CEILING), ("--occluder", occluder)], "--rays 16384");
        for (name, value, error) in &methods {
            // The published value has six digits.
            assert!((value - error - 0.099_505).abs() < 2e-6, "{name}: {value} {error}");
            let sees = name == "polygon" || name == "rays";
            // 256 visibility rays in a pattern; of rays as above.
            assert!(if sees { error.abs() < 0.01 } else { *value == 0.0 }, "{name}: {value}");
        }
    }
    let beside = "2,0,0.5 3,0,0.5 3,1,0.5";
    let open = methods(&[("--from", FLOOR), ("--to", CEILING), ("--occluder", beside)], "--method polygon");
    assert!((open[0].1 - 0.199_824_9).abs() < 2e-3 && (open[0].1 - open[0].2 - 0.199_824_896).abs() < 2e-6);
}

#[test]
fn one_method_can_be_chosen_and_numbers_may_be_negative() {
    let moved = "-1,-1,0 0,-1,0 0,0,0 -1,0,0";
    let methods = methods(&[("--from", moved), ("--to", "-1,-1,2 -1,0,2 0,0,2 0,-1,2")], "--method disc");
    assert_eq!(methods.len(), 1);
    let exact = 1.0 / (4.0 * std::f64::consts::PI + 1.0);
    assert!((methods[0].1 - exact).abs() < 1e-12, "{}", methods[0].1);
}

#[test]
fn a_table_is_printed_for_people() {
    let output = form_factor(&[("--from", FLOOR), ("--to", CEILING)], "--method centroid");
    let lines: Vec<&str> = stdout(&output).lines().collect();
    assert_eq!(lines.len(), 3, "{}", stdout(&output));
    assert_contains(lines[0], &["method", "form factor", "error", "µs"]);
    assert_contains(lines[1], &["centroid", "0.318309886", "+1.2e-1"]);
    assert_contains(lines[2], &["reference", "0.199824896"]);
}

#[test]
fn what_is_no_polygon_is_exit_code_2() {
    for (from, words, reason) in [
        ("0,0,0 1,0,0", "", "three or four corners"),
        ("0,0,0 1,0,0 2,0,0", "", "on a line"),
        ("0,0,0 1,0,0 1,1,0 0,1,1", "", "one plane"),
        ("0,0,0 1,0,0 0.2,0.2,0 0,1,0", "", "not convex"),
        ("0,0,0 1,0,0 1,1,inf", "", "three numbers"),
        (FLOOR, "--method sideways", "no form factor is called `sideways`"),
        (FLOOR, "--resolution 7", "even number"),
        (FLOOR, "--rays 0", "--rays"),
    ] {
        let output = form_factor(&[("--from", from), ("--to", CEILING)], words);
        assert_eq!(output.status.code(), Some(2), "{from} {words}");
        assert_eq!(stdout(&output), "");
        assert_contains(stderr(&output), &[reason]);
    }
    assert_eq!(form_factor(&[("--from", FLOOR)], "").status.code(), Some(2));
}
