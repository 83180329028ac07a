//! `lightwell probe`.

use crate::{assert_contains, folder, json, keys, number, printed, program, refusal, stdout, write_dark_scene};
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

/// A table of shares: for each point the share in red, green and blue, its standard error and the rays.
fn shares(text: &str) -> Vec<[f64; 5]> {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("x,y,z,nx,ny,nz,r,g,b,standard_error,rays"));
    let numbers = |line: &str| line.split(',').map(|field| field.parse().expect("a number")).collect::<Vec<f64>>();
    lines.map(|line| numbers(line)[6..].try_into().expect("five numbers")).collect()
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
    assert_eq!(keys(&points["points"][0]), ["irradiance", "normal", "on_surface", "point"]);
    let on_surface: Vec<_> = (0..5).map(|i| points["points"][i]["on_surface"].as_bool()).collect();
    assert_eq!(on_surface, [true, true, true, false, false].map(Some));
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

#[test]
fn all_ambient_light_arrives_on_an_open_plane_and_none_in_a_closed_room() {
    let folder = folder();
    write_dark_scene(&folder);
    std::fs::write(folder.path().join("points"), "0.5 0 0.5 0 1 0\n0.2 0 0.9 0 3 0\n").expect("a file");
    let probe = "probe --points points --method ambient-occlusion";
    // Nothing but the sky is in sight, and the plane does not hide itself.
    for share in shares(&printed(&folder, &format!("{probe} dark.obj"))) {
        assert_eq!(share, [1.0, 1.0, 1.0, 0.0, 1024.0]);
    }
    for share in shares(&printed(&folder, &format!("{probe} furnace --ao-distance unlimited --ao-rays 300"))) {
        assert_eq!(share, [0.0, 0.0, 0.0, 0.0, 300.0]);
    }
    let points = json(&folder, &format!("{probe} dark.obj --json"));
    assert_eq!(keys(&points["points"][0]), ["normal", "on_surface", "point", "rays", "share", "standard_error"]);
}

#[test]
fn under_a_ceiling_the_shares_are_those_of_closed_forms() {
    let folder = folder();
    // Two planes 1 m apart, which end at 200 m: of the sky, 1/200² = 3e-5 is beyond that.
    let plane = |y: i32| format!("v -200 {y} -200\nv -200 {y} 200\nv 200 {y} 200\nv 200 {y} -200\nf -4 -3 -2 -1\n");
    std::fs::write(folder.path().join("ceiling.obj"), plane(0) + &plane(1)).expect("a file");
    std::fs::write(folder.path().join("points"), "0 0 0 0 1 0\n0.3 1 0.2 0 -1 0\n").expect("a file");
    for (falloff, distance, hidden) in [
        // 1 − (h/D)², (1 − h/D)², 1 − ln 2, 2 E₃(1)
        ("none", 2.0, 0.75),
        ("linear", 2.0, 0.25),
        ("quadratic", 1.0, 0.306_852_819_440_055),
        ("exponential", 1.0, 0.219_383_934_395_520),
    ] {
        let options = format!("--ao-falloff {falloff} --ao-distance {distance} --ao-rays 4096");
        let probe = format!("probe ceiling.obj --points points --method ambient-occlusion {options}");
        for [r, g, b, error, rays] in shares(&printed(&folder, &probe)) {
            assert!(r == g && g == b && rays == 4096.0);
            // Rays start 32 ulps of 200 m above the surface, 8e-4 m, and no share changes by more than 1.4 a metre.
            let is_close = (r - (1.0 - hidden)).abs() <= 3.0 * error + 1.2e-3;
            // Whatever the fall-off, no variance is above that of all or nothing, and no share here is all or nothing.
            let most = (r * (1.0 - r) / (rays - 1.0)).sqrt();
            assert!(is_close && error > 0.1 * most && error < 1.0001 * most, "{falloff}: {r} ± {error}");
        }
    }
}

#[test]
fn ambient_occlusion_is_of_surfaces_and_takes_no_options_of_light() {
    let folder = folder();
    std::fs::write(folder.path().join("points"), "0.5 0.5 0.5 0 1 0\n").expect("a file");
    let probe = "probe furnace --points points --method ambient-occlusion";
    let message = refusal(&folder, probe, 1);
    assert_contains(&message, &["no surface is at 0.5,0.5,0.5", "of surfaces alone"]);
    for option in ["--photons 5", "--steps 5", "--converge 1", "--time 1", "--light-rays 5000"] {
        let name = option.split(' ').next().expect("a name");
        let message = refusal(&folder, &format!("{probe} {option}"), 2);
        assert_contains(&message, &[&format!("{name} is not for --method ambient-occlusion")]);
    }
    assert_contains(&refusal(&folder, &format!("{probe} --without colour"), 2), &["can leave out nothing"]);
    let message = refusal(&folder, "probe furnace --points points --ao-rays 5", 2);
    assert_contains(&message, &["--ao-rays is not for --method radiosity"]);
    let message = refusal(&folder, "solve furnace --method ambient-occlusion", 2);
    assert_contains(&message, &["no method is called `ambient-occlusion`", "radiosity, photon-map"]);
}

/// On surfaces and in the air, with a standard error that means what it says.
#[test]
fn the_truth_of_a_furnace_is_known_with_its_error() {
    let folder = folder();
    std::fs::write(folder.path().join("points.txt"), FURNACE_POINTS).expect("a file");
    let probe = "probe furnace --points points.txt --method reference --samples 1024";
    let text = printed(&folder, probe);
    assert!(text.starts_with("x,y,z,nx,ny,nz,r,g,b,r_error,g_error,b_error,paths\n"), "{text}");
    let points = json(&folder, &format!("{probe} --json"));
    let points = points["points"].as_array().expect("points");
    assert_eq!(
        (points.len(), keys(&points[0])),
        (5, vec!["irradiance", "normal", "on_surface", "paths", "point", "standard_error"])
    );
    for point in points {
        let number = |key: &str| point[key][0].as_f64().expect("a number");
        // 2 W/m², as above. Beyond 5 standard errors once in 40,000.
        assert!((number("irradiance") - 2.0).abs() < 5.0 * number("standard_error"), "{point}");
        assert!(number("standard_error") < 0.02 && point["paths"] == 1024, "{point}");
    }
    let timed = json(&folder, "probe furnace --points points.txt --method reference --time 0.2 --json");
    assert!(timed["points"][0]["paths"].as_u64() >= Some(32), "{timed}");
    assert_contains(&refusal(&folder, "probe furnace --points - --samples 5", 2), &["--samples", "--method radiosity"]);
    assert_contains(&refusal(&folder, &format!("{probe} --steps 5"), 2), &["--steps", "--method reference"]);
}

/// The same points whatever the method and the mesh, so that solutions can be held against the truth.
#[test]
fn points_are_spread_over_all_that_light_reaches() {
    let folder = folder();
    let places = |options: &str| -> Vec<String> {
        let text = printed(&folder, &format!("probe cornell-box --spread 50 {options}"));
        text.lines().skip(1).map(|line| line.split(',').take(6).collect::<Vec<_>>().join(",")).collect()
    };
    let by_radiosity = places("--steps 1 --element 0.1");
    assert_eq!(by_radiosity.len(), 50);
    assert_eq!(by_radiosity, places("--steps 1 --element 0.05"));
    assert_eq!(by_radiosity, places("--method reference --samples 1"));
    assert_eq!(by_radiosity, places("--steps 1 --element 0.1 --seed 1"));
    assert_contains(&refusal(&folder, "probe furnace", 2), &["--points"]);
    assert_contains(&refusal(&folder, "probe furnace --points - --spread 5", 2), &["--spread"]);
}

/// Of light as a view shows it, the whole: what emitters send and what goes on from wall to wall.
#[test]
fn views_measure_the_light_of_a_furnace() {
    let folder = folder();
    let probe = |options: &str| json(&folder, &format!("probe furnace --spread 100 --samples 4 --json {options}"));
    for options in
        ["--method radiosity-direct --light-rays 16", "--method final-gather --light-rays 16 --photons 100000"]
    {
        let report = probe(options);
        let points = report["points"].as_array().expect("a list");
        assert_eq!(
            keys(&points[0]),
            ["irradiance", "normal", "on_surface", "point", "samples", "standard_error"],
            "{options}"
        );
        let mean = points.iter().map(|point| number(&point["irradiance"][0])).sum::<f64>() / points.len() as f64;
        // 2 W/m², as above. Half of it by 6,400 rays to emitters, which weigh by cosines and squared distances with a spread of
        // about 3: 4 % of 1 W/m² in the mean. The rest is read off what conserves energy.
        assert!((mean - 2.0).abs() < 3.0 * 0.04, "{options}: {mean}");
    }
    let refused = |options: &str, parts: &[&str]| {
        assert_contains(&refusal(&folder, &format!("probe furnace --spread 5 {options}"), 2), parts);
    };
    refused("--method radiosity-direct --photons 5", &["--photons", "radiosity-direct"]);
    refused("--method final-gather --steps 5", &["--steps", "final-gather"]);
    refused("--method diffuse-ao --gather-rays 5", &["--gather-rays", "diffuse-ao"]);
}
