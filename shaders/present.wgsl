// Shows stored values on a screen: exposure, tone curve, background, lines, encoding.

// Mirrored by `DisplayUniform` in src/viewport/gpu_types.rs.
struct Display {
    // Colour of the outlined patch, before encoding.
    outline: vec3<f32>,
    // Stored values to exposed ones, of which 1 is white.
    exposure: f32,
    // A tone curve: 0 linear, 1 filmic.
    tone: u32,
    // Whether the target wants values that are already encoded.
    encode: u32,
    // How many texels of `radiance` lie along the width and height of the target: less than there are where its last cells
    // reach past the edge.
    span: vec2<f32>,
}

@group(0) @binding(0) var<uniform> display: Display;
// Premultiplied with coverage.
@group(0) @binding(1) var radiance: texture_2d<f32>;
// Coverage by outlines of elements and by the outline of one patch; a single texel where there are none.
@group(0) @binding(2) var overlay: texture_2d<f32>;

// Colour of a screen before encoding.
const BACKGROUND = vec3(0.018, 0.022, 0.030);
// How far a line takes a dark pixel towards white and a bright one towards black, which looks about the same.
const LIGHTEN = 0.1;
const DARKEN = 0.4;
const MID_GREY = 0.18;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
}

// One triangle that covers the whole target.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let uv = vec2(f32(2u * (index & 1u)), f32(index & 2u));
    return Corner(vec4(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, 0.0, 1.0), uv);
}

@fragment
fn fragment(corner: Corner) -> @location(0) vec4<f32> {
    let stored = textureLoad(radiance, texel(corner.uv * display.span, textureDimensions(radiance)), 0);
    let overlay_size = textureDimensions(overlay);
    let lines = textureLoad(overlay, texel(corner.uv * vec2<f32>(overlay_size), overlay_size), 0).rg;

    var shown = BACKGROUND;
    if stored.a > 0.0 {
        shown = mix(BACKGROUND, toned(display.exposure * stored.rgb / stored.a), stored.a);
    }
    let is_dark = luminance(shown) < MID_GREY;
    shown = mix(shown, vec3(select(0.0, 1.0, is_dark)), select(DARKEN, LIGHTEN, is_dark) * lines.r);
    shown = mix(shown, display.outline, lines.g);
    return vec4(select(shown, encoded(shown), display.encode != 0u), 1.0);
}

// The texel at a place in texels, or the nearest that there is.
fn texel(place: vec2<f32>, size: vec2<u32>) -> vec2<u32> {
    return min(vec2<u32>(place), size - 1u);
}

fn toned(exposed: vec3<f32>) -> vec3<f32> {
    if display.tone == 1u {
        return filmic(exposed);
    }
    return saturate(exposed);
}

// Narkowicz's fit of the reference curve of the Academy Color Encoding System ("ACES filmic tone mapping curve", 2016).
// Beyond 100 it is flat, and its squares would leave the range of numbers.
fn filmic(exposed: vec3<f32>) -> vec3<f32> {
    let x = min(exposed, vec3(100.0));
    return saturate(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14));
}

// The transfer function of sRGB (IEC 61966-2-1).
fn encoded(linear: vec3<f32>) -> vec3<f32> {
    return select(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, linear <= vec3(0.0031308));
}
