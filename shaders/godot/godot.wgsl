// Motion blur of Godot's add-on by sphynx-owner, and of the engine's proposal that came from it: taps along a pixel's own motion show
// what is behind it, and taps along the longest motion near it lay movers over that. Written anew from code under the MIT licence,
// Copyright (c) 2025 sphynx-owner.

struct Parameters {
    samples: i32,
    tile_size: i32,
    trail_tiles: i32,
    tile_motion: u32,
    tile_lookup: u32,
    diagonals: u32,
    arrival: u32,
    slow_taps: u32,
    noise: u32,
    storage: u32,
    depth_motion: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
// Motion while the shutter is open, towards the place before, in pixels; how much deeper the surface was; its depth. In metres.
@group(0) @binding(5) var surfaces: texture_2d<f32>;
@group(0) @binding(6) var surfaces_out: texture_storage_2d<rgba32float, write>;
// The longest motion of a tile's part of a row of pixels.
@group(0) @binding(7) var row_max: texture_2d<f32>;
@group(0) @binding(8) var row_max_out: texture_storage_2d<rg32float, write>;
@group(0) @binding(9) var tile_max: texture_2d<f32>;
@group(0) @binding(10) var tile_max_out: texture_storage_2d<rg32float, write>;
// The longest motion of a tile and those around it.
@group(0) @binding(11) var neighbor_max: texture_2d<f32>;
@group(0) @binding(12) var neighbor_max_out: texture_storage_2d<rg32float, write>;
@group(0) @binding(13) var output: texture_storage_2d<rgba32float, write>;

const TILES_WHOLE = 0u;
const LOOKUP_KEPT = 1u;
const LOOKUP_STRETCHED = 2u;
const DIAGONALS_EITHER_WAY = 0u;
const ARRIVAL_HALF = 0u;
const SLOW_TAPS_RAISED = 0u;
const NOISE_CROSSED = 0u;
const STORAGE_HALVES = 0u;
const DEPTH_MOTION_SHUTTER = 0u;

const TAU = 6.2831853;
// Far plane of Godot's camera, in metres: the sky is there.
const FAR = 4000.0;
// Motion below this many pixels counts as none.
const LEAST = 0.5;
// A surface is wholly behind another that is nearer by one metre over this.
const DEPTH_SHARPNESS = 10.0;
// Squared motion of an object in parts of the picture, from which on its change of depth is unknown.
const OBJECT_MOVES = 1e-6;

// Numbers as 16-bit floats hold them: rounded to the nearest, of two equally near ones to the even.
fn stored(numbers: vec4<f32>) -> vec4<f32> {
    if parameters.storage != STORAGE_HALVES {
        return numbers;
    }
    let bits = bitcast<vec4<u32>>(numbers);
    let rounded = bits + 0xfffu + ((bits >> vec4<u32>(13u)) & vec4<u32>(1u));
    return bitcast<vec4<f32>>(rounded & vec4<u32>(0xffffe000u));
}

// A motion, cut at the longest trail.
fn cut(motion: vec2<f32>) -> vec2<f32> {
    let longest = f32(parameters.trail_tiles * parameters.tile_size);
    return motion * (longest / max(longest, length(motion)));
}

// How much deeper a still surface was one frame before, in metres. Godot knows the camera's motion alone: 0 for movers, and for the sky.
fn depth_change(pixel: vec2<i32>, back: vec2<f32>, metres: f32) -> f32 {
    let by_camera = before_camera(centre(pixel), metres) - centre(pixel);
    let by_object = (back - by_camera) / vec2<f32>(frame.size);
    if metres >= FAR || dot(by_object, by_object) > OBJECT_MOVES {
        return 0.0;
    }
    // The third row gives the depth before as a part of the depth now.
    let place = frame.reprojection * vec4<f32>(centre(pixel), 1.0, 1.0 / metres);
    return metres * (place.z - 1.0);
}

@compute @workgroup_size(8, 8)
fn store_surfaces(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let size = vec2<f32>(frame.size);
    // Godot holds it in parts of the picture.
    let back = size * stored(vec4<f32>(-textureLoad(velocity, pixel, 0).xy / size, 0.0, 0.0)).xy;
    let metres = textureLoad(depth, pixel, 0).x;
    let deeper = depth_change(pixel, back, metres);
    let whole_frame = parameters.depth_motion != DEPTH_MOTION_SHUTTER;
    var motion = vec3<f32>(frame.exposure * back, deeper * select(frame.exposure, 1.0, whole_frame));
    if parameters.tile_motion == TILES_WHOLE {
        let longest = f32(parameters.trail_tiles * parameters.tile_size);
        motion *= longest / max(longest, length(motion.xy));
    }
    textureStore(surfaces_out, pixel, stored(vec4<f32>(motion, min(metres, FAR))));
}

fn tile_count() -> vec2<i32> {
    return (frame.size + parameters.tile_size - 1) / parameters.tile_size;
}

// The longer of two motions; the first of two equal ones.
fn longer(a: vec2<f32>, b: vec2<f32>) -> vec2<f32> {
    return select(a, b, dot(b, b) > dot(a, a));
}

// A motion as the textures of tiles hold it.
fn as_tile(motion: vec2<f32>) -> vec4<f32> {
    return vec4<f32>(select(motion, trunc(motion), parameters.tile_motion == TILES_WHOLE), 0.0, 0.0);
}

@compute @workgroup_size(8, 8)
fn reduce_rows(@builtin(global_invocation_id) id: vec3<u32>) {
    let texel = vec2<i32>(id.xy);
    if texel.x >= tile_count().x || texel.y >= frame.size.y {
        return;
    }
    var longest = vec2<f32>(0.0);
    for (var i = 0; i < parameters.tile_size; i++) {
        let pixel = vec2<i32>(texel.x * parameters.tile_size + i, texel.y);
        if inside(pixel) {
            longest = longer(longest, textureLoad(surfaces, pixel, 0).xy);
        }
    }
    textureStore(row_max_out, texel, as_tile(longest));
}

@compute @workgroup_size(8, 8)
fn reduce_columns(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    if any(tile >= tile_count()) {
        return;
    }
    var longest = vec2<f32>(0.0);
    for (var i = 0; i < parameters.tile_size; i++) {
        let row = tile.y * parameters.tile_size + i;
        if row < frame.size.y {
            longest = longer(longest, textureLoad(row_max, vec2<i32>(tile.x, row), 0).xy);
        }
    }
    textureStore(tile_max_out, tile, vec4<f32>(longest, 0.0, 0.0));
}

// Whether the motion of a tile may reach the one that sees it at an offset. Only diagonal ones are asked.
fn reaches(motion: vec2<f32>, offset: vec2<i32>) -> bool {
    if offset.x == 0 || offset.y == 0 {
        return true;
    }
    if parameters.diagonals == DIAGONALS_EITHER_WAY {
        // Within a quadrant about the diagonal, for a smear that goes both ways.
        return motion.x * motion.y * f32(offset.x * offset.y) > 0.0;
    }
    // Motion towards the place before, away from the tile that asks.
    return dot(motion, vec2<f32>(offset) / vec2<f32>(tile_count())) > 0.0;
}

@compute @workgroup_size(8, 8)
fn spread_to_neighbors(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    let count = tile_count();
    if any(tile >= count) {
        return;
    }
    var longest = vec2<f32>(0.0);
    for (var i = 0; i < 9; i++) {
        let offset = vec2<i32>(i / 3, i % 3) - 1;
        let neighbor = tile + offset;
        if all(neighbor >= vec2<i32>(0)) && all(neighbor < count) {
            let motion = textureLoad(tile_max, neighbor, 0).xy;
            longest = select(longest, longer(longest, motion), reaches(motion, offset));
        }
    }
    textureStore(neighbor_max_out, tile, vec4<f32>(longest, 0.0, 0.0));
}

// In [0, 1); walks a cycle of 64 frames, or of 8.
fn noise(place: vec2<i32>) -> f32 {
    var walk = vec2<f32>(5.588238) * f32(frame.frame_index % 64u);
    if parameters.noise != NOISE_CROSSED {
        walk = vec2<f32>(47.0, 17.0) * 0.695 * f32(frame.frame_index % 8u);
    }
    return interleaved_gradient_noise(vec2<f32>(place) + walk);
}

// The longest motion near a pixel; noise moves the borders of tiles by up to a quarter of a tile.
fn longest_near(pixel: vec2<i32>) -> vec2<f32> {
    let count = tile_count();
    let place = select(pixel + vec2<i32>(2, 0), 4 * pixel, parameters.noise == NOISE_CROSSED);
    let angle = TAU * noise(place);
    let around = vec2<f32>(cos(angle), sin(angle));
    if parameters.tile_lookup == LOOKUP_STRETCHED {
        // The tiles over the whole picture, also where they go on beyond its border.
        let position = centre(pixel) / vec2<f32>(frame.size) * vec2<f32>(count) + 0.25 * around;
        let tile = clamp(vec2<i32>(floor(position)), vec2<i32>(0), count - 1);
        return textureLoad(neighbor_max, tile, 0).xy;
    }
    let tile = (pixel + vec2<i32>(around * f32(parameters.tile_size) / 4.0)) / parameters.tile_size;
    if parameters.tile_lookup == LOOKUP_KEPT {
        return textureLoad(neighbor_max, min(tile, count - 1), 0).xy;
    }
    // One texture holds rows, and then tiles in its first rows: below the last tile is a row of pixels near the picture's top.
    if tile.y >= count.y && tile.x < count.x {
        return textureLoad(row_max, min(tile, frame.size - 1), 0).xy;
    }
    return select(vec2<f32>(0.0), textureLoad(neighbor_max, min(tile, count - 1), 0).xy, tile.x < count.x);
}

// A colour, and how much of it covers what is below.
struct Tap {
    color: vec4<f32>,
    weight: f32,
}

// Along a pixel's own motion: what is not in front of where its surface is at that time, in parts of the motion.
fn own_tap(pixel: vec2<i32>, own: vec4<f32>, time: f32) -> Tap {
    let place = pixel_at(centre(pixel) + time * cut(own.xy));
    let nearer = own.w + time * own.z - textureLoad(surfaces, place, 0).w;
    return Tap(textureLoad(color, place, 0), 1.0 - saturate(DEPTH_SHARPNESS * nearer));
}

// Along the longest motion near a pixel: what moves far enough to come here, and is not behind the pixel.
fn near_tap(pixel: vec2<i32>, own_depth: f32, longest: vec2<f32>, time: f32) -> Tap {
    let place = pixel_at(centre(pixel) + time * longest);
    let tap = textureLoad(surfaces, place, 0);
    let motion = cut(tap.xy);
    let speed = length(motion);
    let reach = length(longest);
    let along = abs(dot(motion, longest)) / max(reach, 1e-6);
    let arrives = abs(time) * reach <= along * select(1.0, 0.5, parameters.arrival == ARRIVAL_HALF);
    let overlap = 1.0 - saturate(DEPTH_SHARPNESS * (tap.w - time * tap.z - own_depth));
    // What is slower than the longest motion meets fewer taps, of which each then counts more, also over 1.
    let raised = sqrt(reach / max(speed, LEAST));
    let weight = overlap * select(1.0, raised, parameters.slow_taps == SLOW_TAPS_RAISED);
    return Tap(textureLoad(color, place, 0), select(0.0, weight, arrives && speed >= LEAST && reach > 0.0));
}

// The colour of one time: the pixel, below its own tap or the one opposite if that is less hidden, below the tap that moves here.
fn laid_over(here: vec4<f32>, own: Tap, opposite: Tap, near: Tap) -> vec4<f32> {
    let share = select(saturate(own.weight / max(opposite.weight, 1e-20)), 1.0, opposite.weight <= 0.0);
    let seen = blend(opposite.color, own.color, share);
    return blend(blend(here, seen, max(own.weight, opposite.weight)), near.color, near.weight);
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let here = textureLoad(color, pixel, 0);
    let own = textureLoad(surfaces, pixel, 0);
    let longest = cut(longest_near(pixel));
    // Whole pixels hide motion of less than one.
    let own_is_hidden = parameters.tile_motion == TILES_WHOLE && length(own.xy) >= LEAST;
    if length(longest) < LEAST && !own_is_hidden {
        textureStore(output, pixel, here);
        return;
    }
    let shift = noise(pixel);
    // A running mean keeps a constant colour exactly as it is.
    var mean = vec4<f32>(0.0);
    for (var i = 0; i < parameters.samples; i++) {
        let step = f32(i) + vec2<f32>(shift, 1.0 - shift);
        // From the instant outwards, shifted against each other; or from the ends inwards.
        let crossed = vec2<f32>(-0.5, 0.5) * step / f32(parameters.samples);
        let mirrored = vec2<f32>(-0.5, 0.5) * (1.0 - step.x / f32(parameters.samples));
        let times = select(mirrored, crossed, parameters.noise == NOISE_CROSSED);
        let after = own_tap(pixel, own, times.x);
        let before = own_tap(pixel, own, times.y);
        let first = laid_over(here, after, before, near_tap(pixel, own.w, longest, times.x));
        mean += (first - mean) / f32(2 * i + 1);
        let second = laid_over(here, before, after, near_tap(pixel, own.w, longest, times.y));
        mean += (second - mean) / f32(2 * i + 2);
    }
    textureStore(output, pixel, mean);
}
