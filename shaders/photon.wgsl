// What the programs that draw photons share. They are compiled with common.wgsl and this file before them.

// Mirrored by `PhotonRecord` in src/viewport/gpu_types.rs.
struct Photon {
    // Unit coordinates.
    x: f32,
    y: f32,
    z: f32,
    // r g b, linear, a byte each.
    colour: u32,
    // Of the side on which it landed, signed bytes.
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
    // Length of a tick that points to where a photon came from, unit coordinates; 0 leaves ticks out.
    tick: f32,
    // Of photons.
    count: u32,
    // One photon of so many is drawn.
    stride: u32,
}

// Marks a square's pixels among those of ticks.
const SQUARE = 0x80000000u;

fn position(photon: Photon) -> vec3<f32> {
    return vec3(photon.x, photon.y, photon.z);
}

fn colour(photon: Photon) -> vec3<f32> {
    return unpack4x8unorm(photon.colour).rgb;
}

// Photons on sides that are turned away would shine through thin walls, which are nearer by less than a square is lifted.
fn faces_eye(photon: Photon, at: vec3<f32>) -> bool {
    return dot(unpack4x8snorm(photon.normal).xyz, points.eye - at) >= 0.0;
}
