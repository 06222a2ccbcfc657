// Guertin, McGuire and Nowrouzezahrai 2014, "A Fast and Stable Feature-Aware Motion Blur Filter".

struct Parameters {
    samples: i32,
    tile_size: i32,
    center_weight_divisor: f32,
    own_direction_ramp: f32,
    jitter: f32,
    tile_blend: f32,
    neighbor_rule: u32,
    split: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
// Half-velocity in pixels; distance along the view axis in metres; 0.
@group(0) @binding(5) var motion: texture_2d<f32>;
@group(0) @binding(6) var motion_out: texture_storage_2d<rgba32float, write>;
// Of a tile: the longest half-velocity, and the shortest length.
@group(0) @binding(7) var tiles: texture_2d<f32>;
@group(0) @binding(8) var tiles_out: texture_storage_2d<rgba32float, write>;
// Of a tile and those around it: the longest half-velocity that reaches the tile, and how much directions vary.
@group(0) @binding(9) var neighborhoods: texture_2d<f32>;
@group(0) @binding(10) var neighborhoods_out: texture_storage_2d<rgba32float, write>;
@group(0) @binding(11) var output: texture_storage_2d<rgba32float, write>;

const RULE_TOWARD = 0u;
const RULE_EITHER_WAY = 1u;
const SPLIT_BY_VARIANCE = 0u;

// In pixels.
const EPSILON = 1e-5;
// A half-velocity that is no longer than this stands still: half a pixel, and what rounding adds.
const STILL = 0.5001;

fn half_velocity(full: vec2<f32>) -> vec2<f32> {
    let half = 0.5 * frame.exposure * full;
    return half * (clamp(length(half), 0.5, f32(parameters.tile_size)) / (length(half) + EPSILON));
}

fn radius_of(half_velocity: vec2<f32>) -> f32 {
    return max(length(half_velocity), 0.5);
}

// Of length 1, or 0 for what has no direction.
fn direction_of(vector: vec2<f32>) -> vec2<f32> {
    return vector / max(length(vector), EPSILON);
}

// How surely the surface at depth `other` lies in front of that at `own`, or not behind it, relative to the nearer
// one. The paper's operands are swapped, since depth here grows into the screen; on inverse depth they are the paper's,
// with the same result.
fn in_front(own: f32, other: f32) -> f32 {
    return saturate(1.0 - (other - own) / min(own, other));
}

fn cone(distance: f32, radius: f32) -> f32 {
    return saturate(1.0 - distance / radius);
}

fn cylinder(distance: f32, radius: f32) -> f32 {
    return 1.0 - smoothstep(0.95 * radius, 1.05 * radius, distance);
}

@compute @workgroup_size(8, 8)
fn halve(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if inside(pixel) {
        let half = half_velocity(textureLoad(velocity, pixel, 0).xy);
        textureStore(motion_out, pixel, vec4<f32>(half, textureLoad(depth, pixel, 0).x, 0.0));
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

fn tile_count() -> vec2<i32> {
    return (frame.size + parameters.tile_size - 1) / parameters.tile_size;
}

// Whether the motion of the tile at an offset may reach the tile in the middle. One that is diagonally off does only if
// it heads there.
fn reaches(half_velocity: vec2<f32>, offset: vec2<i32>) -> bool {
    if offset.x == 0 || offset.y == 0 {
        return true;
    }
    switch parameters.neighbor_rule {
        case RULE_TOWARD: {
            return dot(half_velocity, vec2<f32>(offset)) < 0.0;
        }
        case RULE_EITHER_WAY: {
            // Within a quadrant about the diagonal, for a smear that goes both ways.
            return half_velocity.x * half_velocity.y * f32(offset.x * offset.y) > 0.0;
        }
        default: {
            return true;
        }
    }
}

@compute @workgroup_size(8, 8)
fn neighbor_max(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(local_invocation_index) index: u32,
) {
    share_tiles(tiles, tile_count(), group.xy, index);
    let middle = direction_of(tile_beside(local.xy, vec2<i32>(0)).xy);
    var region = NO_MOTION;
    var moving = 0.0;
    var agreement = 0.0;
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let offset = vec2<i32>(x, y);
            let neighbor = tile_beside(local.xy, offset);
            if reaches(neighbor.xy, offset) {
                region = merged(region, neighbor);
            }
            if length(neighbor.xy) > STILL {
                moving += 1.0;
                agreement += abs(dot(middle, direction_of(neighbor.xy)));
            }
        }
    }
    // Of the tiles that move; a tile without motion of its own has no direction to differ from.
    let variance = select(0.0, 1.0 - agreement / moving, any(middle != vec2<f32>(0.0)));
    if all(id.xy < textureDimensions(tiles)) {
        textureStore(neighborhoods_out, id.xy, vec4<f32>(region.xy, variance, 0.0));
    }
}

// In [0, 1); walks a cycle of 8 frames. Two streams for one pixel are `offset` apart.
fn noise_at(pixel: vec2<i32>, offset: f32) -> f32 {
    let walk = f32(frame.frame_index % 8u) * vec2<f32>(47.0, 17.0) * 0.695;
    return interleaved_gradient_noise(vec2<f32>(pixel) + walk + offset);
}

// The tile that a pixel asks: its own or, the more often the nearer their border is, the one across it. Only the nearest
// border counts, so never a tile that is diagonally off.
fn tile_of(pixel: vec2<i32>) -> vec2<i32> {
    let position = centre(pixel) / f32(parameters.tile_size);
    let tile = vec2<i32>(position);
    let from_middle = position - floor(position) - 0.5;
    let horizontal = abs(from_middle.x) > abs(from_middle.y);
    let aside = select(from_middle.y, from_middle.x, horizontal);
    let to_border = 0.5 - abs(aside);
    // Even odds at the border itself.
    let odds = 0.5 * saturate(1.0 - to_border / max(parameters.tile_blend, EPSILON));
    if noise_at(pixel, 37.0) >= odds {
        return tile;
    }
    let step = i32(sign(aside));
    let across = tile + select(vec2<i32>(0, step), vec2<i32>(step, 0), horizontal);
    return clamp(across, vec2<i32>(0), tile_count() - 1);
}

// Whether tap i goes along the pixel's own direction, which a part `variance` of them does, spread evenly.
fn is_own(i: i32, variance: f32) -> bool {
    if parameters.split == SPLIT_BY_VARIANCE {
        return floor(f32(i + 1) * variance) > floor(f32(i) * variance);
    }
    return i % 2 == 1;
}

// The pixel's own direction for the weights. The slower the pixel, the more it is across the longest motion, so that
// what it does not share does not blur it.
fn center_direction(longest: vec2<f32>, own: vec2<f32>) -> vec2<f32> {
    let along = direction_of(longest);
    let left = vec2<f32>(-along.y, along.x);
    let across = select(left, -left, dot(left, own) < 0.0);
    let trust = saturate((length(own) - 0.5) / parameters.own_direction_ramp);
    return direction_of(mix(across, direction_of(own), trust));
}

@compute @workgroup_size(8, 8)
fn reconstruct(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let here = textureLoad(color, pixel, 0);
    let neighborhood = textureLoad(neighborhoods, tile_of(pixel), 0);
    let longest = neighborhood.xy;
    if length(longest) <= STILL {
        textureStore(output, pixel, here);
        return;
    }
    let own = textureLoad(motion, pixel, 0);
    let own_radius = radius_of(own.xy);
    let center = center_direction(longest, own.xy);
    let samples = f32(parameters.samples);
    let shift = (2.0 * noise_at(pixel, 0.0) - 1.0) * parameters.jitter / samples;
    // A running mean keeps a constant colour exactly as it is.
    var mean = here;
    var total = samples / (parameters.center_weight_divisor * own_radius);
    for (var i = 0; i < parameters.samples; i++) {
        let t = 2.0 * (f32(i) + shift + 1.0) / (samples + 1.0) - 1.0;
        let along = select(longest, own.xy, is_own(i, neighborhood.z));
        // Cut off, not rounded, as the paper has it.
        let tap = clamp(pixel + vec2<i32>(t * along), vec2<i32>(0), frame.size - 1);
        let other = textureLoad(motion, tap, 0);
        // Along the longest motion for both directions, as the paper has it.
        let distance = abs(t) * length(longest);
        let radius = radius_of(other.xy);
        let direction = direction_of(along);
        let center_aligned = abs(dot(center, direction));
        let tap_aligned = abs(dot(other.xy / radius, direction));
        // What smears over the pixel from in front of it.
        let over = in_front(own.z, other.z) * cone(distance, radius) * tap_aligned;
        // What the pixel, smeared itself, lets through from behind it.
        let behind = in_front(other.z, own.z) * cone(distance, own_radius) * center_aligned;
        // Both smeared over each other.
        let both = cylinder(distance, min(radius, own_radius)) * max(center_aligned, tap_aligned);
        let weight = over + behind + 2.0 * both;
        total += weight;
        if weight > 0.0 {
            mean += (textureLoad(color, tap, 0) - mean) * (weight / total);
        }
    }
    textureStore(output, pixel, mean);
}
