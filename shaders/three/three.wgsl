// The motion blur of three.js: an even gather along each pixel's own motion.

struct Parameters {
    samples: i32,
    blur_amount: f32,
    coordinates: u32,
    divisor: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var output: texture_storage_2d<rgba32float, write>;

const COORDINATES_DEVICE = 0u;
const DIVISOR_SAMPLES = 0u;

// From motion in pixels to the trail in pixels. Device coordinates are two wide, with +y up; texture coordinates are one
// wide, with +y down. The engine adds the one to the other.
fn conversion() -> vec2<f32> {
    return select(vec2<f32>(1.0), vec2<f32>(2.0, -2.0), parameters.coordinates == COORDINATES_DEVICE);
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let motion = textureLoad(velocity, pixel, 0).xy * frame.exposure * parameters.blur_amount;
    let trail = motion * conversion();
    // A running mean keeps a constant colour exactly as it is.
    var mean = textureLoad(color, pixel, 0);
    for (var i = 1; i <= parameters.samples; i++) {
        // From one step after the trail's end to one step beyond its other end.
        let along = f32(i) / f32(parameters.samples - 1) - 0.5;
        let tap = bilinear(color, centre(pixel) + along * trail);
        mean += (tap - mean) / f32(i + 1);
    }
    // The engine's divisor is one less than its number of fetches.
    let gain = select(1.0, f32(parameters.samples + 1) / f32(parameters.samples), parameters.divisor == DIVISOR_SAMPLES);
    textureStore(output, pixel, mean * gain);
}
