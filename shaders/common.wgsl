// What several filters share; appended after every filter's kernels. Conventions: positions are in pixels, +x right,
// +y down, and the centre of pixel (i, j) lies at (i + 0.5, j + 0.5).

struct Frame {
    // Pixels per row, rows.
    size: vec2<i32>,
    // How long the shutter is open, in frames.
    exposure: f32,
    // Changes the noise, and nothing else.
    frame_index: u32,
    // Of the pass that runs: 0 to iterations - 1.
    iteration: u32,
    iterations: u32,
    // As far as the frame or the filter's convention says it; else 60.
    frames_per_second: f32,
    // The camera's motion: see before_camera.
    reprojection: mat4x3<f32>,
}

@group(0) @binding(0) var<uniform> frame: Frame;

fn inside(pixel: vec2<i32>) -> bool {
    return all(pixel >= vec2<i32>(0)) && all(pixel < frame.size);
}

fn centre(pixel: vec2<i32>) -> vec2<f32> {
    return vec2<f32>(pixel) + 0.5;
}

// Where the frame before showed a position at a depth, if it stands still in the world and only the camera moved; the
// position itself where that was behind the camera. A filter that calls this needs a frame that says how the camera moved.
fn before_camera(position: vec2<f32>, depth: f32) -> vec2<f32> {
    let place = frame.reprojection * vec4<f32>(position, 1.0, 1.0 / depth);
    return select(position, place.xy / place.z, place.z > 0.0);
}

// Whether a position lies on the image, its border included.
fn on_screen(position: vec2<f32>) -> bool {
    return all(position >= vec2<f32>(0.0)) && all(position <= vec2<f32>(frame.size));
}

// The pixel that holds a position; the nearest one at the border.
fn pixel_at(position: vec2<f32>) -> vec2<i32> {
    return clamp(vec2<i32>(floor(position)), vec2<i32>(0), frame.size - 1);
}

// The four texels around a position, clamped to the image, and how far it lies from `low` towards `high`.
struct Corners {
    low: vec2<i32>,
    high: vec2<i32>,
    fraction: vec2<f32>,
}

fn corners(position: vec2<f32>) -> Corners {
    let from_centre = position - 0.5;
    let base = floor(from_centre);
    let texel = vec2<i32>(base);
    let low = clamp(texel, vec2<i32>(0), frame.size - 1);
    let high = clamp(texel + 1, vec2<i32>(0), frame.size - 1);
    return Corners(low, high, from_centre - base);
}

// Written as a + f (b - a), so that equal values stay exactly what they are.
fn blend(a: vec4<f32>, b: vec4<f32>, fraction: f32) -> vec4<f32> {
    return a + fraction * (b - a);
}

// Bilinear, clamped to the edge. By hand, because filtering 32-bit floats is an optional feature of GPUs.
fn bilinear(image: texture_2d<f32>, position: vec2<f32>) -> vec4<f32> {
    let at = corners(position);
    let top = blend(
        textureLoad(image, at.low, 0),
        textureLoad(image, vec2<i32>(at.high.x, at.low.y), 0),
        at.fraction.x,
    );
    let bottom = blend(
        textureLoad(image, vec2<i32>(at.low.x, at.high.y), 0),
        textureLoad(image, at.high, 0),
        at.fraction.x,
    );
    return blend(top, bottom, at.fraction.y);
}

// Interleaved gradient noise in [0, 1) (Jimenez 2014, Next Generation Post Processing in Call of Duty).
fn interleaved_gradient_noise(position: vec2<f32>) -> f32 {
    return fract(52.9829189 * fract(dot(position, vec2<f32>(0.06711056, 0.00583715))));
}

// What tile filters know of the motion in a region: its longest vector, in pixels, and its shortest length.
const NO_MOTION = vec3<f32>(0.0, 0.0, 1e9);

fn merged(a: vec3<f32>, b: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(select(a.xy, b.xy, dot(b.xy, b.xy) > dot(a.xy, a.xy)), min(a.z, b.z));
}

// Memory of a workgroup of 8 x 8 invocations; only kernels that call what follows have it.
var<workgroup> group_regions: array<vec3<f32>, 64>;
var<workgroup> group_tiles: array<vec3<f32>, 100>;

// The regions of all invocations of a workgroup of 8 x 8 as one. Every invocation has to call it, each with its
// @builtin(local_invocation_index).
fn merged_over_group(index: u32, region: vec3<f32>) -> vec3<f32> {
    group_regions[index] = region;
    workgroupBarrier();
    for (var half = 32u; half > 0u; half /= 2u) {
        if index < half {
            group_regions[index] = merged(group_regions[index], group_regions[index + half]);
        }
        workgroupBarrier();
    }
    return group_regions[0];
}

// Reads the tiles of a workgroup of 8 x 8 and the ring around them once, for `tile_beside`. Tiles from `count` on do
// not exist. Every invocation has to call it.
fn share_tiles(tiles: texture_2d<f32>, count: vec2<i32>, group: vec2<u32>, index: u32) {
    for (var i = i32(index); i < 100; i += 64) {
        let tile = 8 * vec2<i32>(group) + vec2<i32>(i % 10, i / 10) - 1;
        var region = NO_MOTION;
        if all(tile >= vec2<i32>(0)) && all(tile < count) {
            region = textureLoad(tiles, tile, 0).xyz;
        }
        group_tiles[i] = region;
    }
    workgroupBarrier();
}

// The region of the tile at an offset of -1 to 1 from that of an invocation, by its @builtin(local_invocation_id).
fn tile_beside(local: vec2<u32>, offset: vec2<i32>) -> vec3<f32> {
    let at = vec2<i32>(local) + offset + 1;
    return group_tiles[10 * at.y + at.x];
}
