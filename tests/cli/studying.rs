//! `lightwell study`: what accuracy costs in time.

use crate::{assert_contains, folder, json, keys, number};

/// A line of the table, cut at its commas.
fn cells(line: &str) -> Vec<&str> {
    line.split(',').collect()
}

/// Of the line of least squares through points (x, y).
fn slope(points: &[[f64; 2]]) -> f64 {
    let count = points.len() as f64;
    let [x, y] = [0, 1].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / count);
    let [of_both, of_x] = [1, 0].map(|axis| points.iter().map(|p| (p[0] - x) * (p[axis] - [x, y][axis])).sum::<f64>());
    of_both / of_x
}

#[test]
fn a_study_has_a_monotonic_front() {
    let folder = folder();
    // How much is done in a budget depends on what else the machine does.
    let study = |budget| json(&folder, &format!("study cornell-box -o cost --budget {budget} --json"));
    let is_long_enough = |report: &serde_json::Value| report["runs"].as_array().is_some_and(|runs| !runs.is_empty());
    let report = [20, 80, 320].into_iter().map(study).find(is_long_enough).expect("a run in some minutes");
    let runs = report["runs"].as_array().expect("a list");
    let fields = [
        "bytes",
        "error",
        "error_uncertainty",
        "finished",
        "levels_off",
        "method",
        "noise",
        "on_front",
        "options",
        "rays",
        "run",
        "seconds",
    ];
    assert_eq!(keys(&runs[0]), fields, "{report}");
    let mut front: Vec<[f64; 2]> = runs
        .iter()
        .filter(|run| run["on_front"] == true)
        .map(|run| [number(&run["seconds"]), number(&run["error"])])
        .collect();
    front.sort_by(|a, b| a[0].total_cmp(&b[0]));
    assert!(!front.is_empty(), "{report}");
    assert!(front.windows(2).all(|pair| pair[0][0] < pair[1][0] && pair[0][1] > pair[1][1]), "{front:?}");
    // Between independent samples and scrambled nets on smooth integrands of two dimensions, n^(-3/4) over their edges: paths
    // have dimensions of both kinds. Rays are counted, whatever else the machine does. Some runs more than a line needs tell it
    // apart from their noise.
    let paths = runs.iter().filter(|run| run["method"] == "reference");
    let points: Vec<[f64; 2]> = paths.map(|run| ["rays", "error"].map(|field| number(&run[field]).ln())).collect();
    if points.len() >= 6 {
        let slope = slope(&points);
        assert!((-0.75..-0.45).contains(&slope), "{slope}: {points:?}");
    }

    // What was measured is known to whoever asks for a budget.
    let solved = json(&folder, "solve cornell-box --error 8 --json");
    assert!(number(&solved["promised"]["seconds"]) > 0.0 && solved["kept"]["error"] == true, "{solved}");

    let table = std::fs::read_to_string(folder.path().join("cost/cost.csv")).expect("a table");
    let columns = cells(table.lines().next().expect("a line")).len();
    assert_eq!(table.lines().count(), runs.len() + 1);
    assert!(table.lines().all(|line| cells(line).len() == columns), "{table}");
    let chart = std::fs::read_to_string(folder.path().join("cost/cost.svg")).expect("a chart");
    assert_contains(&chart, &["<svg", "solver time, s", "the front", "Path tracing"]);
    let text = std::fs::read_to_string(folder.path().join("cost/report.md")).expect("a report");
    assert_contains(&text, &["## The front", "## What each knob buys", "## All runs", "cost.svg"]);
}

#[test]
fn a_scene_without_light_has_nothing_to_study() {
    let folder = folder();
    let report = json(&folder, "study ao-study -o cost --budget 2 --json");
    assert_eq!(report["runs"].as_array().map(Vec::len), Some(0));
    let text = std::fs::read_to_string(folder.path().join("cost/report.md")).expect("a report");
    assert_contains(&text, &["There is no light to measure"]);
}
