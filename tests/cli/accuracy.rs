//! The error that the program states, against the one that is computed outside of it from what it prints.

use crate::{assert_contains, folder, json, keys, number, printed, refusal};
use serde_json::Value;
use tempfile::TempDir;

/// Irradiance at the points where errors are measured, W/m², and its standard error where the method states one.
struct Probed {
    irradiance: Vec<f64>,
    standard_error: Vec<f64>,
}

fn probe(folder: &TempDir, options: &str) -> Probed {
    let report = json(folder, &format!("probe cornell-box --spread 1024 --json {options}"));
    let points = report["points"].as_array().expect("a list");
    let channels = |key: &str| -> Vec<f64> {
        points.iter().filter_map(|point| point[key].as_array()).flatten().map(number).collect()
    };
    Probed { irradiance: channels("irradiance"), standard_error: channels("standard_error") }
}

/// The relative root of the mean square of what lies between a solution and the truth, without the truth's own noise, and its
/// standard error: that of a mean over points, whose channels may all be off together.
fn error(found: &Probed, truth: &Probed) -> (f64, f64) {
    let count = truth.irradiance.len() as f64;
    assert_eq!(found.irradiance.len(), truth.irradiance.len());
    let (mut square, mut variance) = (0.0, 0.0);
    let values = found.irradiance.iter().zip(&truth.irradiance).zip(&truth.standard_error);
    for ((found, truth), own) in values {
        let (off, own) = ((found - truth).powi(2), own * own);
        square += off - own;
        variance += 3.0 * (4.0 * (off - own).max(0.0) * own + 2.0 * own * own);
    }
    let mean = truth.irradiance.iter().sum::<f64>() / count;
    let rms = (square.max(0.0) / count).sqrt();
    (rms / mean, variance.sqrt() / count / (2.0 * rms) / mean)
}

fn assert_agree(what: &str, stated: &Value, outside: (f64, f64)) {
    let (rms, uncertainty) = (number(&stated["error"]), number(&stated["error_uncertainty"]));
    let limit = 3.0 * uncertainty.hypot(outside.1);
    assert!((rms - outside.0).abs() < limit, "{what}: stated {rms} ± {uncertainty}, outside {outside:?}");
    // Nothing would be told by an error that is known no better than that.
    assert!(limit < 0.2 * rms, "{what}: {rms} ± {limit}");
    assert!(number(&stated["floor"]) <= 0.25 * rms && stated["points"] == 1024, "{stated}");
}

#[test]
fn the_error_that_is_stated_is_the_one_that_is_found_from_outside() {
    let folder = folder();
    // Another seed: noise that has nothing to do with that of the program's own reference.
    let truth = probe(&folder, "--method reference --seed 77 --samples 8192");
    for element in ["0.2", "0.1", "0.05"] {
        let options = format!("--element {element} --seed 5");
        let stated = json(&folder, &format!("solve cornell-box --accuracy --json {options}"));
        assert_agree(&options, &stated["accuracy"], error(&probe(&folder, &options), &truth));
    }
    for photons in ["20000", "100000", "400000"] {
        let options = format!("--method photon-map --photons {photons} --seed 5");
        let stated = json(&folder, &format!("solve cornell-box --accuracy --json {options}"));
        assert_agree(&options, &stated["accuracy"], error(&probe(&folder, &options), &truth));
    }
    let options = "--method diffuse-ao --ao-rays 32 --samples 4 --seed 5";
    let stated = json(&folder, &format!("probe cornell-box --accuracy --json {options}"));
    assert_agree(options, &stated["accuracy"], error(&probe(&folder, options), &truth));
}

/// A mean over passes has noise that its own spread tells; the error of a few of them is more than that.
#[test]
fn the_error_of_photons_is_told_apart_into_noise_and_bias() {
    let folder = folder();
    let passes = "solve cornell-box --method photon-map --photons 20000 --passes 4 --accuracy --json";
    let accuracy = json(&folder, passes)["accuracy"].take();
    let known = ["bias", "error", "error_below_percent", "error_uncertainty", "floor", "noise", "paths", "points"];
    assert_eq!(keys(&accuracy), known);
    let [rms, noise, bias] = ["error", "noise", "bias"].map(|key| number(&accuracy[key]));
    assert!(noise > 0.0 && bias > 0.0 && (noise.hypot(bias) / rms - 1.0).abs() < 1e-9, "{accuracy}");
}

#[test]
fn an_error_is_told_in_words_and_where_there_is_no_light_there_is_none() {
    let folder = folder();
    let text = printed(&folder, "solve furnace --accuracy --converge 1");
    assert_contains(&text, &["error", "% of the mean irradiance at 1024 points"]);
    let dark = json(&folder, "solve ao-study --accuracy --json");
    assert!(dark["accuracy"]["error"].is_null(), "{dark}");
    assert_contains(&refusal(&folder, "probe furnace --accuracy --spread 5", 2), &["--accuracy", "--spread"]);
    assert_contains(&refusal(&folder, "probe furnace --accuracy --method ambient-occlusion", 2), &["--accuracy"]);
}

/// The second time costs no path more.
#[test]
fn the_truth_is_kept_for_the_next_time() {
    let folder = folder();
    let solve = || json(&folder, "solve cornell-box --element 0.2 --accuracy --json")["accuracy"].take();
    let first = solve();
    assert_eq!(first, solve());
    assert!(folder.path().join("lightwell").is_dir(), "{first}");
}
