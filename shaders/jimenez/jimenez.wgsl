// Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare", and the engines that follow it.
//
// `scaled` motion is strength x exposure x velocity. Taps lie on the trail, which goes `extent` of it to either side of a
// pixel. What a preset calls a speed is the length of scaled motion in its `measure`.

struct Parameters {
    pairs: i32,
    tap_length: f32,
    placement: u32,
    noise: u32,
    sampling: u32,
    tile_size: i32,
    tile_reach: i32,
    dilation: u32,
    last_tiles: u32,
    tile_dither: f32,
    dither_shape: u32,
    tile_lookup: u32,
    strength: f32,
    extent: f32,
    screen_extent: f32,
    measure: u32,
    longest_by: u32,
    shortest: f32,
    longest: f32,
    depth_scale: f32,
    spread: u32,
    direction: u32,
    direction_from: f32,
    mirror: u32,
    rest: u32,
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
const PLACEMENT_COMMON_MIDDLES = 1u;
const PLACEMENT_WHOLE_PIXELS = 2u;
const PLACEMENT_WITH_CENTRE = 3u;
const NOISE_CHECKER = 0u;
const NOISE_SHIFT = 1u;
const NOISE_SCRAMBLE = 2u;
const NOISE_SCALE = 3u;
const SAMPLING_NEAREST = 1u;
const DILATION_WALK = 1u;
const LAST_TILES_CORNER = 1u;
const DITHER_CIRCLE = 0u;
const DITHER_DIAGONAL = 1u;
const DITHER_BAYER = 2u;
const LOOKUP_LINEAR = 1u;
const MEASURE_WIDTHS = 1u;
const MEASURE_DIAGONALS = 2u;
const LONGEST_BY_SCREENS = 1u;
const LONGEST_BY_LAST_SCREENS = 2u;
const LONGEST_BY_PACKED_SCREENS = 3u;
const SPREAD_STEPS = 0u;
const SPREAD_LATE_STEPS = 1u;
const SPREAD_TILE_STEPS = 2u;
const SPREAD_PIXELS = 3u;
const DIRECTION_WEIGHTED = 1u;
const MIRROR_SLOW_BACKGROUND = 0u;
const MIRROR_FAST_BACKGROUND = 1u;
const REST_LAYERS = 1u;
const PLAIN_SIMILAR = 1u;
const PLAIN_EQUAL = 2u;
const BORDER_DROP = 1u;
const BORDER_PUSH = 2u;

const TAU = 6.2831853;
// A shift of half a step to either side, of which the scrambled numbers from -15 to 16 are parts.
const SCRAMBLE = 0.5 / 15.0;
// Tiles whose longest speed is at most this carry nothing to others in Unity HDRP, in pixels.
const WALK_FROM = 0.5;
// Tiles are plain to Unity HDRP if the least speed near is more than this part of the longest ..
const PLAIN_RATIO = 0.25;
// .. and the longest under this part of the picture's diagonal.
const PLAIN_DIAGONAL = 0.333;
// Tiles are plain to Wicked Engine if speeds differ by less than this part of the picture, before `strength` ..
const PLAIN_DIFFERENCE = 0.002;
// .. and still if the longest is under this one, which Unity HDRP takes for no motion at all.
const STILL = 0.0001;
// Wicked Engine's factor on speeds, which makes almost any motion enough.
const CONSTANT_SCALE = 1000.0;
// Taps that weigh less than this together have no colour to Unity HDRP.
const NO_WEIGHT = 1e-4;

fn screen() -> vec2<f32> {
    return vec2<f32>(frame.size);
}

// Motion in the space in which lengths and directions are compared.
fn measured(motion: vec2<f32>) -> vec2<f32> {
    switch parameters.measure {
        case MEASURE_WIDTHS: {
            return motion / screen() * screen().x;
        }
        case MEASURE_DIAGONALS: {
            return motion / screen() * length(screen());
        }
        default: {
            return motion;
        }
    }
}

fn speed_of(motion: vec2<f32>) -> f32 {
    return length(measured(motion));
}

// Whether a tile that knows the first motion learns the second.
fn is_longer(known: vec2<f32>, candidate: vec2<f32>) -> bool {
    switch parameters.longest_by {
        case LONGEST_BY_SCREENS: {
            return length(candidate / screen()) > length(known / screen());
        }
        case LONGEST_BY_LAST_SCREENS: {
            return length(candidate / screen()) >= length(known / screen());
        }
        case LONGEST_BY_PACKED_SCREENS: {
            let first = packed(known / screen());
            let second = packed(candidate / screen());
            return second.x > first.x || (second.x == first.x && second.y > first.y);
        }
        default: {
            return length(candidate) > length(known);
        }
    }
}

// Length and angle, each rounded to the 11 digits of a 16-bit float; they compare like the numbers.
fn packed(motion: vec2<f32>) -> vec2<u32> {
    if all(motion == vec2<f32>(0.0)) {
        return vec2<u32>(0u);
    }
    let bits = bitcast<vec2<u32>>(vec2<f32>(length(motion), atan2(motion.y, motion.x) / TAU + 0.5));
    return (bits + 0xfffu + ((bits >> vec2<u32>(13u)) & vec2<u32>(1u))) >> vec2<u32>(13u);
}

// Strength x exposure x velocity, in pixels.
fn scaled(motion: vec2<f32>) -> vec2<f32> {
    let whole = parameters.strength * frame.exposure * motion;
    let speed = speed_of(whole);
    if parameters.measure == MEASURE_DIAGONALS && speed < STILL * length(screen()) {
        return vec2<f32>(0.0);
    }
    return select(whole, whole * (parameters.longest / speed), speed > parameters.longest);
}

// From a pixel to the end of its trail, in pixels.
fn half_trail(motion: vec2<f32>) -> vec2<f32> {
    return parameters.extent * motion + parameters.screen_extent * motion / screen();
}

fn tile_count() -> vec2<i32> {
    return (frame.size + parameters.tile_size - 1) / parameters.tile_size;
}

// Longest motion of a tile, and its least speed.
@compute @workgroup_size(8, 8)
fn reduce(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    let corner = tile * parameters.tile_size;
    var side = parameters.tile_size;
    // Unity HDRP takes the pixel in the corner for all of a tile beside the right or lower border.
    if parameters.last_tiles == LAST_TILES_CORNER && any(corner >= frame.size - side) {
        side = 1;
    }
    var longest = vec2<f32>(0.0);
    var least = 1e30;
    for (var y = 0; y < side; y++) {
        for (var x = 0; x < side; x++) {
            let pixel = corner + vec2<i32>(x, y);
            if inside(pixel) {
                let candidate = scaled(textureLoad(velocity, pixel, 0).xy);
                longest = select(longest, candidate, is_longer(longest, candidate));
                least = min(least, speed_of(candidate));
            }
        }
    }
    textureStore(tile_motion_out, tile, vec4<f32>(longest, least, 0.0));
}

// Whether Unity HDRP's walk over tiles along a line, both in tiles, comes by the tile that lies `away` from where it
// starts. It starts a tile further up and left, and goes a tile further down and right.
fn walk_meets(away: vec2<i32>, line: vec2<f32>) -> bool {
    let goal = vec2<i32>(ceil(line + 1.0));
    let first = min(vec2<i32>(-1), goal - 1);
    let last = max(vec2<i32>(-1), goal - 1);
    if any(away < first) || any(away > last) {
        return false;
    }
    let sides = sign(goal);
    let lengths = goal * sides;
    var place = vec2<i32>(-1);
    var balance = lengths.y - lengths.x;
    for (var i = 0; i < lengths.x + lengths.y; i++) {
        if balance < 0 {
            place.x += sides.x;
            balance += 2 * lengths.y;
        } else {
            place.y += sides.y;
            balance -= 2 * lengths.x;
        }
        if all(place == away) {
            return true;
        }
    }
    return false;
}

// Whether the motion of one tile counts for another that lies `away` from it, in tiles.
fn is_carried(motion: vec2<f32>, away: vec2<i32>) -> bool {
    if parameters.dilation != DILATION_WALK || all(away == vec2<i32>(0)) {
        return true;
    }
    if speed_of(motion) <= WALK_FROM {
        return false;
    }
    let line = 0.5 * motion / screen() * vec2<f32>(tile_count());
    return walk_meets(away, line) || walk_meets(away, -line);
}

// The least speed near a tile in which motion is as long as that: of the tile itself; or of those as far away as the
// motion is long, four tiles at most, and one fewer on the right and below.
fn least_along(tile: vec2<i32>, longest: f32) -> f32 {
    let side = f32(parameters.tile_size);
    var least = textureLoad(tile_motion, tile, 0).z;
    if longest > 0.5 * side {
        let count = clamp(i32(longest / side), 1, 4);
        for (var y = -count; y < count; y++) {
            for (var x = -count; x < count; x++) {
                let other = clamp(tile + vec2<i32>(x, y), vec2<i32>(0), tile_count() - 1);
                least = min(least, textureLoad(tile_motion, other, 0).z);
            }
        }
    }
    return least;
}

// Longest motion that is carried to a tile, and least speed near it.
@compute @workgroup_size(8, 8)
fn dilate(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    if any(tile >= tile_count()) {
        return;
    }
    var near = vec4<f32>(0.0, 0.0, 1e30, 0.0);
    for (var x = -parameters.tile_reach; x <= parameters.tile_reach; x++) {
        for (var y = -parameters.tile_reach; y <= parameters.tile_reach; y++) {
            let source = tile + vec2<i32>(x, y);
            let beside = max(abs(x), abs(y)) <= 1;
            if any(source < vec2<i32>(0)) || any(source >= tile_count()) {
                // Beyond the border, Wicked Engine reads that nothing moves.
                near.z = select(near.z, 0.0, beside);
                continue;
            }
            let candidate = textureLoad(tile_motion, source, 0);
            near.z = select(near.z, min(near.z, candidate.z), beside);
            if is_longer(near.xy, candidate.xy) && is_carried(candidate.xy, tile - source) {
                near = vec4<f32>(candidate.xy, near.zw);
            }
        }
    }
    if parameters.plain_tiles == PLAIN_SIMILAR {
        near.z = least_along(tile, speed_of(near.xy));
    }
    textureStore(near_motion_out, tile, near);
}

// Three numbers from -15 to 16 that look like noise: kajiya's.
fn scrambled(pixel: vec2<i32>) -> vec3<i32> {
    var place = pixel;
    place.x += place.x << 4u;
    place.x ^= place.x >> 6u;
    place.y += place.x << 1u;
    place.y += place.y << 6u;
    place.y ^= place.y >> 2u;
    place.x ^= place.y;
    let third = place.x ^ (place.y << 1u);
    return (vec3<i32>(place, third) & vec3<i32>(31)) - 15;
}

// From 1/65 to 64/65: ordered dither.
fn bayer(pixel: vec2<i32>) -> f32 {
    let high = pixel.x ^ pixel.y;
    let low = pixel.y;
    let coarse = 32 * (high & 1) + 16 * (low & 1);
    let middle = 4 * (high & 2) + 2 * (low & 2);
    let fine = (high & 4) / 2 + (low & 4) / 4;
    return f32(coarse + middle + fine + 1) / 65.0;
}

// How far beside a pixel its tile is looked up, in pixels.
fn tile_shift(pixel: vec2<i32>) -> vec2<f32> {
    let radius = parameters.tile_dither * f32(parameters.tile_size);
    switch parameters.dither_shape {
        case DITHER_CIRCLE: {
            let angle = TAU * interleaved_gradient_noise(vec2<f32>(pixel) + vec2<f32>(2.0 * screen().x, 0.0));
            return radius * vec2<f32>(cos(angle), sin(angle));
        }
        case DITHER_DIAGONAL: {
            return vec2<f32>(radius * (2.0 * interleaved_gradient_noise(vec2<f32>(pixel)) - 1.0));
        }
        case DITHER_BAYER: {
            return vec2<f32>(radius * (2.0 * bayer(pixel) - 1.0));
        }
        default: {
            return radius / 16.0 * vec2<f32>(scrambled(pixel).xy);
        }
    }
}

// What the tiles near a pixel know, looked up a little beside it so that their borders dissolve.
fn look_near(pixel: vec2<i32>) -> vec4<f32> {
    let beside = vec2<f32>(pixel) + tile_shift(pixel);
    if parameters.tile_lookup == LOOKUP_LINEAR {
        return linear_tile(beside / screen() * vec2<f32>(tile_count()) - 0.5);
    }
    if parameters.dither_shape == DITHER_BAYER {
        let tile = vec2<i32>(beside / f32(parameters.tile_size));
        // Beyond the border, Wicked Engine reads that nothing moves.
        let found = textureLoad(near_motion, min(tile, tile_count() - 1), 0);
        return select(found, vec4<f32>(0.0), any(tile >= tile_count()));
    }
    return textureLoad(near_motion, pixel_at(beside + 0.5) / parameters.tile_size, 0);
}

// Between the centres of tiles, in tiles.
fn linear_tile(position: vec2<f32>) -> vec4<f32> {
    let base = floor(position);
    let last = tile_count() - 1;
    let low = clamp(vec2<i32>(base), vec2<i32>(0), last);
    let high = clamp(vec2<i32>(base) + 1, vec2<i32>(0), last);
    let fraction = position - base;
    let top = blend(
        textureLoad(near_motion, low, 0),
        textureLoad(near_motion, vec2<i32>(high.x, low.y), 0),
        fraction.x,
    );
    let bottom = blend(
        textureLoad(near_motion, vec2<i32>(low.x, high.y), 0),
        textureLoad(near_motion, high, 0),
        fraction.x,
    );
    return blend(top, bottom, fraction.y);
}

// Whether nothing blurs here.
fn is_still(near: vec4<f32>) -> bool {
    let longest = speed_of(near.xy);
    if parameters.plain_tiles == PLAIN_EQUAL {
        return longest < STILL * abs(parameters.strength) * screen().x;
    }
    return longest < parameters.shortest;
}

// Whether all taps may weigh alike here.
fn is_plain(near: vec4<f32>) -> bool {
    let longest = speed_of(near.xy);
    switch parameters.plain_tiles {
        case PLAIN_SIMILAR: {
            return near.z > PLAIN_RATIO * longest && longest < PLAIN_DIAGONAL * length(screen());
        }
        case PLAIN_EQUAL: {
            return longest - near.z < PLAIN_DIFFERENCE * abs(parameters.strength) * screen().x;
        }
        default: {
            return false;
        }
    }
}

// How many pairs of taps lie on a trail of such a speed: as many as `pairs`, or on a short one of as many taps, rounded
// up to an even number, as it has tap lengths.
fn pair_count(speed: f32) -> i32 {
    if parameters.tap_length == 0.0 {
        return parameters.pairs;
    }
    let taps = i32(min(speed / parameters.tap_length, 1000.0));
    return clamp((taps + (taps & 1)) / 2, 1, parameters.pairs);
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
        case NOISE_SCRAMBLE: {
            return SCRAMBLE * f32(scrambled(pixel).z);
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

// Where the two taps of a pair lie on a trail, in steps; it ends at `count` and -`count`.
fn steps_of_pair(i: i32, count: i32, shift: f32) -> vec2<f32> {
    let inner = f32(i);
    switch parameters.placement {
        case PLACEMENT_MIDDLES: {
            return (inner + 0.5 + shift) * vec2<f32>(1.0, -1.0);
        }
        case PLACEMENT_COMMON_MIDDLES: {
            return (inner + 0.5) * vec2<f32>(-1.0, 1.0) + shift;
        }
        case PLACEMENT_WHOLE_PIXELS: {
            return (inner + shift) * vec2<f32>(1.0, -1.0);
        }
        case PLACEMENT_WITH_CENTRE: {
            return (inner + 1.0) * vec2<f32>(1.0, -1.0) + shift;
        }
        default: {
            let middle = f32(count) - 0.5;
            return (vec2<f32>(2.0 * inner, 2.0 * inner + 1.0) - middle) * (f32(count) / middle);
        }
    }
}

struct Tap {
    // Scaled motion and its speed.
    motion: vec2<f32>,
    speed: f32,
    // In metres.
    depth: f32,
}

fn tap_at(position: vec2<f32>) -> Tap {
    let pixel = pixel_at(position);
    let motion = scaled(textureLoad(velocity, pixel, 0).xy);
    return Tap(motion, speed_of(motion), textureLoad(depth, pixel, 0).x);
}

fn color_at(position: vec2<f32>) -> vec4<f32> {
    if parameters.sampling == SAMPLING_NEAREST {
        return textureLoad(color, pixel_at(position), 0);
    }
    return bilinear(color, position);
}

// How much a tap lies behind and in front of the pixel; together 1 (DepthCmp).
fn depth_split(own: Tap, tap: Tap) -> vec2<f32> {
    let farther = parameters.depth_scale * (tap.depth - own.depth);
    return saturate(0.5 + vec2<f32>(farther, -farther));
}

// Whether the pixel's own motion and the tap's cover the way between them (SpreadCmp). `trail` is the scaled motion that
// the taps lie on, `distance` the way in steps, of which the trail has `count` on either side.
fn spread(own: Tap, tap: Tap, trail: vec2<f32>, distance: f32, count: i32) -> vec2<f32> {
    let speeds = vec2<f32>(own.speed, tap.speed);
    let reached = speeds * (f32(count) / speed_of(trail));
    switch parameters.spread {
        case SPREAD_STEPS: {
            return saturate(reached - distance + 1.0);
        }
        case SPREAD_LATE_STEPS: {
            return saturate(reached - max(distance - 1.0, 0.0));
        }
        case SPREAD_TILE_STEPS: {
            return saturate(vec2<f32>(f32(count), reached.y) - distance + 1.0);
        }
        case SPREAD_PIXELS: {
            let pixels = distance * length(half_trail(trail)) / f32(count);
            return saturate(0.5 * speeds - (pixels + 1.0));
        }
        default: {
            // Wicked Engine gives the neighbourhood's speed for the way, and forgets the strength at taps.
            let unequal = speeds / vec2<f32>(1.0, abs(parameters.strength));
            return saturate((CONSTANT_SCALE * unequal - speed_of(trail)) / screen().x + 1.0);
        }
    }
}

// Part of the way along the trail that a tap's own motion goes.
fn along_trail(own: Tap, tap: Tap, trail: vec2<f32>) -> f32 {
    if own.speed == 0.0 || tap.speed <= parameters.direction_from {
        return 1.0;
    }
    // Unity HDRP divides by the square of half the trail.
    let half_way = 0.5 * measured(trail);
    return saturate(abs(dot(measured(tap.motion), half_way)) / dot(half_way, half_way));
}

// How much a tap counts: what lies behind shows where the pixel moves away, what lies in front where it comes here.
fn tap_weight(own: Tap, tap: Tap, trail: vec2<f32>, distance: f32, count: i32) -> f32 {
    var reached = spread(own, tap, trail, distance, count);
    if parameters.direction == DIRECTION_WEIGHTED {
        reached.y *= along_trail(own, tap, trail);
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

// Keeps a position on the centres of the border's pixels, or nearer to the middle.
fn pushed(position: vec2<f32>) -> vec2<f32> {
    return clamp(position, vec2<f32>(0.5), screen() - 0.5);
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let near = look_near(pixel);
    // Wicked Engine sorts tiles, and looks only for the motion beside the pixel.
    let tile = textureLoad(near_motion, pixel / parameters.tile_size, 0);
    let sorted = select(near, tile, vec4<bool>(parameters.plain_tiles == PLAIN_EQUAL));
    let plain = is_plain(sorted);
    var trail = near.xy;
    if plain && parameters.plain_tiles == PLAIN_EQUAL {
        trail = tap_at(centre(pixel)).motion;
    }
    if is_still(sorted) || all(trail == vec2<f32>(0.0)) {
        textureStore(output, pixel, textureLoad(color, pixel, 0));
        return;
    }
    let count = pair_count(speed_of(trail));
    let step = half_trail(trail) * stretch(pixel) / f32(count);
    // kajiya shifts the pixel itself along with its taps, and counts it as one of them.
    let with_centre = parameters.placement == PLACEMENT_WITH_CENTRE;
    let here = centre(pixel) + select(0.0, shift(pixel), with_centre) * step;
    var own = tap_at(here);
    if with_centre {
        own.motion = scaled(bilinear(velocity, here).xy);
        own.speed = speed_of(own.motion);
    }
    let own_color = textureLoad(color, pixel_at(here), 0);

    var taps = Mean(vec4<f32>(0.0), 0.0);
    var used = select(0.0, 1.0, with_centre);
    // Where the trail is pushed inwards at the border of the picture, its next tap.
    var next = pushed(centre(pixel) + steps_of_pair(0, count, shift(pixel)).x * step);
    for (var i = 0; i < count; i++) {
        let offsets = steps_of_pair(i, count, shift(pixel));
        var places = array<vec2<f32>, 2>(centre(pixel) + offsets.x * step, centre(pixel) + offsets.y * step);
        var distances = abs(offsets);
        if parameters.placement == PLACEMENT_WHOLE_PIXELS {
            places = array<vec2<f32>, 2>(
                centre(pixel) + trunc(offsets.x * step),
                centre(pixel) + trunc(offsets.y * step),
            );
            // O3DE keeps the sign that the noise gives the innermost one.
            distances = offsets.xx;
        }
        if parameters.border == BORDER_PUSH {
            let way = (offsets.y - offsets.x) * step;
            places = array<vec2<f32>, 2>(next, pushed(next + way));
            next = pushed(places[1] + way);
        }
        var pair = array<Tap, 2>(tap_at(places[0]), tap_at(places[1]));
        var weights = vec2<f32>(1.0);
        if !plain {
            weights = vec2<f32>(
                tap_weight(own, pair[0], trail, distances.x, count),
                tap_weight(own, pair[1], trail, distances.y, count),
            );
            weights = mirrored(weights, pair[0], pair[1]);
        }
        for (var side = 0; side < 2; side++) {
            if parameters.border == BORDER_DROP && !on_screen(places[side]) {
                continue;
            }
            used += 1.0;
            taps = with_tap(taps, color_at(places[side]), weights[side]);
        }
    }
    let covered = taps.total / max(used, 1.0);
    var result = own_color + (taps.color - own_color) * covered;
    if parameters.rest == REST_LAYERS && !plain && taps.total >= NO_WEIGHT {
        // Over this lies what the taps saw, as far as the pixel moves like the fastest near it.
        result += (taps.color - result) * saturate(own.speed / speed_of(trail));
    }
    textureStore(output, pixel, result);
}
