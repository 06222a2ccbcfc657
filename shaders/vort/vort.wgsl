// vort's motion blur for ReShade: tiles of the longest motion, and taps on both sides of the instant, along it and along the pixel's
// own motion.

struct Parameters {
    samples: i32,
    tap_length: f32,
    depth_scale: f32,
    tile_rows: i32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var velocity_next: texture_2d<f32>;
@group(0) @binding(5) var depth: texture_2d<f32>;
@group(0) @binding(6) var motions: texture_2d<f32>;
@group(0) @binding(7) var motions_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(8) var depths: texture_2d<f32>;
@group(0) @binding(9) var depths_out: texture_storage_2d<r32float, write>;
@group(0) @binding(10) var tile_max: texture_2d<f32>;
@group(0) @binding(11) var tile_max_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(12) var near_max: texture_2d<f32>;
@group(0) @binding(13) var near_max_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(14) var output: texture_storage_2d<rgba32float, write>;

// Near plane of the game's camera, in metres.
const NEAR = 0.1;
// Far plane that ReShade assumes, in near planes.
const FAR = 1000.0;
// Half-motions below this many pixels have no direction.
const LEAST = 1.0;
// The original's approximate cosine of 45 degrees.
const DIAGONAL = 0.7104;
const OFFSETS = array<vec2<i32>, 25>(
    vec2<i32>(0, 0), vec2<i32>(1, 0), vec2<i32>(0, 1), vec2<i32>(-1, 0), vec2<i32>(0, -1),
    vec2<i32>(1, 1), vec2<i32>(-1, -1), vec2<i32>(-1, 1), vec2<i32>(1, -1), vec2<i32>(2, 0),
    vec2<i32>(0, 2), vec2<i32>(-2, 0), vec2<i32>(0, -2), vec2<i32>(2, 1), vec2<i32>(2, -1),
    vec2<i32>(-2, 1), vec2<i32>(-2, -1), vec2<i32>(1, 2), vec2<i32>(-1, 2), vec2<i32>(1, -2),
    vec2<i32>(-1, -2), vec2<i32>(2, 2), vec2<i32>(-2, -2), vec2<i32>(-2, 2), vec2<i32>(2, -2),
);

fn tile_size() -> i32 {
    return max(frame.size.y / parameters.tile_rows, 1);
}

// Whole tiles only; they are stretched over the picture.
fn tile_count() -> vec2<i32> {
    return max(frame.size / tile_size(), vec2<i32>(1));
}

// From a pixel to its place in the last frame, and to that in the next one, in pixels.
fn both_ways(pixel: vec2<i32>) -> vec4<f32> {
    return vec4<f32>(-textureLoad(velocity, pixel, 0).xy, textureLoad(velocity_next, pixel, 0).xy);
}

// Half the motion while the shutter is open, up to two tiles; none for less than a pixel per frame.
fn limited(motion: vec2<f32>) -> vec2<f32> {
    let speed = length(motion);
    let reach = min(0.5 * frame.exposure * speed, f32(2 * tile_size()));
    return select(motion * (reach / max(speed, 1e-15)), vec2<f32>(0.0), speed < 1.0);
}

@compute @workgroup_size(8, 8)
fn prepare(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let motion = both_ways(pixel);
    textureStore(motions_out, pixel, vec4<f32>(limited(motion.xy), limited(motion.zw)));
    // As ReShade reads a depth buffer by default.
    let buffer = 1.0 - NEAR / textureLoad(depth, pixel, 0).x;
    textureStore(depths_out, pixel, vec4<f32>(saturate(buffer / (FAR - buffer * (FAR - 1.0)))));
}

fn longer(a: vec2<f32>, b: vec2<f32>) -> vec2<f32> {
    return select(a, b, dot(b, b) > dot(a, a));
}

@compute @workgroup_size(8, 8)
fn reduce(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    if any(tile >= tile_count()) {
        return;
    }
    var longest = vec4<f32>(0.0);
    for (var y = 0; y < tile_size(); y++) {
        for (var x = 0; x < tile_size(); x++) {
            let motion = both_ways(min(tile * tile_size() + vec2<i32>(x, y), frame.size - 1));
            longest = vec4<f32>(longer(longest.xy, motion.xy), longer(longest.zw, motion.zw));
        }
    }
    textureStore(tile_max_out, tile, longest);
}

// What counts of the motion of a tile at an offset: all, but on diagonals only what heads there or away.
fn arriving(motion: vec2<f32>, offset: vec2<i32>) -> vec2<f32> {
    let way = vec2<f32>(offset);
    let heads = abs(dot(way, motion)) > DIAGONAL * length(way) * length(motion);
    return select(vec2<f32>(0.0), motion, heads || offset.x * offset.y == 0);
}

@compute @workgroup_size(8, 8)
fn spread(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    if any(tile >= tile_count()) {
        return;
    }
    var offsets = OFFSETS;
    var longest = vec4<f32>(0.0);
    for (var i = 0; i < 25; i++) {
        let neighbor = tile + offsets[i];
        if all(neighbor >= vec2<i32>(0)) && all(neighbor < tile_count()) {
            let motion = textureLoad(tile_max, neighbor, 0);
            longest = vec4<f32>(
                longer(longest.xy, arriving(motion.xy, offsets[i])),
                longer(longest.zw, arriving(motion.zw, offsets[i])),
            );
        }
    }
    textureStore(near_max_out, tile, vec4<f32>(limited(longest.xy), limited(longest.zw)));
}

// The longest half-motions near a pixel; noise moves the borders of tiles by up to an eighth of a tile, along x or along y.
fn longest_near(pixel: vec2<i32>) -> vec4<f32> {
    let noise = 0.25 * (interleaved_gradient_noise(centre(pixel).yx) - 0.5);
    let along = select(vec2<f32>(0.0, 1.0), vec2<f32>(1.0, 0.0), (pixel.x + pixel.y) % 2 == 1);
    let position = centre(pixel) + noise * f32(tile_size()) * along;
    let tile = vec2<i32>(floor(position / vec2<f32>(frame.size) * vec2<f32>(tile_count())));
    return textureLoad(near_max, clamp(tile, vec2<i32>(0), tile_count() - 1), 0);
}

fn direction_of(motion: vec2<f32>) -> vec2<f32> {
    return motion / max(length(motion), 1e-15);
}

struct Tap {
    color: vec4<f32>,
    depth: f32,
    speed: f32,
    // Of what is behind the pixel, and of what is in front.
    weights: vec2<f32>,
}

// Reads the tap so many of `count` steps away on one side of the instant.
fn read_tap(pixel: vec2<i32>, own: vec2<f32>, near: vec2<f32>, steps: f32, count: f32, by_near: bool, is_next: bool) -> Tap {
    let has_own = length(own) >= LEAST;
    let line = select(own, near, by_near || !has_own);
    let position = centre(pixel) - steps / count * line;
    let both = textureLoad(motions, pixel_at(position), 0);
    let motion = select(both.xy, both.zw, is_next);
    let tap_depth = bilinear(depths, position).x;
    let farther = parameters.depth_scale * (tap_depth - textureLoad(depths, pixel, 0).x);
    let layers = saturate(vec2<f32>(0.5 + farther, 0.5 - farther));
    // What is behind shows as far as the pixel moves, what is in front as far as it moves itself; in steps.
    let speeds = vec2<f32>(length(own), length(motion));
    let arrives = saturate(speeds * (count / max(length(near), 1e-6)) - max(0.0, steps - 1.0));
    let direction = direction_of(line);
    let aligned = abs(vec2<f32>(dot(direction_of(own), direction), dot(direction_of(motion), direction)));
    let follows = vec2<f32>(select(1.0, aligned.x, by_near && has_own), aligned.y);
    return Tap(bilinear(color, position), tap_depth, speeds.y, layers * arrives * follows);
}

// Mean colours and weights of what is behind and of what is in front.
struct Sums {
    back: vec4<f32>,
    front: vec4<f32>,
    weights: vec2<f32>,
}

fn add(sums: ptr<function, Sums>, tap: vec4<f32>, weights: vec2<f32>) {
    (*sums).weights += weights;
    let parts = weights / max((*sums).weights, vec2<f32>(1e-20));
    (*sums).back += (tap - (*sums).back) * parts.x;
    (*sums).front += (tap - (*sums).front) * parts.y;
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let here = textureLoad(color, pixel, 0);
    let near = longest_near(pixel);
    let reach = max(length(near.xy), length(near.zw));
    if reach < LEAST {
        textureStore(output, pixel, here);
        return;
    }
    // An odd number on each side: one more along the longest motion than along the pixel's own.
    let count = i32(clamp(ceil(reach / parameters.tap_length), 3.0, f32(max(3, parameters.samples)))) | 1;
    let own = textureLoad(motions, pixel, 0);
    let own_reach = max(0.5, max(length(own.xy), length(own.zw)));
    var sums = Sums(here, vec4<f32>(0.0), vec2<f32>(saturate(0.05 * f32(count) / own_reach), 0.0));
    let noise = interleaved_gradient_noise(centre(pixel) + 5.588238 * f32(frame.frame_index % 63u));
    for (var i = 0; i < count; i++) {
        let by_near = i % 2 == 0;
        let last = read_tap(pixel, own.xy, near.xy, f32(i) + noise, f32(count), by_near, false);
        let next = read_tap(pixel, own.zw, near.zw, f32(i) + 1.0 - noise, f32(count), by_near, true);
        // A pair has the weights of one tap, if the other is farther or slower.
        let is_farther = last.depth > next.depth;
        let is_slower = next.speed > last.speed;
        let first = select(last.weights, next.weights, is_farther && is_slower);
        add(&sums, last.color, first);
        add(&sums, next.color, select(first, next.weights, is_farther || is_slower));
    }
    // What is behind fills the rest.
    let share = sums.weights.y / f32(2 * count + 1);
    textureStore(output, pixel, sums.back + share * (sums.front - sums.back));
}
