// Dagor Engine's object motion blur: the longest motion of tiles, and taps along it and along the pixel's own motion.

struct Parameters {
    samples: i32,
    longest: f32,
    tile_size: i32,
    vignette: f32,
    storage: u32,
    border: u32,
    sky: u32,
    opposite: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
// Half-motion towards the place before in pixels, its length, and depth in metres.
@group(0) @binding(5) var surfaces: texture_2d<f32>;
@group(0) @binding(6) var surfaces_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(7) var tile_max: texture_2d<f32>;
@group(0) @binding(8) var tile_max_out: texture_storage_2d<rg32float, write>;
@group(0) @binding(9) var neighbor_max: texture_2d<f32>;
@group(0) @binding(10) var neighbor_max_out: texture_storage_2d<rg32float, write>;
@group(0) @binding(11) var output: texture_storage_2d<rgba32float, write>;

const STORAGE_PACKED = 0u;
const BORDER_REPEAT = 0u;
const SKY_LEFT_OUT = 0u;
const OPPOSITE_IGNORED = 0u;

const TAU = 6.2831853;
// Planes of the engine's default camera, in metres; its depth buffer is reversed. What is at the far plane is sky.
const NEAR = 0.01;
const FAR = 10000.0;
// A surface is wholly in front if it is nearer by one part in this many of its depth.
const DEPTH_SHARPNESS = 15.0;
// Half-motion of what stands still, in pixels.
const LEAST = 0.5;
// The pixel itself weighs as many taps as there are, over this times its half-motion.
const CENTER_DIVISOR = 40.0;

// A positive number, rounded to a float with 5 bits of exponent and this many of mantissa.
fn small_float(value: f32, mantissa: i32) -> f32 {
    let exponent = max(i32(bitcast<u32>(value) >> 23u) - 127, -14);
    let step = bitcast<f32>(u32(exponent - mantissa + 127) << 23u);
    return round(value / step) * step;
}

// Half the motion while the shutter is open, cut at the longest, and shorter in the middle of the picture. Tiles go on beyond the
// border, with the motion at the border.
fn half_motion(pixel: vec2<i32>) -> vec2<f32> {
    let motion = textureLoad(velocity, clamp(pixel, vec2<i32>(0), frame.size - 1), 0).xy;
    let half = -0.5 * frame.exposure * motion;
    let place = 2.0 * centre(pixel) / vec2<f32>(frame.size) - 1.0;
    let vignette = saturate(dot(place, place) + 1.0 - parameters.vignette);
    let cut = min(1.0, parameters.longest / max(length(half), 1e-9));
    return half * (cut * vignette * vignette);
}

fn metres_of(raw: f32) -> f32 {
    return 1.0 / (1.0 / FAR + (FAR - NEAR) / (NEAR * FAR) * raw);
}

// Length, angle and reversed depth of a pixel, as they come out of 11, 11 and 10 bits.
@compute @workgroup_size(8, 8)
fn flatten(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let half = half_motion(pixel);
    let metres = textureLoad(depth, pixel, 0).x;
    let raw = max(0.0, (FAR / metres - 1.0) * NEAR / (FAR - NEAR));
    var surface = vec4<f32>(half, length(half), metres_of(raw));
    if parameters.storage == STORAGE_PACKED {
        let has_direction = any(half != vec2<f32>(0.0));
        let turns = select(0.0, atan2(half.y, half.x) / TAU, has_direction) + 0.5;
        let angle = TAU * small_float(turns, 6) - 0.5 * TAU;
        let speed = small_float(length(half), 6);
        surface = vec4<f32>(speed * vec2<f32>(cos(angle), sin(angle)), speed, metres_of(small_float(raw, 5)));
    }
    textureStore(surfaces_out, pixel, surface);
}

fn tile_count() -> vec2<i32> {
    return (frame.size + parameters.tile_size - 1) / parameters.tile_size;
}

@compute @workgroup_size(8, 8)
fn reduce_to_tiles(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    if any(tile >= tile_count()) {
        return;
    }
    var longest = vec2<f32>(0.0);
    for (var y = 0; y < parameters.tile_size; y++) {
        for (var x = 0; x < parameters.tile_size; x++) {
            let half = half_motion(tile * parameters.tile_size + vec2<i32>(x, y));
            longest = select(longest, half, dot(half, half) >= dot(longest, longest));
        }
    }
    if parameters.storage == STORAGE_PACKED {
        let rounded = vec2<f32>(small_float(abs(longest.x), 10), small_float(abs(longest.y), 10));
        longest = sign(longest) * rounded;
    }
    textureStore(tile_max_out, tile, vec4<f32>(longest, 0.0, 0.0));
}

@compute @workgroup_size(8, 8)
fn spread_to_neighbors(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    if any(tile >= tile_count()) {
        return;
    }
    var longest = vec2<f32>(-1.0, 0.0);
    var reach = -1.0;
    for (var i = 0u; i < 9u; i++) {
        // The first of two equally long motions counts, in the order in which the engine's threads compare them.
        let place = select(8u, reverseBits(i) >> 29u, i < 8u);
        let neighbor = tile + vec2<i32>(i32(place % 3u), i32(place / 3u)) - 1;
        let motion = textureLoad(tile_max, clamp(neighbor, vec2<i32>(0), tile_count() - 1), 0).xy;
        if length(motion) > reach {
            longest = motion;
            reach = length(motion);
        }
    }
    textureStore(neighbor_max_out, tile, vec4<f32>(longest, 0.0, 0.0));
}

// In [0, 1); walks a cycle of 8 frames.
fn noise(position: vec2<f32>) -> f32 {
    let walk = f32(frame.frame_index % 8u) * vec2<f32>(47.0, 17.0) * 0.695;
    return interleaved_gradient_noise(position + walk);
}

// The longest motion near a pixel; noise moves the borders of tiles by up to a quarter of a tile.
fn longest_near(pixel: vec2<i32>, noises: vec2<f32>) -> vec2<f32> {
    let shift = vec2<i32>((0.5 * noises - 0.25) * f32(parameters.tile_size));
    let tile = (pixel + shift) / parameters.tile_size;
    return textureLoad(neighbor_max, clamp(tile, vec2<i32>(0), tile_count() - 1), 0).xy;
}

// The surface that a tap reads. The engine leaves its sampler's address mode at the default, which repeats the picture.
fn surface_at(position: vec2<f32>) -> vec4<f32> {
    let pixel = vec2<i32>(floor(position));
    let repeated = (pixel % frame.size + frame.size) % frame.size;
    let nearest = clamp(pixel, vec2<i32>(0), frame.size - 1);
    return textureLoad(surfaces, select(nearest, repeated, parameters.border == BORDER_REPEAT), 0);
}

// The direction of a vector of this length, which storage may have rounded; 0 for what stands still.
fn direction_of(vector: vec2<f32>, speed: f32) -> vec2<f32> {
    return select(vec2<f32>(0.0), vector / max(speed, 1e-6), speed >= LEAST);
}

// How surely the surface at depth `other` lies in front of that at `own`, or not behind it, relative to the nearer one.
fn in_front(own: f32, other: f32) -> f32 {
    return saturate(1.0 - DEPTH_SHARPNESS * (other - own) / min(own, other));
}

fn cone(distance: f32, radius: f32) -> f32 {
    return saturate(1.0 - distance / max(radius, 1e-5));
}

fn cylinder(distance: f32, radius: f32) -> f32 {
    let part = saturate((distance - 0.95 * radius) / max(0.1 * radius, 1e-9));
    return 1.0 - part * part * (3.0 - 2.0 * part);
}

// The weight of a tap at a distance along a direction, which the pixel's own direction follows as far as `center_aligned`.
fn weight_of(own: vec4<f32>, tap: vec4<f32>, distance: f32, direction: vec2<f32>, center_aligned: f32) -> f32 {
    if parameters.sky == SKY_LEFT_OUT && own.w < FAR && tap.w >= FAR {
        return 0.0;
    }
    let front = in_front(own.w, tap.w);
    let back = in_front(tap.w, own.w);
    let tap_aligned = abs(dot(tap.xy, direction)) / max(tap.z, 1e-5);
    // What smears over the pixel from in front of it.
    let over = front / (front + back) * cone(distance, tap.z) * tap_aligned;
    // What the pixel, smeared itself, lets through from behind it.
    let behind = back / (front + back) * cone(distance, own.z) * center_aligned;
    // Both smeared over each other.
    let both = cylinder(distance, min(tap.z, own.z)) * max(center_aligned, tap_aligned);
    return max(max(over, behind), both);
}

// The most taps that a pixel of the workgroup asks for; all of them take as many.
var<workgroup> most_taps: atomic<u32>;

fn taps_for(reach: f32) -> u32 {
    let most = ceil(0.25 * f32(parameters.samples));
    return u32(4.0 * clamp(ceil(reach / parameters.longest * most), 1.0, most));
}

@compute @workgroup_size(16, 16)
fn reconstruct(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    let size = vec2<f32>(frame.size);
    let noises = vec2<f32>(
        noise(centre(pixel)),
        noise((centre(pixel) / size + vec2<f32>(0.52354, 0.62321)) * size),
    );
    let longest = longest_near(pixel, noises);
    let reach = max(length(longest), LEAST);
    atomicMax(&most_taps, taps_for(reach));
    workgroupBarrier();
    let taps = atomicLoad(&most_taps);
    if !inside(pixel) {
        return;
    }
    let here = textureLoad(color, pixel, 0);
    var own = textureLoad(surfaces, pixel, 0);
    let along_longest = direction_of(longest, length(longest));
    let along_own = direction_of(own.xy, own.z);
    own.z = max(own.z, LEAST);
    // The slower the pixel, the more its direction is across the longest motion, so that what it does not share does not blur it.
    let left = vec2<f32>(-along_longest.y, along_longest.x);
    let across = select(left, -left, dot(left, own.xy) < 0.0);
    let mixed = mix(across, along_own, saturate((own.z - 0.5) / 1.5));
    let center = direction_of(mixed, length(mixed));

    // A running mean keeps a constant colour exactly as it is.
    var mean = here;
    var total = f32(taps) / (CENTER_DIVISOR * own.z);
    for (var i = 0u; i < taps; i++) {
        // Pairs of taps, ahead and behind. Even pairs go along the pixel's own motion, odd ones along the longest.
        let pair = i / 2u;
        let is_ahead = i % 2u == 0u;
        let is_own = pair % 2u == 0u;
        let place = (f32(pair) + select(1.0 - noises.x, noises.x, is_ahead)) / f32(taps / 2u);
        let offset = place * select(longest, own.xy, is_own);
        let position = centre(pixel) + select(-offset, offset, is_ahead);
        let direction = select(along_longest, along_own, is_own);
        let along = dot(center, direction);
        let aligned = select(abs(along), along, parameters.opposite == OPPOSITE_IGNORED);
        let distance = place * select(reach, own.z, is_own);
        let weight = weight_of(own, surface_at(position), distance, direction, aligned);
        total += weight;
        if weight > 0.0 {
            mean += (bilinear(color, position) - mean) * (weight / total);
        }
    }
    textureStore(output, pixel, mean);
}
