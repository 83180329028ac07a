//! The program as it is called from a shell.

mod accuracy;
mod budget;
mod checking;
mod form_factors;
mod inspecting;
mod photons;
mod pictures_for_budgets;
mod places;
mod probing;
mod rays;
mod refusing;
mod rendering;
mod solving;
mod studying;

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A folder for one test to work in.
fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder")
}

fn program(folder: &TempDir, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lightwell"));
    command.current_dir(folder).args(arguments.split_whitespace()).stdin(Stdio::null());
    // Without this some graphics drivers complain on standard error.
    command.env("XDG_RUNTIME_DIR", folder.path());
    // Nothing is known from before.
    command.env("XDG_CACHE_HOME", folder.path()).env("MESA_SHADER_CACHE_DISABLE", "true");
    command
}

/// Runs the program with these words as arguments.
fn run(folder: &TempDir, arguments: &str) -> Output {
    program(folder, arguments).output().expect("the program starts")
}

fn stdout(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).expect("text")
}

fn stderr(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).expect("text")
}

/// What the program prints when all goes well.
fn printed(folder: &TempDir, arguments: &str) -> String {
    let output = run(folder, arguments);
    assert!(output.status.success(), "{arguments}: {}", stderr(&output));
    stdout(&output).to_owned()
}

/// The one JSON object that it prints.
fn json(folder: &TempDir, arguments: &str) -> Value {
    let text = printed(folder, arguments);
    assert_eq!(text.lines().count(), 1, "{text}");
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// The error that was achieved, or what it is surely below where it cannot be told from none.
fn error_or_limit(achieved: &Value) -> f64 {
    achieved["error"].as_f64().unwrap_or_else(|| number(&achieved["error_below_percent"]) / 100.0)
}

/// The message of a call that must fail with this exit code and print nothing else.
fn refusal(folder: &TempDir, arguments: &str, code: i32) -> String {
    let output = run(folder, arguments);
    assert_eq!(output.status.code(), Some(code), "{arguments}: {}", stderr(&output));
    assert_eq!(stdout(&output), "", "{arguments}");
    stderr(&output).to_owned()
}

fn assert_contains(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "`{part}` is not in: {text}");
    }
}

fn keys(object: &Value) -> Vec<&str> {
    let mut keys: Vec<&str> = object.as_object().expect("an object").keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Names of the files in a folder, hidden ones too.
fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// A floor without a light, as `dark.obj`.
fn write_dark_scene(folder: &TempDir) {
    let text = "mtllib dark.mtl\no floor\nv 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nusemtl grey\nf 1 2 3 4\n";
    std::fs::write(folder.path().join("dark.obj"), text).expect("a file");
    std::fs::write(folder.path().join("dark.mtl"), "newmtl grey\nKd 0.5 0.5 0.5\n").expect("a file");
}
