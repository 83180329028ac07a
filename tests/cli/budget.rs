//! Light for an error that is wanted, or a time that is allowed.

use crate::{assert_contains, folder, json, keys, number, printed, refusal};
use serde_json::Value;
use std::path::Path;

#[test]
fn an_error_that_is_wanted_is_reached_and_can_be_reached_again() {
    let folder = folder();
    let report = json(&folder, "solve empty-box --error 5 --seed 2 --json");
    assert_eq!(keys(&report["promised"]), ["error", "seconds"]);
    assert_eq!(keys(&report["achieved"]), ["error", "error_uncertainty", "seconds", "solver_seconds"]);
    assert_eq!(keys(&report["chosen"]), ["method", "options", "settings"]);
    assert_eq!((&report["promised"]["error"], &report["kept"]), (&0.05.into(), &true.into()));
    let achieved = number(&report["achieved"]["error"]);
    assert!(achieved <= 0.05, "{report}");
    // The options that it names lead to the same light, whose error is measured by whoever wants to know.
    let options = report["chosen"]["options"].as_str().expect("text");
    let again = json(&folder, &format!("probe empty-box --accuracy --seed 2 --json {options}"))["accuracy"].take();
    let limit = 3.0 * (number(&again["error_uncertainty"]) + number(&report["achieved"]["error_uncertainty"]));
    assert!((number(&again["error"]) - achieved).abs() < limit, "{again} {report}");
}

/// The runs that are kept in the caches below a folder.
fn known_runs(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let runs = |path: &Path| -> usize {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        serde_json::from_str::<Vec<Value>>(&text).map_or(0, |runs| runs.len())
    };
    entries.map(|path| if path.is_dir() { known_runs(&path) } else { runs(&path) }).sum()
}

/// The second time it is known what does it: nothing else is tried.
#[test]
fn what_was_measured_once_is_chosen_at_once() {
    let folder = folder();
    let solve = || json(&folder, "solve empty-box --error 8 --json")["chosen"]["options"].take();
    let first = solve();
    let known = known_runs(folder.path());
    assert!(known > 0);
    assert_eq!((solve(), known_runs(folder.path())), (first, known));
}

/// However fast the machine is, the report says truly whether the time was kept.
#[test]
fn a_time_that_is_allowed_is_told_of() {
    let folder = folder();
    let report = json(&folder, "solve cornell-box --time 4 --json");
    assert_eq!(report["promised"]["seconds"], 4.0, "{report}");
    assert_eq!(report["kept"], number(&report["achieved"]["seconds"]) <= 4.4, "{report}");
    assert!(number(&report["achieved"]["error"]) > 0.0, "{report}");
}

/// A promise that cannot be kept is called so.
#[test]
fn a_promise_that_was_not_kept_is_called_so() {
    let text = printed(&folder(), "solve cornell-box --error 0.01 --time 1");
    assert_contains(&text, &["promised: an error of 0.01 %", "THE PROMISE WAS NOT KEPT", "chosen: --method"]);
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
