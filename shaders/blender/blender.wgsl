// Blender's blur, of EEVEE and of the compositor's Vector Blur: on both sides of the frame's instant, taps along the longest motion
// near a pixel and along its own, weighed by depth, reach and direction. Rows count from below, as in Blender.

struct Parameters {
    samples: i32,
    depth_scale: f32,
    tile_size: i32,
    tile_rule: u32,
    tile_shift: u32,
    noise: u32,
    sampling: u32,
    draws: i32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var velocity_next: texture_2d<f32>;
@group(0) @binding(5) var depth: texture_2d<f32>;
@group(0) @binding(6) var tile_motion: texture_2d<f32>;
@group(0) @binding(7) var tile_motion_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(8) var near_motion: texture_2d<f32>;
@group(0) @binding(9) var near_motion_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(10) var output: texture_storage_2d<rgba32float, write>;

const TILES_CLIPPED = 0u;
const SHIFT_UNCLAMPED = 1u;
const SHIFT_DOWN = 2u;
const NOISE_PAIR = 0u;
const SAMPLING_NEAREST = 0u;

// Motion of half an exposure below this many pixels counts as none.
const LEAST_MOTION = 0.5;
// A tile counts for those whose middle lies nearer to the line of its motion, in tiles.
const TILE_DIAGONAL = 1.41421356;

// Reads an image at a position, +y up.
fn read(image: texture_2d<f32>, position: vec2<f32>) -> vec4<f32> {
    if parameters.sampling == SAMPLING_NEAREST {
        let pixel = pixel_at(position);
        return textureLoad(image, vec2<i32>(pixel.x, frame.size.y - 1 - pixel.y), 0);
    }
    return bilinear(image, vec2<f32>(position.x, f32(frame.size.y) - position.y));
}

// From a position to where its surface is when the shutter opens, and to where it is when the shutter closes. In pixels, +y up.
fn displacements(position: vec2<f32>) -> vec4<f32> {
    let last = read(velocity, position).xy;
    let next = read(velocity_next, position).xy;
    return 0.5 * frame.exposure * vec4<f32>(-last.x, last.y, next.x, -next.y);
}

fn tile_count() -> vec2<i32> {
    return (frame.size + parameters.tile_size - 1) / parameters.tile_size;
}

// The part of a displacement from a position that lies on the picture.
fn clipped(position: vec2<f32>, displacement: vec2<f32>) -> vec2<f32> {
    if parameters.tile_rule != TILES_CLIPPED {
        return displacement;
    }
    let backwards = displacement < vec2<f32>(0.0);
    let signed_length = max(abs(displacement), vec2<f32>(1e-6)) * select(vec2<f32>(1.0), vec2<f32>(-1.0), backwards);
    let to_border = max((vec2<f32>(frame.size) - position) / signed_length, -position / signed_length);
    return displacement * min(1.0, min(to_border.x, to_border.y));
}

// The longer of two vectors, in whole pixels or exactly; the second of two equal ones.
fn longer(a: vec2<f32>, b: vec2<f32>, whole_pixels: bool) -> vec2<f32> {
    if whole_pixels {
        return select(a, b, ceil(length(b)) >= ceil(length(a)));
    }
    return select(a, b, dot(b, b) >= dot(a, a));
}

@compute @workgroup_size(8, 8)
fn reduce(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    if any(tile >= tile_count()) {
        return;
    }
    let whole_pixels = parameters.tile_rule == TILES_CLIPPED;
    var longest = vec4<f32>(0.0);
    for (var y = 0; y < parameters.tile_size; y++) {
        for (var x = 0; x < parameters.tile_size; x++) {
            let position = centre(min(tile * parameters.tile_size + vec2<i32>(x, y), frame.size - 1));
            let both = displacements(position);
            longest = vec4<f32>(
                longer(longest.xy, clipped(position, both.xy), whole_pixels),
                longer(longest.zw, clipped(position, both.zw), whole_pixels),
            );
        }
    }
    textureStore(tile_motion_out, tile, longest);
}

// Whether the line of a tile's motion passes another tile.
fn passes(start: vec2<i32>, motion: vec2<f32>, tile: vec2<i32>) -> bool {
    let end = start + vec2<i32>(sign(motion) * ceil(abs(motion) / f32(parameters.tile_size)));
    if any(tile < min(start, end)) || any(tile > max(start, end)) {
        return false;
    }
    let direction = motion / max(length(motion), 1e-6);
    return abs(dot(vec2<f32>(-direction.y, direction.x), vec2<f32>(start - tile))) < TILE_DIAGONAL;
}

@compute @workgroup_size(8, 8)
fn dilate(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    let count = tile_count();
    if any(tile >= count) {
        return;
    }
    var longest = vec4<f32>(0.0);
    for (var i = 0; i < count.x * count.y; i++) {
        // Column by column: the last of equal ones counts.
        let start = vec2<i32>(i / count.y, i % count.y);
        let both = textureLoad(tile_motion, start, 0);
        // Either line carries both motions.
        if passes(start, both.xy, tile) || passes(start, both.zw, tile) {
            longest = vec4<f32>(longer(longest.xy, both.xy, true), longer(longest.zw, both.zw, true));
        }
    }
    textureStore(near_motion_out, tile, longest);
}

// In [0, 1). EEVEE moves it with every sample of a picture, here with the frame and the draw; the compositor's stands still.
fn random(pixel: vec2<i32>, seed: f32, draw: i32) -> f32 {
    if parameters.noise != NOISE_PAIR {
        return interleaved_gradient_noise(vec2<f32>(pixel));
    }
    let walk = 0.618034 * f32((frame.frame_index * u32(parameters.draws) + u32(draw)) % 64u);
    return fract(walk + interleaved_gradient_noise(vec2<f32>(pixel) + seed * 0.695 * vec2<f32>(47.0, 17.0)));
}

// The longest motion near a pixel; noise blurs where one tile ends and the next begins.
fn longest_near(pixel: vec2<i32>, draw: i32) -> vec4<f32> {
    let quarter = 0.25 * f32(parameters.tile_size);
    let twice = 2.0 * random(pixel, 0.0, draw);
    // The compositor lacks the brackets around `twice - 1`.
    let shift = i32(select((twice - 1.0) * quarter, twice - quarter, parameters.tile_shift == SHIFT_DOWN));
    let tile = (pixel + shift) / parameters.tile_size;
    if parameters.tile_shift == SHIFT_UNCLAMPED && any(tile >= tile_count()) {
        // The compositor's table is 0 there, which names the first tile.
        return textureLoad(tile_motion, vec2<i32>(0), 0);
    }
    return textureLoad(near_motion, clamp(tile, vec2<i32>(0), tile_count() - 1), 0);
}

// A pixel and what it gathers.
struct Sums {
    position: vec2<f32>,
    depth: f32,
    // Mean colour of taps behind the pixel, and of those in front.
    back: vec4<f32>,
    front: vec4<f32>,
    back_weight: f32,
    front_weight: f32,
    // Taps that count, and one more.
    count: f32,
}

fn add_tap(sums: ptr<function, Sums>, offset: vec2<f32>, speed: f32, closing: bool) {
    let position = (*sums).position - offset;
    let both = displacements(position);
    let motion = select(both.xy, both.zw, closing);
    let tap_speed = length(motion);
    // What moves the other way does not come here.
    if tap_speed >= LEAST_MOTION && dot(offset, motion) <= 0.0 {
        return;
    }
    let nearer = parameters.depth_scale * ((*sums).depth - read(depth, position).x);
    // What is behind shows as far as the pixel moves, what is in front as far as it moves itself.
    let arrives = saturate(vec2<f32>(speed, tap_speed) - length(offset) + 1.0);
    let weights = arrives * saturate(vec2<f32>(0.5 - nearer, 0.5 + nearer));
    let tap = read(color, position);
    (*sums).count += 1.0;
    (*sums).back_weight += weights.x;
    (*sums).back += (tap - (*sums).back) * (weights.x / (*sums).back_weight);
    if weights.y > 0.0 {
        (*sums).front_weight += weights.y;
        (*sums).front += (tap - (*sums).front) * (weights.y / (*sums).front_weight);
    }
}

// Adds the taps of one side of the instant: along the longest motion near the pixel, and along its own.
fn add_side(sums: ptr<function, Sums>, own: vec2<f32>, near: vec2<f32>, noise: f32, closing: bool) {
    let speed = length(own);
    // The look aside may find a slower tile.
    let longest = select(near, own, length(near) < speed);
    if length(longest) < LEAST_MOTION {
        return;
    }
    let lines = select(1, 2, speed >= LEAST_MOTION);
    for (var i = 0; i < lines * parameters.samples; i++) {
        let line = select(longest, own, i >= parameters.samples);
        let along = (f32(i % parameters.samples) + noise) / f32(parameters.samples);
        add_tap(sums, line * along, speed, closing);
    }
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let texel = vec2<i32>(pixel.x, frame.size.y - 1 - pixel.y);
    // A running mean keeps a single draw exactly as it is.
    var mean = vec4<f32>(0.0);
    for (var draw = 0; draw < parameters.draws; draw++) {
        mean += (gathered(pixel, texel, draw) - mean) / f32(draw + 1);
    }
    textureStore(output, texel, mean);
}

// What a pixel gathers with one draw of noise.
fn gathered(pixel: vec2<i32>, texel: vec2<i32>, draw: i32) -> vec4<f32> {
    let here = textureLoad(color, texel, 0);
    var sums = Sums(centre(pixel), textureLoad(depth, texel, 0).x, here, here, 0.0, 0.0, 1.0);
    // Too little to be seen, unless no tap lies behind.
    sums.back_weight = 1.0 / (200.0 * f32(parameters.samples));
    let own = displacements(sums.position);
    let near = longest_near(pixel, draw);
    let noise = random(pixel, 1.0, draw);
    add_side(&sums, own.xy, near.xy, noise, false);
    add_side(&sums, own.zw, near.zw, noise, true);
    // What is behind fills the rest.
    let share = sums.front_weight / sums.count;
    return sums.back + share * (sums.front - sums.back);
}
