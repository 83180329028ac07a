//! Light for an error that is wanted, or a time that is allowed.

use crate::{assert_contains, error_or_limit, folder, json, keys, number, printed, program, refusal};
use serde_json::json;
use std::fs::write;

#[test]
fn an_error_that_is_wanted_is_reached_and_can_be_reached_again() {
    let folder = folder();
    let report = json(&folder, "solve empty-box --error 5 --seed 2 --json");
    assert_eq!(keys(&report["promised"]), ["error", "seconds"]);
    assert_eq!(
        keys(&report["achieved"]),
        ["error", "error_below_percent", "error_uncertainty", "seconds", "solver_seconds"]
    );
    assert_eq!(keys(&report["chosen"]), ["method", "options", "settings"]);
    assert_eq!((&report["promised"]["error"], &report["kept"]), (&0.05.into(), &json!({ "error": true })));
    let achieved = number(&report["achieved"]["error"]);
    assert!(achieved <= 0.05, "{report}");
    // The options that it names lead to the same light, whose error is measured by whoever wants to know.
    let options = report["chosen"]["options"].as_str().expect("text");
    let again = json(&folder, &format!("probe empty-box --accuracy --seed 2 --json {options}"))["accuracy"].take();
    let limit = 3.0 * (number(&again["error_uncertainty"]) + number(&report["achieved"]["error_uncertainty"]));
    assert!((number(&again["error"]) - achieved).abs() < limit, "{again} {report}");
}

/// The second time it is known what does it: less is tried.
#[test]
fn what_was_measured_once_is_chosen_at_once() {
    let folder = folder();
    let tried = || {
        let output = program(&folder, "solve empty-box --error 8").env("RUST_LOG", "lightwell=info").output();
        let output = output.expect("it starts");
        let chosen = String::from_utf8_lossy(&output.stdout);
        let chosen = chosen.lines().find(|line| line.contains("chosen:")).expect("a choice").to_owned();
        let log = String::from_utf8_lossy(&output.stderr);
        (chosen, log.lines().filter(|line| line.contains("--method ")).count())
    };
    let (first, many) = tried();
    let (second, one) = tried();
    assert_eq!(first, second);
    assert!(one < many, "{one} {many}");
}

/// Whether the time was kept depends on the machine: the report says what was so.
#[test]
fn a_time_that_is_allowed_is_used_and_told() {
    let folder = folder();
    let report = json(&folder, "solve cornell-box --time 4 --json");
    let seconds = number(&report["achieved"]["seconds"]);
    assert_eq!((&report["promised"]["seconds"], &report["kept"]), (&4.0.into(), &json!({ "time": seconds <= 4.2 })));
    assert!(error_or_limit(&report["achieved"]) > 0.0, "{report}");
}

/// One quad that emits and nothing that it lights, as long in its units as a Cornell box in millimetres: π · 0.1 · 308,231 · 3 W
/// escape, and no error can be stated.
#[test]
fn an_emitter_that_lights_nothing_is_solved_for_a_budget_all_the_same() {
    let folder = folder();
    let quad = "mtllib quad.mtl\nusemtl pbr\nv 552.8 0 0\nv 0 0 0\nv 0 0 559.2\nv 549.6 0 559.2\nf 1 2 3 4\n";
    write(folder.path().join("quad.obj"), quad).expect("a file");
    let material = "newmtl pbr\nKd 1 1 1\nKe 0.1 0.1 0.1\nPr 0.2\nPm 0.3\nPs 0.4\n";
    write(folder.path().join("quad.mtl"), material).expect("a file");
    for budget in ["--time 2", "--error 5"] {
        let output = program(&folder, &format!("solve quad.obj {budget} --json")).output().expect("it starts");
        assert!(output.status.success(), "{budget}");
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("an object");
        let [emitted, escaped] = ["emitted", "escaped"].map(|name| number(&report["energy"][name]));
        let expected = std::f64::consts::PI * 0.1 * 3.0 * (552.8 + 549.6) / 2.0 * 559.2;
        assert!((emitted / expected - 1.0).abs() < 1e-5 && (escaped / emitted - 1.0).abs() < 1e-9, "{report}");
        assert!(report.get("achieved").is_none(), "{report}");
        assert_contains(
            &String::from_utf8_lossy(&output.stderr),
            &["no light arrives at any surface", "without an error"],
        );
    }
}

/// A promise that cannot be kept is called so.
#[test]
fn a_promise_that_was_not_kept_is_called_so() {
    let text = printed(&folder(), "solve cornell-box --error 0.01 --time 1");
    assert_contains(&text, &["promised: an error of 0.01 %", "target missed: ", "% > 0.0", "chosen: --method"]);
}

#[test]
fn a_budget_goes_with_nothing_that_it_is_to_choose() {
    let folder = folder();
    let refused = |arguments: &str, parts: &[&str]| assert_contains(&refusal(&folder, arguments, 2), parts);
    refused("solve furnace --error 5 --method radiosity", &["--error", "--method radiosity"]);
    refused("solve furnace --error 5 --element 0.1", &["--error", "choose"]);
    refused("solve furnace --time 1 --photons 5", &["--photons"]);
    refused("solve furnace --error 5 --steps 3", &["--error", "--steps"]);
    refused("solve furnace --error 0", &["above 0"]);
    assert_contains(&refusal(&folder, "solve ao-study --error 5", 1), &["no light"]);
}
