// Draws photons as squares of a fixed width on the screen, and ticks that point to where they came from. Vertices are
// pulled: six for each photon.

// Mirrored by `PhotonRecord` in src/viewport/gpu_types.rs.
struct Photon {
    // Unit coordinates.
    x: f32,
    y: f32,
    z: f32,
    // r g b, linear, a byte each.
    colour: u32,
    // Of the side on which it landed, signed bytes; 0 for what is seen from everywhere.
    normal: u32,
    // In which it flew, signed bytes.
    direction: u32,
}

// Mirrored by `PointsUniform` in src/viewport/gpu_types.rs.
struct Points {
    // Unit coordinates.
    eye: vec3<f32>,
    // Of a square, pixels.
    size: f32,
    // Length of a tick, unit coordinates.
    tick: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> points: Points;
@group(0) @binding(2) var<storage, read> photons: array<Photon>;

// Of a tick, pixels.
const TICK_WIDTH = 1.0;
// Of a tick's colour, so that the photons stand out.
const TICK_BRIGHTNESS = 0.6;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Coloured {
    let photon = photons[index / 6u];
    let at = position(photon);
    if !is_seen(photon, at) {
        return Coloured(HIDDEN, vec3(0.0));
    }
    let center = frame.clip_from_unit * vec4(at, 1.0);
    let shift = points.size * rectangle_corner(index % 6u) / frame.size * center.w;
    return Coloured(lifted(vec4(center.xy + shift, center.zw)), colour(photon));
}

@vertex
fn vertex_tick(@builtin(vertex_index) index: u32) -> Coloured {
    let photon = photons[index / 6u];
    let at = position(photon);
    if !is_seen(photon, at) {
        return Coloured(HIDDEN, vec3(0.0));
    }
    let came_from = at - points.tick * unpack4x8snorm(photon.direction).xyz;
    let a = frame.clip_from_unit * vec4(at, 1.0);
    let b = frame.clip_from_unit * vec4(came_from, 1.0);
    let corner = line_corner(a, b, index % 6u, TICK_WIDTH, frame.size);
    return Coloured(lifted(corner), TICK_BRIGHTNESS * colour(photon));
}

@fragment
fn fragment(corner: Coloured) -> Drawn {
    return Drawn(vec4(frame.scale * corner.colour, 1.0), vec2(0.0));
}

fn position(photon: Photon) -> vec3<f32> {
    return vec3(photon.x, photon.y, photon.z);
}

fn colour(photon: Photon) -> vec3<f32> {
    return unpack4x8unorm(photon.colour).rgb;
}

// Photons on sides that are turned away would shine through thin walls, which are nearer by less than a square is lifted.
fn is_seen(photon: Photon, at: vec3<f32>) -> bool {
    return dot(unpack4x8snorm(photon.normal).xyz, points.eye - at) >= 0.0;
}
