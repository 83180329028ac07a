//! Files with troubles, one kind a file: each opens with the findings that name the trouble and its line, or is refused
//! with a clear message. None makes the loader panic.

use lightwell::scene::FindingKind::{self, *};
use lightwell::scene::Scene;
use std::path::Path;

/// What is expected of a file.
enum Expected {
    /// The polygons that are left, and each finding with the end of its subject, in order.
    Opens(usize, &'static [(FindingKind, &'static str)]),
    /// A part of the message, with its causes.
    Refused(&'static str),
}
use Expected::{Opens, Refused};

const CORPUS: &[(&str, Expected)] = &[
    ("empty.obj", Refused("empty.obj has no face that can be used: the file is empty")),
    ("only-comments.obj", Refused("it has no line that begins with `f`")),
    ("no-face.obj", Refused("it has no line that begins with `f`")),
    ("binary.obj", Refused("binary.obj: it is not a text file")),
    (
        "no-usable-face.obj",
        Refused("none of its 3 faces can be used (object 'unnamed', line 6: vertex 9 does not exist"),
    ),
    (
        "non-finite.obj",
        Opens(
            1,
            &[
                (NonFiniteVertex, "vertex 5, line 7"),
                (NonFiniteVertex, "vertex 6, line 8"),
                (NonFiniteVertex, "vertex 7, line 9"),
                (NonFiniteVertex, "line 11"),
                (NonFiniteVertex, "line 12"),
                (NonFiniteVertex, "line 13"),
            ],
        ),
    ),
    ("too-large.obj", Opens(1, &[(ValueOutOfRange, "vertex 5, line 7"), (NonFiniteVertex, "line 9")])),
    (
        "malformed-vertex.obj",
        Opens(
            2,
            &[
                (MalformedLine, "vertex 5, line 7"),
                (MalformedLine, "vertex 6, line 8"),
                (NonFiniteVertex, "line 13"),
                (UnusedVertices, "the file"),
            ],
        ),
    ),
    (
        "index-out-of-range.obj",
        Opens(
            2,
            &[
                (IndexOutOfRange, "line 8"),
                (IndexOutOfRange, "line 9"),
                (IndexOutOfRange, "line 10"),
                (MalformedLine, "line 11"),
                (IndexOutOfRange, "line 12"),
                (IndexOutOfRange, "line 14"),
            ],
        ),
    ),
    (
        "too-few-corners.obj",
        Opens(1, &[(DegenerateFace, "line 8"), (DegenerateFace, "line 9"), (DegenerateFace, "line 10")]),
    ),
    (
        "malformed-face.obj",
        Opens(
            1,
            &[
                (NormalIgnored, "line 7"),
                (MalformedLine, "line 8"),
                (MalformedLine, "line 9"),
                (MalformedLine, "line 10"),
            ],
        ),
    ),
    (
        "bad-normals.obj",
        Opens(
            11,
            &[
                (NormalIgnored, "normal 1, line 9"),
                (NormalIgnored, "line 21"),
                (NormalIgnored, "line 22"),
                (NormalIgnored, "line 23"),
                (NormalIgnored, "normal 2, line 10"),
                (NormalIgnored, "normal 3, line 11"),
                (NormalIgnored, "normal 4, line 12"),
                (NormalIgnored, "object 'unnamed', line 25"),
            ],
        ),
    ),
    (
        "degenerate.obj",
        Opens(4, &[(DegenerateFace, "line 11"), (DegenerateFace, "line 13"), (DegenerateFace, "line 14")]),
    ),
    ("duplicate.obj", Opens(2, &[(DuplicateFace, "line 9"), (DuplicateFace, "line 12"), (DuplicateFace, "line 14")])),
    ("warped.obj", Opens(2, &[(NonPlanarFace, "line 7")])),
    ("crossed.obj", Opens(2, &[(CrossedFace, "line 7")])),
    ("concave.obj", Opens(4 + 2, &[])),
    (
        "missing-library.obj",
        Opens(
            1,
            &[
                (MissingMaterialFile, "material file 'nowhere.mtl', line 1"),
                (MissingMaterial, "material 'white', line 6"),
                (NoEmitter, "the scene"),
            ],
        ),
    ),
    (
        "library-is-binary.obj",
        Opens(
            1,
            &[
                (MissingMaterialFile, "material file 'binary.obj', line 1"),
                (MissingMaterial, "line 6"),
                (NoEmitter, "the scene"),
            ],
        ),
    ),
    ("unknown-material.obj", Opens(5, &[(MalformedLine, "line 14"), (MissingMaterial, "material 'wite', line 9")])),
    ("no-material.obj", Opens(1, &[(MissingMaterial, "line 5"), (NoEmitter, "the scene")])),
    ("unused-vertices.obj", Opens(1, &[(UnusedVertices, "the file")])),
    ("lines-and-points.obj", Opens(1, &[(IndexOutOfRange, "line 14")])),
    ("layout.obj", Opens(1, &[])),
    ("latin1.obj", Opens(1, &[])),
    ("names.obj", Opens(2, &[])),
    (
        "bad-values.obj",
        Opens(
            4,
            &[
                (MalformedLine, "bad-values.mtl, line 1"),
                (MalformedLine, "bad-values.mtl, line 22"),
                (MalformedLine, "bad-values.mtl, line 24"),
                // Of the two materials 'a' only the later one is used, so only its own troubles are told.
                (MalformedLine, "material 'a', line 27"),
                (ValueOutOfRange, "material 'b', line 8"),
                (ValueOutOfRange, "material 'b', line 9"),
                (ValueOutOfRange, "material 'b', line 10"),
                (ValueOutOfRange, "material 'b', line 11"),
                (MalformedLine, "material 'c', line 14"),
                (MalformedLine, "material 'c', line 15"),
                (MalformedLine, "material 'c', line 16"),
                (MalformedLine, "material 'c', line 17"),
                (ValueOutOfRange, "material 'd', line 19"),
                (ValueOutOfRange, "material 'd', line 20"),
                (ValueOutOfRange, "material 'd', line 21"),
            ],
        ),
    ),
    // The material that no face uses goes unmentioned.
    ("textures.obj", Opens(1, &[(TextureIgnored, "material 'painted', line 2"), (MissingMaterial, "'painted'")])),
    (
        "specular.obj",
        Opens(5, &[(SpecularIgnored, "'mirror'"), (SpecularIgnored, "'gloss'"), (SpecularIgnored, "'glass'")]),
    ),
];

fn folder() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/corpus")
}

fn open(file: &str) -> Result<Scene, String> {
    let path = folder().join(file);
    Scene::open(path.to_str().expect("the path is text")).map_err(|error| {
        let mut message = error.to_string();
        let mut cause = std::error::Error::source(&error);
        while let Some(error) = cause {
            message += &format!(": {error}");
            cause = error.source();
        }
        message
    })
}

#[test]
fn every_file_is_mended_or_refused_by_name_and_line() {
    for (file, expected) in CORPUS {
        match (open(file), expected) {
            (Ok(scene), Opens(polygons, findings)) => {
                let found: Vec<_> = scene.findings.iter().map(|f| (f.kind, f.subject.as_str())).collect();
                let all_match = found.len() == findings.len()
                    && found.iter().zip(*findings).all(|(f, e)| f.0 == e.0 && f.1.ends_with(e.1));
                assert!(all_match, "{file}: found {:#?}\nbut expected {findings:#?}", scene.findings);
                assert_eq!(scene.polygons.len(), *polygons, "{file}");
            }
            (Err(message), Refused(part)) => assert!(message.contains(part), "{file}: {message}"),
            (Ok(scene), Refused(_)) => panic!("{file} opened with {} polygons", scene.polygons.len()),
            (Err(message), Opens(..)) => panic!("{file} was refused: {message}"),
        }
    }
}

#[test]
fn every_file_of_the_corpus_is_tested() {
    for entry in std::fs::read_dir(folder()).expect("the corpus is there") {
        let name = entry.expect("the corpus can be read").file_name().into_string().expect("names are text");
        let is_listed = CORPUS.iter().any(|(file, _)| *file == name);
        assert!(is_listed || name.ends_with(".mtl"), "{name} is not in the list");
    }
}

#[test]
fn folders_and_missing_files_have_clear_messages() {
    let folder_message = open("").expect_err("a folder is no scene");
    assert!(folder_message.starts_with("cannot read "), "{folder_message}");
    let message = open("no-such-file.obj").expect_err("the file does not exist");
    assert!(message.contains("no scene is called `") && message.contains("cornell-box, empty-box"), "{message}");
}
