// An even gather on both sides of each pixel, along its own motion.

struct Parameters {
    samples: i32,
    intensity: f32,
    taps: u32,
    smoothing: u32,
}

@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var output: texture_storage_2d<rgba32float, write>;

const TAPS_MIDDLES = 0u;
const TAPS_SELF_FIRST = 2u;
const SMOOTHING_MEAN_OF_NINE = 1u;

// Motion of a pixel in a frame, in pixels; or the mean of its own and its eight neighbours'.
fn motion_at(pixel: vec2<i32>) -> vec2<f32> {
    if parameters.smoothing != SMOOTHING_MEAN_OF_NINE {
        return textureLoad(velocity, pixel, 0).xy;
    }
    var sum = vec2<f32>(0.0);
    for (var y = -1; y <= 1; y++) {
        for (var x = -1; x <= 1; x++) {
            let neighbour = clamp(pixel + vec2<i32>(x, y), vec2<i32>(0), frame.size - 1);
            sum += textureLoad(velocity, neighbour, 0).xy;
        }
    }
    return sum / 9.0;
}

// Place of a tap on the trail, from -1/2 behind the pixel to 1/2 ahead of it.
fn place(i: i32) -> f32 {
    if parameters.taps == TAPS_MIDDLES {
        return (f32(i) + 0.5) / f32(parameters.samples) - 0.5;
    }
    return f32(i) / f32(parameters.samples - 1) - 0.5;
}

@compute @workgroup_size(8, 8)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) {
        return;
    }
    let trail = motion_at(pixel) * frame.exposure * parameters.intensity;
    // A running mean keeps a constant colour exactly as it is.
    var mean = textureLoad(color, pixel, 0);
    var count = select(1.0, 0.0, parameters.taps == TAPS_MIDDLES);
    for (var i = select(0, 1, parameters.taps == TAPS_SELF_FIRST); i < parameters.samples; i++) {
        count += 1.0;
        mean += (bilinear(color, centre(pixel) + place(i) * trail) - mean) / count;
    }
    textureStore(output, pixel, mean);
}
