// The jump flood of jump_flood.wgsl, which says what each step is for; here it says why it is quick. It takes the same
// decisions from the same arithmetic, so that the pictures differ at most where rounding decides.
//
// Every source is the centre of a pixel, where a mixed fetch is that of one texel: one fetch gives its motion and depth.
// A map of 16 bits moves sources off the centres, and costs the mixed fetch.
// A seed is one packed number; one bit of it tells which pixels stand still and need no further look. Tiles that no
// trail can reach are left alone. On the way back, one texel and how much its neighbours differ rule out most probes.
// What a pixel shows is kept as motion and depth instead of a position, so that a tap is one fetch of it.

struct Parameters {
    samples: i32,
    intensity: f32,
    passes: i32,
    step_multiplier: i32,
    perpendicular_tolerance: f32,
    probes: i32,
    match_threshold: f32,
    parallel_sensitivity: f32,
    perpendicular_sensitivity: f32,
    foreground_extent: f32,
    mismatch_exponent: f32,
    metric: u32,
    reach_cap: u32,
    jitter: u32,
    kernel: u32,
    fetch: u32,
    tap: u32,
    behind_extent: f32,
    near_plane: f32,
    way_back: u32,
    depth_match: f32,
    map: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
@group(0) @binding(5) var surfaces: texture_2d<f32>;
@group(0) @binding(6) var surfaces_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(7) var trails: texture_2d<f32>;
@group(0) @binding(8) var trails_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(9) var row_trails: texture_2d<f32>;
@group(0) @binding(10) var row_trails_out: texture_storage_2d<rg32float, write>;
@group(0) @binding(11) var reached: texture_2d<u32>;
@group(0) @binding(12) var reached_out: texture_storage_2d<r32uint, write>;
@group(0) @binding(13) var seeds: texture_2d<u32>;
@group(0) @binding(14) var seeds_out: texture_storage_2d<r32uint, write>;
@group(0) @binding(15) var sources: texture_2d<f32>;
@group(0) @binding(16) var sources_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(17) var output: texture_storage_2d<rgba32float, write>;

// Side of a tile in pixels: what filter.toml divides by, and the workgroup that sums a tile up.
const TILE = 16;

const METRIC_UV = 0u;
const REACH_DOUBLE = 1u;
const REACH_NONE = 2u;
const JITTER_STEP_SCALE = 0u;
const JITTER_START_OFFSET = 1u;
const JITTER_STEP_OFFSET = 2u;
const TAP_REPLACED = 1u;
const WAY_BACK_THIRD_MATCH = 1u;
const MAP_FLOAT16 = 1u;
const KERNEL_WITH_CENTRE = 1u;
const FETCH_BILINEAR = 0u;

// As in jump_flood.wgsl.
const STILL = 1e-12;
const NO_TIME = 1e-12;
const PROBE_SLACK = 0.2;
// The neighbours in the same order, the pixel itself first: two bits each, 0 to 2 for -1 to 1.
const KERNEL_X = 0x10a19u;
const KERNEL_Y = 0x11a9u;

// What paths are measured with; made once per pixel, since compilers do not move reads of uniforms out of loops.
struct Measure {
    // From pixels to the space in which paths are measured.
    metric: vec2<f32>,
    // How many frames of motion a trail is long.
    frames: f32,
    // How far beside a path a pixel may lie, in frames of motion.
    beside: f32,
}

fn measure() -> Measure {
    let uv = parameters.metric == METRIC_UV;
    let frames = frame.exposure * parameters.intensity;
    return Measure(
        select(vec2<f32>(1.0), 1.0 / vec2<f32>(frame.size), uv),
        frames,
        parameters.perpendicular_tolerance * frames,
    );
}

// Set in the seed of a place that moves.
const MOVES = 0x80000000u;
// Set in a seed that passed over the pixel that holds it.
const PASSED = 0x8000u;

fn packed(pixel: vec2<i32>, motion: vec2<f32>) -> u32 {
    return u32(pixel.x) | (u32(pixel.y) << 16u) | select(0u, MOVES, moves(motion));
}

fn unpacked(seed: u32) -> vec2<i32> {
    return vec2<i32>(vec2<u32>(seed & 0x7fffu, (seed & ~MOVES) >> 16u));
}

fn moves(motion: vec2<f32>) -> bool {
    return dot(motion, motion) > STILL;
}

// A surface and how it moves.
struct Surface {
    // In pixels per frame.
    motion: vec2<f32>,
    // In metres.
    depth: f32,
    // Longest difference between the motion here and one pixel further right, down, or both, in the space in which
    // paths are measured; 0 where fetches are not mixed.
    doubt: f32,
}

fn surface_of(pixel: vec2<i32>) -> Surface {
    let texel = textureLoad(surfaces, pixel, 0);
    return Surface(texel.xy, texel.z, texel.w);
}

// Where a position between texels takes its values from.
fn mixed_at(position: vec2<f32>) -> Corners {
    if parameters.fetch == FETCH_BILINEAR {
        return corners(position);
    }
    let pixel = pixel_at(position);
    return Corners(pixel, pixel, vec2<f32>(0.0));
}

fn mixed(at: Corners) -> Surface {
    let top_left = textureLoad(surfaces, at.low, 0);
    let top_right = textureLoad(surfaces, vec2<i32>(at.high.x, at.low.y), 0);
    let bottom_left = textureLoad(surfaces, vec2<i32>(at.low.x, at.high.y), 0);
    let bottom_right = textureLoad(surfaces, at.high, 0);
    let top = blend(top_left, top_right, at.fraction.x);
    let bottom = blend(bottom_left, bottom_right, at.fraction.x);
    let motion = blend(top, bottom, at.fraction.y).xy;
    let depths = vec4<f32>(top_left.z, top_right.z, bottom_left.z, bottom_right.z);
    return Surface(motion, mixed_depth(depths, at.fraction), 0.0);
}

// Of the texels top left, top right, bottom left and bottom right: mixed as the inverse, and at a texel that texel's; in a
// map of 16 bits also what all four have.
fn mixed_depth(depths: vec4<f32>, fraction: vec2<f32>) -> f32 {
    let inverse = 1.0 / depths;
    let rows = inverse.xz + fraction.x * (inverse.yw - inverse.xz);
    let between = 1.0 / (rows.x + fraction.y * (rows.y - rows.x));
    let level = parameters.map == MAP_FLOAT16 && all(depths == depths.xxxx);
    return select(between, depths.x, level || all(fraction == vec2<f32>(0.0)));
}

// Rounds a fraction of a side towards zero to 16 bits. Vulkan leaves the rounding of a store to the driver; Direct3D
// prescribes this one, and Mesa's llvmpipe has it. A quotient that misses a 16-bit number by its last bits is that
// number, however a GPU divides. No centre of a pixel lies below 2^-14 in a picture of up to 8192 pixels.
fn half(fraction: vec2<f32>) -> vec2<f32> {
    return bitcast<vec2<f32>>((bitcast<vec2<u32>>(fraction) + 3u) & vec2<u32>(0xffffe000u));
}

// The position that comes back from the map, which holds fractions of width and height.
fn stored(position: vec2<f32>) -> vec2<f32> {
    if parameters.map != MAP_FLOAT16 {
        return position;
    }
    let size = vec2<f32>(frame.size);
    return half(position / size) * size;
}

// The place of the source that a seed names. Only what an earlier step of the dilation stored went through the map.
fn place(seed: u32, steps_before: u32) -> vec2<f32> {
    let position = centre(unpacked(seed));
    if steps_before == 0u {
        return position;
    }
    return stored(position);
}

// The surface at that place.
fn source_of(seed: u32, steps_before: u32) -> Surface {
    if parameters.map == MAP_FLOAT16 && steps_before > 0u {
        return mixed(mixed_at(place(seed, steps_before)));
    }
    return surface_of(unpacked(seed));
}

// How far the trails of the workgroup's tile reach left, up, right and down; floats from 0 are ordered as their bits.
var<workgroup> tile_trails: array<atomic<u32>, 4>;

// How far beyond a pixel its trail reaches: left, up, right, down. A pixel lies on the trail where the source lies at
// most `trail_frames` ahead along the path and at most the tolerance beside it; rounding is given a pixel and a
// thousandth. 0 where nothing moves.
fn trail_of(motion: vec2<f32>) -> vec4<f32> {
    if !moves(motion) {
        return vec4<f32>(0.0);
    }
    let by = measure();
    let ahead = by.frames * max(vec4<f32>(motion, -motion), vec4<f32>(0.0));
    let beside = by.beside * abs(motion * by.metric).yx / by.metric;
    return 1.0 + 1.001 * (ahead + beside.xyxy);
}

fn velocity_at(position: vec2<f32>) -> vec2<f32> {
    if parameters.fetch == FETCH_BILINEAR {
        return bilinear(velocity, position).xy;
    }
    return textureLoad(velocity, pixel_at(position), 0).xy;
}

// How far the trail of what a map of 16 bits holds in the place of a pixel reaches beyond that pixel.
fn trail_of_stored(pixel: vec2<i32>) -> vec4<f32> {
    let position = stored(centre(pixel));
    let trail = trail_of(velocity_at(position));
    let shift = abs(position - centre(pixel)).xyxy;
    return select(vec4<f32>(0.0), trail + shift, trail > vec4<f32>(0.0));
}

// Gathers what is known of each pixel, and of each tile.
@compute @workgroup_size(16, 16)
fn pack(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(workgroup_id) tile: vec3<u32>,
    @builtin(local_invocation_index) index: u32,
) {
    let pixel = vec2<i32>(id.xy);
    if inside(pixel) {
        let metric = measure().metric;
        let next = min(pixel + 1, frame.size - 1);
        let motion = textureLoad(velocity, pixel, 0).xy;
        let right = (textureLoad(velocity, vec2<i32>(next.x, pixel.y), 0).xy - motion) * metric;
        let below = (textureLoad(velocity, vec2<i32>(pixel.x, next.y), 0).xy - motion) * metric;
        let across = (textureLoad(velocity, next, 0).xy - motion) * metric;
        let longest = sqrt(max(max(dot(right, right), dot(below, below)), dot(across, across)));
        let doubt = select(0.0, longest, parameters.fetch == FETCH_BILINEAR);
        textureStore(surfaces_out, pixel, vec4<f32>(motion, textureLoad(depth, pixel, 0).x, doubt));
        textureStore(seeds_out, pixel, vec4<u32>(packed(pixel, motion)));
        var trail = trail_of(motion);
        if parameters.map == MAP_FLOAT16 {
            trail = max(trail, trail_of_stored(pixel));
        }
        let ordered = bitcast<vec4<u32>>(trail);
        for (var side = 0; side < 4; side++) {
            atomicMax(&tile_trails[side], ordered[side]);
        }
    }
    workgroupBarrier();
    if index == 0u {
        let trail = vec4<u32>(
            atomicLoad(&tile_trails[0]),
            atomicLoad(&tile_trails[1]),
            atomicLoad(&tile_trails[2]),
            atomicLoad(&tile_trails[3]),
        );
        textureStore(trails_out, tile.xy, bitcast<vec4<f32>>(trail));
    }
}

// How many tiles away a source may lie: the dilation carries it no further.
fn tiles_in_reach() -> i32 {
    let pixels = f32((1 << u32(parameters.passes)) - 1) * f32(parameters.step_multiplier);
    return i32(ceil(pixels / f32(TILE))) + 1;
}

// Whether trails that reach so far back (left or up) and ahead (right or down) come from one tile to another, that many
// tiles further.
fn comes_to(back: f32, ahead: f32, tiles: i32) -> bool {
    // From the nearest pixel of one to the nearest of the other.
    let gap = f32(abs(tiles) * TILE - (TILE - 1));
    return select(ahead, back, tiles < 0) >= gap && max(back, ahead) > 0.0;
}

@compute @workgroup_size(8, 8)
fn reach_along_rows(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    let last = (frame.size.x - 1) / TILE;
    var up_and_down = vec2<f32>(0.0);
    for (var x = max(0, tile.x - tiles_in_reach()); x <= min(last, tile.x + tiles_in_reach()); x++) {
        let trail = textureLoad(trails, vec2<i32>(x, tile.y), 0);
        if comes_to(trail.x, trail.z, tile.x - x) {
            up_and_down = max(up_and_down, trail.yw);
        }
    }
    textureStore(row_trails_out, tile, vec4<f32>(up_and_down, 0.0, 0.0));
}

@compute @workgroup_size(8, 8)
fn reach_along_columns(@builtin(global_invocation_id) id: vec3<u32>) {
    let tile = vec2<i32>(id.xy);
    let last = (frame.size.y - 1) / TILE;
    var any = false;
    for (var y = max(0, tile.y - tiles_in_reach()); y <= min(last, tile.y + tiles_in_reach()); y++) {
        let trail = textureLoad(row_trails, vec2<i32>(tile.x, y), 0);
        any |= comes_to(trail.x, trail.y, tile.y - y);
    }
    textureStore(reached_out, tile, vec4<u32>(u32(any)));
}

fn is_reached(pixel: vec2<i32>) -> bool {
    return textureLoad(reached, pixel / TILE, 0).x != 0u;
}

struct Fitness {
    // When the source was here, in frames before the instant.
    frames: f32,
    valid: bool,
}

// Whether a surface at `source` passed over `position` while the shutter was open.
fn fitness(
    by: Measure,
    position: vec2<f32>,
    source: vec2<f32>,
    motion: vec2<f32>,
    steps_before: u32,
) -> Fitness {
    var path = motion * by.metric;
    var offset = (source - position) * by.metric;
    // What came through a map of 16 bits the demo measures between fractions: their last bits decide where a source lies
    // exactly at the end of a trail.
    if parameters.map == MAP_FLOAT16 && parameters.metric == METRIC_UV && steps_before > 0u {
        let size = vec2<f32>(frame.size);
        path = motion / size;
        offset = source / size - position / size;
    }
    let along = dot(path, offset) / dot(path, path);
    let beside = abs(path.y * offset.x - path.x * offset.y) / dot(path, path);
    let middle = 0.5 * by.frames;
    let on_trail = abs(along - middle) <= middle;
    return Fitness(along, moves(motion) && on_trail && beside <= by.beside);
}

@compute @workgroup_size(8, 8)
fn dilate(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    if !is_reached(pixel) {
        // It does not move either, or its own trail would reach it.
        textureStore(seeds_out, pixel, vec4<u32>(packed(pixel, vec2<f32>(0.0))));
        return;
    }
    let by = measure();
    let size = frame.size;
    let here = centre(pixel);
    let step = (1 << (frame.iterations - 1u - frame.iteration)) * parameters.step_multiplier;
    var best_seed = 0u;
    var best_depth = 0.0;
    var found = false;
    for (var i = select(1, 0, parameters.kernel == KERNEL_WITH_CENTRE); i < 9; i++) {
        let offset = (vec2<u32>(KERNEL_X, KERNEL_Y) >> vec2<u32>(2u * u32(i))) & vec2<u32>(3u);
        let neighbour = pixel + step * (vec2<i32>(offset) - 1);
        if any(neighbour < vec2<i32>(0)) || any(neighbour >= size) {
            continue;
        }
        let seed = textureLoad(seeds, neighbour, 0).x;
        if (seed & MOVES) == 0u {
            continue;
        }
        let source = source_of(seed, frame.iteration);
        let candidate = fitness(by, here, place(seed, frame.iteration), source.motion, frame.iteration);
        if candidate.valid && (!found || source.depth < best_depth) {
            found = true;
            best_depth = source.depth;
            best_seed = seed | PASSED;
        }
    }
    if !found {
        best_seed = packed(pixel, surface_of(pixel).motion);
    }
    if parameters.map == MAP_FLOAT16 {
        // At its rounded place a still pixel may move, and a moving one stand still.
        let moving = moves(source_of(best_seed, 1u).motion);
        best_seed = select(best_seed & ~MOVES, best_seed | MOVES, moving);
    }
    textureStore(seeds_out, pixel, vec4<u32>(best_seed));
}

// Largest step of the dilation, in the space in which paths are measured.
fn reach() -> f32 {
    let pixels = f32((1 << u32(parameters.passes - 1)) * parameters.step_multiplier);
    let side = f32(max(frame.size.x, frame.size.y));
    return select(pixels, pixels / side, parameters.metric == METRIC_UV);
}

fn within_reach(by: Measure, frames: f32, motion: vec2<f32>, reaches: f32) -> f32 {
    let quotient = reach() / (length(motion * by.metric) * by.frames);
    return select(frames, min(frames, reaches * quotient), parameters.reach_cap != REACH_NONE);
}

// How much another path differs from `path`, relative to it; not cut at 1 yet. `sensitivity`: parallel, perpendicular.
fn path_difference(sensitivity: vec2<f32>, path: vec2<f32>, other: vec2<f32>) -> f32 {
    let change = path - other;
    let parallel = abs(dot(change, path)) / dot(path, path);
    let perpendicular = abs(change.x * path.y - change.y * path.x) / dot(path, path);
    return sensitivity.x * parallel + sensitivity.y * perpendicular;
}

// How much paths of a mixture of a texel and its neighbours differ from `path` at the least. Both parts of a difference
// are at most as long as the change of the path, so the sum of their weights bounds what the neighbours may take away;
// rounding is given a hundred-thousandth.
fn least_difference(sensitivity: vec2<f32>, path: vec2<f32>, texel: vec4<f32>, metric: vec2<f32>) -> f32 {
    let other = texel.xy * metric;
    let slack = 1e-5 * (length(path) + length(other));
    let taken = (sensitivity.x + sensitivity.y) * (texel.w + slack) / length(path);
    return path_difference(sensitivity, path, other) - taken;
}

// Whether a surface lies as deep as a source, in the demo's device depth.
fn at_depth(surface_depth: f32, source_depth: f32) -> bool {
    let device = parameters.near_plane / vec2<f32>(surface_depth, source_depth);
    return abs(device.x - device.y) < parameters.depth_match;
}

// What the map shows of a position where `surface` lies.
fn shown_from(position: vec2<f32>, surface: Surface) -> Surface {
    if parameters.map == MAP_FLOAT16 {
        return mixed(mixed_at(stored(position)));
    }
    return surface;
}

@compute @workgroup_size(8, 8)
fn backtrack(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let by = measure();
    let probes = parameters.probes;
    let threshold = parameters.match_threshold;
    let sensitivity = vec2<f32>(parameters.parallel_sensitivity, parameters.perpendicular_sensitivity);
    let third = parameters.way_back == WAY_BACK_THIRD_MATCH;
    let enough = select(1, 3, third);
    let here = centre(pixel);
    let seed = textureLoad(seeds, pixel, 0).x;
    let before = u32(parameters.passes - 1);
    let source = source_of(seed, before);
    let own = surface_of(pixel);
    // Its own source has no way back, unless the map moved it.
    let another = any(unpacked(seed) != pixel) || parameters.map == MAP_FLOAT16;
    let walks = (seed & PASSED) != 0u && another && own.depth >= source.depth;
    let path = source.motion * by.metric;
    let arrival = fitness(by, here, place(seed, before), source.motion, before).frames;
    let frames = within_reach(by, arrival, source.motion, 1.0);
    var hits = 0;
    var ends = false;
    var last_hit = here;
    var hit = own;
    var probe = select(probes + 1, -probes, walks);
    while probe <= probes && !ends {
        var position = here;
        var misses = false;
        // To the next probe that may be like the source, or that ends a row of hits.
        while probe <= probes {
            let back = frames * (1.0 + f32(probe) / f32(probes));
            position = here + source.motion * back;
            if back <= by.frames + PROBE_SLACK && back >= NO_TIME && on_screen(position) {
                let texel = textureLoad(surfaces, mixed_at(position).low, 0);
                misses = saturate(least_difference(sensitivity, path, texel, by.metric)) > threshold;
                if !misses || hits > 0 {
                    break;
                }
            }
            probe++;
        }
        if probe > probes {
            break;
        }
        if !misses {
            let other = mixed(mixed_at(position));
            misses = saturate(path_difference(sensitivity, path, other.motion * by.metric)) > threshold
                || (third && !at_depth(other.depth, source.depth));
            if !misses {
                hits++;
                last_hit = position;
                hit = other;
            }
        }
        ends = hits == enough || (hits > 0 && misses);
        probe++;
    }
    var shown = shown_from(here, own);
    if ends {
        shown = shown_from(last_hit, hit);
    }
    textureStore(sources_out, pixel, vec4<f32>(shown.motion, shown.depth, 0.0));
}

// What a pixel gathers along.
struct Trail {
    // Where it starts, in pixels, and where it leads from there.
    start: vec2<f32>,
    leads: vec2<f32>,
    // Of its source, in the space in which paths are measured, and in metres.
    path: vec2<f32>,
    depth: f32,
    // In [0, 1).
    noise: f32,
}

// Position of tap i.
fn tap(trail: Trail, i: i32) -> vec2<f32> {
    let steps = f32(max(1, parameters.samples - 1));
    var along = f32(i) / steps;
    switch parameters.jitter {
        case JITTER_STEP_SCALE: {
            along *= 0.5 + trail.noise;
        }
        case JITTER_START_OFFSET: {
            along = (f32(i) + trail.noise) / f32(parameters.samples);
        }
        case JITTER_STEP_OFFSET: {
            along = (f32(i) + trail.noise - 1.0) / steps;
        }
        default: {}
    }
    return trail.start + trail.leads * along;
}

// The first tap that is not the pixel itself: with shifted taps, the first of them stands for it.
fn first_tap() -> i32 {
    return select(1, 0, parameters.jitter == JITTER_START_OFFSET);
}

// How much a tap counts whose source has the path `other`.
fn tap_weight(trail: Trail, other: vec2<f32>, depth: f32) -> f32 {
    let change = trail.path - other;
    let slower = saturate(dot(change, trail.path) / dot(trail.path, trail.path));
    let mismatch = select(0.0, pow(slower, parameters.mismatch_exponent), slower > 0.0);
    let in_front = saturate(1.0 - (depth - trail.depth) / parameters.foreground_extent);
    return 1.0 - in_front * mismatch;
}

fn depth_at(position: vec2<f32>) -> f32 {
    let at = mixed_at(position);
    let depths = vec4<f32>(
        textureLoad(depth, at.low, 0).x,
        textureLoad(depth, vec2<i32>(at.high.x, at.low.y), 0).x,
        textureLoad(depth, vec2<i32>(at.low.x, at.high.y), 0).x,
        textureLoad(depth, at.high, 0).x,
    );
    return mixed_depth(depths, at.fraction);
}

// How much of a tap is taken from the tap itself, the rest being the pixel's own place.
fn tap_share(not_behind: f32, trail: Trail, position: vec2<f32>) -> f32 {
    let extent = parameters.foreground_extent;
    let in_front = saturate(1.0 - (depth_at(position) - extent - trail.depth) / extent);
    return max(not_behind, in_front);
}

fn mean_of_taps(here: vec4<f32>, trail: Trail, own_depth: f32, metric: vec2<f32>) -> vec4<f32> {
    let device = parameters.near_plane / vec2<f32>(trail.depth, own_depth);
    let not_behind = saturate(1.0 - (device.x - device.y) / parameters.behind_extent);
    let replaced = parameters.tap == TAP_REPLACED;
    var mean = here;
    var total = f32(first_tap());
    for (var i = first_tap(); i < parameters.samples; i++) {
        let position = tap(trail, i);
        if !on_screen(position) {
            break;
        }
        let other = textureLoad(sources, pixel_at(position), 0);
        let weight = tap_weight(trail, other.xy * metric, other.z);
        var taken_from = position;
        if replaced {
            taken_from = mix(trail.start, position, tap_share(not_behind, trail, position));
        }
        total += weight;
        if weight > 0.0 {
            mean += (bilinear(color, taken_from) - mean) * (weight / total);
        }
    }
    return mean;
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let by = measure();
    let here = textureLoad(color, pixel, 0);
    let source = textureLoad(sources, pixel, 0);
    let motion = source.xy;
    if !moves(motion) || by.frames == 0.0 {
        textureStore(output, pixel, here);
        return;
    }
    // The demo walks a cycle of 8 frames.
    let walk = f32(frame.frame_index % 8u) * vec2<f32>(47.0, 17.0) * 0.695;
    let reaches = select(1.0, 2.0, parameters.reach_cap == REACH_DOUBLE);
    let trail = Trail(
        centre(pixel),
        motion * within_reach(by, by.frames, motion, reaches),
        motion * by.metric,
        source.z,
        interleaved_gradient_noise(vec2<f32>(pixel) + walk),
    );
    let own_depth = textureLoad(depth, pixel, 0).x;
    textureStore(output, pixel, mean_of_taps(here, trail, own_depth, by.metric));
}
