// Golan 2024, "Using the Jump Flood Algorithm to Dilate Velocity Maps", and the gather pass of its demo.
//
// The paper speaks of UV and of the velocity V that leads back to the previous frame; here positions are in pixels,
// exact at pixel centres, and motion is the forward one, u = -V.

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
// The best source found so far: its position in pixels; 0; 1 where there is one.
@group(0) @binding(5) var seeds: texture_2d<f32>;
@group(0) @binding(6) var seeds_out: texture_storage_2d<rgba32float, write>;
// The source that a pixel shows: its position in pixels; 0; 1 where the way back found no mover.
@group(0) @binding(7) var sources: texture_2d<f32>;
@group(0) @binding(8) var sources_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(9) var output: texture_storage_2d<rgba32float, write>;

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

// Squared motion, in pixels per frame, under which a pixel stands still. The paper compares with the smallest float,
// which GPUs may flush to zero.
const STILL = 1e-12;
// In frames; a probe nearer than this is the pixel itself.
const NO_TIME = 1e-12;
// Probes may pass the end of the trail by this much, in frames.
const PROBE_SLACK = 0.2;

// The order decides between sources of equal depth. The demo skips the centre.
const KERNEL = array<vec2<i32>, 9>(
    vec2<i32>(0, 0),
    vec2<i32>(1, 1),
    vec2<i32>(0, 1),
    vec2<i32>(-1, 1),
    vec2<i32>(1, 0),
    vec2<i32>(1, -1),
    vec2<i32>(-1, 0),
    vec2<i32>(-1, -1),
    vec2<i32>(0, -1),
);

// The paper's m: how many frames of motion a trail is long.
fn trail_frames() -> f32 {
    return frame.exposure * parameters.intensity;
}

// From pixels to the space in which paths are measured.
fn metric() -> vec2<f32> {
    return select(vec2<f32>(1.0), 1.0 / vec2<f32>(frame.size), parameters.metric == METRIC_UV);
}

// Largest step of the dilation, in the space in which paths are measured. The paper takes the longer side of the
// image for both axes, which cuts vertical trails of a wide image shorter.
fn reach() -> f32 {
    let pixels = f32((1 << u32(parameters.passes - 1)) * parameters.step_multiplier);
    let side = f32(max(frame.size.x, frame.size.y));
    return select(pixels, pixels / side, parameters.metric == METRIC_UV);
}

// `frames` of motion, cut at `reaches` times the dilation's reach. The quotient is the paper's; it is a time only for m = 1.
fn within_reach(frames: f32, motion: vec2<f32>, reaches: f32) -> f32 {
    let quotient = reach() / (length(motion * metric()) * trail_frames());
    return select(frames, min(frames, reaches * quotient), parameters.reach_cap != REACH_NONE);
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

// The place of the source that a texel of `seeds` names. Only what an earlier step of the dilation stored went through
// the map. `seeds` itself names pixels, so that nothing is rounded twice.
fn place(seed: vec2<f32>, steps_before: u32) -> vec2<f32> {
    if steps_before == 0u {
        return seed;
    }
    return stored(seed);
}

fn motion_at(position: vec2<f32>) -> vec2<f32> {
    if parameters.fetch == FETCH_BILINEAR {
        return bilinear(velocity, position).xy;
    }
    return textureLoad(velocity, pixel_at(position), 0).xy;
}

// Distance along the view axis. The demo filters the depth buffer, which holds near plane / distance: between texels
// the inverse is linear, and the far value of the background does no harm.
fn depth_at(position: vec2<f32>) -> f32 {
    if parameters.fetch != FETCH_BILINEAR {
        return textureLoad(depth, pixel_at(position), 0).x;
    }
    let at = corners(position);
    // At a texel the depth is that texel's, to the last bit: comparisons of a source with itself must not hang on how
    // a compiler rounds two inversions.
    if all(at.fraction == vec2<f32>(0.0)) {
        return textureLoad(depth, at.low, 0).x;
    }
    let depths = vec4<f32>(
        textureLoad(depth, at.low, 0).x,
        textureLoad(depth, vec2<i32>(at.high.x, at.low.y), 0).x,
        textureLoad(depth, vec2<i32>(at.low.x, at.high.y), 0).x,
        textureLoad(depth, at.high, 0).x,
    );
    // A map of 16 bits moves sources off their texels, and leaves them as deep as their neighbours on a level surface.
    if parameters.map == MAP_FLOAT16 && all(depths == depths.xxxx) {
        return depths.x;
    }
    let inverse = 1.0 / depths;
    let rows = inverse.xz + at.fraction.x * (inverse.yw - inverse.xz);
    return 1.0 / (rows.x + at.fraction.y * (rows.y - rows.x));
}

struct Fitness {
    // When the source was here, in frames before the instant.
    frames: f32,
    // Of the source, in metres.
    depth: f32,
    valid: bool,
}

// Whether the surface at `source` passed over `position` while the shutter was open (sample_fitness of the paper).
fn fitness(position: vec2<f32>, source: vec2<f32>, steps_before: u32) -> Fitness {
    let motion = motion_at(source);
    if dot(motion, motion) <= STILL {
        return Fitness(0.0, 0.0, false);
    }
    var path = motion * metric();
    var offset = (source - position) * metric();
    // What came through a map of 16 bits the demo measures between fractions: their last bits decide where a source lies
    // exactly at the end of a trail.
    if parameters.map == MAP_FLOAT16 && parameters.metric == METRIC_UV && steps_before > 0u {
        let size = vec2<f32>(frame.size);
        path = motion / size;
        offset = source / size - position / size;
    }
    let along = dot(path, offset) / dot(path, path);
    let beside = abs(path.y * offset.x - path.x * offset.y) / dot(path, path);
    let middle = 0.5 * trail_frames();
    let on_trail = abs(along - middle) <= middle;
    let on_path = beside <= parameters.perpendicular_tolerance * trail_frames();
    return Fitness(along, depth_at(source), on_trail && on_path);
}

// How much `other` differs from `motion`, relative to it, in [0, 1] (get_motion_difference of the paper).
fn motion_difference(motion: vec2<f32>, other: vec2<f32>) -> f32 {
    let path = motion * metric();
    let change = path - other * metric();
    let parallel = abs(dot(change, path)) / dot(path, path);
    let perpendicular = abs(change.x * path.y - change.y * path.x) / dot(path, path);
    return saturate(
        parameters.parallel_sensitivity * parallel
            + parameters.perpendicular_sensitivity * perpendicular,
    );
}

// Every pixel begins as its own source. The demo's first iteration reads the neighbours themselves instead of a map,
// which comes to the same.
@compute @workgroup_size(8, 8)
fn seed(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if inside(pixel) {
        textureStore(seeds_out, pixel, vec4<f32>(centre(pixel), 0.0, 0.0));
    }
}

// One step of the flood: of what the neighbours hold, keep the nearest to the camera that passed over this pixel.
@compute @workgroup_size(8, 8)
fn dilate(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let step = (1 << (frame.iterations - 1u - frame.iteration)) * parameters.step_multiplier;
    var best = Fitness(0.0, 0.0, false);
    var best_seed = centre(pixel);
    for (var i = select(1, 0, parameters.kernel == KERNEL_WITH_CENTRE); i < 9; i++) {
        var kernel = KERNEL;
        let neighbour = pixel + step * kernel[i];
        if !inside(neighbour) {
            continue;
        }
        let seed = textureLoad(seeds, neighbour, 0).xy;
        let candidate = fitness(centre(pixel), place(seed, frame.iteration), frame.iteration);
        if candidate.valid && (!best.valid || candidate.depth < best.depth) {
            best = candidate;
            best_seed = seed;
        }
    }
    textureStore(seeds_out, pixel, vec4<f32>(best_seed, 0.0, f32(best.valid)));
}

// Rejects sources behind the pixel, and walks from the pixel towards the source for what moves like it, so that what the
// flood carried sideways falls away. The demo does this at the end of its last iteration.
@compute @workgroup_size(8, 8)
fn backtrack(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let here = centre(pixel);
    let found = textureLoad(seeds, pixel, 0);
    let steps_before = u32(parameters.passes - 1);
    let source = place(found.xy, steps_before);
    let best = fitness(here, source, steps_before);
    if found.w == 0.0 || depth_at(here) < best.depth {
        textureStore(sources_out, pixel, vec4<f32>(stored(here), 0.0, 0.0));
        return;
    }
    let motion = motion_at(source);
    // Of the demo's two cuts, two days later, only that of the gather is doubled.
    let frames = within_reach(best.frames, motion, 1.0);
    let third = parameters.way_back == WAY_BACK_THIRD_MATCH;
    let enough = select(1, 3, third);
    var hits = 0;
    var last_hit = here;
    for (var probe = -parameters.probes; probe <= parameters.probes; probe++) {
        let back = frames * (1.0 + f32(probe) / f32(parameters.probes));
        let position = here + motion * back;
        // A probe that is left out is no miss.
        if back > trail_frames() + PROBE_SLACK || back < NO_TIME || !on_screen(position) {
            continue;
        }
        var matches = motion_difference(motion, motion_at(position)) <= parameters.match_threshold;
        if third && matches {
            matches = at_depth(position, best.depth);
        }
        if matches {
            hits++;
            last_hit = position;
        }
        // Hits that the last probe cuts short count nothing.
        if hits == enough || (hits > 0 && !matches) {
            textureStore(sources_out, pixel, vec4<f32>(stored(last_hit), 0.0, 0.0));
            return;
        }
    }
    textureStore(sources_out, pixel, vec4<f32>(stored(here), 0.0, 1.0));
}

// Whether a position lies as deep as a source, in the demo's device depth.
fn at_depth(position: vec2<f32>, source_depth: f32) -> bool {
    let device = parameters.near_plane / vec2<f32>(depth_at(position), source_depth);
    return abs(device.x - device.y) < parameters.depth_match;
}

// How much a tap counts whose source is `other`: less where that lies in front of `source` and moves otherwise.
fn tap_weight(source: vec2<f32>, other: vec2<f32>) -> f32 {
    let path = motion_at(source) * metric();
    let change = path - motion_at(other) * metric();
    let slower = saturate(dot(change, path) / dot(path, path));
    let mismatch = select(0.0, pow(slower, parameters.mismatch_exponent), slower > 0.0);
    let behind = depth_at(other) - depth_at(source);
    let in_front = saturate(1.0 - behind / parameters.foreground_extent);
    return 1.0 - in_front * mismatch;
}

// How much of a tap is taken from the tap itself, the rest being the pixel's own place (the demo of two days later, which
// weighs taps as well): all of it where the pixel is not behind its source, or where the tap is not behind it.
fn tap_share(here: vec2<f32>, source: vec2<f32>, tap: vec2<f32>) -> f32 {
    let device = parameters.near_plane / vec2<f32>(depth_at(source), depth_at(here));
    let not_behind = saturate(1.0 - (device.x - device.y) / parameters.behind_extent);
    let extent = parameters.foreground_extent;
    let in_front = saturate(1.0 - (depth_at(tap) - extent - depth_at(source)) / extent);
    return max(not_behind, in_front);
}

// Where tap i lies on the trail, 0 at the pixel and 1 at its end.
fn tap_position(i: i32, pixel: vec2<i32>) -> f32 {
    // The demo walks a cycle of 8 frames.
    let walk = f32(frame.frame_index % 8u) * vec2<f32>(47.0, 17.0) * 0.695;
    let noise = interleaved_gradient_noise(vec2<f32>(pixel) + walk);
    let even = f32(i) / f32(max(1, parameters.samples - 1));
    switch parameters.jitter {
        case JITTER_STEP_SCALE: {
            return even * (0.5 + noise);
        }
        case JITTER_START_OFFSET: {
            return (f32(i) + noise) / f32(parameters.samples);
        }
        case JITTER_STEP_OFFSET: {
            return (f32(i) + noise - 1.0) / f32(max(1, parameters.samples - 1));
        }
        default: {
            return even;
        }
    }
}

// Averages colours along the motion of the pixel's source (the demo's blur; the paper leaves it out).
@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let here = textureLoad(color, pixel, 0);
    let source = textureLoad(sources, pixel, 0).xy;
    let motion = motion_at(source);
    if dot(motion, motion) <= STILL || trail_frames() == 0.0 {
        textureStore(output, pixel, here);
        return;
    }
    let reaches = select(1.0, 2.0, parameters.reach_cap == REACH_DOUBLE);
    let trail = motion * within_reach(trail_frames(), motion, reaches);
    // A running mean keeps a constant colour exactly as it is. The pixel itself counts once: with shifted taps, the
    // first of them stands for it.
    var mean = here;
    var total = select(1.0, 0.0, parameters.jitter == JITTER_START_OFFSET);
    for (var i = i32(total); i < parameters.samples; i++) {
        let position = centre(pixel) + trail * tap_position(i, pixel);
        if !on_screen(position) {
            break;
        }
        let other = textureLoad(sources, pixel_at(position), 0).xy;
        let weight = tap_weight(source, other);
        var taken_from = position;
        if parameters.tap == TAP_REPLACED {
            let share = tap_share(centre(pixel), source, position);
            taken_from = mix(centre(pixel), position, share);
        }
        total += weight;
        if weight > 0.0 {
            mean += (bilinear(color, taken_from) - mean) * (weight / total);
        }
    }
    textureStore(output, pixel, mean);
}
