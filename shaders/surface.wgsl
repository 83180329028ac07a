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

struct Drawn {
    // Premultiplied with coverage.
    @location(0) radiance: vec4<f32>,
    // Coverage by outlines of elements and by the shooter's outline.
    @location(1) overlay: vec2<f32>,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let element = index / 4u;
    let corner = index % 4u;
    let position = triple(&positions, elements[element][corner]);
    let uv = vec2(f32(corner == 1u || corner == 2u), f32(corner >= 2u));
    return Corner(frame.clip_from_unit * vec4(position, 1.0), element, uv);
}

@fragment
fn fragment_constant(corner: Corner) -> Drawn {
    return drawn(corner, triple(&values, corner.element));
}

// Linear over a triangle, bilinear over a quad, so that no diagonal shows (Gouraud 1971).
@fragment
fn fragment_smooth(corner: Corner) -> Drawn {
    let corners = elements[corner.element];
    let at_0 = triple(&values, corners.x);
    let at_1 = triple(&values, corners.y);
    let at_2 = triple(&values, corners.z);
    // The pixel's centre may lie just outside of the element that covers some of its samples.
    var uv = saturate(corner.uv);
    if corners.w == NONE {
        uv.y = min(uv.y, uv.x);
        return drawn(corner, at_0 + uv.x * (at_1 - at_0) + uv.y * (at_2 - at_1));
    }
    let at_3 = triple(&values, corners.w);
    return drawn(corner, mix(mix(at_0, at_1, uv.x), mix(at_3, at_2, uv.x), uv.y));
}
