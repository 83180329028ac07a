//! What the shaders read, byte for byte. `tests/shaders.rs` compares every struct with its WGSL.

use bytemuck::{Pod, Zeroable};

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
    pub padding: [u32; 2],
}
