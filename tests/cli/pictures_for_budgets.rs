//! Pictures for an error that is wanted, or a time that is allowed; and the error as a picture.

use crate::rendering::{attributes, can_draw, radiances, texts};
use crate::{assert_contains, error_or_limit, folder, json, keys, number, printed, program, refusal, write_dark_scene};
use serde_json::json;
use tempfile::TempDir;

const SIZE: &str = "--size 80x60";

/// The error of a picture as its file has it: the root of the mean square over pixels and channels, as a share of the mean.
/// Of two references with noise of their own the product of the differences has none on average.
fn error_of(folder: &TempDir, scene: &str, name: &str) -> f64 {
    let [one, other] = [98, 99].map(|seed| {
        let name = format!("truth-{seed}.exr");
        printed(folder, &format!("render {scene} -o {name} {SIZE} --view reference --samples 1024 --seed {seed}"));
        radiances(folder, &name)
    });
    let (mut square, mut mean, mut count) = (0.0, 0.0, 0.0);
    for ((found, one), other) in radiances(folder, name).iter().zip(&one).zip(&other) {
        for channel in 0..3 {
            let [found, one, other] = [found, one, other].map(|pixel| f64::from(pixel[channel]));
            square += (found - one) * (found - other);
            mean += (one + other) / 2.0;
            count += 1.0;
        }
    }
    (square / count).sqrt() / (mean / count)
}

#[test]
fn a_picture_for_an_error_has_it_and_says_how_to_make_it_again() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let report = json(&folder, &format!("render empty-box -o box.exr {SIZE} --error 4 --seed 3 --json"));
    assert_eq!((&report["promised"]["error"], &report["kept"]), (&0.04.into(), &json!({ "error": true })), "{report}");
    assert_eq!(
        keys(&report["achieved"]),
        ["error", "error_below_percent", "error_uncertainty", "seconds", "solver_seconds"]
    );
    let achieved = number(&report["achieved"]["error"]);
    assert!(achieved <= 0.04, "{report}");
    // The same picture, to the bit, on any number of threads.
    let options = report["chosen"]["options"].as_str().expect("text");
    let again = format!("render empty-box -o again.exr {SIZE} --seed 3 {options}");
    let output = program(&folder, &again).env("RAYON_NUM_THREADS", "1").output().expect("it starts");
    assert!(output.status.success(), "{again}");
    assert!(radiances(&folder, "again.exr") == radiances(&folder, "box.exr"), "{options}");
    // A PNG says the same of itself.
    let text = printed(&folder, &format!("render empty-box -o box.png {SIZE} --error 4 --seed 3"));
    assert_contains(&text, &["promised: an error of 4.00 %", "error target met", "chosen: --view "]);
    let facts = texts(&folder, "box.png");
    assert_contains(&facts["Promised"], &["an error of 4.00 %"]);
    assert_contains(&facts["Chosen"], &["--view ", "--samples "]);
    assert_contains(&facts["Achieved"], &["an error of ", "of the solver"]);
    assert_eq!(facts["Kept"], "error target met");
    // And so does an EXR.
    let attributes = attributes(&folder, "box.exr");
    assert_contains(&attributes["Promised"], &["an error of 4.00 %"]);
    assert_contains(&attributes["Achieved"], &["% ± "]);
    assert_eq!((attributes["Scene"].as_str(), attributes["Kept"].as_str()), ("empty-box", "error target met"));
}

#[test]
fn the_error_that_a_picture_is_said_to_have_is_the_one_that_it_has() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    for (scene, options) in
        [("furnace", "--error 5"), ("furnace", "--error 5 --view reference"), ("two-rooms", "--time 2")]
    {
        let report = json(&folder, &format!("render {scene} -o picture.exr {SIZE} {options} --json"));
        let achieved = &report["achieved"];
        let found = error_of(&folder, scene, "picture.exr");
        println!("{scene} {options}: {found:.4}, said to be {achieved}");
        // Three standard errors of the smaller of two estimates of the uncertainty, which is itself known to a third.
        let tolerance = 4.0 * number(&achieved["error_uncertainty"]);
        let is_so = match achieved["error_below_percent"].as_f64() {
            Some(limit) => 100.0 * found < limit + 100.0 * tolerance,
            None => (number(&achieved["error"]) - found).abs() < tolerance,
        };
        assert!(is_so, "{scene} {options}: {found}, not {report}");
    }
}

#[test]
fn a_picture_for_a_time_tells_of_it_and_can_be_made_again() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let report = json(&folder, "render cornell-box -o box.exr --size 200x200 --time 3 --json");
    // It ends with a whole sample of every pixel: the last one before the time is up, which the report knows of.
    let seconds = number(&report["achieved"]["seconds"]);
    assert_eq!((&report["promised"]["seconds"], &report["kept"]), (&3.0.into(), &json!({ "time": seconds <= 3.15 })));
    assert!(number(&report["achieved"]["error_uncertainty"]) > 0.0, "{report}");
    let options = report["chosen"]["options"].as_str().expect("text");
    printed(&folder, &format!("render cornell-box -o again.exr --size 200x200 {options}"));
    assert!(radiances(&folder, "again.exr") == radiances(&folder, "box.exr"), "{options}");
}

#[test]
fn a_promise_that_cannot_be_kept_is_told_as_broken() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    // Ambient light is another light than that between surfaces, however many rays look for it.
    let command = format!("render cornell-box -o box.png {SIZE} --error 2 --view diffuse-ao");
    assert_contains(&printed(&folder, &command), &["promised: an error of 2.00 %", "target missed: "]);
    assert_contains(&texts(&folder, "box.png")["Kept"], &["target missed: ", "% > 2.0 %"]);
    // In so short a time nothing is as good as that. What there is time for is made, and what is known of it is told.
    let report = json(&folder, &format!("render cornell-box -o box.png {SIZE} --error 0.2 --time 1.5 --json"));
    assert!(report["kept"]["error"] != true, "{report}");
    let achieved = &report["achieved"];
    assert!(error_or_limit(achieved) > 0.002, "{report}");
}

#[test]
fn pictures_of_little_are_judged_by_what_they_show() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let report = json(&folder, "render cornell-box -o one.exr --size 1x1 --error 5 --json");
    assert_eq!((radiances(&folder, "one.exr").len(), &report["promised"]["error"]), (1, &0.05.into()), "{report}");
    // From far away: about one pixel in a thousand shows the box.
    let far = "--eye 0.278,0.273,-25 --size 160x120 --error 10 --json";
    let report = json(&folder, &format!("render cornell-box -o far.exr {far}"));
    // Nearly all of them were looked at: nothing but the reference's noise is uncertain.
    let achieved = &report["achieved"];
    let (error, uncertainty) = (error_or_limit(achieved), number(&achieved["error_uncertainty"]));
    assert!(error > 0.0 && error < 0.1 + 3.0 * uncertainty && uncertainty < 0.02, "{report}");
    let nothing = refusal(&folder, "render cornell-box -o none.png --eye 9,9,9 --target 99,99,99 --error 5", 1);
    assert_contains(&nothing, &["no light"]);
}

#[test]
fn a_budget_for_a_picture_goes_with_nothing_that_it_is_to_choose() {
    let folder = folder();
    let refused = |options: &str, parts: &[&str]| {
        assert_contains(&refusal(&folder, &format!("render furnace -o x.png {options}"), 2), parts);
    };
    refused("--error 5 --samples 4", &["--error", "choose"]);
    refused("--time 5 --photons 4", &["--time", "choose"]);
    refused("--error 5 --view patches", &["|radiosity-direct|", "no view"]);
    refused("--error 5 --steps 4", &["--steps"]);
    refused("--error 5 --wireframe", &["no patches"]);
    if can_draw() {
        write_dark_scene(&folder);
        assert_contains(&refusal(&folder, "render dark.obj -o x.png --error 5", 1), &["no light"]);
    }
}

#[test]
fn points_are_measured_for_a_budget() {
    let folder = folder();
    let report = json(&folder, "probe cornell-box --spread 100 --error 3 --json");
    assert_eq!((&report["promised"]["error"], &report["kept"]), (&0.03.into(), &json!({ "error": true })));
    let points = report["points"].as_array().expect("a list");
    let (mut square, mut mean) = (0.0, 0.0);
    for point in points {
        for channel in 0..3 {
            square += number(&point["standard_error"][channel]).powi(2);
            mean += number(&point["irradiance"][channel]);
        }
    }
    let count = 300.0;
    let error = (square / count).sqrt() / (mean / count);
    assert!(
        error <= 0.03 && (error - number(&report["achieved"]["error"])).abs() < 1e-6,
        "{error} {}",
        report["achieved"]
    );
    // The options that it names lead to the same numbers.
    let options = report["chosen"]["options"].as_str().expect("text");
    assert_eq!(json(&folder, &format!("probe cornell-box --spread 100 --json {options}"))["points"], report["points"]);
    let report = json(&folder, "probe cornell-box --spread 100 --time 1 --json");
    // On a machine that is busy otherwise it may take longer, which the report knows of.
    let seconds = number(&report["achieved"]["seconds"]);
    assert_eq!(report["kept"]["time"], seconds <= 1.05);
    let refused = |options: &str, parts: &[&str]| {
        assert_contains(&refusal(&folder, &format!("probe furnace --spread 5 {options}"), 2), parts);
    };
    refused("--error 5 --samples 4", &["--error", "choose"]);
    refused("--error 5 --method radiosity", &["--error", "--method radiosity"]);
    assert_contains(&refusal(&folder, "probe ao-study --spread 5 --error 5", 1), &["no light"]);
}

#[test]
fn the_error_of_a_view_is_a_picture() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let command = format!("render cornell-box -o error.png {SIZE} --view error-of-ray-traced --samples 32 --json");
    let report = json(&folder, &command);
    let error = &report["picture"]["error"];
    assert_eq!(keys(error), ["floor", "mean_radiance", "offset", "rms", "uncertainty"]);
    // All light between surfaces is missing, which is about as much as the rest.
    assert!((-0.7..-0.3).contains(&number(&error["offset"])), "{report}");
    assert!(number(&error["rms"]) > -number(&error["offset"]) && number(&error["floor"]) < 0.2, "{report}");
    let facts = texts(&folder, "error.png");
    assert_eq!((facts["View"].as_str(), facts.contains_key("Exposure")), ("error-of-ray-traced", false));
}
