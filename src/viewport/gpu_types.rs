//! What the shaders read, byte for byte. `tests/shaders.rs` compares every struct with its WGSL.

use crate::math::rgb::Rgb;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// `Frame` of shaders/common.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct FrameUniform {
    pub clip_from_unit: [[f32; 4]; 4],
    pub size: [f32; 2],
    pub scale: f32,
    pub line_width: f32,
}

/// `Outline` of shaders/outline.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct OutlineUniform {
    /// Unit coordinates; the fourth of each is unused.
    pub corners: [[f32; 4]; 4],
    pub count: u32,
    /// Pixels.
    pub width: f32,
    pub padding: [u32; 2],
}

/// `Display` of shaders/present.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct DisplayUniform {
    pub outline: [f32; 3],
    pub exposure: f32,
    pub tone: u32,
    pub encode: u32,
    pub span: [f32; 2],
}

/// `Photon` of shaders/photon.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct PhotonRecord {
    /// Unit coordinates.
    pub x: f32,
    pub y: f32,
    pub z: f32,
    /// See [`colour_bytes`].
    pub colour: u32,
    /// See [`direction_bytes`].
    pub normal: u32,
    pub direction: u32,
}

/// `Points` of shaders/photon.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct PointsUniform {
    /// Unit coordinates.
    pub eye: [f32; 3],
    /// Pixels.
    pub size: f32,
    /// Unit coordinates.
    pub tick: f32,
    pub count: u32,
    pub stride: u32,
    pub padding: u32,
}

/// `Line` of shaders/lines.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct LineRecord {
    /// Unit coordinates.
    pub start: [f32; 3],
    /// Pixels.
    pub width: f32,
    pub end: [f32; 3],
    /// See [`colour_bytes`].
    pub colour: u32,
}

/// A linear colour in [0, 1] in a byte a channel, the first one lowest.
pub fn colour_bytes(colour: Rgb) -> u32 {
    let [r, g, b] = colour.to_array().map(|channel| (255.0 * channel.clamp(0.0, 1.0)).round() as u8);
    u32::from_le_bytes([r, g, b, 255])
}

/// A vector of at most unit length in a signed byte a coordinate, the first one lowest.
pub fn direction_bytes(direction: Vec3) -> u32 {
    let [x, y, z] = direction.to_array().map(|coordinate| (127.0 * coordinate).round() as i8 as u8);
    u32::from_le_bytes([x, y, z, 0])
}
