// McGuire, Hennessy, Bukowski and Osman 2012, "A Reconstruction Filter for Plausible Motion Blur", and what two
// published implementations make of it.
//
// The paper's Z is negative into the screen; depth here is positive, so its depth comparison has its operands swapped.

struct Parameters {
    samples: i32,
    tile_size: i32,
    soft_extent: f32,
    center_weight: f32,
    near_plane: f32,
    far_plane: f32,
    depth_compare: u32,
    radius_range: u32,
    tile_lookup: u32,
    uniform_tiles: u32,
    direction: u32,
    taps: u32,
    jitter: u32,
    noise: u32,
    center_tap: u32,
    fetch: u32,
    distance: u32,
    cylinder_edge: u32,
    neighbor_rule: u32,
    own_direction_from: f32,
    only_own_direction_from: f32,
    camera_influence: f32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
// Half-velocity in pixels; depth as it is compared; 0.
@group(0) @binding(5) var motion: texture_2d<f32>;
@group(0) @binding(6) var motion_out: texture_storage_2d<rgba32float, write>;
// Of a tile: the longest half-velocity, and the shortest length.
@group(0) @binding(7) var tiles: texture_2d<f32>;
@group(0) @binding(8) var tiles_out: texture_storage_2d<rgba32float, write>;
// The same of a tile and the eight around it.
@group(0) @binding(9) var neighborhoods: texture_2d<f32>;
@group(0) @binding(10) var neighborhoods_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(11) var output: texture_storage_2d<rgba32float, write>;

const DEPTH_LINEAR = 0u;
const DEPTH_DEVICE = 1u;
const RADIUS_HALF_PIXEL_TO_TILE = 0u;
const LOOKUP_OWN = 0u;
const UNIFORM_TILES_ASSUMED = 1u;
const DIRECTION_ALTERNATE = 1u;
const TAPS_WIDENED = 1u;
const JITTER_HALF_STEP = 0u;
const JITTER_FULL_STEP = 1u;
const NOISE_SINE = 1u;
const CENTER_TAP_SKIPPED = 0u;
const FETCH_NEAREST = 0u;
const DISTANCE_TO_PIXEL = 0u;
const DISTANCE_TO_TAP = 1u;
const CYLINDER_SMOOTH = 0u;
const NEIGHBORS_ALL = 0u;

// The paper's epsilon, in pixels.
const EPSILON = 1e-5;
// A neighbourhood whose longest half-velocity is no longer than this stands still: half a pixel, and what rounding adds.
const STILL = 0.5001;
// In pixels: what rounding leaves of the motion of a camera that stands still.
const CAMERA_STILL = 1e-3;
// G3D: a neighbourhood counts as uniform if its shortest radius is at least this, in pixels and as part of the longest.
const UNIFORM_FROM = 4.0;
const UNIFORM_PART = 0.65;

// Smallest radius that divides, in pixels. Only the published repository lets motion have any length.
fn least_radius() -> f32 {
    return select(1e-8, 0.5, parameters.radius_range == RADIUS_HALF_PIXEL_TO_TILE);
}

fn radius_of(half_velocity: vec2<f32>) -> f32 {
    return max(length(half_velocity), least_radius());
}

// Motion in a whole frame. G3D takes a part of the camera's, and an object's own whole.
fn full_velocity(pixel: vec2<i32>) -> vec2<f32> {
    let full = textureLoad(velocity, pixel, 0).xy;
    if parameters.camera_influence == 1.0 {
        return full;
    }
    let camera = centre(pixel) - before_camera(centre(pixel), textureLoad(depth, pixel, 0).x);
    if length(camera) < CAMERA_STILL {
        return full;
    }
    return full - (1.0 - parameters.camera_influence) * camera;
}

fn half_velocity(full: vec2<f32>) -> vec2<f32> {
    let half = 0.5 * frame.exposure * full;
    let tile = f32(parameters.tile_size);
    if parameters.radius_range == RADIUS_HALF_PIXEL_TO_TILE {
        return half * (clamp(length(half), 0.5, tile) / (length(half) + EPSILON));
    }
    // The repository cuts the whole motion at the side of a tile, and halves it then.
    return half / max(1.0, length(half) / (0.5 * tile));
}

// Metres, or what a depth buffer between the two planes holds: 0 near, 1 far. Not 0 itself, which divides.
fn compared_depth(metres: f32) -> f32 {
    if parameters.depth_compare == DEPTH_LINEAR {
        return metres;
    }
    let scale = parameters.far_plane / (parameters.far_plane - parameters.near_plane);
    return clamp(scale * (1.0 - parameters.near_plane / metres), 1e-6, 1.0);
}

// How surely the surface at depth `other` lies in front of that at `own`, or not behind it.
fn in_front(own: f32, other: f32) -> f32 {
    if parameters.depth_compare <= DEPTH_DEVICE {
        return saturate(1.0 - (other - own) / parameters.soft_extent);
    }
    // The repository has the paper's order of operands and a depth that grows into the screen, which swaps front and
    // back.
    return saturate(1.0 - (own - other) / min(own, other));
}

fn cone(distance: f32, radius: f32) -> f32 {
    return saturate(1.0 - distance / radius);
}

fn cylinder(distance: f32, radius: f32) -> f32 {
    if parameters.cylinder_edge == CYLINDER_SMOOTH {
        return 1.0 - smoothstep(0.95 * radius, 1.05 * radius, distance);
    }
    return select(0.0, 1.0, distance <= radius);
}

@compute @workgroup_size(8, 8)
fn halve(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if inside(pixel) {
        let half = half_velocity(full_velocity(pixel));
        let z = compared_depth(textureLoad(depth, pixel, 0).x);
        textureStore(motion_out, pixel, vec4<f32>(half, z, 0.0));
    }
}

// One workgroup per tile: its invocations share the pixels.
@compute @workgroup_size(8, 8)
fn tile_max(
    @builtin(workgroup_id) tile: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(local_invocation_index) index: u32,
) {
    var region = NO_MOTION;
    for (var y = i32(local.y); y < parameters.tile_size; y += 8) {
        for (var x = i32(local.x); x < parameters.tile_size; x += 8) {
            let pixel = vec2<i32>(tile.xy) * parameters.tile_size + vec2<i32>(x, y);
            if inside(pixel) {
                let half = textureLoad(motion, pixel, 0).xy;
                region = merged(region, vec3<f32>(half, length(half)));
            }
        }
    }
    let whole = merged_over_group(index, region);
    if index == 0u {
        textureStore(tiles_out, tile.xy, vec4<f32>(whole, 0.0));
    }
}

// The repository has no tile for what is left over at the right and at the bottom.
fn tile_count() -> vec2<i32> {
    if parameters.tile_lookup == LOOKUP_OWN {
        return (frame.size + parameters.tile_size - 1) / parameters.tile_size;
    }
    return max(frame.size / parameters.tile_size, vec2<i32>(1));
}

// Whether the motion of the tile at an offset counts for the tile in the middle. G3D: on every axis that the offset has,
// it moves, and on a diagonal to both or from both.
fn reaches(half_velocity: vec2<f32>, offset: vec2<i32>) -> bool {
    if parameters.neighbor_rule == NEIGHBORS_ALL {
        return true;
    }
    let heading = sign(half_velocity * vec2<f32>(offset));
    return abs(heading.x + heading.y) == f32(abs(offset.x) + abs(offset.y));
}

@compute @workgroup_size(8, 8)
fn neighbor_max(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(local_invocation_index) index: u32,
) {
    share_tiles(tiles, tile_count(), group.xy, index);
    var region = NO_MOTION;
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let offset = vec2<i32>(x, y);
            var neighbor = tile_beside(local.xy, offset);
            if !reaches(neighbor.xy, offset) {
                neighbor = vec3<f32>(0.0, 0.0, neighbor.z);
            }
            region = merged(region, neighbor);
        }
    }
    if all(id.xy < textureDimensions(tiles)) {
        textureStore(neighborhoods_out, id.xy, vec4<f32>(region, 0.0));
    }
}

// Bilinear; past the border, the nearest texel or that of the opposite side.
fn mixed(image: texture_2d<f32>, position: vec2<f32>, size: vec2<i32>, wrap: bool) -> vec4<f32> {
    let base = floor(position - 0.5);
    let fraction = position - 0.5 - base;
    let texel = vec2<i32>(base);
    let low = select(clamp(texel, vec2<i32>(0), size - 1), (texel % size + size) % size, wrap);
    let high = select(clamp(texel + 1, vec2<i32>(0), size - 1), ((texel + 1) % size + size) % size, wrap);
    let top = blend(
        textureLoad(image, low, 0),
        textureLoad(image, vec2<i32>(high.x, low.y), 0),
        fraction.x,
    );
    let bottom = blend(
        textureLoad(image, vec2<i32>(low.x, high.y), 0),
        textureLoad(image, high, 0),
        fraction.x,
    );
    return blend(top, bottom, fraction.y);
}

fn neighborhood_of(pixel: vec2<i32>) -> vec3<f32> {
    if parameters.tile_lookup == LOOKUP_OWN {
        return textureLoad(neighborhoods, pixel / parameters.tile_size, 0).xyz;
    }
    // The repository stretches its tiles over the image, and filters between them.
    let count = tile_count();
    let position = centre(pixel) / vec2<f32>(frame.size) * vec2<f32>(count);
    return mixed(neighborhoods, position, count, false).xyz;
}

// In [0, 1).
fn noise_at(pixel: vec2<i32>) -> f32 {
    if parameters.noise == NOISE_SINE {
        // The repository's, the same in every frame; the bracket that should close before the last factor does not,
        // so this is spread like a sine and not evenly.
        let hash = dot(centre(pixel) / vec2<f32>(frame.size), vec2<f32>(12.9898, 78.233));
        return fract(sin(hash * 43758.5453));
    }
    // Walks a cycle of 8 frames.
    let walk = f32(frame.frame_index % 8u) * vec2<f32>(47.0, 17.0) * 0.695;
    return interleaved_gradient_noise(vec2<f32>(pixel) + walk);
}

// In steps between taps.
fn shift_of(pixel: vec2<i32>) -> f32 {
    switch parameters.jitter {
        case JITTER_HALF_STEP: {
            return noise_at(pixel) - 0.5;
        }
        case JITTER_FULL_STEP: {
            return 2.0 * noise_at(pixel) - 1.0;
        }
        default: {
            return 0.0;
        }
    }
}

// Where a tap lies, in half-velocities from the pixel.
fn tap_position(i: i32, shift: f32) -> f32 {
    let along = (f32(i) + shift + 1.0) / f32(parameters.samples + 1);
    if parameters.taps == TAPS_WIDENED {
        return clamp(2.4 * along - 1.2, -1.0, 1.0);
    }
    return 2.0 * along - 1.0;
}

// The directions that taps take by turns, as long as the neighbourhood's longest half-velocity.
struct Directions {
    even: vec2<f32>,
    odd: vec2<f32>,
}

fn directions(longest: vec2<f32>, own: vec2<f32>) -> Directions {
    if parameters.direction != DIRECTION_ALTERNATE {
        return Directions(longest, longest);
    }
    let own_radius = radius_of(own);
    let along_own = own * (length(longest) / own_radius);
    let even = select(longest, along_own, own_radius >= parameters.only_own_direction_from);
    return Directions(even, select(even, along_own, own_radius >= parameters.own_direction_from));
}

struct Tap {
    // As the weights take it; in pixels, but for the repository.
    distance: f32,
    // Length of its half-velocity.
    radius: f32,
    depth: f32,
    color: vec4<f32>,
}

fn tap_at(pixel: vec2<i32>, offset: vec2<f32>) -> Tap {
    let position = centre(pixel) + offset;
    let nearest = vec2<i32>(floor(position));
    var tap: Tap;
    switch parameters.distance {
        case DISTANCE_TO_PIXEL: {
            tap.distance = length(vec2<f32>(nearest - pixel));
        }
        case DISTANCE_TO_TAP: {
            tap.distance = length(offset);
        }
        default: {
            // The repository's unit error: fractions of the image, against radii in pixels.
            tap.distance = length(offset / vec2<f32>(frame.size));
        }
    }
    if parameters.fetch == FETCH_NEAREST {
        let texel = clamp(nearest, vec2<i32>(0), frame.size - 1);
        let other = textureLoad(motion, texel, 0);
        tap.radius = radius_of(other.xy);
        tap.depth = other.z;
        tap.color = textureLoad(color, texel, 0);
    } else {
        // The repository's samplers: velocity ends at the border, colour and the depth beside it begin anew.
        tap.radius = radius_of(mixed(motion, position, frame.size, false).xy);
        tap.depth = mixed(motion, position, frame.size, true).z;
        tap.color = mixed(color, position, frame.size, true);
    }
    return tap;
}

@compute @workgroup_size(8, 8)
fn reconstruct(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let here = textureLoad(color, pixel, 0);
    let neighborhood = neighborhood_of(pixel);
    let longest = length(neighborhood.xy);
    if longest <= STILL {
        textureStore(output, pixel, here);
        return;
    }
    let own = textureLoad(motion, pixel, 0);
    let own_radius = radius_of(own.xy);
    let along = directions(neighborhood.xy, own.xy);
    let uniform_tiles = parameters.uniform_tiles == UNIFORM_TILES_ASSUMED
        && neighborhood.z >= max(UNIFORM_FROM, UNIFORM_PART * longest);
    let shift = shift_of(pixel);
    // A running mean keeps a constant colour exactly as it is.
    var mean = here;
    var total = parameters.center_weight / max(own_radius, 0.5);
    for (var i = 0; i < parameters.samples; i++) {
        if parameters.center_tap == CENTER_TAP_SKIPPED && 2 * i == parameters.samples - 1 {
            continue;
        }
        let offset = select(along.even, along.odd, i % 2 == 1) * tap_position(i, shift);
        var tap = tap_at(pixel, offset);
        if uniform_tiles {
            tap.radius = longest;
        }
        // What smears over the pixel from in front of it.
        let over = in_front(own.z, tap.depth) * cone(tap.distance, tap.radius);
        // What the pixel, smeared itself, lets through from behind it.
        let behind = in_front(tap.depth, own.z) * cone(tap.distance, own_radius);
        // Both smeared over each other.
        let both = cylinder(tap.distance, tap.radius) * cylinder(tap.distance, own_radius);
        let weight = over + behind + 2.0 * both;
        total += weight;
        if weight > 0.0 {
            mean += (tap.color - mean) * (weight / total);
        }
    }
    textureStore(output, pixel, mean);
}
