//! `lightwell render` of photons and by rays from the camera, and `lightwell series`. Needs a graphics adapter.

use crate::rendering::{can_draw, pixels, radiances, texts};
use crate::{assert_contains, files, folder, json, keys, number, printed, refusal, write_dark_scene};

const SMALL: &str = "cornell-box --element 0.25 --size 32x24";
const PHOTONS: &str = "--photons 20000 --caustic-photons 1000";

#[test]
fn every_view_by_rays_is_written_and_tells_how_it_was_made() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    for (view, options, facts) in [
        (
            "ray-traced",
            "--light-rays 2 --paths L(S*)DE",
            vec![("Method", "ray tracing"), ("Light rays", "2"), ("Paths", "L(S*)DE")],
        ),
        ("radiosity-specular", "--steps 10", vec![("Method", "radiosity"), ("Steps", "10")]),
        ("radiosity-direct", "--steps 10 --light-rays 2", vec![("Method", "radiosity"), ("Light rays", "2")]),
        ("reference", "--paths LDDE", vec![("Method", "path tracing"), ("Paths", "LDDE")]),
        (
            "photon-irradiance",
            "--photons 20000 --kernel cone",
            vec![("Method", "photon map"), ("Kernel", "cone"), ("Photons", "20000")],
        ),
        ("photon-radiance", "--photons 20000 --nearest 30", vec![("Nearest", "30"), ("Passes", "1")]),
        ("caustics", PHOTONS, vec![("Caustic photons", "1000")]),
        ("final-gather", "--photons 20000 --gather-rays 4", vec![("Gather rays", "4"), ("Light rays", "4")]),
    ] {
        let report = json(&folder, &format!("render {SMALL} -o {view}.png --view {view} {options} --samples 2 --json"));
        let picture = &report["picture"];
        assert_eq!(keys(picture), ["exposure", "file", "rays", "samples", "seconds", "size", "view"]);
        assert_eq!((&picture["view"], number(&picture["samples"])), (&view.into(), 2.0));
        // Two samples of 32 × 24 pixels, and a coarse pass or more before.
        assert!(number(&picture["rays"]) > 2.0 * 32.0 * 24.0 && number(&picture["seconds"]) > 0.0, "{report}");
        let texts = texts(&folder, &format!("{view}.png"));
        for (name, value) in facts.into_iter().chain([("View", view), ("Samples", "2"), ("Scene", "cornell-box")]) {
            assert_eq!(texts.get(name).map(String::as_str), Some(value), "{view}: {name} in {texts:?}");
        }
        assert!(texts.contains_key("Exposure") && texts.contains_key("Eye") && texts.contains_key("Seed"));
    }
}

#[test]
fn ambient_occlusion_tells_how_it_was_made_and_needs_no_lamp() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let options = "--ao-rays 8 --ao-distance 0.2 --ao-falloff exponential --samples 2";
    for view in ["ambient-occlusion", "diffuse-ao"] {
        printed(&folder, &format!("render {SMALL} -o {view}.png --view {view} {options}"));
        let texts = texts(&folder, &format!("{view}.png"));
        for (name, value) in
            [("Ambient rays", "8"), ("Ambient fall-off", "exponential"), ("Ambient distance", "0.2 m"), ("View", view)]
        {
            assert_eq!(texts.get(name).map(String::as_str), Some(value), "{view}: {name} in {texts:?}");
        }
        assert_eq!(texts.contains_key("Exposure"), view == "diffuse-ao");
    }
    let report = json(&folder, &format!("render {SMALL} -o a.png --view ambient-occlusion --samples 1 --json"));
    assert_eq!(report["method"], "ambient-occlusion");
    for (view, option) in
        [("diffuse", "--ao-rays 8"), ("ray-traced", "--ao-distance unlimited"), ("smooth", "--ao-falloff none")]
    {
        let name = option.split(' ').next().expect("a name");
        let refused = refusal(&folder, &format!("render {SMALL} -o a.png --view {view} {option}"), 2);
        assert_contains(&refused, &[&format!("{name} is not for the view `{view}`")]);
    }
}

#[test]
fn ambient_occlusion_on_the_mesh_is_drawn_without_a_lamp() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    write_dark_scene(&folder);
    let options = "-o mesh.png --view ambient-occlusion-vertices --ao-rays 8 --samples 3 --size 64x48 --json";
    let report = json(&folder, &format!("render dark.obj {options}"));
    assert_eq!(report["method"], "ambient-occlusion-vertices");
    // Both sides of the floor are open to the sky. A vertex shares its rays out to the elements round it, each of which gets
    // one at least.
    let vertices = number(&report["vertices"]);
    assert!(vertices > 1000.0 && number(&report["picture"]["rounds"]) == 3.0, "{report}");
    let rays = number(&report["picture"]["rays"]);
    assert!((24.0 * vertices..27.0 * vertices).contains(&rays), "{report}");
    let texts = texts(&folder, "mesh.png");
    for (name, value) in [("Ambient rays", "8"), ("Rounds", "3"), ("View", "ambient-occlusion-vertices")] {
        assert_eq!(texts.get(name).map(String::as_str), Some(value), "{name} in {texts:?}");
    }
    assert!(!texts.contains_key("Exposure"));
    for option in ["--steps 3", "--converge 1", "--paths LDE", "--photons 5", "--light-rays 5"] {
        let name = option.split(' ').next().expect("a name");
        let refused =
            refusal(&folder, &format!("render dark.obj -o a.png --view ambient-occlusion-vertices {option}"), 2);
        assert_contains(&refused, &[&format!("{name} is not for the view `ambient-occlusion-vertices`")]);
    }
}

#[test]
fn ambient_occlusion_is_held_against_indirect_light_where_there_is_some() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let render = "-o c.png --view ao-minus-indirect --samples 4 --json";
    let report = json(&folder, &format!("render {SMALL} {render}"));
    assert_eq!(report["method"], "ao-minus-indirect");
    let picture = &report["picture"];
    let high = number(&picture["legend"]["high"]);
    assert!(high > 0.0 && number(&picture["legend"]["low"]) == -high, "{report}");
    let [difference, correlation] = ["mean_absolute_difference", "correlation"].map(|name| number(&picture[name]));
    assert!(difference > 0.0 && difference < high && (-1.0..=1.0).contains(&correlation), "{report}");
    assert!(number(&picture["mean_share"]) > 0.0 && number(&picture["mean_indirect_irradiance"]) > 0.0, "{report}");
    assert_eq!(picture["exposure"], serde_json::Value::Null);
    let texts = texts(&folder, "c.png");
    assert_eq!(texts.get("Range"), Some(&high.to_string()), "{texts:?}");
    write_dark_scene(&folder);
    let refused = refusal(&folder, "render dark.obj -o d.png --view ao-minus-indirect --samples 1 --size 16x12", 1);
    assert_contains(&refused, &["No light comes here", "there is nothing to compare"]);
    let refused = refusal(&folder, &format!("render {SMALL} {render} --paths LDE"), 2);
    assert_contains(&refused, &["--paths is not for the view `ao-minus-indirect`"]);
}

#[test]
fn a_report_tells_of_the_light_that_a_picture_is_read_off() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let report = |view: &str, options: &str| {
        json(&folder, &format!("render {SMALL} -o picture.png --samples 1 --view {view} {options} --json"))
    };
    let photons = report("photon-radiance", PHOTONS);
    assert_eq!((&photons["method"], number(&photons["counters"]["emitted"])), (&"photon-map".into(), 20_000.0));
    assert_eq!(report("radiosity-specular", "--steps 3")["steps"], 3);
    assert_eq!(report("ray-traced", "")["method"], "ray-tracing");
}

#[test]
fn the_furnace_looks_the_same_read_off_photons_and_gathered() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let expected = 2.0 / std::f64::consts::PI;
    // L = M_e / ((1 − ρ) π). Half of it is emitted and seen as it is; the other half is read off photons: 60,000 that land
    // twice each on average, so that the mean of the picture is good to half a percent. Irradiance takes no reflectance, so
    // it adds to the emitted half a whole one, E / π. Shadow rays between walls that meet have a spread without bound: the
    // tests of the method hold them closer than a command line has the time for.
    for (view, options, share, tolerance) in [
        ("photon-irradiance", "", 1.5, 0.02),
        ("photon-radiance", "", 1.0, 0.02),
        ("final-gather", "--gather-rays 16 --light-rays 64 --samples 4", 1.0, 0.1),
    ] {
        let scene = "furnace --size 16x12 --element 0.25 --photons 60000";
        assert_eq!(printed(&folder, &format!("render {scene} -o {view}.exr --view {view} {options}")), "");
        let pixels = radiances(&folder, &format!("{view}.exr"));
        let mean: f64 = pixels.iter().map(|pixel| f64::from(pixel[1])).sum::<f64>() / pixels.len() as f64;
        println!("{view}: {mean}, {} of what it should be", mean / (share * expected));
        assert!((mean / (share * expected) - 1.0).abs() < tolerance, "{view}: {mean} and not {share} times {expected}");
    }
}

#[test]
fn passes_give_a_sample_each_and_time_gives_at_least_one() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let render = |options: &str| json(&folder, &format!("render {SMALL} -o picture.png {options} --json"));
    let passes = render("--view photon-radiance --photons 5000 --passes 3");
    assert_eq!((number(&passes["passes"]), number(&passes["picture"]["samples"])), (3.0, 3.0));
    assert!(texts(&folder, "picture.png").get("Passes").is_some_and(|passes| passes == "3"));
    let short = render("--view ray-traced --time 1e-6");
    assert_eq!(number(&short["picture"]["samples"]), 1.0);
    let timed = render("--view ray-traced --time 0.2");
    assert!(number(&timed["picture"]["seconds"]) >= 0.2 && number(&timed["picture"]["samples"]) > 1.0);
}

#[test]
fn photons_and_their_tree_are_drawn() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let report = json(&folder, &format!("render {SMALL} -o photons.png --view photons {PHOTONS} --json"));
    assert_eq!(keys(&report["picture"]), ["file", "photons", "size", "view"]);
    assert!(number(&report["picture"]["photons"]) > 20_000.0);
    printed(&folder, &format!("render {SMALL} -o tree.png --view kd-tree {PHOTONS}"));
    let none = printed(&folder, &format!("render {SMALL} -o direct.png --view photons --paths LDE {PHOTONS}"));
    assert_eq!(none, "");
    let different = |a: &str, b: &str| pixels(&folder, a) != pixels(&folder, b);
    assert!(different("photons.png", "tree.png") && different("photons.png", "direct.png"));
    assert_eq!(texts(&folder, "direct.png").get("Paths").map(String::as_str), Some("LDE"));
}

#[test]
fn options_that_a_view_has_no_use_for_are_exit_code_2() {
    let folder = folder();
    for (options, reasons) in [
        ("--view smooth --photons 5", ["--photons", "`smooth`"]),
        ("--view ray-traced --nearest 5", ["--nearest", "`ray-traced`"]),
        ("--view ray-traced --steps 5", ["--steps", "`ray-traced`"]),
        ("--view photons --converge 5", ["--converge", "`photons`"]),
        ("--view photons --gather-rays 5", ["--gather-rays", "`photons`"]),
        ("--view photon-radiance --gather-rays 5", ["--gather-rays", "`photon-radiance`"]),
        ("--view photon-radiance --light-rays 5", ["--light-rays", "`photon-radiance`"]),
        ("--view final-gather --light-rays 5000", ["--light-rays", "4096"]),
        ("--view final-gather --gather-rays 0", ["--gather-rays", "from 1 to"]),
        ("--view smooth --light-rays 5", ["--light-rays", "1000"]),
        ("--view radiosity-direct --light-rays 5000", ["--light-rays", "4096"]),
        ("--view reference --light-rays 5", ["--light-rays", "`reference`"]),
        ("--view smooth --paths LDE", ["--paths", "`smooth`"]),
        ("--view radiosity-specular --paths LDE", ["--paths", "`radiosity-specular`"]),
        ("--view ray-traced --paths LXE", ["--paths", "`X`"]),
        ("--view photon-radiance --passes 2 --samples 4", ["--passes", "--samples"]),
    ] {
        assert_contains(&refusal(&folder, &format!("render {SMALL} -o picture.png {options}"), 2), &reasons);
    }
    for (output, reason) in [("no/such/folder", "there is no folder no/such"), ("a-file", "a-file is not a folder")] {
        std::fs::write(folder.path().join("a-file"), "").expect("a file");
        assert_contains(&refusal(&folder, &format!("series {SMALL} -o {output}"), 2), &[reason]);
    }
    assert_eq!(files(folder.path()), ["a-file"]);
}

#[test]
fn a_series_is_one_scene_from_one_camera() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let options = "--samples 1 --gather-rays 4 --light-rays 1";
    let report = json(&folder, &format!("series {SMALL} -o slides {options} {PHOTONS} --json"));
    let names =
        ["1-ray-traced.png", "2-photons.png", "3-photon-irradiance.png", "4-photon-radiance.png", "5-final-gather.png"];
    assert_eq!(files(&folder.path().join("slides")), names);
    assert_eq!(report["pictures"].as_array().map(Vec::len), Some(5));
    assert_eq!(number(&report["counters"]["emitted"]), 20_000.0);
    let texts = |name: &str| texts(&folder, &format!("slides/{name}"));
    for fact in ["Eye", "Target", "Scene", "Seed"] {
        assert!(names.iter().all(|name| texts(name).get(fact) == texts(names[0]).get(fact)), "{fact}");
    }
    // It can be made again over the old one.
    let text = printed(&folder, &format!("series {SMALL} -o slides {options} {PHOTONS}"));
    assert_contains(&text, &names);
}
