// Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare", and the engines that follow it.
//
// `scaled` motion is strength x exposure x velocity; taps lie on the trail, which goes `extent` of it to either side.

struct Parameters {
    pairs: i32,
    placement: u32,
    noise: u32,
    tile_size: i32,
    tile_reach: i32,
    dilation: u32,
    tile_dither: f32,
    strength: f32,
    unit: u32,
    extent: f32,
    shortest: f32,
    longest: f32,
    depth_scale: f32,
    spread: u32,
    direction: u32,
    mirror: u32,
    plain_tiles: u32,
    border: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
@group(0) @binding(5) var tile_motion: texture_2d<f32>;
@group(0) @binding(6) var tile_motion_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(7) var near_motion: texture_2d<f32>;
@group(0) @binding(8) var near_motion_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(9) var output: texture_storage_2d<rgba32float, write>;

const PLACEMENT_MIDDLES = 0u;
const PLACEMENT_WHOLE_PIXELS = 1u;
const PLACEMENT_ENDS = 2u;
const NOISE_CHECKER = 0u;
const NOISE_SHIFT = 1u;
const NOISE_SCALE = 2u;
const DILATION_ALONG_MOTION = 1u;
const UNIT_SCREENS = 1u;
const SPREAD_STEPS = 0u;
const SPREAD_LATE_STEPS = 1u;
const SPREAD_TILE_STEPS = 2u;
const SPREAD_PIXELS = 3u;
const DIRECTION_WEIGHTED = 1u;
const MIRROR_SLOW_BACKGROUND = 0u;
const MIRROR_FAST_BACKGROUND = 1u;
const PLAIN_SIMILAR = 1u;
const PLAIN_EQUAL = 2u;
const BORDER_DROP = 1u;

const TAU = 6.2831853;
// Tiles are plain to Unity HDRP if the least motion near is more than this part of the longest ..
const PLAIN_RATIO = 0.25;
// .. and the longest under this part of the picture's width.
const PLAIN_WIDTH = 0.333;
// Tiles are plain to Wicked Engine if motions differ by less than this part of the picture.
const PLAIN_DIFFERENCE = 0.002;
// Wicked Engine's factor on speeds, which makes almost any motion enough.
const CONSTANT_SCALE = 1000.0;

// Strength x exposure x velocity, in pixels, or in widths and heights taken for pixels.
fn scaled(motion: vec2<f32>) -> vec2<f32> {
    let unit = select(vec2<f32>(1.0), 1.0 / vec2<f32>(frame.size), parameters.unit == UNIT_SCREENS);
    let whole = parameters.strength * frame.exposure * motion * unit;
    let speed = length(whole);
    return select(whole, whole * (parameters.longest / speed), speed > parameters.longest);
}

fn tile_count() -> vec2<i32> {
    return (frame.size + parameters.tile_size - 1) / parameters.tile_size;
}

// Longest and shortest motion of a tile.
@compute @workgroup_size(8, 8)
fn reduce(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    var longest = vec2<f32>(0.0);
    var least = 1e30;
    for (var y = 0; y < parameters.tile_size; y++) {
        for (var x = 0; x < parameters.tile_size; x++) {
            let pixel = tile * parameters.tile_size + vec2<i32>(x, y);
            if inside(pixel) {
                let candidate = scaled(textureLoad(velocity, pixel, 0).xy);
                longest = select(longest, candidate, length(candidate) > length(longest));
                least = min(least, length(candidate));
            }
        }
    }
    textureStore(tile_motion_out, tile, vec4<f32>(longest, least, 0.0));
}

// Whether the trail of something in a tile may touch the tile that lies `away` from it, in tiles. Something is
// anywhere in the first and touches anywhere in the second, so their centres may miss by a tile.
fn trail_touches(away: vec2<i32>, motion: vec2<f32>) -> bool {
    let trail = parameters.extent * motion;
    let side = f32(parameters.tile_size);
    var first = -1.0;
    var last = 1.0;
    for (var axis = 0; axis < 2; axis++) {
        let apart = f32(away[axis]) * side;
        if trail[axis] == 0.0 {
            if abs(apart) >= side {
                return false;
            }
        } else {
            let ends = vec2<f32>(apart - side, apart + side) / trail[axis];
            first = max(first, min(ends.x, ends.y));
            last = min(last, max(ends.x, ends.y));
        }
    }
    return first < last;
}

// Longest motion whose trail may reach a tile, and least of the tile and those that touch it.
@compute @workgroup_size(8, 8)
fn dilate(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    if any(tile >= tile_count()) {
        return;
    }
    var near = textureLoad(tile_motion, tile, 0);
    for (var y = -parameters.tile_reach; y <= parameters.tile_reach; y++) {
        for (var x = -parameters.tile_reach; x <= parameters.tile_reach; x++) {
            let source = tile + vec2<i32>(x, y);
            if any(source < vec2<i32>(0)) || any(source >= tile_count()) {
                continue;
            }
            let candidate = textureLoad(tile_motion, source, 0);
            if max(abs(x), abs(y)) <= 1 {
                near.z = min(near.z, candidate.z);
            }
            let reaches = parameters.dilation != DILATION_ALONG_MOTION
                || trail_touches(tile - source, candidate.xy);
            if reaches && length(candidate.xy) > length(near.xy) {
                near = vec4<f32>(candidate.xy, near.zw);
            }
        }
    }
    textureStore(near_motion_out, tile, near);
}

// What the tiles near a pixel know, looked up a little beside it so that their borders dissolve.
fn look_near(pixel: vec2<i32>) -> vec4<f32> {
    let angle = TAU * interleaved_gradient_noise(vec2<f32>(pixel) + vec2<f32>(2.0 * f32(frame.size.x), 0.0));
    let radius = parameters.tile_dither * f32(parameters.tile_size);
    let beside = centre(pixel) + radius * vec2<f32>(cos(angle), sin(angle));
    return textureLoad(near_motion, pixel_at(beside) / parameters.tile_size, 0);
}

// Whether all taps may weigh alike around here.
fn is_plain(near: vec4<f32>) -> bool {
    let longest = length(near.xy);
    switch parameters.plain_tiles {
        case PLAIN_SIMILAR: {
            return near.z > PLAIN_RATIO * longest && longest < PLAIN_WIDTH * f32(frame.size.x);
        }
        case PLAIN_EQUAL: {
            return longest - near.z < PLAIN_DIFFERENCE * parameters.strength;
        }
        default: {
            return false;
        }
    }
}

// How far taps shift along the trail, in steps.
fn shift(pixel: vec2<i32>) -> f32 {
    switch parameters.noise {
        case NOISE_CHECKER: {
            let odd = vec2<f32>(pixel % 2);
            return (0.5 * odd.x - 0.25) * (2.0 * odd.y - 1.0);
        }
        case NOISE_SHIFT: {
            return interleaved_gradient_noise(vec2<f32>(pixel)) - 0.5;
        }
        default: {
            return 0.0;
        }
    }
}

// What noise makes of the length of a trail; it walks a cycle of 64 frames.
fn stretch(pixel: vec2<i32>) -> f32 {
    let walk = 5.588238 * f32(frame.frame_index % 64u);
    let random = interleaved_gradient_noise(vec2<f32>(pixel) + walk);
    return select(1.0, random, parameters.noise == NOISE_SCALE);
}

// Where the two taps of a pair lie on the trail, in steps; the trail ends at `pairs` and -`pairs`.
fn steps_of_pair(i: i32, shift: f32) -> vec2<f32> {
    let inner = f32(i);
    let count = f32(parameters.pairs);
    switch parameters.placement {
        case PLACEMENT_MIDDLES: {
            return (inner + 0.5 + shift) * vec2<f32>(1.0, -1.0);
        }
        case PLACEMENT_WHOLE_PIXELS: {
            return (inner + shift) * vec2<f32>(1.0, -1.0);
        }
        case PLACEMENT_ENDS: {
            return vec2<f32>(inner + 1.0 + shift, -inner - 1.0 + shift);
        }
        default: {
            let middle = count - 0.5;
            return (vec2<f32>(2.0 * inner, 2.0 * inner + 1.0) - middle) * (count / middle);
        }
    }
}

struct Tap {
    // Scaled motion and its length.
    motion: vec2<f32>,
    speed: f32,
    // In metres.
    depth: f32,
}

fn tap_at(position: vec2<f32>) -> Tap {
    let pixel = pixel_at(position);
    let motion = scaled(textureLoad(velocity, pixel, 0).xy);
    return Tap(motion, length(motion), textureLoad(depth, pixel, 0).x);
}

// How much a tap lies behind and in front of the pixel; together 1 (DepthCmp of the slides).
fn depth_split(own: Tap, tap: Tap) -> vec2<f32> {
    let farther = parameters.depth_scale * (tap.depth - own.depth);
    return saturate(0.5 + vec2<f32>(farther, -farther));
}

// Whether the pixel's own motion and the tap's cover the way between them (SpreadCmp of the slides). `trail` is the
// scaled motion that the taps lie on, `offset` the way in steps.
fn spread(own: Tap, tap: Tap, trail: vec2<f32>, offset: f32) -> vec2<f32> {
    let speeds = vec2<f32>(own.speed, tap.speed);
    let reached = speeds * (f32(parameters.pairs) / length(trail));
    switch parameters.spread {
        case SPREAD_STEPS: {
            return saturate(reached - offset + 1.0);
        }
        case SPREAD_LATE_STEPS: {
            return saturate(reached - max(offset - 1.0, 0.0));
        }
        case SPREAD_TILE_STEPS: {
            return saturate(vec2<f32>(f32(parameters.pairs), reached.y) - offset + 1.0);
        }
        case SPREAD_PIXELS: {
            let pixels = offset * parameters.extent * length(trail) / f32(parameters.pairs);
            return saturate(speeds - pixels + 1.0);
        }
        default: {
            // Wicked Engine gives the neighbourhood's speed for the way, and forgets the strength at taps.
            let unequal = speeds / vec2<f32>(1.0, parameters.strength);
            return saturate(CONSTANT_SCALE * unequal - length(trail) + 1.0);
        }
    }
}

// How much a tap counts: what lies behind shows where the pixel moves away, what lies in front where it comes here.
fn tap_weight(own: Tap, tap: Tap, trail: vec2<f32>, offset: f32) -> f32 {
    var reached = spread(own, tap, trail, abs(offset));
    if parameters.direction == DIRECTION_WEIGHTED {
        reached.y *= saturate(abs(dot(tap.motion, trail)) / dot(trail, trail));
    }
    return dot(depth_split(own, tap), reached);
}

// The weights of a pair after one took over the other's.
fn mirrored(weights: vec2<f32>, first: Tap, second: Tap) -> vec2<f32> {
    let behind = first.depth > second.depth;
    var faster = second.speed > first.speed;
    switch parameters.mirror {
        case MIRROR_SLOW_BACKGROUND: {}
        case MIRROR_FAST_BACKGROUND: {
            faster = first.speed > second.speed;
        }
        default: {
            return weights;
        }
    }
    if behind == faster {
        return select(weights.xx, weights.yy, behind);
    }
    return weights;
}

// A weighted mean of colours that grows by one at a time; equal colours stay exactly as they are.
struct Mean {
    color: vec4<f32>,
    total: f32,
}

fn with_tap(mean: Mean, tap: vec4<f32>, weight: f32) -> Mean {
    if weight <= 0.0 {
        return mean;
    }
    let total = mean.total + weight;
    return Mean(mean.color + (tap - mean.color) * (weight / total), total);
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let near = look_near(pixel);
    if length(near.xy) < parameters.shortest || all(near.xy == vec2<f32>(0.0)) {
        textureStore(output, pixel, textureLoad(color, pixel, 0));
        return;
    }
    let plain = is_plain(near);
    var trail = near.xy;
    if plain && parameters.plain_tiles == PLAIN_EQUAL {
        trail = tap_at(centre(pixel)).motion;
    }
    let step = trail * parameters.extent * stretch(pixel) / f32(parameters.pairs);
    // kajiya shifts the pixel itself along with its taps, and counts it as one of them.
    let with_centre = parameters.placement == PLACEMENT_ENDS;
    let here = centre(pixel) + select(0.0, shift(pixel), with_centre) * step;
    let own = tap_at(here);
    let own_color = bilinear(color, here);

    var taps = Mean(vec4<f32>(0.0), 0.0);
    var count = select(0.0, 1.0, with_centre);
    for (var i = 0; i < parameters.pairs; i++) {
        let offsets = steps_of_pair(i, shift(pixel));
        var way = array<vec2<f32>, 2>(offsets.x * step, offsets.y * step);
        if parameters.placement == PLACEMENT_WHOLE_PIXELS {
            way = array<vec2<f32>, 2>(trunc(way[0]), trunc(way[1]));
        }
        var pair = array<Tap, 2>(tap_at(centre(pixel) + way[0]), tap_at(centre(pixel) + way[1]));
        var weights = vec2<f32>(1.0);
        if !plain {
            weights = vec2<f32>(
                tap_weight(own, pair[0], trail, offsets.x),
                tap_weight(own, pair[1], trail, offsets.y),
            );
            weights = mirrored(weights, pair[0], pair[1]);
        }
        for (var side = 0; side < 2; side++) {
            let position = centre(pixel) + way[side];
            if parameters.border == BORDER_DROP && !on_screen(position) {
                continue;
            }
            count += 1.0;
            taps = with_tap(taps, bilinear(color, position), weights[side]);
        }
    }
    // What no tap reached is taken for the pixel's own colour.
    let covered = taps.total / max(count, 1.0);
    textureStore(output, pixel, own_color + (taps.color - own_color) * covered);
}
