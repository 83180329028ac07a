// Finds out which photon each pixel shows. A thread a photon does it, in place of two triangles: a million of these would
// take a software adapter seconds.

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<uniform> points: Points;
@group(0) @binding(2) var<storage, read> photons: array<Photon>;
// Of the surfaces.
@group(0) @binding(3) var depths: texture_depth_multisampled_2d;
// For each pixel 1 + the index of a photon, with SQUARE if its square covers the pixel and not its tick only; 0 for none.
// Whatever is nearer than its surface hides a photon, so those of one pixel lie on one surface: the largest may win.
@group(0) @binding(4) var<storage, read_write> shown: array<atomic<u32>>;

// Ticks have at most this many pixels.
const LONGEST_TICK = 256.0;

@compute @workgroup_size(256)
fn splat(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= points.count || id.x % points.stride != 0u {
        return;
    }
    let photon = photons[id.x];
    let at = position(photon);
    let clip = frame.clip_from_unit * vec4(at, 1.0);
    if clip.w < clip.z || !faces_eye(photon, at) {
        return;
    }
    square(clip, id.x);
    if points.tick > 0.0 {
        tick(clip, frame.clip_from_unit * vec4(at - points.tick * unpack4x8snorm(photon.direction).xyz, 1.0), id.x);
    }
}

fn square(clip: vec4<f32>, index: u32) {
    let width = i32(max(round(points.size), 1.0));
    let first = vec2<i32>(floor(pixel(clip) - 0.5 * f32(width) + 0.5));
    for (var y = 0; y < width; y++) {
        for (var x = 0; x < width; x++) {
            show(first + vec2(x, y), clip.z / clip.w, SQUARE | (index + 1u));
        }
    }
}

// A line one pixel wide.
fn tick(start: vec4<f32>, far_end: vec4<f32>, index: u32) {
    let end = before_eye(far_end, start);
    let first = pixel(start);
    let last = pixel(end);
    let way = abs(last - first);
    let steps = min(ceil(max(way.x, way.y)), LONGEST_TICK);
    for (var step = 1.0; step <= steps; step += 1.0) {
        let share = step / steps;
        // Depth is linear on the screen.
        show(vec2<i32>(floor(mix(first, last, share))), mix(start.z / start.w, end.z / end.w, share), index + 1u);
    }
}

fn show(place: vec2<i32>, depth: f32, value: u32) {
    let size = vec2<i32>(frame.size);
    if any(place < vec2(0)) || any(place >= size) {
        return;
    }
    if depth * (1.0 + LIFT) >= textureLoad(depths, place, 0) {
        atomicMax(&shown[place.y * size.x + place.x], value);
    }
}

// From the top left corner.
fn pixel(clip: vec4<f32>) -> vec2<f32> {
    return frame.size * (vec2(0.5, -0.5) * clip.xy / clip.w + 0.5);
}
