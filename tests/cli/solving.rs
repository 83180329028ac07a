//! `lightwell solve` and `lightwell scenes`.

use crate::{assert_contains, folder, json, keys, number, printed, program, stderr, stdout};
use serde_json::Value;

#[test]
fn the_built_in_scenes_are_listed_with_a_line_each() {
    let folder = folder();
    let text = printed(&folder, "scenes");
    let names: Vec<&str> = text.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let boxes = ["cornell-box", "empty-box", "furnace", "two-rooms", "gallery"];
    let optics = ["cornell-spheres", "caustic-ring", "glass-block", "glossy-floor"];
    let dark = ["ao-study", "machine-hall"];
    assert_eq!(names, [&boxes[..], &optics, &dark].concat());
    assert!(text.lines().all(|line| line.split_whitespace().count() > 3), "{text}");
    let listed = json(&folder, "scenes --json");
    let listed: Vec<&Value> = listed["scenes"].as_array().expect("a list").iter().collect();
    assert_eq!(listed.iter().map(|scene| &scene["name"]).collect::<Vec<_>>(), names);
}

#[test]
fn a_solve_reports_these_fields_and_its_ledger_closes() {
    let report = json(&folder(), "solve furnace --json --steps 3");
    let fields = [
        "closure",
        "converged",
        "counters",
        "elements",
        "energy",
        "form_factor",
        "method",
        "patches",
        "scene",
        "seconds",
        "simulated",
        "skipped",
        "solver",
        "steps",
    ];
    assert_eq!(keys(&report), fields);
    assert_eq!(keys(&report["energy"]), ["absorbed", "defect", "emitted", "escaped", "unshot"]);
    assert_eq!(keys(&report["closure"]), ["mean", "reciprocity", "worst"]);
    // Nothing stands in the way in a furnace, and there is no way out.
    assert_eq!(number(&report["counters"]["rays"]), 0.0);
    assert_eq!((&report["scene"], &report["method"]), (&"furnace".into(), &"radiosity".into()));
    assert_eq!((number(&report["steps"]), &report["converged"]), (3.0, &false.into()));
    assert!(number(&report["seconds"]) > 0.0 && number(&report["elements"]) > number(&report["patches"]));
    let energy = |name: &str| number(&report["energy"][name]);
    // Six square metres that emit 1 W/m² in each of three channels. Ke is stated to ten digits.
    assert!((energy("emitted") / 18.0 - 1.0).abs() < 1e-6);
    let sum = energy("absorbed") + energy("unshot") + energy("escaped") + energy("defect");
    assert!((sum - energy("emitted")).abs() < 1e-12 * energy("emitted"));
    assert!(energy("defect").abs() <= 1e-6 * energy("emitted"));
    // Nothing leaves a closed room.
    assert!(energy("absorbed") > 0.0 && energy("unshot") < energy("emitted"));
    assert_eq!(energy("escaped"), 0.0);
}

#[test]
fn every_solver_and_method_can_be_asked_for() {
    let folder = folder();
    let solve = |options: &str| json(&folder, &format!("solve furnace --element 0.25 --json {options}"));
    for solver in ["progressive", "jacobi", "gauss-seidel", "southwell"] {
        for form_factor in ["centroid", "disc", "polygon", "rays", "hemicube"] {
            let options = format!("--solver {solver} --form-factor {form_factor} --light-rays 100000 --hemicube 32");
            let report = solve(&options);
            assert_eq!((&report["solver"], &report["form_factor"]), (&solver.into(), &form_factor.into()));
            assert_eq!(report["converged"], true, "{options}");
        }
    }
    let steps = |options: &str| number(&solve(options)["steps"]);
    assert!(steps("--overshoot") < steps(""));
    // With every element a patch, there are four times as many.
    assert_eq!(number(&solve("--patch-edge 1 --steps 1")["patches"]), number(&solve("--steps 1")["elements"]));
}

#[test]
fn a_solve_stops_when_it_is_told_to() {
    let folder = folder();
    let unshot_share = |report: &Value| number(&report["energy"]["unshot"]) / number(&report["energy"]["emitted"]);
    let converged = json(&folder, "solve furnace --element 0.25 --converge 10 --json");
    assert!(unshot_share(&converged) <= 0.1 && converged["converged"] == true);
    let before = number(&converged["steps"]) - 1.0;
    let before = json(&folder, &format!("solve furnace --element 0.25 --steps {before} --json"));
    assert!(unshot_share(&before) > 0.1, "it stops at the first step that will do");
    let default = json(&folder, "solve furnace --element 0.25 --json");
    assert!(unshot_share(&default) <= 1e-3 && default["converged"] == true);
    // By the clock it goes on past any limit.
    let timed = json(&folder, "solve cornell-box --method radiosity --time 0.3 --json");
    assert!(number(&timed["seconds"]) >= 0.3 && number(&timed["steps"]) > 0.0, "{timed}");
    let none = json(&folder, "solve furnace --steps 0 --json");
    assert_eq!((number(&none["steps"]), unshot_share(&none)), (0.0, 1.0));
}

#[test]
fn a_solve_for_people_names_every_entry_of_the_ledger() {
    let text = printed(&folder(), "solve furnace --steps 3");
    assert_contains(&text, &["furnace", "3 shots", "emitted", "absorbed", "unshot", "escaped", "defect", "closure"]);
}

#[test]
fn the_same_seed_gives_the_same_result_on_any_number_of_threads() {
    let folder = folder();
    let scene = "cornell-box --element 0.05 --steps 40";
    let on = |threads: &str, arguments: &str| {
        let output = program(&folder, arguments).env("RAYON_NUM_THREADS", threads).output().expect("it starts");
        assert!(output.status.success(), "{}", stderr(&output));
        stdout(&output).to_owned()
    };
    let report = |threads: &str, seed: u32| {
        let text = on(threads, &format!("solve {scene} --seed {seed} --json"));
        let mut report: Value = serde_json::from_str(&text).expect("JSON");
        report["seconds"] = Value::Null;
        report
    };
    let first = report("1", 5);
    assert_eq!(first, report("1", 5));
    assert_eq!(first, report("2", 5));
    assert_ne!(first, report("2", 6));

    let points = "0.1 0 0.3 0 1 0\n0.5 0 0.5 0 1 0\n0.3 0.5488 0.1 0 -1 0\n0.3 0.3 0.1 0.2 0.5 -1\n";
    std::fs::write(folder.path().join("points"), points).expect("a file");
    let probe = format!("probe {scene} --points points");
    let table = on("1", &probe);
    assert_eq!(table.lines().count(), 5);
    assert_eq!(table, on("2", &probe));
}

fn names(list: &Value) -> Vec<&str> {
    list.as_array().expect("a list").iter().filter_map(|entry| entry["effect"].as_str()).collect()
}

#[test]
fn a_report_says_what_was_skipped_and_why() {
    let folder = folder();
    let planned = json(&folder, "solve furnace --element 0.25 --steps 6 --json");
    assert_eq!(names(&planned["simulated"]), ["direct-light", "interreflection"]);
    assert_eq!(names(&planned["skipped"]), ["shadows", "colour", "escape"]);
    let shadows = &planned["skipped"][0];
    assert_eq!(shadows["reason"], "Nothing stands before the planes of the 6 polygons that light reaches.");
    let all = json(&folder, "solve furnace --element 0.25 --steps 6 --effects all --json");
    assert_eq!(names(&all["skipped"]), [""; 0]);
    assert_eq!(number(&shadows["rays_saved"]), number(&all["counters"]["shadow_rays"]));
    assert_eq!(number(&planned["skipped"][2]["rays_saved"]), number(&all["counters"]["escape_rays"]));
    for field in ["energy", "steps", "closure"] {
        assert_eq!(planned[field], all[field], "{field}");
    }
    let without = json(&folder, "solve cornell-box --steps 3 --without shadows --without colour --json");
    assert_eq!(names(&without["skipped"]), ["shadows", "colour"]);
    assert_eq!(
        without["skipped"][0]["reason"],
        "It was left out. Light would shine through whatever stands in its way."
    );
    assert_eq!(number(&without["counters"]["shadow_rays"]), 0.0);
    let photons = json(&folder, "solve cornell-box --method photon-map --photons 1000 --caustic-photons 500 --json");
    let caustics = photons["skipped"].as_array().expect("a list").iter().find(|entry| entry["effect"] == "caustics");
    assert_eq!(number(&caustics.expect("none are needed")["rays_saved"]), 500.0);
    assert_eq!(number(&photons["counters"]["caustic_emitted"]), 0.0);
}
