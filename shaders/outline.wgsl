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

// Lines are this much nearer than the surface they lie on, as a share of their distance.
const LIFT = 4e-3;

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) edge: u32) -> @builtin(position) vec4<f32> {
    let a = frame.clip_from_unit * vec4(outline.corners[edge].xyz, 1.0);
    let b = frame.clip_from_unit * vec4(outline.corners[(edge + 1u) % outline.count].xyz, 1.0);
    let start = before_eye(a, b);
    let end = before_eye(b, a);
    let along = normalize(pixels(end) - pixels(start) + vec2(1e-6, 0.0));
    let across = vec2(-along.y, along.x);

    // Corner of the line's rectangle, which reaches half a width past both ends: (-1 or 1, -1 or 1).
    let at_end = index == 1u || index == 2u || index == 4u;
    let sign = vec2(select(-1.0, 1.0, at_end), select(-1.0, 1.0, index == 2u || index >= 4u));
    var corner = start;
    if at_end {
        corner = end;
    }
    let offset = 0.5 * outline.width * (sign.x * along + sign.y * across);
    let shift = offset * 2.0 / frame.size * corner.w;
    return vec4(corner.xy + shift, corner.z * (1.0 + LIFT), corner.w);
}

@fragment
fn fragment() -> @location(1) vec2<f32> {
    return vec2(0.0, 1.0);
}

// `point`, or where the line to `other` enters the space before the near plane, at which w is z.
fn before_eye(point: vec4<f32>, other: vec4<f32>) -> vec4<f32> {
    let near = point.z;
    if point.w >= near || other.w <= near {
        return point;
    }
    return mix(point, other, (near - point.w) / (other.w - point.w));
}

fn pixels(clip: vec4<f32>) -> vec2<f32> {
    return 0.5 * frame.size * clip.xy / clip.w;
}
