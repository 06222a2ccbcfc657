// KinoMotion (Keijiro Takahashi, 2016): half-motions packed into 10 bits, the longest of each tile and its neighbours,
// and a gather from the outside in that learns on its way how fast the background moves.

struct Parameters {
    samples: i32,
    radius_percent: f32,
    block_size: i32,
    storage: u32,
    far_plane: f32,
    jitter: u32,
    least_motion: f32,
    tiles: u32,
    window: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
@group(0) @binding(5) var motion: texture_2d<f32>;
@group(0) @binding(6) var motion_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(7) var block_max: texture_2d<f32>;
@group(0) @binding(8) var block_max_out: texture_storage_2d<rg32float, write>;
@group(0) @binding(9) var tile_max: texture_2d<f32>;
@group(0) @binding(10) var tile_max_out: texture_storage_2d<rg32float, write>;
@group(0) @binding(11) var neighbor_max: texture_2d<f32>;
@group(0) @binding(12) var neighbor_max_out: texture_storage_2d<rg32float, write>;
@group(0) @binding(13) var output: texture_storage_2d<rgba32float, write>;

const STORAGE_PACKED = 0u;
const JITTER_NOISE = 0u;
const JITTER_NONE = 2u;
const TILES_STRETCHED = 0u;
const WINDOW_FALLING = 0u;

const TAU = 6.2831853;
// A tile's own motion counts for this much more than its neighbours'.
const OWN_TILE = 1.01;
// A tap is wholly foreground where it is nearer than the pixel by one part in this many of the pixel's depth.
const FOREGROUND_SHARPNESS = 20.0;
// Weight of a tap at the pixel; a falling one loses 1 up to the end of the trail.
const WINDOW = 1.2;

// Longest half of a trail, in whole pixels.
fn radius() -> f32 {
    return max(1.0, floor(parameters.radius_percent * f32(frame.size.y) / 100.0));
}

// Blocks per side of a tile: as many as the radius fills, the last one in part.
fn blocks_per_tile() -> i32 {
    return (i32(radius()) + parameters.block_size - 1) / parameters.block_size;
}

fn tile_size() -> i32 {
    return blocks_per_tile() * parameters.block_size;
}

// How many squares of that side there are: whole ones alone where they are stretched, at least one.
fn count_of(side: i32) -> vec2<i32> {
    if parameters.tiles == TILES_STRETCHED {
        return max(frame.size / side, vec2<i32>(1));
    }
    return (frame.size + side - 1) / side;
}

fn tile_count() -> vec2<i32> {
    return count_of(tile_size());
}

fn block_count() -> vec2<i32> {
    return count_of(parameters.block_size);
}

// The texel of a finer grid that a tap beside the middle of a coarser grid's texel falls on.
fn finer(texel: vec2<i32>, coarse: vec2<i32>, fine: vec2<i32>, tap: vec2<f32>) -> vec2<i32> {
    let middle = (vec2<f32>(texel) + 0.5) / vec2<f32>(coarse) * vec2<f32>(fine);
    return clamp(vec2<i32>(floor(middle + tap)), vec2<i32>(0), fine - 1);
}

// From texels of twice that side, in pixels, to those of the side; blocks that are no larger stay as they are.
fn half_as_large(texel: vec2<i32>, place: vec2<i32>, side: i32) -> vec2<i32> {
    if side >= parameters.block_size {
        return texel;
    }
    return finer(texel, count_of(2 * side), count_of(side), vec2<f32>((place / side) % 2) - 0.5);
}

// The pixel that a block takes as one of its own, by column and row in the block.
fn pixel_of(block: vec2<i32>, place: vec2<i32>) -> vec2<i32> {
    let side = parameters.block_size;
    if parameters.tiles != TILES_STRETCHED {
        return block * side + place;
    }
    if countOneBits(side) != 1 {
        let tap = vec2<f32>(place) - 0.5 * f32(side - 1);
        return finer(block, block_count(), frame.size, tap);
    }
    // The original halves the picture until a texel is a block, and every time reads two texels by two. No loop: Mesa's
    // llvmpipe allows an invocation 65,535 iterations of all loops, and a block of 64x64 takes as many as that with one here.
    var texel = block;
    texel = half_as_large(texel, place, 32);
    texel = half_as_large(texel, place, 16);
    texel = half_as_large(texel, place, 8);
    texel = half_as_large(texel, place, 4);
    texel = half_as_large(texel, place, 2);
    return half_as_large(texel, place, 1);
}

// The block that a tile takes as one of its own, by column and row in the tile.
fn block_of(tile: vec2<i32>, place: vec2<i32>) -> vec2<i32> {
    if parameters.tiles != TILES_STRETCHED {
        return tile * blocks_per_tile() + place;
    }
    let tap = vec2<f32>(place) - 0.5 * f32(blocks_per_tile() - 1);
    return finer(tile, tile_count(), block_count(), tap);
}

// The longer of two vectors; the first of two equal ones.
fn longer(a: vec2<f32>, b: vec2<f32>) -> vec2<f32> {
    return select(a, b, dot(b, b) > dot(a, a));
}

// A number in [0, 1] after 10 bits.
fn ten_bits(value: vec3<f32>) -> vec3<f32> {
    return floor(saturate(value) * 1023.0 + 0.5) / 1023.0;
}

// Half the motion while the shutter is open, cut at the radius, and depth; as they come out of 10 bits per channel.
@compute @workgroup_size(8, 8)
fn pack(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let whole = 0.5 * frame.exposure * textureLoad(velocity, pixel, 0).xy;
    let half_motion = whole * min(length(whole), radius()) / max(length(whole), 1e-6);
    let metres = textureLoad(depth, pixel, 0).x;
    var stored = vec3<f32>(half_motion, metres);
    if parameters.storage == STORAGE_PACKED {
        let bits = ten_bits(vec3<f32>(0.5 * half_motion / radius() + 0.5, metres / parameters.far_plane));
        stored = vec3<f32>((2.0 * bits.xy - 1.0) * radius(), bits.z);
    }
    textureStore(motion_out, pixel, vec4<f32>(stored, 0.0));
}

@compute @workgroup_size(8, 8)
fn reduce_to_blocks(@builtin(global_invocation_id) id: vec3<u32>) {
    let block = vec2<i32>(id.xy);
    if any(block >= block_count()) {
        return;
    }
    var longest = vec2<f32>(0.0);
    for (var y = 0; y < parameters.block_size; y++) {
        for (var x = 0; x < parameters.block_size; x++) {
            let pixel = pixel_of(block, vec2<i32>(x, y));
            if inside(pixel) {
                longest = longer(longest, textureLoad(motion, pixel, 0).xy);
            }
        }
    }
    textureStore(block_max_out, block, vec4<f32>(longest, 0.0, 0.0));
}

@compute @workgroup_size(8, 8)
fn reduce_to_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    if any(tile >= tile_count()) {
        return;
    }
    var longest = vec2<f32>(0.0);
    for (var y = 0; y < blocks_per_tile(); y++) {
        for (var x = 0; x < blocks_per_tile(); x++) {
            let block = block_of(tile, vec2<i32>(x, y));
            if all(block < block_count()) {
                longest = longer(longest, textureLoad(block_max, block, 0).xy);
            }
        }
    }
    textureStore(tile_max_out, tile, vec4<f32>(longest, 0.0, 0.0));
}

@compute @workgroup_size(8, 8)
fn spread_to_neighbors(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    if any(tile >= tile_count()) {
        return;
    }
    var longest = OWN_TILE * textureLoad(tile_max, tile, 0).xy;
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let neighbor = tile + vec2<i32>(x, y);
            if all(neighbor >= vec2<i32>(0)) && all(neighbor < tile_count()) {
                longest = longer(longest, textureLoad(tile_max, neighbor, 0).xy);
            }
        }
    }
    // Whichever wins is divided again, so a neighbour's motion arrives one per cent short.
    textureStore(neighbor_max_out, tile, vec4<f32>(longest / OWN_TILE, 0.0, 0.0));
}

// Pixels of the picture that a tile stands for.
fn tile_extent() -> vec2<f32> {
    if parameters.tiles == TILES_STRETCHED {
        return vec2<f32>(frame.size) / vec2<f32>(tile_count());
    }
    return vec2<f32>(f32(tile_size()));
}

// In [0, 1). The original drives its noise by the clock; here it walks a cycle of 64 frames, or stands still.
fn noise(position: vec2<f32>) -> f32 {
    let walked = select(0u, frame.frame_index % 64u, parameters.jitter == JITTER_NOISE);
    return interleaved_gradient_noise(position + 5.588238 * f32(walked));
}

// The longest motion near a pixel; noise blurs where one tile ends and the next begins.
fn longest_near(pixel: vec2<i32>) -> vec2<f32> {
    var position = centre(pixel);
    if parameters.jitter != JITTER_NONE {
        let angle = TAU * noise(vec2<f32>(pixel) + vec2<f32>(2.0 * f32(frame.size.x), 0.0));
        position += 0.25 * tile_extent() * vec2<f32>(cos(angle), sin(angle));
    }
    let tile = vec2<i32>(floor(position / tile_extent()));
    return textureLoad(neighbor_max, clamp(tile, vec2<i32>(0), tile_count() - 1), 0).xy;
}

// Weight of a tap by its place, from 0 at the pixel to 1 at the end of the trail.
fn window(along: f32) -> f32 {
    return select(1.0, WINDOW - along, parameters.window == WINDOW_FALLING);
}

// How much a tap counts as foreground: 1 where it is nearer by a twentieth of the pixel's depth or more.
fn foreground(own_depth: f32, tap_depth: f32) -> f32 {
    // Packed depth may be 0, which nothing is in front of.
    if own_depth <= 0.0 {
        return 0.0;
    }
    return saturate(FOREGROUND_SHARPNESS * (own_depth - tap_depth) / own_depth);
}

@compute @workgroup_size(8, 8)
fn reconstruct(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let here = textureLoad(color, pixel, 0);
    let longest = longest_near(pixel);
    let reach = length(longest);
    if reach < parameters.least_motion {
        textureStore(output, pixel, here);
        return;
    }
    let own = textureLoad(motion, pixel, 0).xyz;
    let own_length = max(length(own.xy), 0.5);
    // The pixel's own direction, where it moves at least half as far as the fastest.
    let other = select(longest, own.xy * (reach / own_length), 2.0 * own_length > reach);

    let pairs = i32(min(f32(parameters.samples / 2), reach / parameters.least_motion));
    let step = 1.0 / f32(pairs);
    let shift = select(0.0, (noise(vec2<f32>(pixel)) - 0.5) * step, parameters.jitter != JITTER_NONE);
    // How far the background moves, as far as the taps so far know.
    var background_length = max(own_length, 1.0);
    var mean = vec4<f32>(0.0);
    var total = 0.0;
    for (var i = 0; i < 2 * pairs; i++) {
        // From the outside in; sides take turns, and directions after every two taps.
        let pair = i / 2;
        let along = 1.0 - (f32(pair) + 0.5) * step;
        let signed_along = select(along, -along, i % 2 == 1) + shift;
        let direction = select(longest, other, pair % 2 == 1);
        let position = centre(pixel) + direction * signed_along;
        let tap = textureLoad(motion, pixel_at(position), 0).xyz;

        // Foreground taps spread as far as they move themselves, background taps as far as the fastest one so far.
        let tap_length = mix(background_length, length(tap.xy), foreground(own.z, tap.z));
        let distance = reach * abs(signed_along);
        let arrives = saturate(tap_length - distance);
        // A tap of no length reaches nothing.
        let weight = arrives / max(tap_length, 1e-6) * window(along);
        background_length = max(background_length, tap_length);
        if weight > 0.0 {
            total += weight;
            mean += (bilinear(color, position) - mean) * (weight / total);
        }
    }
    let own_weight = window(0.0) * step / (2.0 * background_length);
    mean += (here - mean) * (own_weight / (total + own_weight));
    textureStore(output, pixel, mean);
}
