// The object based motion blur of Babylon.js: one tap per pixel of a pixel's own motion.

struct Parameters {
    samples: i32,
    strength: f32,
    storage: u32,
    fetch: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var depth: texture_2d<f32>;
@group(0) @binding(5) var output: texture_storage_2d<rgba32float, write>;

const STORAGE_PACKED = 0u;
const FETCH_NEAREST = 0u;

// Depth from which nothing is drawn, in metres.
const SKY = 1e10;

// Motion in parts of width and height, as it comes out of 8 bits per axis that hold its cube root.
fn stored(motion: vec2<f32>) -> vec2<f32> {
    if parameters.storage != STORAGE_PACKED {
        return motion;
    }
    let root = pow(abs(motion), vec2<f32>(1.0 / 3.0)) * sign(motion) * 0.5 + 0.5;
    let bits = floor(saturate(root) * 255.0 + 0.5) / 255.0;
    let unpacked = bits * 2.0 - 1.0;
    return pow(abs(unpacked), vec2<f32>(3.0)) * sign(unpacked);
}

fn fetched(at: vec2<f32>) -> vec4<f32> {
    let position = at * vec2<f32>(frame.size);
    if parameters.fetch == FETCH_NEAREST {
        return textureLoad(color, pixel_at(position), 0);
    }
    return bilinear(color, position);
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let texel = 1.0 / vec2<f32>(frame.size);
    var motion = vec2<f32>(0.0);
    if textureLoad(depth, pixel, 0).x < SKY {
        motion = stored(textureLoad(velocity, pixel, 0).xy * texel) * (frame.exposure * parameters.strength);
    }
    let count = i32(clamp(length(motion / texel), 1.0, f32(parameters.samples)));
    // A pixel long. The engine takes the direction before it measures in pixels, which skews it where the picture is wide.
    let step = motion / max(length(motion), 1e-12) * texel;
    let first = 0.5 - 0.5 * f32(count);
    // The pixel itself stands for the first tap. A running mean keeps a constant colour exactly as it is.
    var mean = textureLoad(color, pixel, 0);
    for (var i = 1; i < count; i++) {
        let tap = fetched(centre(pixel) / vec2<f32>(frame.size) + step * (first + f32(i)));
        mean += (tap - mean) / f32(i + 1);
    }
    textureStore(output, pixel, mean);
}
