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

// What is drawn into the picture.
struct Drawn {
    // Premultiplied with coverage.
    @location(0) radiance: vec4<f32>,
    // Coverage by outlines of elements and by the outline of one patch.
    @location(1) overlay: vec2<f32>,
}

// A corner of something of one colour.
struct Coloured {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat, either) colour: vec3<f32>,
}

// Lines and points are this much nearer than the surface they lie on, as a share of their distance.
const LIFT = 4e-3;

fn lifted(clip: vec4<f32>) -> vec4<f32> {
    return vec4(clip.xy, clip.z * (1.0 + LIFT), clip.w);
}

// One of the six corners of the two triangles of a rectangle: (-1 or 1, -1 or 1).
fn rectangle_corner(index: u32) -> vec2<f32> {
    let right = index == 1u || index == 2u || index == 4u;
    let top = index == 2u || index >= 4u;
    return vec2(select(-1.0, 1.0, right), select(-1.0, 1.0, top));
}

// One of the six corners of a line from `a` to `b`, of a width in pixels in a picture of this size: a rectangle that
// reaches half a width past both ends.
fn line_corner(a: vec4<f32>, b: vec4<f32>, index: u32, width: f32, size: vec2<f32>) -> vec4<f32> {
    let start = before_eye(a, b);
    let end = before_eye(b, a);
    let along = normalize(size * (end.xy / end.w - start.xy / start.w) + vec2(1e-6, 0.0));
    let across = vec2(-along.y, along.x);
    let sign = rectangle_corner(index);
    var corner = start;
    if sign.x > 0.0 {
        corner = end;
    }
    let shift = width * (sign.x * along + sign.y * across) / size * corner.w;
    return vec4(corner.xy + shift, corner.zw);
}

// `point`, or where the line to `other` enters the space before the near plane, at which w is z.
fn before_eye(point: vec4<f32>, other: vec4<f32>) -> vec4<f32> {
    let near = point.z;
    if point.w >= near || other.w <= near {
        return point;
    }
    return mix(point, other, (near - point.w) / (other.w - point.w));
}
