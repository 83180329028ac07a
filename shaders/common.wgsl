// What several programs share. Each is compiled with this file before it.

// Mirrored by `FrameUniform` in src/viewport/gpu_types.rs.
struct Frame {
    // Unit coordinates (the scene shifted to the origin and scaled to radius 1) to clip coordinates, reversed depth.
    clip_from_unit: mat4x4<f32>,
    // Of the picture, pixels.
    size: vec2<f32>,
    // Uploaded values to stored radiance.
    scale: f32,
    // Of the outlines of elements, pixels; 0 leaves them out.
    line_width: f32,
}

// Relative luminance of linear RGB (weights of ITU-R BT.709).
fn luminance(rgb: vec3<f32>) -> f32 {
    return dot(rgb, vec3(0.2126, 0.7152, 0.0722));
}
