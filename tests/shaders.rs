//! Every shader parses, is valid, and agrees with the Rust structs that are sent to it. No graphics adapter is needed.

use lightwell::viewport::SHADERS;
use lightwell::viewport::gpu_types::{
    DisplayUniform, FrameUniform, LineRecord, OutlineUniform, PhotonRecord, PointsUniform,
};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use std::mem::{offset_of, size_of};

fn parse(name: &str) -> naga::Module {
    let (_, source) = SHADERS.iter().find(|(shader, _)| *shader == name).expect("a shader of this name");
    naga::front::wgsl::parse_str(source).unwrap_or_else(|error| panic!("{}", error.emit_to_string(source)))
}

/// The size of a WGSL struct, and each member's name and offset.
fn layout(module: &naga::Module, name: &str) -> (usize, Vec<(String, usize)>) {
    let is_wanted = |ty: &naga::Type| ty.name.as_deref() == Some(name);
    let (_, ty) = module.types.iter().find(|(_, ty)| is_wanted(ty)).expect("a struct of this name");
    let naga::TypeInner::Struct { members, span } = &ty.inner else { panic!("{name} is not a struct") };
    let members = members.iter().map(|member| (member.name.clone().expect("a name"), member.offset as usize));
    (*span as usize, members.collect())
}

/// The same of a Rust struct, of the members named.
macro_rules! mirror {
    ($rust:ty, $($member:ident),+) => {
        (size_of::<$rust>(), vec![$((stringify!($member).to_owned(), offset_of!($rust, $member))),+])
    };
}

#[test]
fn every_shader_is_valid() {
    for (name, _) in SHADERS {
        let module = parse(name);
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
        if let Err(error) = validator.validate(&module) {
            panic!("{name}: {error:?}");
        }
        let has = |stage| module.entry_points.iter().any(|entry| entry.stage == stage);
        let draws = has(naga::ShaderStage::Vertex) && has(naga::ShaderStage::Fragment);
        assert!(draws || has(naga::ShaderStage::Compute), "{name} has no entry for a pipeline");
    }
}

#[test]
fn every_shader_file_is_a_program_or_a_shared_part() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
    let mut files: Vec<String> = std::fs::read_dir(folder)
        .expect("the shaders' folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    let mut expected: Vec<String> = SHADERS.iter().map(|(name, _)| format!("{name}.wgsl")).collect();
    expected.extend(["common.wgsl", "photon.wgsl"].map(str::to_owned));
    files.sort();
    expected.sort();
    assert_eq!(files, expected);
}

#[test]
fn structs_have_the_layout_of_their_shaders() {
    let frame = mirror!(FrameUniform, clip_from_unit, size, scale, line_width);
    assert_eq!(layout(&parse("surface"), "Frame"), frame);
    for name in ["outline", "splat", "photons", "lines"] {
        assert_eq!(layout(&parse(name), "Frame"), frame);
    }
    assert_eq!(layout(&parse("outline"), "Outline"), mirror!(OutlineUniform, corners, count, width));
    assert_eq!(layout(&parse("present"), "Display"), mirror!(DisplayUniform, outline, exposure, tone, encode, span));
    let photon = mirror!(PhotonRecord, x, y, z, colour, normal, direction);
    assert_eq!(layout(&parse("splat"), "Photon"), photon);
    assert_eq!(layout(&parse("splat"), "Points"), mirror!(PointsUniform, eye, size, tick, count, stride));
    assert_eq!(layout(&parse("lines"), "Line"), mirror!(LineRecord, start, width, end, colour));
}
