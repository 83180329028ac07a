//! `lightwell render`. Needs a graphics adapter; one in software will do.

use crate::{assert_contains, files, folder, json, keys, number, printed, refusal, run, stderr, write_dark_scene};
use image::ImageReader;
use lightwell::viewport::{AdapterChoice, Gpu};
use std::collections::BTreeMap;
use tempfile::TempDir;

/// Whether there is an adapter; with `REQUIRE_GPU=1` there must be one.
pub fn can_draw() -> bool {
    match Gpu::new(&AdapterChoice::System) {
        Ok(_) => true,
        Err(error) if std::env::var("REQUIRE_GPU").is_ok_and(|value| value == "1") => panic!("{error}"),
        Err(error) => {
            println!("skipped: {error}");
            false
        }
    }
}

/// What a PNG says of itself.
pub fn texts(folder: &TempDir, name: &str) -> BTreeMap<String, String> {
    let file = std::fs::File::open(folder.path().join(name)).expect("a file");
    let reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a picture");
    let info = reader.info();
    let plain = info.uncompressed_latin1_text.iter().map(|chunk| (chunk.keyword.clone(), chunk.text.clone()));
    let other = info.utf8_text.iter().map(|chunk| (chunk.keyword.clone(), chunk.get_text().expect("text")));
    plain.chain(other).collect()
}

/// The same of an EXR.
pub fn attributes(folder: &TempDir, name: &str) -> BTreeMap<String, String> {
    let meta = exr::meta::MetaData::read_from_file(folder.path().join(name), false).expect("a picture");
    let texts = meta.headers[0].own_attributes.other.iter().filter_map(|(name, value)| match value {
        exr::meta::attribute::AttributeValue::Text(text) => {
            let text = String::from_utf8(text.as_slice().to_vec()).expect("what OpenEXR reads");
            Some((name.to_string(), text))
        }
        _ => None,
    });
    texts.collect()
}

/// Every pixel of an EXR file.
pub fn radiances(folder: &TempDir, name: &str) -> Vec<[f32; 4]> {
    let image = ImageReader::open(folder.path().join(name)).expect("a file").decode().expect("a picture");
    image.into_rgba32f().pixels().map(|pixel| pixel.0).collect()
}

#[test]
fn a_png_says_how_it_was_made() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let arguments = "render cornell-box -o box.png --element 0.1 --steps 20 --size 64x48 --view patches --seed 9";
    assert_eq!(printed(&folder, arguments), "");
    let file = std::fs::File::open(folder.path().join("box.png")).expect("a file");
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("a picture");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut pixels).expect("pixels");
    reader.finish().expect("the end");
    let info = reader.info();
    assert_eq!((info.width, info.height), (64, 48));
    // Light on most of it, and not all of it white.
    assert!(pixels.chunks(4).filter(|pixel| pixel[0] > 0).count() > 64 * 48 / 2);
    assert!(pixels.chunks(4).any(|pixel| pixel[0] < 255));
    let texts: BTreeMap<&str, &str> =
        info.uncompressed_latin1_text.iter().map(|chunk| (chunk.keyword.as_str(), chunk.text.as_str())).collect();
    for (key, value) in [
        ("Scene", "cornell-box"),
        ("View", "patches"),
        ("Method", "radiosity"),
        ("Solver", "progressive"),
        ("Element size", "0.1 m"),
        ("Steps", "20"),
        ("Seed", "9"),
    ] {
        assert_eq!(texts.get(key), Some(&value), "{texts:?}");
    }
    assert!(texts["Seconds"].parse::<f64>().is_ok_and(|seconds| seconds > 0.0), "{texts:?}");
    assert!(texts.contains_key("Exposure") && texts.contains_key("Eye") && texts.contains_key("Software"));
    assert_eq!(files(folder.path()), ["box.png"]);
}

#[test]
fn an_exr_holds_the_radiance_of_the_furnace() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let arguments = "render furnace -o furnace.EXR --size 32x24 --exposure 3 --element 0.0625 --converge 0.01 --json";
    let report = json(&folder, arguments);
    assert_eq!(keys(&report["picture"]), ["exposure", "file", "size", "view"]);
    assert_eq!(report["picture"]["file"], "furnace.EXR");
    let pixels = radiances(&folder, "furnace.EXR");
    assert_eq!(pixels.len(), 32 * 24);
    // L = M_e / ((1 − ρ) π) = 2 / π in every direction, whatever the exposure.
    let expected = 2.0 / std::f32::consts::PI;
    for pixel in pixels {
        assert!(pixel[..3].iter().all(|radiance| (radiance / expected - 1.0).abs() < 0.01), "{pixel:?}");
    }
}

#[test]
fn a_scene_without_emitters_is_black_until_a_light_is_added() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    write_dark_scene(&folder);
    let view = "--size 16x16 --element 0.1 --eye 0.5,0.3,1 --target 0.5,0,0.5";
    let dark = run(&folder, &format!("render dark.obj -o dark.exr {view}"));
    assert!(dark.status.success(), "{}", stderr(&dark));
    assert_contains(stderr(&dark), &["warning: the scene: no surface emits light"]);
    assert!(radiances(&folder, "dark.exr").iter().all(|pixel| pixel[..3] == [0.0; 3]));
    let lit = run(&folder, &format!("render dark.obj -o lit.exr --ceiling-light {view}"));
    assert_eq!((lit.status.code(), stderr(&lit)), (Some(0), ""));
    let middle = radiances(&folder, "lit.exr")[8 * 16 + 8];
    assert!(middle[..3].iter().all(|&radiance| radiance > 0.0), "{middle:?}");
}

#[test]
fn a_picture_that_cannot_be_written_leaves_nothing_behind() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    std::fs::create_dir_all(folder.path().join("taken.png/inside")).expect("a folder");
    let message = refusal(&folder, "render furnace -o taken.png --element 0.25 --size 8x8 --steps 1", 1);
    assert_contains(&message, &["cannot write taken.png", "directory"]);
    assert_eq!(files(folder.path()), ["taken.png"]);
    assert_eq!(files(&folder.path().join("taken.png")), ["inside"]);
}

#[test]
fn a_picture_replaces_one_of_the_same_name_only_when_it_is_whole() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let path = folder.path().join("box.png");
    std::fs::write(&path, "an older picture").expect("a file");
    refusal(&folder, "render missing.obj -o box.png", 1);
    refusal(&folder, "render furnace -o box.png --element 0.25 --steps 1 --size 8x1000000", 1);
    refusal(&folder, "render furnace -o box.png --element 0.25 --steps 1 --adapter no-such-adapter", 1);
    assert_eq!(std::fs::read(&path).expect("a file"), b"an older picture");
    printed(&folder, "render furnace -o box.png --element 0.25 --steps 1 --size 8x8");
    assert!(std::fs::read(&path).expect("a file").starts_with(b"\x89PNG"));
    assert_eq!(files(folder.path()), ["box.png"]);
}

pub fn pixels(folder: &TempDir, name: &str) -> image::RgbaImage {
    let image = ImageReader::open(folder.path().join(name)).expect("a file").decode().expect("a picture");
    image.into_rgba8()
}

/// A room with so few patches that its matrix takes no time.
const SMALL: &str = "cornell-box --element 0.3 --patch-edge 1";

#[test]
fn diagrams_need_no_graphics_adapter() {
    let folder = folder();
    let matrix = format!("render {SMALL} -o matrix.png --view matrix --solver jacobi --adapter none-such --json");
    let report = json(&folder, &matrix);
    let picture = &report["picture"];
    let zeros = picture["zeros"].as_array().expect("reasons");
    let share: f64 = zeros.iter().map(|zero| number(&zero["share"])).sum();
    assert!(zeros.len() == 3 && share > 0.1 && share < 1.0, "{picture}");
    assert!(number(&picture["legend"]["high"]) <= 1.0);
    let patches = report["patches"].as_u64().expect("a count") as u32;
    let image = pixels(&folder, "matrix.png");
    let magnified = 480 / patches;
    assert!(magnified > 1 && image.dimensions() == (magnified * patches, magnified * patches), "{patches} patches");

    let buffer = format!("render {SMALL} -o buffer.png --view item-buffer --patch 0 --hemicube 64 --steps 0");
    assert_eq!(printed(&folder, &format!("{buffer} --adapter none-such")), "");
    let image = pixels(&folder, "buffer.png");
    assert_eq!(image.dimensions(), (3 * 128, 3 * 128));
    assert_eq!([image.get_pixel(0, 0)[3], image.get_pixel(192, 192)[3]], [0, 255], "corners are transparent");
}

#[test]
fn a_patch_is_picked_by_its_number_or_by_a_place_in_the_picture() {
    if !can_draw() {
        return;
    }
    let folder = folder();
    let arguments = format!("render {SMALL} --view form-factors --steps 0 --size 64x48 --json");
    let report = json(&folder, &format!("{arguments} -o by-place.png --pick 32,40"));
    assert!(number(&report["picture"]["legend"]["high"]) > 0.0);
    let patch = &report["picture"]["patch"];
    printed(&folder, &format!("{arguments} -o by-number.png --patch {patch}"));
    assert!(pixels(&folder, "by-number.png") == pixels(&folder, "by-place.png"));
    printed(&folder, &format!("{arguments} -o other.png --patch 0"));
    assert!(pixels(&folder, "other.png") != pixels(&folder, "by-place.png"));
}

#[test]
fn what_a_view_needs_is_asked_for() {
    let folder = folder();
    for (view, reasons) in [
        ("form-factors", ["--patch N", "--pick X,Y"]),
        ("item-buffer", ["--patch N", "--pick X,Y"]),
        ("bounces", ["--solver jacobi", "bounce"]),
        ("matrix --patch 0", ["--solver jacobi|gauss-seidel|southwell", "matrix"]),
        ("item-buffer --patch 0 --pick 1,1", ["--patch", "--pick"]),
        ("item-buffer --pick 1", ["--pick", "320,240"]),
        ("wrong", ["form-factors", "item-buffer"]),
    ] {
        assert_contains(&refusal(&folder, &format!("render {SMALL} -o picture.png --view {view}"), 2), &reasons);
    }
    for (view, reason) in [
        ("item-buffer --patch 100000", "there is no patch 100000"),
        ("item-buffer --pick 0,0", "no patch is seen at 0,0"),
        ("matrix --solver jacobi --steps 0", "nothing to draw"),
    ] {
        assert_contains(&refusal(&folder, &format!("render {SMALL} -o picture.png --view {view}"), 1), &[reason]);
    }
    if can_draw() {
        let bounces = "--view bounces --solver jacobi --steps 2 --bounce";
        let message = refusal(&folder, &format!("render {SMALL} -o picture.png {bounces} 3"), 1);
        assert_contains(&message, &["only 2 bounces"]);
        printed(&folder, &format!("render {SMALL} -o picture.png {bounces} 2"));
    }
    assert_eq!(files(folder.path()).len(), usize::from(can_draw()));
}
