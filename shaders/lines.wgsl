// Draws lines of a fixed width on the screen. Vertices are pulled: six for each line.

// Mirrored by `LineRecord` in src/viewport/gpu_types.rs.
struct Line {
    // Unit coordinates.
    start: vec3<f32>,
    // Pixels.
    width: f32,
    end: vec3<f32>,
    // r g b, linear, a byte each.
    colour: u32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> lines: array<Line>;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Coloured {
    let line = lines[index / 6u];
    let a = frame.clip_from_unit * vec4(line.start, 1.0);
    let b = frame.clip_from_unit * vec4(line.end, 1.0);
    let corner = line_corner(a, b, index % 6u, line.width, frame.size);
    return Coloured(lifted(corner), unpack4x8unorm(line.colour).rgb);
}

@fragment
fn fragment(corner: Coloured) -> Drawn {
    return Drawn(vec4(frame.scale * corner.colour, 1.0), vec2(0.0));
}
