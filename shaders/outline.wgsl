// Draws the outline of one patch, in lines of a fixed width on the screen. Instance i is the edge from corner i to the
// next; its six vertices are two triangles.

// Mirrored by `OutlineUniform` in src/viewport/gpu_types.rs.
struct Outline {
    // Unit coordinates; w is unused.
    corners: array<vec4<f32>, 4>,
    count: u32,
    // Pixels.
    width: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> outline: Outline;

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) edge: u32) -> @builtin(position) vec4<f32> {
    let a = frame.clip_from_unit * vec4(outline.corners[edge].xyz, 1.0);
    let b = frame.clip_from_unit * vec4(outline.corners[(edge + 1u) % outline.count].xyz, 1.0);
    return lifted(line_corner(a, b, index, outline.width, frame.size));
}

@fragment
fn fragment() -> @location(1) vec2<f32> {
    return vec2(0.0, 1.0);
}
