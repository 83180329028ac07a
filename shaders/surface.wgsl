// Draws every element on the side where it shines. Vertices are pulled: number 4 e + k is corner k of element e.

@group(0) @binding(0) var<uniform> frame: Frame;
// x y z of each vertex of the mesh, unit coordinates.
@group(0) @binding(1) var<storage, read> positions: array<f32>;
// Corners of each element, counter-clockwise; the last is NONE for a triangle.
@group(0) @binding(2) var<storage, read> elements: array<vec4<u32>>;
// r g b of each element, or of each vertex for `fragment_smooth`.
@group(0) @binding(3) var<storage, read> values: array<f32>;

const NONE = 0xffffffffu;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat, either) element: u32,
    // Corners are at (0, 0), (1, 0), (1, 1) and (0, 1).
    @location(1) uv: vec2<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let element = index / 4u;
    let corner = index % 4u;
    let at = position(elements[element][corner]);
    let uv = vec2(f32(corner == 1u || corner == 2u), f32(corner >= 2u));
    return Corner(frame.clip_from_unit * vec4(at, 1.0), element, uv);
}

@fragment
fn fragment_constant(corner: Corner) -> Drawn {
    return drawn(corner, value(corner.element));
}

// Linear over a triangle, bilinear over a quad, so that no diagonal shows (Gouraud 1971).
@fragment
fn fragment_smooth(corner: Corner) -> Drawn {
    let corners = elements[corner.element];
    let at_0 = value(corners.x);
    let at_1 = value(corners.y);
    let at_2 = value(corners.z);
    // The pixel's centre may lie just outside of the element that covers some of its samples.
    var uv = saturate(corner.uv);
    if corners.w == NONE {
        uv.y = min(uv.y, uv.x);
        return drawn(corner, at_0 + uv.x * (at_1 - at_0) + uv.y * (at_2 - at_1));
    }
    let at_3 = value(corners.w);
    return drawn(corner, mix(mix(at_0, at_1, uv.x), mix(at_3, at_2, uv.x), uv.y));
}

fn position(vertex: u32) -> vec3<f32> {
    return vec3(positions[3u * vertex], positions[3u * vertex + 1u], positions[3u * vertex + 2u]);
}

fn value(index: u32) -> vec3<f32> {
    return vec3(values[3u * index], values[3u * index + 1u], values[3u * index + 2u]);
}

fn drawn(corner: Corner, value: vec3<f32>) -> Drawn {
    var line = 0.0;
    if frame.line_width > 0.0 {
        line = outline_coverage(corner.uv, elements[corner.element].w == NONE);
    }
    return Drawn(vec4(nearest_half(frame.scale * value), 1.0), vec2(line, 0.0));
}

// Rounded to the 11 bits of a half float. Adapters may cut the others off when they store it, which would darken pictures.
fn nearest_half(value: vec3<f32>) -> vec3<f32> {
    return bitcast<vec3<f32>>((bitcast<vec3<u32>>(value) + 0x1000u) & vec3(0xffffe000u));
}

// How much of the pixel the outline of its element covers, from the distance to each edge (Baerentzen, Nielsen, Gjoel,
// Larsen, Christensen 2006). What hides a surface hides its outline, so no depth has to be biased.
fn outline_coverage(uv: vec2<f32>, is_triangle: bool) -> f32 {
    let across = line_coverage(uv.x, true, !is_triangle);
    let along = line_coverage(uv.y, !is_triangle, true);
    let diagonal = line_coverage(uv.x - uv.y, false, is_triangle);
    return max(max(across, along), diagonal);
}

// Coverage by the lines on which `x`, which changes evenly over the picture, is 0 and 1, where they are wanted.
fn line_coverage(x: f32, at_one: bool, at_zero: bool) -> f32 {
    let step = length(vec2(dpdx(x), dpdy(x)));
    let to_one = select(1e9, (1.0 - x) / step, at_one);
    let to_zero = select(1e9, x / step, at_zero);
    // Lines that are only a few pixels apart fade before they would fill the picture.
    let fade = saturate(0.25 / step - 0.5);
    // Each of two neighbours draws its half.
    return fade * saturate(0.5 * frame.line_width + 0.5 - min(to_one, to_zero));
}
