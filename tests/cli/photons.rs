//! `lightwell solve` and `lightwell probe` by photons.

use crate::{assert_contains, folder, json, keys, number, printed, program, refusal, stderr, stdout};
use serde_json::Value;

const SMALL: &str = "--element 0.25 --photons 20000";

#[test]
fn the_ledger_of_photons_closes_and_every_landing_is_counted() {
    let report = json(&folder(), &format!("solve cornell-box --method photon-map {SMALL} --json"));
    let fields = [
        "batches",
        "complete",
        "counters",
        "energy",
        "kernel",
        "max_radius",
        "method",
        "nearest",
        "passes",
        "scene",
        "seconds",
        "simulated",
        "skipped",
        "warnings",
    ];
    assert_eq!(keys(&report), fields);
    assert_eq!((&report["method"], &report["complete"]), (&"photon-map".into(), &true.into()));
    assert_eq!(report["warnings"].as_array().map(Vec::len), Some(0), "{report}");
    assert_eq!(keys(&report["energy"]), ["absorbed", "defect", "emitted", "escaped", "truncated"]);
    let energy = |name: &str| number(&report["energy"][name]);
    let sum = energy("absorbed") + energy("escaped") + energy("truncated") + energy("defect");
    assert!((sum - energy("emitted")).abs() < 1e-12 * energy("emitted"));
    assert!(energy("defect").abs() < 1e-6 * energy("emitted"));
    // The box is open at the front.
    assert!(energy("escaped") > 0.0 && energy("absorbed") > energy("escaped"));
    let counters = &report["counters"];
    let count = |name: &str| number(&counters[name]);
    assert_eq!(count("emitted"), 20_000.0);
    assert_eq!(count("absorbed") + count("escaped") + count("truncated"), count("emitted"));
    let sum = |values: &mut dyn Iterator<Item = &Value>| -> f64 { values.map(number).sum() };
    let by_bounce = counters["by_bounce"].as_array().expect("a list");
    let by_path = counters["by_path"].as_object().expect("names");
    assert_eq!(sum(&mut by_bounce.iter()), count("stored"));
    assert_eq!(sum(&mut by_path.values()), count("stored"));
    assert!(number(&by_path["L"]) > number(&by_path["LD"]), "{by_path:?}");
}

#[test]
fn a_solve_by_photons_is_told_to_people_and_stops_by_the_clock() {
    let folder = folder();
    let text = printed(&folder, &format!("solve furnace --method photon-map {SMALL} --passes 3"));
    let parts =
        ["furnace", "3 passes", "emitted", "absorbed", "escaped", "truncated", "defect", "landings by path: L "];
    assert_contains(&text, &parts);
    let timed = json(&folder, "solve cornell-box --method photon-map --photons 50000000 --time 0.2 --json");
    assert_eq!(timed["complete"], false);
    assert!((0.2..5.0).contains(&number(&timed["seconds"])));
    assert!(number(&timed["counters"]["emitted"]) < 5e7);
}

/// What a probe prints: for each point the numbers after its place and normal.
fn table(text: &str, columns: &str) -> Vec<Vec<f64>> {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(format!("x,y,z,nx,ny,nz,r,g,b,{columns}").as_str()));
    let numbers = |line: &str| line.split(',').map(|field| field.parse().expect("a number")).collect::<Vec<f64>>();
    lines.map(|line| numbers(line)[6..].to_vec()).collect()
}

const POINTS: &str = "0.3 0 0.6 0 1 0\n0.5 0 0.5 0 2 0\n1 0.4 0.7 -1 0 0\n";

#[test]
fn in_a_furnace_photons_agree_with_radiosity_within_their_own_error() {
    let folder = folder();
    std::fs::write(folder.path().join("points"), POINTS).expect("a file");
    let probe = "probe furnace --points points --method photon-map --photons 100000 --nearest 400";
    // E = M_e / (1 − ρ) = 2 W/m². The photons of an estimate deviate by their relative error, a twentieth here; five of it
    // for three points of three channels that have the same photons.
    for line in table(&printed(&folder, probe), "relative_error,radius,photons") {
        let [r, g, b, error, radius, photons] = line[..] else { panic!("{line:?}") };
        assert!((0.02..0.1).contains(&error) && photons == 399.0 && radius > 0.0, "{line:?}");
        assert!([r, g, b].iter().all(|value| (value / 2.0 - 1.0).abs() < 5.0 * error), "{line:?}");
    }
    let text = printed(&folder, &format!("{probe} --passes 8"));
    for line in table(&text, "r_error,g_error,b_error,passes") {
        let (values, errors) = (&line[..3], &line[3..6]);
        assert_eq!(line[6], 8.0);
        // Of eight passes the standard error itself is uncertain by a quarter.
        let is_close = |(value, error): (&f64, &f64)| *error > 0.0 && (value - 2.0).abs() < 6.0 * error;
        assert!(values.iter().zip(errors).all(is_close), "{line:?}");
    }
    let points = json(&folder, &format!("{probe} --json"));
    let fields = ["irradiance", "normal", "on_surface", "photons", "point", "radius", "relative_error"];
    assert_eq!(keys(&points["points"][0]), fields);
    let points = json(&folder, &format!("{probe} --json --passes 2"));
    assert_eq!(keys(&points["points"][2]), ["irradiance", "normal", "on_surface", "passes", "point", "standard_error"]);
}

#[test]
fn photons_are_on_surfaces_only() {
    let folder = folder();
    for point in ["0.5 0.5 0.5 0 1 0", "0.5 -1 0.5 0 1 0"] {
        std::fs::write(folder.path().join("points"), format!("{point}\n")).expect("a file");
        let message = refusal(&folder, "probe furnace --points points --method photon-map --photons 100", 1);
        assert_contains(&message, &["no surface is at 0.5,"]);
    }
}

#[test]
fn the_same_seed_gives_the_same_photons_on_any_number_of_threads() {
    let folder = folder();
    let on = |threads: &str, seed: u32| {
        let arguments = format!("solve cornell-box --method photon-map {SMALL} --seed {seed} --json");
        let output = program(&folder, &arguments).env("RAYON_NUM_THREADS", threads).output().expect("it starts");
        assert!(output.status.success(), "{}", stderr(&output));
        let mut report: Value = serde_json::from_str(stdout(&output)).expect("JSON");
        report["seconds"] = Value::Null;
        report
    };
    let first = on("1", 5);
    assert_eq!(first, on("2", 5));
    assert_ne!(first, on("2", 6));
}

#[test]
fn options_of_another_method_are_exit_code_2() {
    let folder = folder();
    for (arguments, reasons) in [
        ("solve furnace --photons 5", ["--photons", "--method radiosity"]),
        ("solve furnace --kernel cone", ["--kernel", "--method radiosity"]),
        ("solve furnace --method photon-map --steps 3", ["--steps", "--method photon-map"]),
        ("solve furnace --method photon-map --converge 3", ["--converge", "--method photon-map"]),
        ("solve furnace --method photon-map --light-rays 3", ["--light-rays", "--method photon-map"]),
        ("solve furnace --light-rays 3", ["--light-rays", "1000"]),
        ("solve furnace --method guessing", ["no method is called `guessing`", "photon-map"]),
        ("solve furnace --method photon-map --photons 0", ["--photons", "from 1 to 50000000"]),
        ("solve furnace --method photon-map --photons 1e3", ["--photons", "whole number"]),
        ("solve furnace --method photon-map --nearest 10001", ["--nearest", "from 1 to 10000"]),
        ("solve furnace --method photon-map --max-radius -1", ["-1", "tip"]),
        ("solve furnace --method photon-map --max-radius 0", ["--max-radius", "above 0"]),
        ("solve furnace --method photon-map --kernel gauss", ["no kernel is called `gauss`", "epanechnikov"]),
        ("solve furnace --method photon-map --passes 0", ["--passes", "from 1 to"]),
        ("probe furnace --points - --passes 2", ["--passes", "--method radiosity"]),
    ] {
        assert_contains(&refusal(&folder, arguments, 2), &reasons);
    }
}

/// A black floor and a grey one under a lamp get the same light, by every method that knows it; and whoever leaves light out says so.
#[test]
fn light_on_a_black_floor_is_known_or_its_lack_is_told() {
    let folder = folder();
    let square = |half: f32, y: f32, face: &str| {
        format!("v -{half} {y} -{half}\nv -{half} {y} {half}\nv {half} {y} {half}\nv {half} {y} -{half}\nf {face}\n")
    };
    let mtl = "newmtl black\nKd 0 0 0\nillum 1\nnewmtl lamp\nKd 0 0 0\nKe 10 10 10\nillum 1\n\
               newmtl mirror\nKd 0 0 0\nKs 0.8 0.8 0.8\nillum 3\n";
    std::fs::write(folder.path().join("m.mtl"), mtl).expect("a file");
    let obj = format!(
        "mtllib m.mtl\nusemtl black\n{}usemtl lamp\n{}usemtl mirror\n{}",
        square(2.0, 0.0, "1 2 3 4"),
        square(0.25, 2.0, "5 6 7 8"),
        square(4.0, 3.0, "12 11 10 9")
    );
    std::fs::write(folder.path().join("black.obj"), obj).expect("a file");
    std::fs::write(folder.path().join("points"), "-1.5 0 0.3 0 1 0\n").expect("a file");
    let probe = |method: &str| format!("probe black.obj --points points --method {method}");
    let truth = json(&folder, &format!("{} --samples 32768 --json", probe("reference")));
    let truth = number(&truth["points"][0]["irradiance"][0]);
    for method in ["photon-map", "final-gather", "caustics"] {
        let report = json(&folder, &format!("{} --json", probe(method)));
        let point = &report["points"][0];
        let value = number(&point["irradiance"][0]);
        let error =
            point["relative_error"].as_f64().map_or_else(|| number(&point["standard_error"][0]), |error| error * value);
        // 100 photons: a tenth. The truth is known better by far.
        assert!((0.09..0.11).contains(&(error / value)), "{method}: {point}");
        assert!((value - truth).abs() < 4.0 * error, "{method}: {point}, {truth}");
        assert_eq!(stderr(&crate::run(&folder, &probe(method))), "", "{method}");
    }
    let output = crate::run(&folder, &probe("radiosity"));
    assert_contains(stderr(&output), &["--method radiosity leaves out light", "mirrors", "reference know it"]);
    let single = json(&folder, &format!("{} --samples 1 --json", probe("final-gather")));
    assert!(single["points"][0]["standard_error"][0].is_null(), "{single}");
}

/// A lamp in a block of glass: light that meets all of its faces at more than the critical angle never leaves it, nor is it
/// absorbed but by the lamp, which it hardly ever meets.
#[test]
fn truncated_flux_is_warned_of() {
    let folder = folder();
    let obj = "mtllib g.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nusemtl glass\n\
               f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n\
               v 0.5 0.5 0.5\nv 0.5 0.5 0.501\nv 0.501 0.5 0.501\nv 0.501 0.5 0.5\nusemtl lamp\nf 9 10 11 12\n\
               v -1 -1 -1\nv -1 -1 2\nv 2 -1 2\nv 2 -1 -1\nusemtl floor\nf 13 14 15 16\n";
    std::fs::write(folder.path().join("block.obj"), obj).expect("a file");
    let mtl = "newmtl glass\nKd 0 0 0\nNi 1.5\nillum 7\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\nnewmtl floor\nKd 0 0 0\n";
    std::fs::write(folder.path().join("g.mtl"), mtl).expect("a file");
    let solve = "solve block.obj --method photon-map --photons 200 --caustic-photons 10";
    let report = json(&folder, &format!("{solve} --json"));
    let [emitted, truncated] = ["emitted", "truncated"].map(|name| number(&report["energy"][name]));
    let warnings = report["warnings"].as_array().expect("a list");
    assert!(warnings.len() == 1 && truncated > 0.05 * emitted, "{report}");
    assert_contains(warnings[0].as_str().expect("text"), &["% of the emitted flux is truncated", "radiosity"]);
    assert_contains(&printed(&folder, solve), &["warning: ", "% of the emitted flux is truncated"]);
}
