// Draws the photons that splat.wgsl found, and marks: photons as squares before everything else.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> points: Points;
@group(0) @binding(2) var<storage, read> photons: array<Photon>;
// See splat.wgsl.
@group(0) @binding(3) var<storage, read> shown: array<u32>;

// Of a tick's colour, so that the photons stand out.
const TICK_BRIGHTNESS = 0.5;

// One triangle that covers the whole picture.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(4.0 * f32(index & 1u) - 1.0, 2.0 * f32(index & 2u) - 1.0, 0.0, 1.0);
}

@fragment
fn fragment(@builtin(position) place: vec4<f32>) -> Drawn {
    let pixel = vec2<u32>(place.xy);
    let value = shown[pixel.y * u32(frame.size.x) + pixel.x];
    if value == 0u {
        discard;
    }
    let brightness = select(TICK_BRIGHTNESS, 1.0, value >= SQUARE);
    return drawn(brightness * colour(photons[(value & ~SQUARE) - 1u]));
}

// Six vertices for each mark.
@vertex
fn vertex_mark(@builtin(vertex_index) index: u32) -> Coloured {
    let mark = photons[index / 6u];
    let center = frame.clip_from_unit * vec4(position(mark), 1.0);
    let shift = points.size * rectangle_corner(index % 6u) / frame.size * center.w;
    return Coloured(vec4(center.xy + shift, center.zw), colour(mark));
}

@fragment
fn fragment_mark(corner: Coloured) -> Drawn {
    return drawn(corner.colour);
}

fn drawn(colour: vec3<f32>) -> Drawn {
    return Drawn(vec4(frame.scale * colour, 1.0), vec2(0.0));
}
