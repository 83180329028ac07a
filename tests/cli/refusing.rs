//! What cannot be done: exit codes, messages and warnings.

use crate::{assert_contains, files, folder, number, refusal, run, stderr, stdout, write_dark_scene};
use serde_json::Value;

#[test]
fn a_wrong_command_line_is_exit_code_2() {
    let folder = folder();
    for (arguments, reason) in [
        ("solve furnace --stepps 3", "--stepps"),
        ("solve furnace --steps three", "three"),
        ("solve furnace --steps 3 --time 1", "cannot be used with"),
        ("solve furnace --steps 3 --converge 1", "cannot be used with"),
        ("solve furnace --time 0", "above 0"),
        ("solve furnace --converge 0", "above 0"),
        ("solve furnace --element 0", "above 0"),
        ("solve furnace --shadow-rays 0", "--shadow-rays"),
        ("solve", "<SCENE>"),
        ("probe furnace", "--points"),
        ("render furnace", "--output"),
        ("render furnace -o picture.jpg", ".png or .exr"),
        ("render furnace -o picture", ".png or .exr"),
        ("render furnace -o nowhere/picture.png", "no folder nowhere"),
        ("render furnace -o picture.png --size 640", "640x480"),
        ("render furnace -o picture.png --size 0x480", "640x480"),
        ("render furnace -o picture.png --samples 0", "--samples"),
        ("render furnace -o picture.png --view sideways", "sideways"),
        ("render furnace -o picture.png --eye 1,2", "three numbers"),
        ("render furnace -o picture.png --fov 180", "170"),
        ("solve furnace --effects some", "no set of effects is called `some`"),
        ("solve furnace --without sound", "no effect is called `sound`"),
        ("solve furnace --without caustics", "can leave out direct-light, shadows, interreflection, colour, escape"),
        ("solve furnace --form-factor hemicube --without shadows", "--without shadows is not for --method radiosity"),
        ("solve furnace --method photon-map --without escape", "--without escape is not for --method photon-map"),
        ("render furnace -o picture.png --view ambient-occlusion --without colour", "can leave out nothing"),
    ] {
        assert_contains(&refusal(&folder, arguments, 2), &[reason]);
    }
    assert_eq!(files(folder.path()), [""; 0]);
}

#[test]
fn a_scene_that_cannot_be_opened_is_exit_code_1_with_its_cause() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("folder.obj")).expect("a folder");
    std::fs::write(folder.path().join("empty.obj"), "").expect("a file");
    for command in ["solve", "inspect", "probe --points -"] {
        for (scene, parts) in [
            ("missing.obj", ["missing.obj", "no such file"]),
            ("folder.obj", ["cannot read folder.obj", "directory"]),
            ("empty.obj", ["empty.obj", "the file is empty"]),
        ] {
            let message = refusal(&folder, &format!("{command} {scene}"), 1);
            assert_contains(&message, &parts);
            assert_eq!(message.lines().count(), 1, "{message}");
        }
    }
    let message = refusal(&folder, "solve furnace --element 1e-6", 1);
    assert_contains(&message, &["at most"]);
}

#[test]
fn warnings_go_to_standard_error() {
    let folder = folder();
    write_dark_scene(&folder);
    let dark = run(&folder, "solve dark.obj --json");
    assert!(dark.status.success());
    assert_contains(stderr(&dark), &["warning: the scene: no surface emits light"]);
    let report: Value = serde_json::from_str(stdout(&dark)).expect("one JSON object and nothing else");
    assert_eq!((number(&report["steps"]), number(&report["energy"]["emitted"])), (0.0, 0.0));
    let lit = run(&folder, "solve dark.obj --ceiling-light --json");
    assert_eq!(stderr(&lit), "");
    let report: Value = serde_json::from_str(stdout(&lit)).expect("JSON");
    assert!(number(&report["energy"]["absorbed"]) > 0.0);
}

/// Before anything is allocated: 10^12 pixels are more than any machine has room for.
#[test]
fn a_picture_that_does_not_fit_into_memory_is_refused() {
    let folder = folder();
    for command in [
        "render furnace -o x.png --view reference --samples 1",
        "render furnace -o x.exr",
        "render furnace -o x.png --error 5",
        "render furnace -o x.png --view matrix --solver jacobi",
        "series furnace -o pictures",
    ] {
        let message = refusal(&folder, &format!("{command} --size 1000000x1000000"), 1);
        assert_contains(&message, &["a picture of 1000000 × 1000000 pixels needs", "MiB", "are free", "smaller size"]);
    }
    assert_eq!(files(folder.path()), [""; 0]);
}
